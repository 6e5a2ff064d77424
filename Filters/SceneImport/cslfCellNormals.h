// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Normals of cells, by which VTK's window shades polygons whose points have none.
 */
#ifndef cslfCellNormals_h
#define cslfCellNormals_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace cslf
{
/// Gives each cell points of its own, with the cell's normal as their normal. Returns the block
/// itself where it has no
/// polygons, where cells have no normals, or where points have some.
vtkSmartPointer<vtkPolyData> SpreadCellNormals(vtkPolyData* block);
}

#endif
