// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfXMLArrayHeaders.h"

#include "Files/cslfFileSystem.h"

#include <vtkBase64Utilities.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkType.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

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

namespace
{
/// The header of a compressed array.
constexpr std::size_t HeaderWords = 3;

std::string GetText(vtkXMLDataElement* element, const char* name)
{
  const char* text = element->GetAttribute(name);
  return text ? text : "";
}

/// The most bytes that one compressed byte can contain: zlib has codes of two bits for 258 bytes
/// each, lengths in LZ4 grow by 255 a byte, and LZMA spends at least 14 choices of 0.022 bits on
/// 273 bytes.
double GetLargestRatio(const std::string& compressor)
{
  return compressor == "vtkZLibDataCompressor" ? 1032.0
    : compressor == "vtkLZ4DataCompressor"     ? 255.0
                                               : 7100.0;
}
}

XMLArrayHeaders::XMLArrayHeaders(const std::string& fileName, vtkXMLDataParser* parser)
  : File(ToPath(fileName), std::ios::binary)
{
  std::error_code failure;
  const auto size = std::filesystem::file_size(ToPath(fileName), failure);
  this->FileSize = failure ? 0.0 : static_cast<double>(size);
  vtkXMLDataElement* root = parser->GetRootElement();
  const std::string compressor = GetText(root, "compressor");
  this->IsCompressed = root->GetAttribute("compressor") != nullptr;
  this->MaximumRatio = GetLargestRatio(compressor);
  this->IsBigEndian = GetText(root, "byte_order") == "BigEndian";
  this->WordSize = GetText(root, "header_type") == "UInt64" ? 8 : 4;
  if (vtkXMLDataElement* data = root->FindNestedElementWithName("AppendedData"))
  {
    this->AppendedData = parser->GetAppendedDataPosition();
    this->IsAppendedBase64 = GetText(data, "encoding") != "raw";
  }
}

bool XMLArrayHeaders::Fit(vtkXMLDataElement* array, double mostBytes)
{
  const Place place = this->Find(array);
  if (place.Begin < 0)
  {
    return true;
  }
  if (!this->IsCompressed)
  {
    // The number of bytes.
    const std::vector<double> words = this->ReadWords(place, 1);
    return words.empty() || words[0] <= this->FileSize;
  }
  // The number of blocks, the size of each, and that of the last one if it is not full. The sizes
  // of the compressed blocks follow, one word each.
  const std::vector<double> words = this->ReadWords(place, HeaderWords);
  if (words.empty() || words[0] == 0.0)
  {
    return true;
  }
  // VTK divides by the size of a block.
  const double blocks = words[0];
  const double full = words[2] > 0.0 ? blocks - 1.0 : blocks;
  return words[1] > 0.0 && words[2] <= words[1] && blocks * this->WordSize <= this->FileSize &&
    full * words[1] + words[2] <= mostBytes && this->FitBlocks(place, words);
}

bool XMLArrayHeaders::FitBlocks(const Place& place, const std::vector<double>& header)
{
  const auto blocks = static_cast<std::size_t>(header[0]);
  const std::vector<double> words = this->ReadWords(place, HeaderWords + blocks);
  if (words.empty())
  {
    return true;
  }
  double bytes = static_cast<double>(words.size() * this->WordSize);
  for (std::size_t block = 0; block < blocks; ++block)
  {
    const bool isPartial = block + 1 == blocks && header[2] > 0.0;
    const double compressed = words[HeaderWords + block];
    if ((isPartial ? header[2] : header[1]) > this->MaximumRatio * compressed)
    {
      return false;
    }
    bytes += compressed;
  }
  return bytes * (place.IsBase64 ? 4.0 / 3.0 : 1.0) <=
    this->FileSize - static_cast<double>(place.Begin);
}

XMLArrayHeaders::Place XMLArrayHeaders::Find(vtkXMLDataElement* array)
{
  // VTK requests the format only if there is no offset.
  if (array->GetAttribute("offset"))
  {
    vtkTypeInt64 offset = 0;
    const bool isThere =
      this->AppendedData >= 0 && array->GetScalarAttribute("offset", offset) && offset >= 0;
    const std::int64_t begin = isThere ? this->AppendedData + offset : -1;
    return { begin, this->IsAppendedBase64 };
  }
  if (GetText(array, "format") != "binary")
  {
    return {};
  }
  this->File.clear();
  this->File.seekg(array->GetXMLByteIndex());
  this->File.ignore(std::numeric_limits<std::streamsize>::max(), '>');
  this->File >> std::ws;
  return { static_cast<std::int64_t>(this->File.tellg()), true };
}

std::vector<double> XMLArrayHeaders::ReadWords(const Place& place, std::size_t count)
{
  const std::size_t length = count * this->WordSize;
  std::string text(place.IsBase64 ? (length + 2) / 3 * 4 : length, '\0');
  this->File.clear();
  this->File.seekg(place.Begin);
  this->File.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(this->File.gcount()));
  std::string bytes = text;
  if (place.IsBase64)
  {
    bytes.resize(text.size() / 4 * 3);
    bytes.resize(
      vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(text.data()),
        text.size() / 4 * 4, reinterpret_cast<unsigned char*>(bytes.data()), bytes.size()));
  }
  if (bytes.size() < length)
  {
    return {};
  }
  std::vector<double> words(count, 0.0);
  for (std::size_t i = 0; i < length; ++i)
  {
    // From the highest to the lowest byte of each word.
    const std::size_t within = i % this->WordSize;
    const std::size_t from = this->IsBigEndian ? i : i + this->WordSize - 1 - 2 * within;
    double& word = words[i / this->WordSize];
    word = word * 256.0 + static_cast<unsigned char>(bytes[from]);
  }
  return words;
}
}
