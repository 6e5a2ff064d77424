// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The geometry of a field: in its video, or in a .geometry.vtp file beside its .vti file.
 */
#ifndef cslfGeometryFiles_h
#define cslfGeometryFiles_h

#include <string>

class vtkAlgorithmOutput;

namespace cslf::tool
{
struct FieldFile;

/// Finds the geometry of an open field. A file beside the field that is damaged or belongs to
/// another field is ignored with a warning.
void OpenGeometry(FieldFile& file);

/// Lets an open field with depth that has no geometry get one of at most that many triangles, made
/// from its depth when it is asked for. 0 triangles: none. Throws a Failure if there is no depth.
void MakeGeometry(int triangles, FieldFile& file);

/// Warns if a geometry that MakeGeometry made lacks many surfaces.
void WarnOfLoss(const FieldFile& file);

/// The name of the file with the geometry of a .vti file.
std::string GetGeometryName(const std::string& fieldName);

/// Pulls the geometry of the field that a connection has delivered, and writes it beside the .vti
/// file of that name, unless it is empty. Throws a Failure.
void WriteGeometry(
  vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, const std::string& fieldName);
}

#endif
