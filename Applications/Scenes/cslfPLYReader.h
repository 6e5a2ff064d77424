// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads PLY files and checks all of their contents. VTK's reader trusts their headers and lists: it
 * reads out of bounds if faces have no indices, if lists are longer than 255, or if elements are in
 * another order.
 */
#ifndef cslfPLYReader_h
#define cslfPLYReader_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace cslf::tool
{
/// Reads the vertices of a PLY file, ASCII or binary, with normals, texture coordinates and
/// colours, and its faces or triangle strips with colours. Without faces and strips, each vertex
/// becomes a vertex cell. Throws a Failure if the file is broken. Leaves out faces with indices of
/// missing vertices, and elements of other kinds, with warnings.
vtkSmartPointer<vtkPolyData> ReadPLY(const std::string& fileName);
}

#endif
