// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Normals of cells, which VTK's window uses to shade polygons whose points have none.
 */
#ifndef cslfCellNormals_h
#define cslfCellNormals_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace cslf
{
/// Gives each cell its own points, with the cell's normal. Returns the block itself if it has no
/// polygons, if cells have no normals, or if points have normals.
vtkSmartPointer<vtkPolyData> SpreadCellNormals(vtkPolyData* block);
}

#endif
