// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMapCodes.h"

#include "cslfColor.h"
#include "cslfGeometryStreams.h"
#include "cslfJSONText.h"

#include <vtkMath.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
/// The limits of the bits of a place.
constexpr int MinimumPlaceBits = 8;
constexpr int MaximumPlaceBits = 16;

/// A step of light changes displayed colours by the inverse of that many of their steps.
constexpr double StepShare = 0.75;

/// The fewest steps of light.
constexpr int MinimumSteps = 64;

/// The most maps: their number has a byte.
constexpr std::size_t MaximumMaps = 255;

///@{
/// The largest step of places: as a share of the range, and of sRGB-encoded colours.
constexpr double RangeStep = 1e-3;
constexpr double ColorStep = 0.5 / 255.0;
///@}

/// The most pixels of all images, so that a file cannot ask for much memory.
constexpr std::size_t MaximumPixels = std::size_t(1) << 27;

/// The bytes of a pixel.
constexpr std::size_t Channels = 4;

constexpr const char* MapsKey = "color_maps";
constexpr const char* PlacesKey = "places";
constexpr const char* BitsKey = "bits";
constexpr const char* LightKey = "maximum_light";
constexpr const char* LightStepsKey = "light_steps";
}

std::uint16_t MapCodes::Scale::ToCode(const glm::dvec2& place) const
{
  if (place.y > 0.5)
  {
    return static_cast<std::uint16_t>(this->GetNone());
  }
  const double size = this->Last - this->First;
  const double share = size > 0.0 ? (place.x - this->First) / size : 0.0;
  return static_cast<std::uint16_t>(
    std::lround(std::clamp(share, 0.0, 1.0) * (this->GetNone() - 1)));
}

glm::dvec2 MapCodes::Scale::ToPlace(int code, const ColorMap& map) const
{
  if (code == this->GetNone())
  {
    return map.GetPlace(vtkMath::Nan());
  }
  return { glm::mix(this->First, this->Last, double(code) / (this->GetNone() - 1)), 0.0 };
}

MapCodes::MapCodes(const MappedPoints& points)
  : Maps(points.Maps)
  , Scales(points.Maps.size())
{
  this->Fit(points);
  for (std::size_t i = 0; i < points.Numbers.size(); ++i)
  {
    const std::uint8_t number = points.Numbers[i];
    const bool hasPlace = number > 0 && !this->Maps[number - 1].IsImage();
    const int code = hasPlace ? this->Scales[number - 1].ToCode(points.GetPlace(i)) : 0;
    const auto low = static_cast<unsigned char>(code & 255);
    const auto high = static_cast<unsigned char>(code >> 8);
    this->Points.insert(this->Points.end(), { low, high, number, 0 });
  }
}

// The range and the bits of places, and of light.
void MapCodes::Fit(const MappedPoints& points)
{
  std::vector<char> areUsed(this->Maps.size(), 0);
  double light = 0.0;
  double baseSquares = 0.0;
  double mapped = 0.0;
  for (std::size_t i = 0; i < points.Numbers.size(); ++i)
  {
    const std::uint8_t number = points.Numbers[i];
    if (number == 0)
    {
      continue;
    }
    for (const std::vector<glm::vec3>& side : points.Light)
    {
      light = std::max({ light, double(side[i].x), double(side[i].y), double(side[i].z) });
    }
    const glm::dvec2 place = points.GetPlace(i);
    const glm::dvec3 base = LinearToSRGB(glm::dvec3(points.GetMap(i).GetColor(place)));
    baseSquares += glm::dot(base, base);
    mapped += 1.0;
    if (!points.GetMap(i).IsImage() && place.y < 0.5)
    {
      Scale& scale = this->Scales[number - 1];
      char& isUsed = areUsed[number - 1];
      scale.First = isUsed != 0 ? std::min(scale.First, place.x) : place.x;
      scale.Last = isUsed != 0 ? std::max(scale.Last, place.x) : place.x;
      isUsed = 1;
    }
  }
  // On dark surfaces, larger steps of light are those of colours.
  this->MaximumLight = light > 0.0 ? light : 1.0;
  const double base = std::sqrt(baseSquares / std::max(3.0 * mapped, 1.0));
  this->LightSteps =
    static_cast<int>(std::clamp(std::ceil(StepShare * MaximumSteps * this->MaximumLight * base),
      double(MinimumSteps), double(MaximumSteps)));
  for (std::size_t i = 0; i < this->Maps.size(); ++i)
  {
    const ColorMap& map = this->Maps[i];
    Scale& scale = this->Scales[i];
    if (map.IsImage())
    {
      continue;
    }
    const double step =
      std::min(RangeStep * map.GetSteps(), ColorStep / std::max(map.GetSteepness(), 1e-9));
    scale.Bits = MinimumPlaceBits;
    while (scale.Bits < MaximumPlaceBits && scale.Last - scale.First > step * (scale.GetNone() - 1))
    {
      ++scale.Bits;
    }
  }
}

void MapCodes::PutLight(
  const MappedPoints& points, int side, std::vector<unsigned char>& colors) const
{
  for (std::size_t i = 0; i < points.Numbers.size(); ++i)
  {
    for (int c = 0; points.Numbers[i] > 0 && c < 3; ++c)
    {
      const double share = points.Light[side][i][c] / this->MaximumLight;
      colors[Channels * i + c] =
        static_cast<unsigned char>(std::lround(this->LightSteps * std::clamp(share, 0.0, 1.0)));
    }
  }
}

void MapCodes::Describe(nlohmann::json& header) const
{
  for (std::size_t i = 0; i < this->Maps.size(); ++i)
  {
    nlohmann::json map = ParseJSON(DescribeColorMap(this->Maps[i]));
    if (!this->Maps[i].IsImage())
    {
      map[PlacesKey] = { this->Scales[i].First, this->Scales[i].Last };
      map[BitsKey] = this->Scales[i].Bits;
    }
    header[MapsKey].push_back(std::move(map));
  }
  header[LightKey] = this->MaximumLight;
  header[LightStepsKey] = this->LightSteps;
}

MapCodes MapCodes::Read(const nlohmann::json& header)
{
  MapCodes codes;
  const nlohmann::json& maps = header.at(MapsKey);
  std::size_t pixels = 0;
  RequireSound(maps.is_array() && !maps.empty() && maps.size() <= MaximumMaps);
  for (const nlohmann::json& map : maps)
  {
    codes.Maps.push_back(ReadColorMap(map.dump()));
    if (codes.Maps.back().IsImage())
    {
      const MapImage::Layout& layout = codes.Maps.back().Layout;
      pixels += std::size_t(layout.Width) * layout.Height;
      RequireSound(pixels <= MaximumPixels);
      codes.Scales.emplace_back();
      continue;
    }
    const auto places = map.at(PlacesKey).get<std::array<double, 2>>();
    const Scale scale{ places[0], places[1], map.at(BitsKey).get<int>() };
    RequireSound(scale.First <= scale.Last && std::isfinite(scale.Last - scale.First) &&
      std::abs(scale.First) <= std::numeric_limits<float>::max() &&
      std::abs(scale.Last) <= std::numeric_limits<float>::max() && scale.Bits >= MinimumPlaceBits &&
      scale.Bits <= MaximumPlaceBits);
    codes.Scales.push_back(scale);
  }
  codes.MaximumLight = header.at(LightKey).get<double>();
  codes.LightSteps = header.at(LightStepsKey).get<int>();
  RequireSound(codes.MaximumLight > 0.0 && std::isfinite(float(codes.MaximumLight)) &&
    codes.LightSteps > 0 && codes.LightSteps <= MaximumSteps);
  return codes;
}

std::size_t MapCodes::GetColorSize() const
{
  std::size_t size = 0;
  for (const ColorMap& map : this->Maps)
  {
    size += map.IsImage() ? map.Layout.Bytes : Channels * (map.Colors.size() + 1);
  }
  return size;
}

// Of each map one component after the other, each less the one before; or an encoded image.
std::vector<unsigned char> MapCodes::PackColors() const
{
  std::vector<unsigned char> bytes;
  for (const ColorMap& map : this->Maps)
  {
    if (map.IsImage())
    {
      const std::vector<unsigned char>& encoded = map.Image->GetEncoded();
      bytes.insert(bytes.end(), encoded.begin(), encoded.end());
      continue;
    }
    for (std::size_t c = 0; c < Channels; ++c)
    {
      unsigned char before = 0;
      for (std::size_t i = 0; i <= map.Colors.size(); ++i)
      {
        const unsigned char value = (i < map.Colors.size() ? map.Colors[i] : map.NanColor)[c];
        bytes.push_back(static_cast<unsigned char>(value - std::exchange(before, value)));
      }
    }
  }
  return bytes;
}

void MapCodes::UnpackColors(const unsigned char* bytes)
{
  for (ColorMap& map : this->Maps)
  {
    if (map.IsImage())
    {
      map.Image = MapImage::Read(map.Layout, { bytes, bytes + map.Layout.Bytes });
      bytes += map.Layout.Bytes;
      continue;
    }
    for (std::size_t c = 0; c < Channels; ++c)
    {
      unsigned char value = 0;
      for (std::size_t i = 0; i <= map.Colors.size(); ++i)
      {
        value = static_cast<unsigned char>(value + *bytes++);
        (i < map.Colors.size() ? map.Colors[i] : map.NanColor)[c] = value;
      }
    }
  }
}

MappedPoints MapCodes::GetPoints(
  const std::vector<unsigned char>& colors, const std::vector<unsigned char>& backColors) const
{
  MappedPoints points;
  points.Maps = this->Maps;
  for (std::size_t i = 0; i < this->Points.size() / PointSize; ++i)
  {
    const unsigned char* code = &this->Points[PointSize * i];
    const std::uint8_t number = code[2];
    RequireSound(number <= this->Maps.size());
    double scalar = 0.0;
    if (number > 0 && !this->Maps[number - 1].IsImage())
    {
      const int place = code[0] + 256 * code[1];
      const Scale& scale = this->Scales[number - 1];
      RequireSound(place <= scale.GetNone());
      const ColorMap& map = this->Maps[number - 1];
      scalar = map.GetValue(scale.ToPlace(place, map));
    }
    points.Numbers.push_back(number);
    points.Scalars.push_back(scalar);
    for (const int side : { 0, 1 })
    {
      const std::vector<unsigned char>& own =
        side == 1 && !backColors.empty() ? backColors : colors;
      const auto get = [&](std::size_t c)
      {
        const int step = std::min<int>(own[Channels * i + c], this->LightSteps);
        return static_cast<float>(this->MaximumLight * step / this->LightSteps);
      };
      points.Light[side].push_back(
        number > 0 ? glm::vec3(get(0), get(1), get(2)) : glm::vec3(0.0f));
    }
  }
  return points;
}
}
