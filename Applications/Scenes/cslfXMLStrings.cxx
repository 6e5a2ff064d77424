// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfXMLStrings.h"

#include "Files/cslfFileSystem.h"

#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkType.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <cstring>

namespace cslf::tool
{
namespace
{
// The number of characters read at once.
constexpr std::size_t ChunkSize = 1048576;

bool IsNamed(vtkXMLDataElement* element, const char* name)
{
  return element && element->GetName() && std::strcmp(element->GetName(), name) == 0;
}

double GetNumber(vtkXMLDataElement* element, const char* name, double otherwise)
{
  double number = otherwise;
  return element->GetScalarAttribute(name, number) ? number : otherwise;
}

template <typename Compressor>
bool SetCompressor(vtkXMLDataParser* parser, const char* name)
{
  vtkNew<Compressor> compressor;
  const bool isIt = std::strcmp(compressor->GetClassName(), name) == 0;
  if (isIt)
  {
    parser->SetCompressor(compressor);
  }
  return isIt;
}

/// The number of tuples that VTK allocates for an array. It reads parts of structured data, in
/// which the strings of a whole piece do not fit, so these must have no strings at points and
/// cells.
double CountTuples(vtkXMLDataElement* array)
{
  vtkXMLDataElement* parent = array->GetParent();
  if (IsNamed(parent, "FieldData"))
  {
    return GetNumber(array, "NumberOfTuples", 0.0);
  }
  vtkXMLDataElement* piece = parent ? parent->GetParent() : nullptr;
  if (!piece)
  {
    return 0.0;
  }
  if (IsNamed(parent, "PointData"))
  {
    return GetNumber(piece, "NumberOfPoints", 0.0);
  }
  double cells = 0.0;
  for (const char* name :
    { "NumberOfCells", "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys" })
  {
    cells += GetNumber(piece, name, 0.0);
  }
  return cells;
}
}

XMLStrings::XMLStrings(const std::string& fileName, vtkXMLDataParser* parser)
  : File(ToPath(fileName), std::ios::binary)
  , Parser(parser)
{
  parser->SetStream(&this->File);
  if (const char* name = parser->GetRootElement()->GetAttribute("compressor"))
  {
    SetCompressor<vtkZLibDataCompressor>(parser, name) ||
      SetCompressor<vtkLZ4DataCompressor>(parser, name) ||
      SetCompressor<vtkLZMADataCompressor>(parser, name);
  }
}

XMLStrings::~XMLStrings()
{
  this->Parser->SetStream(nullptr);
}

bool XMLStrings::Fit(vtkXMLDataElement* array)
{
  const char* type = array->GetAttribute("type");
  if (!type || std::strcmp(type, "String") != 0)
  {
    return true;
  }
  const double limit = CountTuples(array) * GetNumber(array, "NumberOfComponents", 1.0);
  double strings = 0.0;
  std::vector<char> characters(ChunkSize);
  std::size_t place = 0;
  while (const std::size_t count = this->Read(array, place, characters))
  {
    const auto end = characters.begin() + static_cast<std::ptrdiff_t>(count);
    // Each ends with a zero.
    strings += static_cast<double>(std::count(characters.begin(), end, '\0'));
    if (strings > limit)
    {
      return false;
    }
    place += count;
  }
  return true;
}

std::size_t XMLStrings::Read(
  vtkXMLDataElement* array, std::size_t place, std::vector<char>& characters)
{
  vtkTypeInt64 offset = 0;
  if (array->GetScalarAttribute("offset", offset))
  {
    return this->Parser->ReadAppendedData(
      offset, characters.data(), place, characters.size(), VTK_CHAR);
  }
  const char* format = array->GetAttribute("format");
  const bool isText = !format || std::strcmp(format, "binary") != 0;
  return this->Parser->ReadInlineData(
    array, isText ? 1 : 0, characters.data(), place, characters.size(), VTK_CHAR);
}
}
