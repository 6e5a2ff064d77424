// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads STL files. VTK reads truncated files without an error, and the numbers of text files as
 * floats.
 */
#ifndef cslfSTLReader_h
#define cslfSTLReader_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace cslf::tool
{
/// The triangles of a binary or a text file. Points of a text file are doubles if floats would lose
/// digits. Triangles with equal corners are left out. Throws a Failure if the file is truncated, or
/// if a text file has a value that is not a finite number or a facet without three corners.
vtkSmartPointer<vtkPolyData> ReadSTL(const std::string& fileName);
}

#endif
