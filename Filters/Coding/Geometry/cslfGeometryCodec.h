// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A field's geometry as bytes, for coded files: see Documentation/FileFormat.md.
 */
#ifndef cslfGeometryCodec_h
#define cslfGeometryCodec_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfCube.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkPolyData;

namespace cslf
{
/// The cube must contain the geometry. Positions get as many bits along each axis of the geometry's
/// bounds as viewpoints need whose tiles have `resolution` texels along an edge: 12 to 16. On
/// failure returns no bytes and says why.
VTKCSLF_EXPORT std::vector<unsigned char> EncodeGeometry(
  vtkPolyData* geometry, const Cube& box, int resolution, std::string& error);

/// Bytes from anywhere. On failure returns null and says why.
VTKCSLF_EXPORT vtkSmartPointer<vtkPolyData> DecodeGeometry(
  const std::vector<unsigned char>& bytes, const Cube& box, std::string& error);
}

#endif
