// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Actors and colours that the procedural scenes share.
 */
#ifndef cslfSceneActors_h
#define cslfSceneActors_h

#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

class vtkActor;
class vtkMapper;
class vtkPolyData;
class vtkRenderer;

namespace cslf
{
/// Adds an actor with this mapper, which the renderer keeps.
vtkActor* AddActor(vtkRenderer* renderer, vtkMapper* mapper);

/// Adds a surface in one colour.
vtkActor* AddSurface(vtkRenderer* renderer, vtkPolyData* data);

/// Adds a surface in the colours of its scalars, interpolated before they are mapped.
vtkActor* AddSurface(vtkRenderer* renderer, vtkPolyData* data, vtkScalarsToColors* colors);

///@{
/// Colours of a range of values: blue, white and red; dark violet, green and yellow; and those of
/// land, from valleys to snow.
vtkSmartPointer<vtkScalarsToColors> MakeCoolToWarm(double lowest, double highest);
vtkSmartPointer<vtkScalarsToColors> MakeViridis(double lowest, double highest);
vtkSmartPointer<vtkScalarsToColors> MakeLandColors(double lowest, double highest);
///@}
}

#endif
