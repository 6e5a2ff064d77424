// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMapImage.h"

#include "cslfColor.h"
#include "cslfJSONText.h"
#include "cslfParallelFor.h"

#include <cstdio> // jpeglib.h needs it
#include <vtk_jpeg.h>
#include <zlib.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace cslf
{
namespace
{
/// The components of a pixel in files.
constexpr int Components = 3;

/// The most pixels along an edge: graphics drivers have textures of that size.
constexpr int MaximumSize = 8192;

/// The most steps of a pixel.
constexpr int MaximumPixelSteps = 65536;

/// More bytes are refused, so that a file cannot ask for much memory.
constexpr std::uint64_t MaximumBytes = std::uint64_t(1) << 28;

/// How JPEG files may be made, from few bytes to many.
struct JPEGStyle
{
  int Quality;
  bool HasCoarseChroma;
};
constexpr JPEGStyle Styles[] = { { 80, true }, { 88, true }, { 85, false }, { 91, false },
  { 95, false }, { 98, false } };

/// The RMS error of sRGB-encoded bytes that one may have.
constexpr double MaximumError = 2.5;

constexpr const char* SizeKey = "size";
constexpr const char* RepeatsKey = "repeats";
constexpr const char* PixelStepsKey = "steps";
constexpr const char* SmoothKey = "smooth";
constexpr const char* JPEGKey = "jpeg";
constexpr const char* BytesKey = "bytes";

/// How libjpeg reports errors.
struct JPEGErrors
{
  jpeg_error_mgr Base; // first, so that both have one address
  std::jmp_buf Place;
};

[[noreturn]] void FailJPEG(j_common_ptr info)
{
  std::longjmp(reinterpret_cast<JPEGErrors*>(info->err)->Place, 1);
}

void IgnoreMessage(j_common_ptr) {}

/// Encodes rows of three components, the lowest first, into memory that the caller frees. False if
/// it cannot. Nothing here may have a destructor. VTK's writer always makes chroma coarser.
bool EncodeJPEG(const unsigned char* rows, const MapImage::Layout& layout, const JPEGStyle& style,
  unsigned char** bytes, unsigned long* size)
{
  jpeg_compress_struct info;
  JPEGErrors errors;
  info.err = jpeg_std_error(&errors.Base);
  errors.Base.error_exit = FailJPEG;
  errors.Base.output_message = IgnoreMessage;
  jpeg_create_compress(&info);
  if (setjmp(errors.Place))
  {
    jpeg_destroy_compress(&info);
    return false;
  }
  jpeg_mem_dest(&info, bytes, size);
  info.image_width = static_cast<JDIMENSION>(layout.Width);
  info.image_height = static_cast<JDIMENSION>(layout.Height);
  info.input_components = Components;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, style.Quality, TRUE);
  info.optimize_coding = TRUE;
  const int factor = style.HasCoarseChroma ? 2 : 1;
  info.comp_info[0].h_samp_factor = factor;
  info.comp_info[0].v_samp_factor = factor;
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height)
  {
    const std::size_t row = info.image_height - 1 - info.next_scanline;
    auto* place =
      const_cast<unsigned char*>(rows + row * std::size_t(layout.Width) * Components); // only read
    jpeg_write_scanlines(&info, &place, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  return true;
}

std::vector<unsigned char> EncodeJPEG(
  const unsigned char* rows, const MapImage::Layout& layout, const JPEGStyle& style)
{
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool isEncoded = EncodeJPEG(rows, layout, style, &bytes, &size);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(bytes, &std::free);
  if (!isEncoded)
  {
    throw std::runtime_error("an image cannot be encoded");
  }
  return { bytes, bytes + size };
}

/// Fills rows of three components, the lowest first. False if the bytes are no whole image of that
/// size. Nothing here may have a destructor. VTK's reader loops or crashes on what is damaged.
bool DecodeJPEG(
  const unsigned char* bytes, std::size_t size, int width, int height, unsigned char* rows)
{
  jpeg_decompress_struct info;
  JPEGErrors errors;
  info.err = jpeg_std_error(&errors.Base);
  errors.Base.error_exit = FailJPEG;
  errors.Base.output_message = IgnoreMessage;
  jpeg_create_decompress(&info);
  if (setjmp(errors.Place))
  {
    jpeg_destroy_decompress(&info);
    return false;
  }
  jpeg_mem_src(
    &info, const_cast<unsigned char*>(bytes), static_cast<unsigned long>(size)); // it only reads
  jpeg_read_header(&info, TRUE);
  // Files of many scans take long.
  bool isSound = static_cast<int>(info.image_width) == width &&
    static_cast<int>(info.image_height) == height && info.num_components == Components &&
    !jpeg_has_multiple_scans(&info);
  if (isSound)
  {
    info.out_color_space = JCS_RGB;
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height)
    {
      const std::size_t row = info.output_height - 1 - info.output_scanline;
      JSAMPROW place = rows + row * static_cast<std::size_t>(width) * Components;
      jpeg_read_scanlines(&info, &place, 1);
    }
    jpeg_finish_decompress(&info);
    isSound = errors.Base.num_warnings == 0;
  }
  jpeg_destroy_decompress(&info);
  return isSound;
}

std::vector<unsigned char> EncodePlanes(const unsigned char* values, std::size_t count)
{
  std::vector<unsigned char> bytes(Components * count);
  auto* place = bytes.data();
  for (int c = 0; c < Components; ++c)
  {
    unsigned char before = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const unsigned char value = values[Components * i + c];
      *place++ = static_cast<unsigned char>(value - std::exchange(before, value));
    }
  }
  return bytes;
}

std::size_t CountCompressed(const std::vector<unsigned char>& bytes)
{
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<unsigned char> compressed(size);
  const int result = compress2(
    compressed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  return result == Z_OK ? size : bytes.size();
}

/// Throws std::exception if the bytes are no image of that size.
std::vector<MapImage::Pixel> Decode(
  const std::vector<unsigned char>& bytes, const MapImage::Layout& layout)
{
  const std::size_t count = std::size_t(layout.Width) * layout.Height;
  std::vector<MapImage::Pixel> pixels(count);
  std::vector<unsigned char> values(layout.IsJPEG ? Components * count : 0);
  if (layout.IsJPEG
      ? !DecodeJPEG(bytes.data(), bytes.size(), layout.Width, layout.Height, values.data())
      : bytes.size() != Components * count)
  {
    throw std::invalid_argument("an image is damaged");
  }
  for (int c = 0; c < Components; ++c)
  {
    unsigned char value = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      value = layout.IsJPEG ? values[Components * i + c]
                            : static_cast<unsigned char>(value + bytes[c * count + i]);
      pixels[i][c] = value;
      pixels[i][3] = 255;
    }
  }
  return pixels;
}

/// The RMS of differences of sRGB-encoded bytes.
double FindError(const unsigned char* values, const std::vector<MapImage::Pixel>& pixels)
{
  double sum = 0.0;
  for (const MapImage::Pixel& pixel : pixels)
  {
    for (int c = 0; c < Components; ++c)
    {
      const double difference = double(*values++) - pixel[c];
      sum += difference * difference;
    }
  }
  return std::sqrt(sum / (Components * static_cast<double>(pixels.size())));
}

double WrapPlace(double value, int size, bool repeats)
{
  return repeats ? value - size * std::floor(value / size)
                 : std::clamp(value, 0.0, double(size - 1));
}
}

std::shared_ptr<const MapImage> MapImage::Make(
  const Layout& layout, const std::function<glm::vec3(const glm::dvec2& place)>& getColor)
{
  const std::size_t count = std::size_t(layout.Width) * layout.Height;
  std::vector<unsigned char> values(Components * count);
  ParallelFor(0, layout.Height, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType y = begin; y < end; ++y)
      {
        unsigned char* pixel = values.data() + Components * y * layout.Width;
        for (int x = 0; x < layout.Width; ++x)
        {
          const glm::dvec3 color(
            LinearToSRGB(glm::dvec3(getColor({ x + 0.5, static_cast<double>(y) + 0.5 }))));
          for (int c = 0; c < Components; ++c)
          {
            *pixel++ = ToByte(color[c]);
          }
        }
      }
    });
  auto made = std::make_shared<MapImage>();
  made->Own = layout;
  made->Own.IsJPEG = false;
  made->Encoded = EncodePlanes(values.data(), count);
  made->Pixels = Decode(made->Encoded, made->Own);
  const std::size_t most = CountCompressed(made->Encoded);
  for (const JPEGStyle& style : Styles)
  {
    std::vector<unsigned char> encoded = EncodeJPEG(values.data(), layout, style);
    if (encoded.size() >= most)
    {
      continue;
    }
    Layout asJPEG = layout;
    asJPEG.IsJPEG = true;
    std::vector<Pixel> pixels = Decode(encoded, asJPEG);
    if (FindError(values.data(), pixels) <= MaximumError)
    {
      made->Own = asJPEG;
      made->Encoded = std::move(encoded);
      made->Pixels = std::move(pixels);
      break;
    }
  }
  made->Own.Bytes = made->Encoded.size();
  return made;
}

std::shared_ptr<const MapImage> MapImage::Read(
  const Layout& layout, std::vector<unsigned char> encoded)
{
  auto image = std::make_shared<MapImage>();
  image->Own = layout;
  image->Pixels = Decode(encoded, layout);
  image->Encoded = std::move(encoded);
  return image;
}

void MapImage::Describe(const Layout& layout, nlohmann::json& json)
{
  json[SizeKey] = { layout.Width, layout.Height };
  json[RepeatsKey] = layout.Repeats;
  json[PixelStepsKey] = layout.Steps;
  json[SmoothKey] = layout.IsSmooth;
  json[JPEGKey] = layout.IsJPEG;
  json[BytesKey] = layout.Bytes;
}

MapImage::Layout MapImage::ReadLayout(const nlohmann::json& json)
{
  const auto size = json.at(SizeKey).get<std::array<int, 2>>();
  if (size[0] < 1 || size[1] < 1 || size[0] > MaximumSize || size[1] > MaximumSize)
  {
    throw std::invalid_argument("the size of an image is invalid");
  }
  const int steps = json.at(PixelStepsKey).get<int>();
  const std::uint64_t bytes = json.at(BytesKey).get<std::uint64_t>();
  if (bytes == 0 || bytes > MaximumBytes || steps < 1 || steps > MaximumPixelSteps)
  {
    throw std::invalid_argument("the size of an image is invalid");
  }
  return { size[0], size[1], json.at(RepeatsKey).get<std::array<bool, 2>>(), steps,
    json.at(SmoothKey).get<bool>(), json.at(JPEGKey).get<bool>(), static_cast<std::size_t>(bytes) };
}

// A pixel, given its number.
const MapImage::Pixel& MapImage::Get(double column, double row) const
{
  const auto x = static_cast<std::size_t>(WrapPlace(column, this->Own.Width, this->Own.Repeats[0]));
  const auto y = static_cast<std::size_t>(WrapPlace(row, this->Own.Height, this->Own.Repeats[1]));
  return this->Pixels[y * static_cast<std::size_t>(this->Own.Width) + x];
}

glm::vec3 MapImage::GetColor(const glm::dvec2& place) const
{
  const auto decode = [this](double column, double row) -> glm::dvec3
  {
    const Pixel& pixel = this->Get(column, row);
    return SRGBToLinear(glm::dvec3(pixel[0], pixel[1], pixel[2]) / 255.0);
  };
  if (!this->Own.IsSmooth)
  {
    return decode(std::floor(place.x), std::floor(place.y));
  }
  const glm::dvec2 first = glm::floor(place - 0.5);
  const glm::dvec2 share = place - 0.5 - first;
  return glm::mix(glm::mix(decode(first.x, first.y), decode(first.x + 1.0, first.y), share.x),
    glm::mix(decode(first.x, first.y + 1.0), decode(first.x + 1.0, first.y + 1.0), share.x),
    share.y);
}
}
