// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checks files before VTK's readers, which trust the numbers in them, read them.
 */
#ifndef cslfSceneChecks_h
#define cslfSceneChecks_h

#include <string>

namespace cslf::tool
{
/// Throws a Failure if a face, line or point of an OBJ file has the index of a missing vertex,
/// texture coordinate or normal, or if the file ends within a line.
void CheckOBJ(const std::string& fileName);

/// Throws a Failure if an STL file has fewer triangles than its header declares, or if its last
/// solid has no end. Returns whether it is a text file.
bool CheckSTL(const std::string& fileName);

/// Throws a Failure if an XML file of VTK, or a file that it refers to, declares more data than the
/// file can hold.
void CheckVTKXML(const std::string& fileName);
}

#endif
