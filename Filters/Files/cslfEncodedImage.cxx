// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEncodedImage.h"

#include "Images/cslfImageFiles.h"

#include <vtk_png.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

namespace cslf
{
namespace
{
// A small file may contain a large image of one colour. An image of this size takes 1 GiB.
constexpr std::uint64_t MaximumPixels = std::uint64_t(1) << 28;

constexpr const char* PNGName = "image.png";

/// The bytes of a file.
struct Bytes
{
  const unsigned char* Data;
  std::size_t Size;

  bool HasAt(std::size_t offset, const char* mark) const
  {
    const std::size_t length = std::strlen(mark);
    return this->Size >= offset + length && std::memcmp(this->Data + offset, mark, length) == 0;
  }
};

/// A file name from which OpenImageIO recognises the format of an image. Empty for other formats
/// than these without an extension.
std::string FindFormat(const Bytes& bytes, const std::string& extension)
{
  if (bytes.HasAt(0, "\x89PNG\r\n\x1a\n"))
  {
    return PNGName;
  }
  if (bytes.HasAt(0, "\xff\xd8\xff"))
  {
    return "image.jpg";
  }
  if (bytes.HasAt(0, "RIFF") && bytes.HasAt(8, "WEBP"))
  {
    return "image.webp";
  }
  return extension.empty() ? "" : "image" + extension;
}

// A PNG file is a signature and chunks: a length, a type, bytes and a checksum. Numbers are
// big-endian.
constexpr std::size_t PNGSignature = 8;
constexpr std::size_t PNGChunkEnds = 12;
// Where the first chunk tells the bits of a sample.
constexpr std::size_t PNGDepth = 24;

/// The chunks of a PNG file that define pixels. Textures ignore its colour space (glTF, section
/// 3.8.2). Damage is detected here, because OpenImageIO's PNG library would print messages. Empty
/// on damage.
std::string KeepPixels(const Bytes& bytes, std::string& error)
{
  static const std::set<std::string> kept = { "IHDR", "PLTE", "tRNS", "IDAT", "IEND" };
  std::string result(reinterpret_cast<const char*>(bytes.Data), PNGSignature);
  std::string type;
  for (std::size_t offset = PNGSignature; type != "IEND";)
  {
    const unsigned char* chunk = bytes.Data + offset;
    const std::size_t rest = bytes.Size - offset;
    const std::size_t length = rest < PNGChunkEnds ? rest : ReadBigEndian(chunk);
    if (rest < PNGChunkEnds || length > rest - PNGChunkEnds)
    {
      error = "cannot be decoded: it is truncated";
      return {};
    }
    type.assign(reinterpret_cast<const char*>(chunk) + 4, 4);
    if (kept.count(type) != 0)
    {
      const uLong checksum = crc32(0, chunk + 4, static_cast<uInt>(length + 4));
      if (checksum != ReadBigEndian(chunk + 8 + length))
      {
        error = "cannot be decoded: it is damaged";
        return {};
      }
      result.append(reinterpret_cast<const char*>(chunk), length + PNGChunkEnds);
    }
    offset += length + PNGChunkEnds;
  }
  return result;
}

/// An image of 8 bits, whose values are not set. Null if its size is not supported.
vtkSmartPointer<vtkImageData> MakeImage(
  std::uint64_t width, std::uint64_t height, int components, std::string& error)
{
  const bool hasSize =
    width * height > 0 && width * height <= MaximumPixels && components > 0 && components <= 4;
  if (!hasSize)
  {
    error = "has a size that is not supported";
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(static_cast<int>(width), static_cast<int>(height), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  return image;
}

vtkSmartPointer<vtkImageData> Decode(
  const Bytes& bytes, const std::string& format, std::string& error)
{
  std::string reason;
  const auto input = OpenImage({ format, "", bytes.Data, bytes.Size, true }, reason);
  if (!input)
  {
    error = "cannot be decoded: " + reason;
    return nullptr;
  }
  const ImageHeader& header = input->GetHeader();
  auto image = MakeImage(header.Width, header.Height, header.Channels, error);
  if (!image)
  {
    return nullptr;
  }
  const std::size_t row = static_cast<std::size_t>(header.Width) * header.Channels;
  std::vector<unsigned char> pixels(row * header.Height);
  if (!input->Read(PixelType::Bytes, pixels.data(), reason))
  {
    error = "cannot be decoded: " + reason;
    return nullptr;
  }
  auto* target = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int y = 0; y < header.Height; ++y)
  {
    std::memcpy(target + y * row, pixels.data() + (header.Height - 1 - y) * row, row);
  }
  return image;
}

/// The same for PNG files of at most 8 bits, without loading OpenImageIO.
vtkSmartPointer<vtkImageData> DecodePNG(const Bytes& bytes, std::string& error)
{
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  vtkSmartPointer<vtkImageData> image;
  if (png_image_begin_read_from_memory(&png, bytes.Data, bytes.Size))
  {
    png.format &= PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_ALPHA;
    image = MakeImage(png.width, png.height, PNG_IMAGE_SAMPLE_CHANNELS(png.format), error);
    const auto row = static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(png));
    if (image && !png_image_finish_read(&png, nullptr, image->GetScalarPointer(), -row, nullptr))
    {
      image = nullptr;
    }
  }
  if (!image && error.empty())
  {
    error = std::string("cannot be decoded: ") + png.message;
  }
  png_image_free(&png);
  return image;
}
}

vtkSmartPointer<vtkImageData> DecodeImage(
  const unsigned char* data, std::size_t size, const std::string& extension, std::string& error)
{
  const Bytes bytes = { data, size };
  const std::string format = FindFormat(bytes, extension);
  if (format.empty())
  {
    error = "is not PNG, JPEG or WebP";
    return nullptr;
  }
  if (format != PNGName)
  {
    return Decode(bytes, format, error);
  }
  const std::string pixelsOnly = KeepPixels(bytes, error);
  if (pixelsOnly.empty())
  {
    return nullptr;
  }
  const Bytes kept = { reinterpret_cast<const unsigned char*>(pixelsOnly.data()),
    pixelsOnly.size() };
  const bool isDeep = kept.Size > PNGDepth && kept.Data[PNGDepth] > 8;
  return isDeep ? Decode(kept, format, error) : DecodePNG(kept, error);
}
}
