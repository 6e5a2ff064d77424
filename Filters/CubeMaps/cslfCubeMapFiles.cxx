// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCubeMapFiles.h"

#include "Files/cslfEncodedImage.h"
#include "Files/cslfFileSystem.h"
#include "Files/cslfJSONFile.h"
#include "Images/cslfImageFiles.h"
#include "cslfJSONText.h"

#include <vtkType.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace cslf
{
namespace
{
/// Reads the bytes of a file in order. Bytes beyond its end are zeros, and set the failure flag.
class ByteReader
{
public:
  ByteReader(const unsigned char* begin, std::size_t size)
    : Place(begin)
    , End(begin + size)
  {
  }

  bool HasFailed() const { return this->Failed; }
  bool IsAtEnd() const { return this->Place == this->End; }

  std::uint32_t TakeInteger()
  {
    const ByteReader bytes = this->Take(4);
    std::uint32_t value = 0;
    for (const unsigned char* byte = bytes.End; byte != bytes.Place;)
    {
      value = value << 8 | *--byte;
    }
    return value;
  }

  /// Up to and including a zero.
  std::string TakeText()
  {
    const unsigned char* zero = std::find(this->Place, this->End, 0);
    std::string text(this->Place, zero);
    this->Take(static_cast<std::size_t>(zero - this->Place) + 1);
    return text;
  }

  ByteReader Take(std::size_t count)
  {
    this->Failed = this->Failed || count > static_cast<std::size_t>(this->End - this->Place);
    if (this->Failed)
    {
      return { this->End, 0 };
    }
    this->Place += count;
    return { this->Place - count, count };
  }

private:
  const unsigned char* Place;
  const unsigned char* End;
  bool Failed = false;
};

/// Whether the value of a window, [xMin, yMin, xMax, yMax], has that size.
bool IsOfSize(ByteReader window, int width, int height)
{
  std::int64_t corners[4];
  for (std::int64_t& corner : corners)
  {
    corner = static_cast<std::int32_t>(window.TakeInteger());
  }
  return corners[2] - corners[0] + 1 == width && corners[3] - corners[1] + 1 == height;
}

/// Whether a list of channels ends where its bytes do. OpenEXR reads up to the empty name that ends
/// the list, and takes what follows for the next attribute.
bool IsWholeChannelList(ByteReader list)
{
  // A channel has its name, its type, four bytes, and its two sampling rates.
  constexpr std::size_t channelSize = 16;
  while (!list.HasFailed() && !list.TakeText().empty())
  {
    list.Take(channelSize);
  }
  return !list.HasFailed() && list.IsAtEnd();
}

/// Whether OpenEXR reads as many bytes of an attribute's value as the file states. For most types,
/// it uses a fixed size and ignores that of the file.
bool IsWholeValue(const std::string& type, const ByteReader& value, std::size_t size)
{
  static const std::map<std::string, std::size_t> sizes = { { "box2f", 16 }, { "box2i", 16 },
    { "chromaticities", 32 }, { "compression", 1 }, { "double", 8 }, { "envmap", 1 },
    { "float", 4 }, { "int", 4 }, { "keycode", 28 }, { "lineOrder", 1 }, { "m33d", 72 },
    { "m33f", 36 }, { "m44d", 128 }, { "m44f", 64 }, { "rational", 8 }, { "timecode", 8 },
    { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 }, { "v3f", 12 }, { "v3i", 12 } };
  if (type == "chlist")
  {
    return IsWholeChannelList(value);
  }
  const auto known = sizes.find(type);
  return type == "string" || (known != sizes.end() && known->second == size);
}
}

bool IsSoundEXR(const std::vector<unsigned char>& content, int width, int height)
{
  constexpr std::uint32_t magic = 20000630;
  constexpr std::uint32_t versionAndLongNames = 0x4ff;
  ByteReader header(content.data(), content.size());
  if (header.TakeInteger() != magic || (header.TakeInteger() & ~versionAndLongNames) != 0)
  {
    return false;
  }
  bool isOfSize = false;
  // An attribute has its name, its type, the size of its value, and the value. An empty name ends
  // the list.
  for (std::string name = header.TakeText(); !name.empty(); name = header.TakeText())
  {
    const std::string type = header.TakeText();
    const std::size_t size = header.TakeInteger();
    const ByteReader value = header.Take(size);
    const bool isWindow = name == "dataWindow";
    if (header.HasFailed() || !IsWholeValue(type, value, size) ||
      (isWindow && (type != "box2i" || !IsOfSize(value, width, height))))
    {
      return false;
    }
    isOfSize = isOfSize || isWindow;
  }
  return isOfSize && !header.HasFailed();
}

namespace
{
// The key that the folder's description has besides the field's keys.
constexpr const char* SlicesKey = "slices";

// PNG has checksums, but EXR does not: this attribute of an image is the CRC-32 of its pixels.
constexpr const char* ChecksumAttribute = "cslf:crc32";

std::string ComputeChecksum(const std::vector<unsigned char>& pixels)
{
  const auto crc = crc32_z(0, pixels.data(), pixels.size());
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%08lx", static_cast<unsigned long>(crc));
  return text.data();
}

PixelType FindPixelType(const Channel& channel)
{
  switch (channel.Type)
  {
    case VTK_UNSIGNED_CHAR:
      return PixelType::Bytes;
    case VTK_UNSIGNED_SHORT:
      return PixelType::Words;
    case VTK_FLOAT:
      return PixelType::Floats;
    default:
      return PixelType::Other;
  }
}

bool IsFileNamePart(const std::string& name)
{
  const auto isAllowed = [](unsigned char c)
  { return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == ' '; };
  return !name.empty() && name.size() <= 100 && std::all_of(name.begin(), name.end(), isAllowed);
}

ImageHeader MakeHeader(const Layout& grid, const Channel& channel)
{
  ImageHeader header;
  header.Width = FaceCount * grid.GetResolution();
  header.Height = grid.GetResolution();
  header.Channels = channel.Components;
  header.Type = FindPixelType(channel);
  header.Attributes[ColorSpaceAttribute] = channel.Encoding == SRGBEncoding ? "sRGB" : "Linear";
  if (channel.Type == VTK_FLOAT)
  {
    header.Attributes["compression"] = "zip";
  }
  header.Attributes["ImageDescription"] = channel.Name + ", " + channel.Encoding;
  return header;
}

/// The bytes of an image file. None if there is no such file, or if it is larger than an image of
/// so many pixels can be.
std::vector<unsigned char> ReadBytes(const std::string& fileName, std::uintmax_t pixels)
{
  constexpr std::uintmax_t mostOfPixel = 64;
  constexpr std::uintmax_t mostOfRest = 1 << 20;
  std::error_code failure;
  if (!std::filesystem::is_regular_file(ToPath(fileName), failure) ||
    std::filesystem::file_size(ToPath(fileName), failure) > mostOfPixel * pixels + mostOfRest)
  {
    return {};
  }
  std::ifstream file(ToPath(fileName), std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// Whether a PNG file has that size, an end chunk and correct checksums. libpng checks this too,
/// but prints errors.
bool IsWholePNG(const std::vector<unsigned char>& content, int width, int height)
{
  // The first chunk is the header, which begins with the size.
  constexpr std::size_t sizeOffset = 16;
  const unsigned char* bytes = content.data();
  if (content.size() < sizeOffset + 8 || std::memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) != 0 ||
    std::memcmp(bytes + sizeOffset - 4, "IHDR", 4) != 0 ||
    ReadBigEndian(bytes + sizeOffset) != static_cast<std::uint32_t>(width) ||
    ReadBigEndian(bytes + sizeOffset + 4) != static_cast<std::uint32_t>(height))
  {
    return false;
  }
  // A chunk has the length of its data, a name of 4 letters, the data, and the checksum of both.
  for (std::size_t chunk = 8; chunk + 12 <= content.size();)
  {
    const std::size_t length = ReadBigEndian(bytes + chunk);
    if (length > content.size() - chunk - 12 ||
      crc32(0, bytes + chunk + 4, static_cast<uInt>(length + 4)) !=
        ReadBigEndian(bytes + chunk + 8 + length))
    {
      return false;
    }
    if (std::memcmp(bytes + chunk + 4, "IEND", 4) == 0)
    {
      return true;
    }
    chunk += length + 12;
  }
  return false;
}

std::unique_ptr<ImageReader> OpenCubeMap(
  const std::string& fileName, const Layout& grid, const Channel& channel)
{
  const bool isEXR = channel.Type == VTK_FLOAT;
  const int height = grid.GetResolution();
  const int width = FaceCount * height;
  const std::vector<unsigned char> content = ReadBytes(fileName, std::uintmax_t(width) * height);
  if (!(isEXR ? IsSoundEXR(content, width, height) : IsWholePNG(content, width, height)))
  {
    return nullptr;
  }
  std::string reason;
  auto input = OpenImage({ fileName, isEXR ? "openexr" : "png", nullptr, 0, true }, reason);
  if (!input)
  {
    return nullptr;
  }
  const ImageHeader& header = input->GetHeader();
  const bool fits = header.Width == width && header.Height == height &&
    header.Channels == channel.Components && header.Type == FindPixelType(channel);
  return fits ? std::move(input) : nullptr;
}

/// Calls `copy(strip offset, cube map offset, bytes)` for each row of each exit face.
template <typename Copy>
void ForEachRow(const Layout& grid, int entryFace, int texelBytes, Copy copy)
{
  const std::size_t row = static_cast<std::size_t>(grid.GetResolution()) * texelBytes;
  for (int y = 0; y < grid.GetResolution(); ++y)
  {
    for (int tile = 0; tile < TileCount; ++tile)
    {
      const int exitFace = ExitFaceOf(entryFace, tile);
      copy((std::size_t(y) * TileCount + tile) * row, (std::size_t(y) * FaceCount + exitFace) * row,
        row);
    }
  }
}

/// Makes the file in memory first, because OpenImageIO does not notice all disk errors.
bool WritePixels(
  const std::string& fileName, const ImageHeader& header, const void* pixels, std::string& error)
{
  const ImageLibrary* library = GetImageLibrary(error);
  std::vector<unsigned char> bytes;
  return library && library->Encode(fileName, header, pixels, bytes, error) &&
    MakeFile(fileName, bytes.data(), bytes.size(), error);
}
}

bool CheckCubeMapChannels(const Description& description, std::string& error)
{
  for (const Channel& channel : description.Channels)
  {
    if (!IsFileNamePart(channel.Name))
    {
      error = "The channel \"" + channel.Name + "\" has a name that cannot be part of a file name.";
      return false;
    }
    const bool isKnown = FindPixelType(channel) != PixelType::Other;
    if (!isKnown || (channel.Type != VTK_FLOAT && channel.Components > 4))
    {
      error = "The channel \"" + channel.Name +
        "\" has a type that cube maps cannot hold: they take 1 to 4 components of 8 or 16 bits, "
        "or float.";
      return false;
    }
  }
  return true;
}

std::string CubeMapFileName(const std::string& folder, const Channel& channel, int slice)
{
  std::string number = std::to_string(slice);
  number.insert(0, std::max<int>(0, 6 - static_cast<int>(number.size())), '0');
  const char* extension = channel.Type == VTK_FLOAT ? ".exr" : ".png";
  return folder + "/" + number + "." + channel.Name + extension;
}

bool WriteCubeMapDescription(
  const std::string& folder, const CubeMapFolder& content, std::string& error)
{
  nlohmann::json json = content.Field.ToJSON();
  json[SlicesKey] = { content.Slices.First, content.Slices.Last };
  const std::string text = json.dump(2) + "\n";
  return MakeFile(folder + "/" + CubeMapDescriptionName, text.data(), text.size(), error);
}

std::vector<std::string> ListCubeMapFiles(const std::string& folder)
{
  std::vector<std::string> files;
  std::string ignored;
  if (const auto content = ReadCubeMapDescription(folder, ignored))
  {
    const std::vector<std::string> names = ListFolder(folder);
    for (const Channel& channel : content->Field.Channels)
    {
      for (int slice = content->Slices.First; slice <= content->Slices.Last; ++slice)
      {
        const std::string name = ToName(ToPath(CubeMapFileName(folder, channel, slice)).filename());
        if (std::binary_search(names.begin(), names.end(), name))
        {
          files.push_back(name);
        }
      }
    }
  }
  // Written last, because it marks a complete folder.
  files.emplace_back(CubeMapDescriptionName);
  return files;
}

std::optional<CubeMapFolder> ReadCubeMapDescription(const std::string& folder, std::string& error)
{
  const std::string fileName = folder + "/" + CubeMapDescriptionName;
  const auto json = ReadJSON(fileName);
  if (!json.is_object())
  {
    error = "The folder " + folder + " is not a light field: it has no readable " +
      CubeMapDescriptionName + ".";
    return std::nullopt;
  }
  auto description = Description::FromJSON(json, error);
  if (!description || !CheckCubeMapChannels(*description, error))
  {
    return std::nullopt;
  }
  CubeMapFolder content{ *description, { 0, description->Grid.GetSlices() - 1 } };
  try
  {
    const auto slices = ToIntegers(json.at(SlicesKey));
    content.Slices = { slices.at(0), slices.at(1) };
  }
  catch (const std::exception&)
  {
    content.Slices = {};
  }
  if (content.Slices.First < 0 || content.Slices.Last >= description->Grid.GetSlices() ||
    content.Slices.GetCount() < 1)
  {
    error = fileName + " does not list the slices of the folder correctly.";
    return std::nullopt;
  }
  return content;
}

bool WriteCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice,
  const unsigned char* texels, std::string& error)
{
  const int texelBytes = channel.GetTexelBytes();
  const std::size_t texelCount =
    static_cast<std::size_t>(FaceCount) * grid.GetResolution() * grid.GetResolution();
  std::vector<unsigned char> pixels(texelCount * texelBytes);
  FillEmpty(channel, pixels.data(), texelCount);
  ForEachRow(grid, grid.ViewpointOf(slice).Face, texelBytes,
    [&](std::size_t strip, std::size_t cubeMap, std::size_t bytes)
    { std::memcpy(pixels.data() + cubeMap, texels + strip, bytes); });

  ImageHeader header = MakeHeader(grid, channel);
  if (channel.Type == VTK_FLOAT)
  {
    header.Attributes[ChecksumAttribute] = ComputeChecksum(pixels);
  }
  return WritePixels(CubeMapFileName(folder, channel, slice), header, pixels.data(), error);
}

bool ReadCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice,
  unsigned char* texels)
{
  const std::string fileName = CubeMapFileName(folder, channel, slice);
  auto input = OpenCubeMap(fileName, grid, channel);
  if (!input)
  {
    return false;
  }
  const int texelBytes = channel.GetTexelBytes();
  std::vector<unsigned char> pixels(
    std::size_t(FaceCount) * grid.GetResolution() * grid.GetResolution() * texelBytes);
  std::string reason;
  if (!input->Read(FindPixelType(channel), pixels.data(), reason))
  {
    return false;
  }
  const auto expected = input->GetHeader().Attributes.find(ChecksumAttribute);
  if (expected != input->GetHeader().Attributes.end() &&
    expected->second != ComputeChecksum(pixels))
  {
    return false;
  }
  ForEachRow(grid, grid.ViewpointOf(slice).Face, texelBytes,
    [&](std::size_t strip, std::size_t cubeMap, std::size_t bytes)
    { std::memcpy(texels + strip, pixels.data() + cubeMap, bytes); });
  return true;
}

bool ProbeCubeMap(const std::string& folder, const Layout& grid, const Channel& channel, int slice)
{
  if (channel.Type != VTK_FLOAT)
  {
    return OpenCubeMap(CubeMapFileName(folder, channel, slice), grid, channel) != nullptr;
  }
  std::vector<unsigned char> texels(
    std::size_t(TileCount) * grid.GetResolution() * grid.GetResolution() * channel.GetTexelBytes());
  return ReadCubeMap(folder, grid, channel, slice, texels.data());
}
}
