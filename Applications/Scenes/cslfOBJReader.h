// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads OBJ files with their materials. VTK 9.1 reads coordinates as floats, makes numbers of words
 * that are none, and leaves colours, materials and some faces out.
 */
#ifndef cslfOBJReader_h
#define cslfOBJReader_h

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <string>

namespace cslf::tool
{
/// The points, lines and polygons of a file: polygonal data, or a block for each material. Points
/// are doubles if floats would lose digits. Colours of vertices (`v x y z r g b`) are active
/// scalars; if one of them is above 1, they all are fractions of 255. Materials are those of
/// OBJMaterials. Throws a Failure if a number is missing, not a number or not finite, or if an
/// index is that of a missing vertex, texture coordinate or normal. What cannot be shown gives a
/// warning.
vtkSmartPointer<vtkDataObject> ReadOBJ(const std::string& fileName);
}

#endif
