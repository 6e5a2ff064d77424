// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFExtensions.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <iterator>

namespace cslf
{
namespace
{
// A binary file starts with a magic number, a version and a length, then the length and the type of
// its first chunk, which is the JSON: glTF 2.0, section 4.4.
constexpr std::uint32_t BinaryMagic = 0x46546c67u;
constexpr std::size_t BinaryHeader = 20;
constexpr std::size_t ChunkLength = 12;

std::uint32_t ReadNumber(const std::string& bytes, std::size_t offset)
{
  std::uint32_t number = 0;
  for (int i = 3; i >= 0; --i)
  {
    number = (number << 8) | static_cast<unsigned char>(bytes[offset + i]);
  }
  return number;
}

/// The JSON of a file.
nlohmann::json ReadJSON(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  std::string text{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  if (text.size() >= BinaryHeader && ReadNumber(text, 0) == BinaryMagic)
  {
    text = text.substr(BinaryHeader, ReadNumber(text, ChunkLength));
  }
  return nlohmann::json::parse(text, nullptr, false);
}

/// An object's member that is an object; an empty one where there is none.
nlohmann::json GetObject(const nlohmann::json& parent, const char* name)
{
  const auto found = parent.is_object() ? parent.find(name) : parent.end();
  return parent.is_object() && found != parent.end() && found->is_object()
    ? *found
    : nlohmann::json::object();
}

double GetNumber(const nlohmann::json& parent, const char* name, double fallback)
{
  const auto found = parent.find(name);
  return found != parent.end() && found->is_number() ? found->get<double>() : fallback;
}

/// Names the extensions that a file says it uses and that nothing reads.
void NameUnknown(const nlohmann::json& document, std::set<std::string>& unknown)
{
  static const std::set<std::string> known = { "KHR_materials_ior", "KHR_materials_transmission",
    "KHR_materials_emissive_strength", "KHR_materials_volume", "KHR_materials_unlit",
    "KHR_lights_punctual" };
  const auto used = document.find("extensionsUsed");
  if (used == document.end() || !used->is_array())
  {
    return;
  }
  for (const nlohmann::json& name : *used)
  {
    if (name.is_string() && known.count(name.get<std::string>()) == 0)
    {
      unknown.insert(name.get<std::string>());
    }
  }
}

GLTFMaterialExtension ReadMaterial(const nlohmann::json& material, std::set<std::string>& unknown)
{
  const nlohmann::json extensions = GetObject(material, "extensions");
  GLTFMaterialExtension result;
  result.IndexOfRefraction =
    GetNumber(GetObject(extensions, "KHR_materials_ior"), "ior", result.IndexOfRefraction);
  result.EmissiveStrength = GetNumber(GetObject(extensions, "KHR_materials_emissive_strength"),
    "emissiveStrength", result.EmissiveStrength);
  const nlohmann::json transmission = GetObject(extensions, "KHR_materials_transmission");
  result.Transmission = GetNumber(transmission, "transmissionFactor", 0.0);
  if (transmission.contains("transmissionTexture"))
  {
    unknown.insert("textures of transmission");
  }
  result.IsSolid =
    GetNumber(GetObject(extensions, "KHR_materials_volume"), "thicknessFactor", 0.0) > 0.0;
  return result;
}
}

std::vector<GLTFMaterialExtension> ReadGLTFExtensions(
  const std::string& fileName, std::set<std::string>& unknown)
{
  std::vector<GLTFMaterialExtension> result;
  const nlohmann::json document = ReadJSON(fileName);
  if (!document.is_object())
  {
    return result;
  }
  NameUnknown(document, unknown);
  const auto materials = document.find("materials");
  if (materials != document.end() && materials->is_array())
  {
    for (const nlohmann::json& material : *materials)
    {
      result.push_back(ReadMaterial(material, unknown));
    }
  }
  return result;
}
}
