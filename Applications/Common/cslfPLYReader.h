// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * PLY files, of which nothing is taken for granted. VTK's reader trusts their headers and lists: it
 * reads out of bounds where faces come without indices, where lists are longer than 255, or where
 * elements are in another order.
 */
#ifndef cslfPLYReader_h
#define cslfPLYReader_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace cslf
{
namespace tool
{
/// Reads the vertices of a PLY file, ASCII or binary, with normals, texture coordinates and
/// colours, and its faces or triangle strips with colours. Without those each vertex is a vertex
/// cell. Throws a Failure where the file is broken; warns of faces with indices of vertices that do
/// not exist, which are left out, and of elements that are not read.
vtkSmartPointer<vtkPolyData> ReadPLY(const std::string& fileName);
}
}

#endif
