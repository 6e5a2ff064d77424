// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPLYHeader.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

namespace cslf::tool
{
namespace
{
using Words = std::vector<std::string>;

PLYType ParseType(const std::string& name)
{
  static const std::map<std::string, PLYType> types = { { "char", { 1, true, false } },
    { "int8", { 1, true, false } }, { "uchar", { 1, false, false } },
    { "uint8", { 1, false, false } }, { "short", { 2, true, false } },
    { "int16", { 2, true, false } }, { "ushort", { 2, false, false } },
    { "uint16", { 2, false, false } }, { "int", { 4, true, false } },
    { "int32", { 4, true, false } }, { "uint", { 4, false, false } },
    { "uint32", { 4, false, false } }, { "float", { 4, true, true } },
    { "float32", { 4, true, true } }, { "double", { 8, true, true } },
    { "float64", { 8, true, true } } };
  const auto found = types.find(name);
  if (found == types.end())
  {
    throw Failure("its header has the unknown type " + name + ".");
  }
  return found->second;
}

PLYHeader::Formats ParseFormat(const Words& words)
{
  const std::string name = words.size() == 3 ? words[1] : "";
  if (name == "ascii")
  {
    return PLYHeader::Formats::ASCII;
  }
  if (name == "binary_little_endian" || name == "binary_big_endian")
  {
    return name == "binary_big_endian" ? PLYHeader::Formats::BigEndian
                                       : PLYHeader::Formats::LittleEndian;
  }
  throw Failure("its header has an unknown format.");
}

PLYElement ParseElement(const Words& words)
{
  PLYElement element;
  element.Name = words.size() == 3 ? words[1] : "";
  const std::string count = words.size() == 3 ? words[2] : "";
  const char* end = count.data() + count.size();
  const auto result = std::from_chars(count.data(), end, element.Count);
  if (result.ec != std::errc() || result.ptr != end)
  {
    throw Failure("its header has an element without a valid count.");
  }
  return element;
}

PLYProperty ParseProperty(const Words& words)
{
  PLYProperty property;
  property.IsList = words.size() == 5 && words[1] == "list";
  if (!property.IsList && words.size() != 3)
  {
    throw Failure("its header has an invalid property.");
  }
  property.Name = words.back();
  property.Type = ParseType(words[words.size() - 2]);
  if (property.IsList)
  {
    property.CountType = ParseType(words[2]);
    if (property.CountType.IsFloat)
    {
      throw Failure("its header has a list whose length is not an integer.");
    }
  }
  return property;
}

void CheckElements(const PLYHeader& header, std::size_t bytes)
{
  std::set<std::string> names;
  for (const PLYElement& element : header.Elements)
  {
    if (!names.insert(element.Name).second)
    {
      throw Failure("its header has more than one element " + element.Name + ".");
    }
    // A number in an ASCII file takes a digit and a space, except for the last one.
    std::size_t least = 0;
    for (const PLYProperty& property : element.Properties)
    {
      const PLYType& type = property.IsList ? property.CountType : property.Type;
      least += header.Format == PLYHeader::Formats::ASCII ? 2 : type.Size;
    }
    if (least > 0 && element.Count > (bytes - header.Size + 1) / least)
    {
      throw Failure("it is too short for " + std::to_string(element.Count) + " of element " +
        element.Name + ".");
    }
  }
}
}

int PLYElement::Find(const std::string& name, bool isList) const
{
  for (std::size_t i = 0; i < this->Properties.size(); ++i)
  {
    if (this->Properties[i].Name == name && this->Properties[i].IsList == isList)
    {
      return static_cast<int>(i);
    }
  }
  return -1;
}

PLYHeader ReadPLYHeader(const std::string& bytes)
{
  PLYHeader header;
  bool hasFormat = false;
  for (std::size_t line = 0;; ++line)
  {
    const std::size_t end = bytes.find('\n', header.Size);
    if (end == std::string::npos)
    {
      throw Failure(line == 0 ? "it is not a PLY file." : "its header has no end_header.");
    }
    const auto split = Split(std::string_view(bytes).substr(header.Size, end - header.Size));
    const Words words(split.begin(), split.end());
    header.Size = end + 1;
    const std::string keyword = words.empty() ? "" : words[0];
    if (line == 0 && keyword != "ply")
    {
      throw Failure("it is not a PLY file.");
    }
    if (keyword == "end_header")
    {
      break;
    }
    if (keyword == "format")
    {
      header.Format = ParseFormat(words);
      hasFormat = true;
    }
    else if (keyword == "element")
    {
      header.Elements.push_back(ParseElement(words));
    }
    else if (keyword == "property")
    {
      if (header.Elements.empty())
      {
        throw Failure("its header has a property without an element.");
      }
      header.Elements.back().Properties.push_back(ParseProperty(words));
    }
  }
  if (!hasFormat)
  {
    throw Failure("its header has no format.");
  }
  CheckElements(header, bytes.size());
  return header;
}

PLYNumbers::PLYNumbers(const std::string& bytes, const PLYHeader& header)
  : Bytes(bytes)
  , Format(header.Format)
  , Offset(header.Size)
{
}

double PLYNumbers::Read(const PLYType& type)
{
  return this->Format == PLYHeader::Formats::ASCII ? this->ReadWord() : this->ReadBinary(type);
}

std::size_t PLYNumbers::ReadCount(const PLYProperty& list)
{
  const double count = this->Read(list.CountType);
  const std::size_t least = this->Format == PLYHeader::Formats::ASCII ? 2 : list.Type.Size;
  if (!(count >= 0.0) || count != std::floor(count) ||
    count > static_cast<double>((this->Bytes.size() - this->Offset + 1) / least))
  {
    throw Failure("it has a list of invalid length.");
  }
  return static_cast<std::size_t>(count);
}

double PLYNumbers::ReadWord()
{
  const char* begin = this->Bytes.data() + this->Offset;
  const char* end = this->Bytes.data() + this->Bytes.size();
  begin = std::find_if_not(begin, end, IsSpace);
  if (begin == end)
  {
    throw Failure("it is truncated.");
  }
  const char* wordEnd = std::find_if(begin, end, IsSpace);
  const std::optional<double> number =
    ToNumber({ begin, static_cast<std::size_t>(wordEnd - begin) });
  if (!number)
  {
    throw Failure("it has a value that is not a number.");
  }
  this->Offset = static_cast<std::size_t>(wordEnd - this->Bytes.data());
  return *number;
}

double PLYNumbers::ReadBinary(const PLYType& type)
{
  if (this->Bytes.size() - this->Offset < type.Size)
  {
    throw Failure("it is truncated.");
  }
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.Size; ++i)
  {
    const bool isLittle = this->Format == PLYHeader::Formats::LittleEndian;
    const std::size_t place = isLittle ? type.Size - 1 - i : i;
    bits = bits << 8 | static_cast<unsigned char>(this->Bytes[this->Offset + place]);
  }
  this->Offset += type.Size;
  if (type.IsFloat && type.Size == sizeof(double))
  {
    double number;
    std::memcpy(&number, &bits, sizeof(number));
    return number;
  }
  const auto low = static_cast<std::uint32_t>(bits);
  if (type.IsFloat)
  {
    float number;
    std::memcpy(&number, &low, sizeof(number));
    return number;
  }
  if (!type.IsSigned)
  {
    return low;
  }
  return type.Size == 1
    ? static_cast<std::int8_t>(low)
    : (type.Size == 2 ? static_cast<std::int16_t>(low) : static_cast<std::int32_t>(low));
}
}
