// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFImages.h"

#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace cslf
{
namespace
{
// A small file may contain a large image of one colour. An image of this size takes 1 GiB.
constexpr std::uint64_t MostPixels = std::uint64_t(1) << 28;

constexpr const char* PNGName = "image.png";

/// A file name from which OpenImageIO recognises the format of an image. Empty for formats that
/// glTF does not have.
const char* FindFormat(const GLTFBytes& bytes)
{
  const auto startsWith = [&bytes](std::size_t offset, const char* mark)
  {
    const std::size_t length = std::strlen(mark);
    return bytes.Size >= offset + length && std::memcmp(bytes.Data + offset, mark, length) == 0;
  };
  if (startsWith(0, "\x89PNG\r\n\x1a\n"))
  {
    return PNGName;
  }
  if (startsWith(0, "\xff\xd8\xff"))
  {
    return "image.jpg";
  }
  return startsWith(0, "RIFF") && startsWith(8, "WEBP") ? "image.webp" : "";
}

// A PNG file is a signature and chunks: a length, a type, bytes and a checksum. Numbers are
// big-endian.
constexpr std::size_t PNGSignature = 8;
constexpr std::size_t PNGChunkEnds = 12;

std::uint32_t ReadBigEndian(const unsigned char* bytes)
{
  return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 |
    std::uint32_t(bytes[2]) << 8 | std::uint32_t(bytes[3]);
}

/// The chunks of a PNG file that define pixels. glTF ignores its colour space (section 3.8.2).
/// Damage is detected here, because the PNG library would print messages.
std::string KeepPixels(const GLTFValue& owner, const GLTFBytes& bytes)
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
      owner.Fail("cannot be decoded: it is truncated");
    }
    type.assign(reinterpret_cast<const char*>(chunk) + 4, 4);
    if (kept.count(type) != 0)
    {
      const uLong checksum = crc32(0, chunk + 4, static_cast<uInt>(length + 4));
      if (checksum != ReadBigEndian(chunk + 8 + length))
      {
        owner.Fail("cannot be decoded: it is damaged");
      }
      result.append(reinterpret_cast<const char*>(chunk), length + PNGChunkEnds);
    }
    offset += length + PNGChunkEnds;
  }
  return result;
}

/// An image whose first row is the lowest, as in VTK.
vtkSmartPointer<vtkImageData> MakeImage(
  int width, int height, int components, const std::vector<unsigned char>& pixels)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  auto* target = static_cast<unsigned char*>(image->GetScalarPointer());
  const std::size_t row = static_cast<std::size_t>(width) * components;
  for (int y = 0; y < height; ++y)
  {
    std::memcpy(target + y * row, pixels.data() + (height - 1 - y) * row, row);
  }
  return image;
}

vtkSmartPointer<vtkImageData> Decode(const GLTFValue& owner, GLTFBytes bytes)
{
  const std::string format = FindFormat(bytes);
  if (format.empty())
  {
    owner.Fail("is not PNG, JPEG or WebP");
  }
  std::string pixelsOnly;
  if (format == PNGName)
  {
    pixelsOnly = KeepPixels(owner, bytes);
    bytes = { reinterpret_cast<const unsigned char*>(pixelsOnly.data()), pixelsOnly.size(), 0 };
  }
  OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes.Data), bytes.Size);
  OIIO::Filesystem::IOProxy* proxy = &memory;
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const auto input = OIIO::ImageInput::open(format, &config, proxy);
  if (!input)
  {
    owner.Fail("cannot be decoded: " + OIIO::geterror());
  }
  const OIIO::ImageSpec spec = input->spec();
  const bool hasSize = spec.width > 0 && spec.height > 0 && spec.nchannels > 0 &&
    spec.nchannels <= 4 && spec.image_pixels() <= MostPixels;
  if (!hasSize)
  {
    owner.Fail("has a size that is not supported");
  }
  std::vector<unsigned char> pixels(spec.image_pixels() * spec.nchannels);
  if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, pixels.data()))
  {
    owner.Fail("cannot be decoded: " + input->geterror());
  }
  return MakeImage(spec.width, spec.height, spec.nchannels, pixels);
}

/// An image without its alpha.
vtkSmartPointer<vtkImageData> DropAlpha(vtkImageData* image)
{
  auto* source = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  if (source->GetNumberOfComponents() % 2 != 0)
  {
    return image;
  }
  const int components = source->GetNumberOfComponents() - 1;
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(components);
  pixels->SetNumberOfTuples(source->GetNumberOfTuples());
  for (vtkIdType i = 0; i < source->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      pixels->SetTypedComponent(i, c, source->GetTypedComponent(i, c));
    }
  }
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->CopyStructure(image);
  copy->GetPointData()->SetScalars(pixels);
  return copy;
}
}

GLTFImages::GLTFImages(GLTFDocument& document)
  : Document(document)
{
}

vtkSmartPointer<vtkImageData> GLTFImages::Get(std::size_t index, bool dropAlpha)
{
  const std::pair<std::size_t, bool> key(index, dropAlpha);
  const auto found = this->Known.find(key);
  if (found != this->Known.end())
  {
    return found->second;
  }
  vtkSmartPointer<vtkImageData> image =
    dropAlpha ? DropAlpha(this->Get(index, false)) : this->Read(index);
  this->Known[key] = image;
  return image;
}

vtkSmartPointer<vtkImageData> GLTFImages::Read(std::size_t index)
{
  const GLTFValue image = this->Document.GetElement("images", index);
  if (const std::optional<std::size_t> view = image["bufferView"].GetIndex())
  {
    return Decode(image, this->Document.GetBufferView(*view));
  }
  const GLTFValue uri = image["uri"];
  if (!uri.IsPresent())
  {
    image.Fail("has neither a uri nor a bufferView");
  }
  const std::string bytes = this->Document.ReadResource(uri);
  return Decode(image, { reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), 0 });
}
}
