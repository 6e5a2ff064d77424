// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneMaps.h"

#include "PathTracing/Materials/cslfTexture.h"
#include "cslfTessellation.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
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

/// The pixels of an image along a texel of the field, on average over surfaces.
constexpr double PixelsOfTexel = 4.0;

/// Places on images are multiples of a step, of which a texel of the field has about so many, and a
/// pixel at least and at most so many.
constexpr double StepsOfTexel = 32.0;
constexpr double MinimumPixelSteps = 16.0;
constexpr double MaximumPixelSteps = 4096.0;

/// The most pixels along an edge.
constexpr double MaximumPixels = 8192.0;

/// More maps tell no colours: files number them by a byte.
constexpr std::size_t MaximumMaps = 254;

/// What is known of the meshes with one texture.
struct ImageUse
{
  std::vector<std::size_t> Meshes;
  glm::dvec2 Low{ HUGE_VAL }; ///< of their texture coordinates
  glm::dvec2 High{ -HUGE_VAL };
  double Area = 0.0;   ///< in texels
  double Pixels = 0.0; ///< on the image
};

void AddUse(const Mesh& mesh, std::size_t number, float texel, ImageUse& use)
{
  const TextureImage& image = mesh.Textures.BaseColor->GetImage();
  const float scale = mesh.Instances.empty() ? 1.0f : FindLargestScale(mesh);
  const double texels = double(scale) * scale / (double(texel) * texel);
  use.Meshes.push_back(number);
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const glm::uvec3& corners = mesh.Triangles[i];
    const glm::dvec2 a(mesh.TexCoords[corners.x]);
    const glm::dvec2 b(mesh.TexCoords[corners.y]);
    const glm::dvec2 c(mesh.TexCoords[corners.z]);
    use.Low = glm::min(glm::min(use.Low, a), glm::min(b, c));
    use.High = glm::max(glm::max(use.High, a), glm::max(b, c));
    use.Area += texels * mesh.GetArea(i);
    use.Pixels += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) *
      image.Width * image.Height;
  }
}

/// The part of a texture along an axis that surfaces show, in pixels of it.
struct Extent
{
  double First = 0.0;
  double Size = 1.0;
  bool Repeats = false;
};

Extent FindExtent(double low, double high, int pixels, TextureWrap wrap)
{
  const bool isCyclic = wrap == TextureWrap::Repeat || wrap == TextureWrap::Mirror;
  const double period = wrap == TextureWrap::Mirror ? 2.0 : 1.0;
  if (isCyclic && high - low > period)
  {
    return { 0.0, period * pixels, true };
  }
  // Beyond an edge that goes on, or a border, all pixels are alike.
  const double first = std::floor(low * pixels) - 1.0;
  const double last = std::ceil(high * pixels) + 1.0;
  const double begin = isCyclic ? first : std::clamp(first, -1.0, double(pixels));
  const double end = isCyclic ? last : std::clamp(last, begin + 1.0, pixels + 1.0);
  return { begin, end - begin, false };
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
    const auto& [texture, use] = uses[i];
    const TextureImage& image = texture->GetImage();
    const glm::ivec2 pixels(image.Width, image.Height);
    Extent extents[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      extents[axis] = FindExtent(use.Low[axis], use.High[axis], pixels[axis], image.Wraps[axis]);
    }
    if (!std::isfinite(use.Low.x + use.Low.y + use.High.x + use.High.y))
    {
      continue;
    }
    double scale = use.Pixels > 0.0 ? PixelsOfTexel * std::sqrt(use.Area / use.Pixels) : 1.0;
    scale =
      std::min({ scale, 1.0, MaximumPixels / extents[0].Size, MaximumPixels / extents[1].Size });
    Frame frame;
    glm::dvec2 step(1.0); // the size of a pixel of the result
    MapImage::Layout layout;
    for (int axis = 0; axis < 2; ++axis)
    {
      const int size = std::max(1, int(std::lround(scale * extents[axis].Size)));
      (axis == 0 ? layout.Width : layout.Height) = size;
      layout.Repeats[axis] = extents[axis].Repeats;
      step[axis] = extents[axis].Size / size;
      frame.Origin[axis] = static_cast<float>(extents[axis].First / pixels[axis]);
      frame.Scale[axis] = static_cast<float>(pixels[axis] / step[axis]);
    }
    const double pixelsOfTexel = scale * std::sqrt(use.Pixels / std::max(use.Area, 1e-9));
    layout.Steps =
      static_cast<int>(std::clamp(std::ceil(StepsOfTexel / std::max(pixelsOfTexel, 1e-9)),
        MinimumPixelSteps, MaximumPixelSteps));
    layout.IsSmooth = image.Interpolate || scale < 1.0;
    const glm::dvec2 origin(extents[0].First, extents[1].First);
    // The mean of a pixel's points, or its middle if it has the size of the texture's.
    const int samples = static_cast<int>(std::ceil(std::max(step.x, step.y) - 1e-6));
    const auto getColor = [&](const glm::dvec2& place)
    {
      glm::vec3 sum(0.0f);
      for (int k = 0; k < samples * samples; ++k)
      {
        const glm::dvec2 offset =
          (glm::dvec2(k % samples, k / samples) + 0.5) / double(samples) - 0.5;
        const glm::dvec2 pixel = origin + step * (place + offset);
        sum += glm::vec3(texture->Get(glm::vec2(pixel / glm::dvec2(pixels))));
      }
      return sum / static_cast<float>(samples * samples);
    };
    this->Maps.push_back(MakeImageMap(MapImage::Make(layout, getColor)));
    this->Frames.push_back(frame);
    this->Tolerances.push_back(std::max(static_cast<float>(ImageTolerance * pixelsOfTexel), 1e-3f));
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

float SceneMaps::GetPixelsOfTexel(std::uint8_t number) const
{
  return this->GetTolerance(number) / ImageTolerance;
}

glm::vec3 SceneMaps::GetFactor(const Mesh& mesh) const
{
  return mesh.FindMap() ? mesh.GetMapFactor() : mesh.Material.BaseColor;
}
}
