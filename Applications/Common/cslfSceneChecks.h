// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checks of files before VTK's readers see them, which trust numbers in them.
 */
#ifndef cslfSceneChecks_h
#define cslfSceneChecks_h

#include <string>

namespace cslf
{
namespace tool
{
/// Throws a Failure where a face, line or point of an OBJ file has an index of a vertex, texture
/// coordinate or normal that does not exist, or the file ends within a line.
void CheckOBJ(const std::string& fileName);

/// Throws a Failure where a file of STL holds fewer triangles than it announces, or its last solid
/// does not end.
void CheckSTL(const std::string& fileName);

/// Throws a Failure where an XML file of VTK, or a file that it names, announces more than there
/// are bytes for.
void CheckVTKXML(const std::string& fileName);
}
}

#endif
