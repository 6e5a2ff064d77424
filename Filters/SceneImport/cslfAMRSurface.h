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
/// The faces between the visible cells of all grids and what is outside of them: neither of cells
/// that finer ones replace, nor between grids. Cells of flat grids are faces themselves. Each face
/// has the data of its cell, and its corners have the data of the grid's points. The data arrays
/// are those that all grids have.
vtkSmartPointer<vtkPolyData> ExtractAMRSurface(vtkUniformGridAMR* grids);
}

#endif
