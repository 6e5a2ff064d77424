// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What VTK's loader leaves out of a glTF file: the extensions of materials.
 */
#ifndef cslfGLTFExtensions_h
#define cslfGLTFExtensions_h

#include <set>
#include <string>
#include <vector>

namespace cslf
{
struct GLTFMaterialExtension
{
  double IndexOfRefraction = 1.5;
  double Transmission = 0.0;
  double EmissiveStrength = 1.0;
  bool IsSolid = false; ///< whether glass has a thickness
};

/// The extensions of all materials of a `.gltf` or `.glb` file, in the file's order. Adds to
/// `unknown` what is not represented. Where the file is broken there are none.
std::vector<GLTFMaterialExtension> ReadGLTFExtensions(
  const std::string& fileName, std::set<std::string>& unknown);
}

#endif
