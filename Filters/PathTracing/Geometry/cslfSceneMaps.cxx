// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneMaps.h"

#include "PathTracing/Materials/cslfTexture.h"
#include "cslfTessellation.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <string>

namespace cslf
{
namespace
{
/// The RMS error of colours, from 0 to 1, that places on maps may cause.
constexpr double PlaceTolerance = 1.0 / 256.0;

/// The largest error of places on maps, as a share of the range.
constexpr double MaximumPlaceError = 0.005;

/// The error of places on images, in texels of the field.
constexpr float ImageTolerance = 0.1f;

/// The pixels of an image along a texel of the field: at least so many, but for this share of the
/// surface. Images are made finer than textures at most so many times, and have about so many
/// pixels along an edge if that is not known.
constexpr double PixelsOfTexel = 4.0;
constexpr double RestShare = 0.1;
constexpr double SmallShare = 0.005;
constexpr double MaximumGrowth = 16.0;
constexpr double UnknownPixels = 256.0;

/// Places on images are multiples of a step, of which a texel of the field has about so many, and a
/// pixel at least and at most so many.
constexpr double StepsOfTexel = 32.0;
constexpr double MinimumPixelSteps = 16.0;
constexpr double MaximumPixelSteps = 4096.0;

/// The farthest place, in steps.
constexpr double MaximumPlace = 1 << 24;

/// The most pixels along an edge.
constexpr double MaximumPixels = 8192.0;

/// More maps tell no colours: files number them by a byte.
constexpr std::size_t MaximumMaps = 254;

/// The meshes with one texture, and how it lies on them.
struct ImageUse
{
  /// Of a triangle: the texels of the field along a pixel of the texture, in x and y.
  struct Sample
  {
    glm::dvec2 Texels;
    double Area;
  };

  std::vector<std::size_t> Meshes;
  glm::dvec2 Low{ HUGE_VAL }; ///< of their texture coordinates
  glm::dvec2 High{ -HUGE_VAL };
  std::vector<Sample> Samples;

  /// The texels along a pixel that no more of the area exceeds than each of these ascending shares;
  /// 0 if none are known.
  std::array<double, 2> FindTexels(int axis, const std::array<double, 2>& shares)
  {
    std::sort(this->Samples.begin(), this->Samples.end(),
      [axis](const Sample& one, const Sample& other)
      { return one.Texels[axis] > other.Texels[axis]; });
    double area = 0.0;
    for (const Sample& sample : this->Samples)
    {
      area += sample.Area;
    }
    std::array<double, 2> found{};
    std::size_t next = 0;
    double sum = 0.0;
    for (const Sample& sample : this->Samples)
    {
      sum += sample.Area;
      for (; next < shares.size() && sum >= shares[next] * area; ++next)
      {
        found[next] = sample.Texels[axis];
      }
    }
    return found;
  }
};

void AddUse(const Mesh& mesh, std::size_t number, float texel, ImageUse& use)
{
  const TextureImage& image = mesh.Textures.BaseColor->GetImage();
  const float scale = mesh.Instances.empty() ? 1.0f : FindLargestScale(mesh);
  const double texels = double(scale) / texel;
  use.Meshes.push_back(number);
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const glm::uvec3& corners = mesh.Triangles[i];
    const glm::dvec2 first(mesh.TexCoords[corners.x]);
    const glm::dvec2 u = glm::dvec2(mesh.TexCoords[corners.y]) - first;
    const glm::dvec2 v = glm::dvec2(mesh.TexCoords[corners.z]) - first;
    const glm::dvec3 start(mesh.Vertices[corners.x]);
    const glm::dvec3 one = glm::dvec3(mesh.Vertices[corners.y]) - start;
    const glm::dvec3 other = glm::dvec3(mesh.Vertices[corners.z]) - start;
    for (const glm::dvec2& place : { first, first + u, first + v })
    {
      use.Low = glm::min(use.Low, place);
      use.High = glm::max(use.High, place);
    }
    const double area = u.x * v.y - u.y * v.x;
    const glm::dvec2 lengths(glm::length((v.y * one - u.y * other) / (area * image.Width)),
      glm::length((u.x * other - v.x * one) / (area * image.Height)));
    if (std::isfinite(lengths.x + lengths.y))
    {
      use.Samples.push_back({ texels * lengths, double(mesh.GetArea(i)) });
    }
  }
}

/// The part of a texture along an axis that surfaces show, in pixels of it.
struct Extent
{
  double First = 0.0;
  double Size = 1.0;
  bool Repeats = false;
};

/// With a margin beside what is shown.
Extent FindExtent(double low, double high, int pixels, TextureWrap wrap, double margin)
{
  const bool isCyclic = wrap == TextureWrap::Repeat || wrap == TextureWrap::Mirror;
  const double period = wrap == TextureWrap::Mirror ? 2.0 : 1.0;
  if (isCyclic && high - low > period)
  {
    return { period * std::floor(low / period) * pixels, period * pixels, true };
  }
  // Beyond an edge that goes on, or a border, all pixels are alike.
  const double first = std::floor(low * pixels) - margin;
  const double last = std::ceil(high * pixels) + margin;
  const double begin = isCyclic ? first : std::clamp(first, -margin, double(pixels));
  const double end = isCyclic ? last : std::clamp(last, begin + 1.0, pixels + margin);
  return { begin, end - begin, false };
}

/// Whether an image would have to become coarser.
bool IsReduced(const Extent extents[2], const MapImage::Layout& layout)
{
  return layout.Width < extents[0].Size || layout.Height < extents[1].Size;
}
}

SceneMaps::SceneMaps(const std::vector<Mesh>& meshes, float texel, const Progress& progress)
  : First(meshes.data())
  , Numbers(meshes.size(), 0)
{
  std::map<std::pair<std::string, std::vector<ColorMap::Pixel>>, std::uint8_t> known;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const ColorMap* map = meshes[i].FindMap();
    if (!map)
    {
      continue;
    }
    std::vector<ColorMap::Pixel> colors = map->Colors;
    colors.push_back(map->NanColor);
    const auto [found, isNew] = known.emplace(std::make_pair(DescribeColorMap(*map), colors), 0);
    if (isNew && this->Maps.size() < MaximumMaps)
    {
      this->Maps.push_back(*map);
      found->second = static_cast<std::uint8_t>(this->Maps.size());
      const double steepness = std::max(map->GetSteepness(), 1e-9);
      this->Tolerances.push_back(static_cast<float>(
        std::min(PlaceTolerance / steepness, MaximumPlaceError * map->GetSteps())));
    }
    this->Numbers[i] = found->second;
  }
  this->Frames.resize(this->Maps.size());
  this->AddImages(meshes, texel, progress);
}

void SceneMaps::AddImages(const std::vector<Mesh>& meshes, float texel, const Progress& progress)
{
  // In the order of the meshes: addresses differ from run to run.
  std::vector<std::pair<const Texture*, ImageUse>> uses;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const Texture* texture = meshes[i].FindImage();
    if (!texture || meshes[i].Triangles.empty())
    {
      continue;
    }
    auto found = std::find_if(
      uses.begin(), uses.end(), [texture](const auto& use) { return use.first == texture; });
    if (found == uses.end())
    {
      uses.emplace_back(texture, ImageUse());
      found = std::prev(uses.end());
    }
    AddUse(meshes[i], i, texel, found->second);
  }
  for (std::size_t i = 0; i < uses.size() && this->Maps.size() < MaximumMaps; ++i)
  {
    OrAbort(progress)(static_cast<double>(i) / static_cast<double>(uses.size()));
    auto& [texture, use] = uses[i];
    const TextureImage& image = texture->GetImage();
    const glm::ivec2 pixels(image.Width, image.Height);
    // Displayed values that are interpolated differ from linear ones, unless pixels are fine.
    const bool isDisplayed = image.DisplayedWhite.x > 0.0f && image.Interpolate;
    Frame frame;
    glm::dvec2 step(1.0); // the size of a pixel of the result
    glm::dvec2 origin(0.0);
    Extent extents[2];
    MapImage::Layout layout;
    double fewest = HUGE_VAL; // pixels of a texel
    double most = 0.0;
    double farthest = 0.0;
    for (int axis = 0; axis < 2; ++axis)
    {
      const auto [texels, densest] = use.FindTexels(axis, { RestShare, 1.0 - SmallShare });
      const double wanted = texels > 0.0 ? PixelsOfTexel * texels : UnknownPixels / pixels[axis];
      double scale = std::min(wanted, isDisplayed ? MaximumGrowth : 1.0);
      const double margin = std::ceil(1.0 / scale) + 1.0;
      extents[axis] =
        FindExtent(use.Low[axis], use.High[axis], pixels[axis], image.Wraps[axis], margin);
      const Extent& extent = extents[axis];
      scale = std::min(scale, MaximumPixels / extent.Size);
      const int size =
        std::max(1, static_cast<int>(std::lround(std::min(scale * extent.Size, MaximumPixels))));
      (axis == 0 ? layout.Width : layout.Height) = size;
      layout.Repeats[axis] = extent.Repeats;
      step[axis] = extent.Size / size;
      origin[axis] = extent.First;
      frame.Origin[axis] = static_cast<float>(extent.First / pixels[axis]);
      frame.Scale[axis] = static_cast<float>(pixels[axis] / step[axis]);
      fewest = std::min(fewest, texels > 0.0 ? 1.0 / (texels * step[axis]) : PixelsOfTexel);
      most = std::max(most, densest > 0.0 ? 1.0 / (densest * step[axis]) : 0.0);
      farthest =
        std::max({ farthest, std::abs(use.Low[axis] - frame.Origin[axis]) * frame.Scale[axis],
          std::abs(use.High[axis] - frame.Origin[axis]) * frame.Scale[axis] });
    }
    layout.Steps = static_cast<int>(std::clamp(
      std::ceil(StepsOfTexel / std::max(fewest, 1e-9)), MinimumPixelSteps, MaximumPixelSteps));
    layout.IsSmooth = image.Interpolate || IsReduced(extents, layout);
    // Floats could not tell such places.
    if (!(farthest * layout.Steps < MaximumPlace))
    {
      continue;
    }
    // The mean of a pixel's points, or its middle if it is as fine as the texture.
    const glm::ivec2 samples(glm::max(glm::ceil(step - 0.05), 1.0));
    const auto getColor = [&, texture = texture](const glm::dvec2& place)
    {
      glm::vec3 sum(0.0f);
      for (int y = 0; y < samples.y; ++y)
      {
        for (int x = 0; x < samples.x; ++x)
        {
          const glm::dvec2 offset = (glm::dvec2(x, y) + 0.5) / glm::dvec2(samples) - 0.5;
          const glm::dvec2 pixel = origin + step * (place + offset);
          sum += glm::vec3(texture->Get(glm::vec2(pixel / glm::dvec2(pixels))));
        }
      }
      return sum / static_cast<float>(samples.x * samples.y);
    };
    this->Maps.push_back(MakeImageMap(MapImage::Make(layout, getColor)));
    this->Frames.push_back(frame);
    this->Tolerances.push_back(std::max(static_cast<float>(ImageTolerance * fewest), 1e-3f));
    this->PixelsOfTexels.resize(this->Maps.size(), 0.0f);
    this->PixelsOfTexels.back() = static_cast<float>(most);
    for (const std::size_t mesh : use.Meshes)
    {
      this->Numbers[mesh] = static_cast<std::uint8_t>(this->Maps.size());
    }
  }
}

glm::vec2 SceneMaps::GetPlace(
  const Mesh& mesh, const SurfaceRegions& regions, const TrianglePoint& point) const
{
  if (mesh.FindMap())
  {
    return regions.GetMapPlace(mesh, point);
  }
  const Frame& frame =
    this->Frames[this->Numbers[static_cast<std::size_t>(&mesh - this->First)] - 1];
  return (mesh.Interpolate(mesh.TexCoords, point) - frame.Origin) * frame.Scale;
}

glm::vec3 SceneMaps::GetFactor(const Mesh& mesh) const
{
  return mesh.FindMap() ? mesh.GetMapFactor() : mesh.Material.BaseColor;
}
}
