// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The material libraries of OBJ files (.mtl).
 */
#ifndef cslfOBJMaterials_h
#define cslfOBJMaterials_h

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

class vtkPolyData;

namespace cslf::tool
{
/// The file of that name beside one in a folder, or else the one in the same folder: the paths of
/// other computers do not exist on this one, and those of Windows have other separators. Quotes
/// around the name are left out.
std::string FindBeside(const std::filesystem::path& folder, std::string name);

/// The name of a material without a comment behind it. "Material #1" is a name.
std::string DropComment(std::string name);

/// An image that multiplies a colour, and how texture coordinates are changed for it.
struct OBJTexture
{
  std::string FileName; ///< empty if there is none
  std::array<double, 2> Scale{ 1.0, 1.0 };
  std::array<double, 2> Offset{ 0.0, 0.0 };
  bool IsRepeated = true;
};

struct OBJMaterial
{
  std::optional<std::array<double, 3>> Color; ///< sRGB-encoded
  std::optional<std::array<double, 3>> Emission;
  std::optional<double> Opacity;      ///< by d
  std::optional<double> Transparency; ///< by Tr, used if there is no d
  OBJTexture ColorTexture;
  OBJTexture EmissionTexture;
};

/// All materials that an OBJ file may use, and their images. Whatever cannot be read or represented
/// gives a warning.
class OBJMaterials
{
public:
  /// Reads a library. Throws a Failure if it cannot be opened.
  void ReadLibrary(const std::string& fileName);

  bool Has(const std::string& name) const { return this->Materials.count(name) > 0; }

  /// Gives the material of that name to a block, whose texture coordinates may be changed.
  void Apply(const std::string& name, vtkPolyData* block);

private:
  bool SetTexture(int slot, const OBJTexture& texture, vtkPolyData* block);
  vtkImageData* FindImage(const std::string& fileName);

  std::map<std::string, OBJMaterial> Materials;
  std::map<std::string, vtkSmartPointer<vtkImageData>> Images; ///< null if it cannot be read
};
}

#endif
