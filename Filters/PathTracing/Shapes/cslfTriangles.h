// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of polygonal data, without those that cannot be traced.
 */
#ifndef cslfTriangles_h
#define cslfTriangles_h

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <glm/vec3.hpp>

#include <vector>

class vtkPolyData;

namespace cslf
{
/// Whether a point's coordinates are finite numbers that a float can hold.
bool IsFinite(const glm::dvec3& point);

/// A point of a data object.
glm::dvec3 GetPoint(vtkPolyData* data, vtkIdType index);

/// Whether a cell of the data, counted over all kinds, belongs to another piece or is hidden.
bool IsGhost(vtkPolyData* data, vtkIdType cell);

struct TriangleSelection
{
  vtkSmartPointer<vtkPolyData> Surface; ///< triangles, with their point and cell data
  std::vector<vtkIdType> Cells;         ///< with finite corners and some area, without ghosts
  vtkIdType Removed = 0;                ///< the number of polygons and triangles with other corners
};

/// Triangulates polygons and strips.
TriangleSelection SelectTriangles(vtkPolyData* data);
}

#endif
