// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFDocument.h"

#include "Files/cslfFileSystem.h"
#include "cslfJSON.h"

#include <vtkBase64Utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

namespace cslf
{
namespace
{
// JSON's numbers are exact integers up to this one.
constexpr double MaximumIndex = 9007199254740992.0;
}

GLTFValue::GLTFValue(const nlohmann::json* value, std::string path)
  : Value(value)
  , Path(std::move(path))
{
}

void GLTFValue::Fail(const std::string& what) const
{
  throw GLTFError((this->Path.empty() ? "the document" : this->Path) + " " + what);
}

GLTFValue GLTFValue::operator[](const char* name) const
{
  GLTFValue member(nullptr, this->Path.empty() ? name : this->Path + "." + name);
  if (this->Value)
  {
    if (!this->Value->is_object())
    {
      this->Fail("is not an object");
    }
    const auto found = this->Value->find(name);
    member.Value = found != this->Value->end() ? &*found : nullptr;
  }
  return member;
}

std::size_t GLTFValue::GetCount() const
{
  if (this->Value && !this->Value->is_array())
  {
    this->Fail("is not an array");
  }
  return this->Value ? this->Value->size() : 0;
}

GLTFValue GLTFValue::At(std::size_t index) const
{
  GLTFValue element(nullptr, this->Path + "[" + std::to_string(index) + "]");
  if (index >= this->GetCount())
  {
    element.Fail("does not exist");
  }
  element.Value = &(*this->Value)[index];
  return element;
}

std::optional<std::size_t> GLTFValue::GetIndex() const
{
  if (!this->Value)
  {
    return std::nullopt;
  }
  const double number = this->Value->is_number() ? this->Value->get<double>() : -1.0;
  if (!(number >= 0.0) || number > MaximumIndex || number != std::floor(number))
  {
    this->Fail("is not a non-negative integer");
  }
  return static_cast<std::size_t>(number);
}

std::size_t GLTFValue::GetIndex(std::size_t fallback) const
{
  return this->GetIndex().value_or(fallback);
}

double GLTFValue::GetNumber(double fallback) const
{
  if (this->Value && !this->Value->is_number())
  {
    this->Fail("is not a number");
  }
  return this->Value ? this->Value->get<double>() : fallback;
}

bool GLTFValue::GetBool(bool fallback) const
{
  if (this->Value && !this->Value->is_boolean())
  {
    this->Fail("is not true or false");
  }
  return this->Value ? this->Value->get<bool>() : fallback;
}

std::string GLTFValue::GetText(const std::string& fallback) const
{
  if (this->Value && !this->Value->is_string())
  {
    this->Fail("is not a string");
  }
  return this->Value ? this->Value->get<std::string>() : fallback;
}

namespace
{
namespace fs = std::filesystem;

// A binary file starts with a magic number, a version and a length. Chunks follow, each with a
// length and a type before its bytes: glTF 2.0, section 4.4.
constexpr std::uint32_t BinaryMagic = 0x46546c67u;
constexpr std::uint32_t BinaryVersion = 2;
constexpr std::uint32_t JSONChunk = 0x4e4f534au;
constexpr std::uint32_t BytesChunk = 0x004e4942u;
constexpr std::size_t BinaryHeader = 12;
constexpr std::size_t ChunkHeader = 8;

/// Extensions with meshes in forms that are not supported.
const std::set<std::string> Unreadable = { "KHR_draco_mesh_compression", "EXT_meshopt_compression",
  "KHR_meshopt_compression" };

// The number of elements that a file may make without bytes or with bytes that it uses more than
// once. All other elements take at least one byte, in an accessor and in a block.
constexpr std::size_t MaximumZeros = std::size_t(1) << 24;
constexpr std::size_t MaximumElements = std::size_t(1) << 26;
constexpr std::size_t MaximumElementsPerByte = 4;

std::uint32_t ReadNumber(const std::string& bytes, std::size_t offset)
{
  std::uint32_t number = 0;
  for (int i = 3; i >= 0; --i)
  {
    number = (number << 8) | static_cast<unsigned char>(bytes[offset + i]);
  }
  return number;
}

std::string ReadFile(const fs::path& path, const std::string& name)
{
  // A device might be endless.
  std::error_code failure;
  if (!fs::is_regular_file(path, failure))
  {
    throw GLTFError("there is no file " + name);
  }
  std::ifstream file(path, std::ios::binary);
  std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  if (!file)
  {
    throw GLTFError("cannot read " + name);
  }
  return bytes;
}

/// Whether a path leads to a place below a folder. Links are followed.
bool IsBelow(const fs::path& path, const fs::path& folder)
{
  std::error_code failure;
  const fs::path outer = fs::canonical(folder.empty() ? fs::path(".") : folder, failure);
  const fs::path inner = failure ? fs::path() : fs::weakly_canonical(outer / path, failure);
  const auto ends = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return !failure && ends.first == outer.end();
}

int GetHexDigit(char digit)
{
  const int lower = std::tolower(static_cast<unsigned char>(digit));
  return std::isdigit(lower) ? lower - '0' : lower - 'a' + 10;
}

/// Replaces %20 and the like.
std::string DecodePercents(const std::string& text)
{
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] == '%' && i + 2 < text.size() &&
      std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
      std::isxdigit(static_cast<unsigned char>(text[i + 2])))
    {
      decoded += static_cast<char>(16 * GetHexDigit(text[i + 1]) + GetHexDigit(text[i + 2]));
      i += 2;
    }
    else
    {
      decoded += text[i];
    }
  }
  return decoded;
}

/// The bytes of data:TYPE;base64,DIGITS.
std::string DecodeDataAddress(const GLTFValue& uri, const std::string& text)
{
  const std::size_t comma = text.find(',');
  const std::string mark = ";base64";
  if (comma == std::string::npos || comma < mark.size() ||
    text.compare(comma - mark.size(), mark.size(), mark) != 0)
  {
    uri.Fail("has data that is not in base64");
  }
  std::string digits = text.substr(comma + 1);
  digits.resize((digits.size() + 3) / 4 * 4, '=');
  std::string bytes(digits.size() / 4 * 3, '\0');
  bytes.resize(
    vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(digits.data()),
      digits.size(), reinterpret_cast<unsigned char*>(&bytes[0]), bytes.size()));
  return bytes;
}
}

GLTFDocument::GLTFDocument(const std::string& fileName)
  : FileName(fileName)
{
  const std::string bytes = ReadFile(ToPath(fileName), ToName(ToPath(fileName).filename()));
  if (bytes.size() >= BinaryHeader && ReadNumber(bytes, 0) == BinaryMagic)
  {
    this->ReadBinary(bytes);
  }
  else
  {
    this->Parse(bytes);
  }
  this->CheckVersion();
  this->CheckRequired();
}

void GLTFDocument::ReadBinary(const std::string& bytes)
{
  if (ReadNumber(bytes, 4) != BinaryVersion)
  {
    throw GLTFError("it is binary glTF of version " + std::to_string(ReadNumber(bytes, 4)) +
      ", but version 2 is required");
  }
  bool hasText = false;
  for (std::size_t offset = BinaryHeader; offset + ChunkHeader <= bytes.size();)
  {
    const std::size_t length = ReadNumber(bytes, offset);
    const std::uint32_t type = ReadNumber(bytes, offset + 4);
    offset += ChunkHeader;
    if (length > bytes.size() - offset)
    {
      throw GLTFError("it is truncated");
    }
    if (type == JSONChunk && !hasText)
    {
      this->Parse(bytes.substr(offset, length));
      hasText = true;
    }
    else if (type == BytesChunk && !this->HasBinaryChunk)
    {
      this->BinaryChunk = bytes.substr(offset, length);
      this->BytesRead += length;
      this->HasBinaryChunk = true;
    }
    offset += length;
  }
  if (!hasText)
  {
    throw GLTFError("it has no JSON chunk");
  }
}

void GLTFDocument::Parse(const std::string& text)
{
  this->Root = nlohmann::json::parse(text, nullptr, false);
  if (!this->Root.is_object())
  {
    throw GLTFError("it is not a JSON object");
  }
}

void GLTFDocument::CheckVersion() const
{
  const std::string version = this->GetRoot()["asset"]["version"].GetText("");
  if (version.compare(0, 2, "2.") != 0)
  {
    throw GLTFError(version.empty()
        ? "asset.version is missing"
        : "it is glTF " + version.substr(0, 8) + ", but glTF 2.0 is required");
  }
}

void GLTFDocument::CheckRequired() const
{
  const GLTFValue required = this->GetRoot()["extensionsRequired"];
  for (std::size_t i = 0; i < required.GetCount(); ++i)
  {
    const std::string name = required.At(i).GetText("");
    if (Unreadable.count(name) != 0)
    {
      throw GLTFError("its meshes are compressed by " + name + ", which is not supported");
    }
  }
}

GLTFValue GLTFDocument::GetElement(const char* array, std::size_t index) const
{
  return this->GetRoot()[array].At(index);
}

GLTFBytes GLTFDocument::GetBufferView(std::size_t index)
{
  const GLTFValue view = this->GetElement("bufferViews", index);
  const std::optional<std::size_t> buffer = view["buffer"].GetIndex();
  const std::optional<std::size_t> length = view["byteLength"].GetIndex();
  if (!buffer || !length)
  {
    view.Fail("has no buffer or no byteLength");
  }
  const std::size_t offset = view["byteOffset"].GetIndex(0);
  const std::string& bytes = this->GetBuffer(*buffer);
  if (offset > bytes.size() || *length > bytes.size() - offset)
  {
    view.Fail("exceeds the " + std::to_string(bytes.size()) + " bytes of its buffer");
  }
  return { reinterpret_cast<const unsigned char*>(bytes.data()) + offset, *length,
    view["byteStride"].GetIndex(0) };
}

const std::string& GLTFDocument::GetBuffer(std::size_t index)
{
  const auto found = this->Buffers.find(index);
  if (found != this->Buffers.end())
  {
    return found->second;
  }
  const GLTFValue buffer = this->GetElement("buffers", index);
  const GLTFValue uri = buffer["uri"];
  if (!uri.IsPresent())
  {
    if (index != 0 || !this->HasBinaryChunk)
    {
      buffer.Fail("has no data");
    }
    return this->BinaryChunk;
  }
  const std::string& bytes = this->Buffers.emplace(index, this->ReadResource(uri)).first->second;
  this->BytesRead += bytes.size();
  return bytes;
}

void GLTFDocument::CountElements(std::size_t elements)
{
  const std::size_t most = MaximumElements + MaximumElementsPerByte * this->BytesRead;
  if (elements > most - std::min(most, this->Elements))
  {
    throw GLTFError("its nodes and meshes repeat more than " + std::to_string(most) + " elements");
  }
  this->Elements += elements;
}

void GLTFDocument::CountZeros(std::size_t elements)
{
  if (elements > MaximumZeros - this->Zeros)
  {
    throw GLTFError("its accessors without a bufferView have more than " +
      std::to_string(MaximumZeros) + " elements");
  }
  this->Zeros += elements;
}

std::string GLTFDocument::ReadResource(const GLTFValue& uri) const
{
  const std::string text = uri.GetText("");
  if (text.compare(0, 5, "data:") == 0)
  {
    return DecodeDataAddress(uri, text);
  }
  const std::string name = DecodePercents(text);
  if (name.empty() || name.find('\0') != std::string::npos || name.find("://") != std::string::npos)
  {
    uri.Fail("is not the path of a local file");
  }
  const fs::path folder = ToPath(this->FileName).parent_path();
  if (!IsBelow(ToPath(name), folder))
  {
    uri.Fail("names " + name + ", which is outside the folder of the glTF file");
  }
  try
  {
    return ReadFile(folder / ToPath(name), name);
  }
  catch (const GLTFError& error)
  {
    uri.Fail(std::string("cannot be read: ") + error.what());
  }
}
}
