// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfOBJMaterials.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Files/cslfEncodedImage.h"
#include "Files/cslfFileSystem.h"
#include "cslfJoin.h"
#include "vtkCSLFMaterial.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

namespace cslf::tool
{
namespace
{
namespace fs = std::filesystem;

bool IsFile(const fs::path& path)
{
  std::error_code failure;
  return fs::is_regular_file(path, failure);
}

/// The lines of a library.
class LibraryReader
{
public:
  LibraryReader(const std::string& fileName, std::map<std::string, OBJMaterial>& materials)
    : FileName(fileName)
    , Bytes(ReadBytes(fileName))
    , Lines(this->Bytes)
    , Materials(materials)
  {
  }

  void Read()
  {
    while (this->Lines.Next())
    {
      if (!this->Lines.GetWords().empty())
      {
        this->ReadLine(std::string(this->Lines.GetWords()[0]));
      }
    }
    if (!this->Invalid.empty())
    {
      AddWarning(
        "Invalid lines of " + this->FileName + " were ignored: " + Join(this->Invalid) + ".");
    }
    if (!this->Ignored.empty())
    {
      AddWarning("Unsupported features of " + this->FileName +
        " were ignored: " + Join(this->Ignored) + ".");
    }
  }

private:
  void ReadLine(const std::string& keyword)
  {
    static const std::set<std::string> harmless = { "Ka", "Ni", "Ns", "illum", "Tf", "sharpness" };
    if (keyword == "newmtl")
    {
      // The first of equal names counts.
      const auto [made, isNew] =
        this->Materials.emplace(DropComment(this->Lines.GetRest(1)), OBJMaterial());
      this->Current = isNew ? &made->second : &this->Repeated;
    }
    else if (keyword[0] == '#' || harmless.count(keyword) > 0)
    {
      return;
    }
    else if (!this->Current)
    {
      this->AddInvalid(keyword);
    }
    else
    {
      this->ReadProperty(keyword, *this->Current);
    }
  }

  void ReadProperty(const std::string& keyword, OBJMaterial& material)
  {
    if (keyword == "Kd")
    {
      material.Color = this->ReadColor(VTK_FLOAT_MAX);
      for (std::size_t i = 0; material.Color && i < 3; ++i)
      {
        double& component = (*material.Color)[i];
        if (component > 1.0)
        {
          this->Ignored.insert("Kd above 1, which counts as 1");
          component = 1.0;
        }
      }
    }
    else if (keyword == "Ke")
    {
      material.Emission = this->ReadColor(VTK_FLOAT_MAX);
    }
    else if (keyword == "d")
    {
      material.Opacity = this->ReadFraction();
    }
    else if (keyword == "Tr")
    {
      material.Transparency = this->ReadFraction();
    }
    else if (keyword == "map_Kd")
    {
      material.ColorTexture = this->ReadTexture();
    }
    else if (keyword == "map_Ke")
    {
      material.EmissionTexture = this->ReadTexture();
    }
    else if (keyword != "Ks" || this->ReadColor(1.0) != Black)
    {
      this->Ignored.insert(keyword);
    }
  }

  using Color = std::array<double, 3>;
  static constexpr Color Black{ 0.0, 0.0, 0.0 };

  /// One number is that of all three components. Empty if the line is invalid.
  std::optional<Color> ReadColor(double most)
  {
    const auto& words = this->Lines.GetWords();
    Color color{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t word = words.size() == 2 ? 1 : i + 1;
      const auto number = word < words.size() ? ToFinite(words[word]) : std::nullopt;
      if (!number || *number < 0.0 || *number > most)
      {
        this->AddInvalid(words[0]);
        return std::nullopt;
      }
      color[i] = *number;
    }
    return color;
  }

  std::optional<double> ReadFraction()
  {
    const auto& words = this->Lines.GetWords();
    const bool isHalo = words.size() > 1 && words[1] == "-halo";
    const std::size_t word = isHalo ? 2 : 1;
    const auto number = word < words.size() ? ToFinite(words[word]) : std::nullopt;
    if (!number || *number < 0.0 || *number > 1.0)
    {
      this->AddInvalid(words[0]);
      return std::nullopt;
    }
    if (isHalo)
    {
      this->Ignored.insert("d -halo");
    }
    return number;
  }

  /// Options, and a file name that may have spaces.
  OBJTexture ReadTexture()
  {
    const auto& words = this->Lines.GetWords();
    OBJTexture texture;
    std::size_t word = 1;
    while (word < words.size() && words[word].size() > 1 && words[word][0] == '-')
    {
      const std::string option(words[word++]);
      if (option == "-s" || option == "-o")
      {
        this->ReadPair(word, option == "-s" ? texture.Scale : texture.Offset);
        continue;
      }
      if (option == "-clamp")
      {
        texture.IsRepeated = word >= words.size() || words[word] != "on";
      }
      else
      {
        this->Ignored.insert(std::string(words[0]) + " " + option);
      }
      word = option == "-t" ? this->SkipNumbers(word) : word + (option == "-mm" ? 2 : 1);
    }
    const std::string name = this->Lines.GetRest(word);
    if (name.empty())
    {
      this->AddInvalid(words[0]);
      return {};
    }
    texture.FileName = FindBeside(ToPath(this->FileName).parent_path(), name);
    return texture;
  }

  /// Up to three numbers, of which the third is that of volumes.
  void ReadPair(std::size_t& word, std::array<double, 2>& pair)
  {
    const auto& words = this->Lines.GetWords();
    const std::size_t end = this->SkipNumbers(word);
    for (std::size_t i = 0; i < 2 && word + i < end; ++i)
    {
      pair[i] = *ToFinite(words[word + i]);
    }
    word = end;
  }

  std::size_t SkipNumbers(std::size_t word) const
  {
    const auto& words = this->Lines.GetWords();
    const std::size_t last = std::min(word + 3, words.size());
    while (word < last && ToFinite(words[word]))
    {
      ++word;
    }
    return word;
  }

  void AddInvalid(std::string_view keyword)
  {
    constexpr std::size_t most = 5;
    if (this->Invalid.size() < most)
    {
      this->Invalid.push_back(
        "line " + std::to_string(this->Lines.GetNumber()) + " (" + std::string(keyword) + ")");
    }
    else if (this->Invalid.size() == most)
    {
      this->Invalid.emplace_back("and more");
    }
  }

  std::string FileName;
  std::string Bytes;
  TextLines Lines;
  std::map<std::string, OBJMaterial>& Materials;
  OBJMaterial* Current = nullptr;
  OBJMaterial Repeated;
  std::set<std::string> Ignored;
  std::vector<std::string> Invalid;
};

void TransformTCoords(const OBJTexture& texture, vtkPolyData* block)
{
  auto* coordinates = vtkFloatArray::SafeDownCast(block->GetPointData()->GetTCoords());
  for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 2; ++c)
    {
      const double value = coordinates->GetTypedComponent(i, c);
      coordinates->SetTypedComponent(
        i, c, static_cast<float>(texture.Scale[c] * value + texture.Offset[c]));
    }
  }
}
}

std::string DropComment(std::string name)
{
  for (std::size_t place = name.find('#'); place != std::string::npos;
       place = name.find('#', place + 1))
  {
    const bool isComment = place > 0 && IsSpace(name[place - 1]) &&
      (place + 1 == name.size() || IsSpace(name[place + 1]));
    if (isComment)
    {
      name.erase(place);
      name.erase(name.find_last_not_of(" \t") + 1);
      break;
    }
  }
  return name;
}

std::string FindBeside(const fs::path& folder, std::string name)
{
  if (name.size() > 2 && name.front() == '"' && name.back() == '"')
  {
    name = name.substr(1, name.size() - 2);
  }
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path = folder / ToPath(name);
  const fs::path beside = folder / path.filename();
  return ToName(!IsFile(path) && IsFile(beside) ? beside : path);
}

void OBJMaterials::ReadLibrary(const std::string& fileName)
{
  LibraryReader(fileName, this->Materials).Read();
}

void OBJMaterials::Apply(const std::string& name, vtkPolyData* block)
{
  const OBJMaterial& material = this->Materials.at(name);
  const OBJTexture& color = material.ColorTexture;
  const OBJTexture& emission = material.EmissionTexture;
  const bool hasColors = this->SetTexture(vtkCSLFMaterial::BaseColorTexture, color, block);
  const bool hasEmissions = this->SetTexture(vtkCSLFMaterial::EmissionTexture, emission, block);
  if (hasColors || hasEmissions)
  {
    const OBJTexture& placed = hasColors ? color : emission;
    TransformTCoords(placed, block);
    if (hasEmissions && (placed.Scale != emission.Scale || placed.Offset != emission.Offset))
    {
      AddWarning("The textures of material " + name +
        " have different coordinates; those of map_Kd are used for map_Ke as well.");
    }
  }
  if (material.Color || hasColors)
  {
    const std::array<double, 3> factor = material.Color.value_or(std::array{ 1.0, 1.0, 1.0 });
    vtkCSLFMaterial::SetBaseColor(block, factor[0], factor[1], factor[2]);
  }
  if (material.Emission || hasEmissions)
  {
    const std::array<double, 3> factor = material.Emission.value_or(std::array{ 1.0, 1.0, 1.0 });
    vtkCSLFMaterial::SetEmission(block, factor[0], factor[1], factor[2]);
  }
  vtkCSLFMaterial::SetOpacity(
    block, material.Opacity.value_or(1.0 - material.Transparency.value_or(0.0)));
}

bool OBJMaterials::SetTexture(int slot, const OBJTexture& texture, vtkPolyData* block)
{
  if (texture.FileName.empty())
  {
    return false;
  }
  if (!block->GetPointData()->GetTCoords())
  {
    AddWarning("The texture " + texture.FileName +
      " is not shown on the faces that have no texture coordinates.");
    return false;
  }
  vtkImageData* image = this->FindImage(texture.FileName);
  return image && vtkCSLFMaterial::SetTexture(block, slot, image, texture.IsRepeated);
}

vtkImageData* OBJMaterials::FindImage(const std::string& fileName)
{
  const auto found = this->Images.find(fileName);
  if (found != this->Images.end())
  {
    return found->second;
  }
  std::string error = "is missing";
  vtkSmartPointer<vtkImageData> image;
  const fs::path path = ToPath(fileName);
  try
  {
    if (IsFile(path))
    {
      static const std::set<std::string> formats = { ".bmp", ".tga", ".tif", ".tiff" };
      const std::string bytes = ReadBytes(fileName);
      const std::string extension = ToLower(ToName(path.extension()));
      image = DecodeImage(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
        formats.count(extension) > 0 ? extension : "", error);
    }
  }
  catch (const Failure&)
  {
    error = "cannot be opened";
  }
  if (!image)
  {
    AddWarning("The texture " + fileName + " " + error + "; the surface is shown without it.");
  }
  this->Images[fileName] = image;
  return image;
}
}
