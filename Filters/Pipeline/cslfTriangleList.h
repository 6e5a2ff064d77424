// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of polygonal data as a list of numbers.
 */
#ifndef cslfTriangleList_h
#define cslfTriangleList_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkSmartPointer.h>

#include <vector>

class vtkPolyData;

namespace cslf
{
/// The polygons and strips as triangles, without vertices and lines. Points keep their numbers.
VTKCSLF_EXPORT vtkSmartPointer<vtkPolyData> Triangulate(vtkPolyData* data);

/// The numbers of the points of all triangles, three for each.
VTKCSLF_EXPORT std::vector<unsigned int> ListCorners(vtkPolyData* triangles);
}

#endif
