// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of polygonal data, without those that cannot be traced.
 */
#ifndef cslfTriangles_h
#define cslfTriangles_h

#include "Pipeline/cslfTriangleList.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <vector>

class vtkPolyData;

namespace cslf
{
/// Whether a cell of the data, counted over all kinds, belongs to another piece or is hidden.
bool IsGhost(vtkPolyData* data, vtkIdType cell);

struct TriangleSelection
{
  vtkSmartPointer<vtkPolyData> Surface; ///< triangles, with their point and cell data
  std::vector<vtkIdType> Cells;         ///< with finite corners and some area, without ghosts
  vtkIdType Removed = 0;                ///< the number of polygons and triangles with other corners
  vtkIdType WithoutArea = 0;            ///< see Triangulation
  vtkIdType Tangled = 0;
};

/// Triangulates polygons and strips.
TriangleSelection SelectTriangles(vtkPolyData* data);
}

#endif
