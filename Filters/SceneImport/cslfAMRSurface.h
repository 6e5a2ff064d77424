// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surface of grids of several levels (adaptive mesh refinement).
 */
#ifndef cslfAMRSurface_h
#define cslfAMRSurface_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

class vtkUniformGridAMR;

namespace cslf
{
/// The outer faces of the visible cells of all grids, without the faces of cells that finer ones
/// replace and without faces between grids. Cells of two-dimensional grids are faces themselves.
/// Each face has the data of its cell, and its corners have the data of the grid's points. It has
/// the data arrays that all grids share.
vtkSmartPointer<vtkPolyData> ExtractAMRSurface(vtkUniformGridAMR* grids);
}

#endif
