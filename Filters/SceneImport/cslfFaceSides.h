// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Imports how an actor draws the two sides of its faces: culling and properties of back faces.
 */
#ifndef cslfFaceSides_h
#define cslfFaceSides_h

#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkActor;

namespace cslf
{
/// A block that is visible from some sides.
struct FaceSide
{
  vtkSmartPointer<vtkPolyData> Block; ///< its field data defines the sides, unless it is both
  vtkSmartPointer<vtkProperty> Property;
  bool IsBack = false; ///< whether the property is that of back faces
};

/// Whether an actor draws the sides of its faces differently.
bool HasDifferentSides(vtkActor* actor);

/// Divides a block of polygons, and perhaps lines and vertices, by how the actor draws the sides of
/// its faces. As in VTK's window, the front is where corners run counterclockwise on the screen, so
/// a reflection turns fronts into backs. `isReflected` says whether the block's matrix was a
/// reflection; instances are examined one by one. If the block has its own colours, VTK ignores the
/// property of back faces. Visible sides that the block's data sets take precedence over culling.
std::vector<FaceSide> DivideBySides(
  vtkActor* actor, vtkPolyData* block, bool isReflected, bool isColored);
}

#endif
