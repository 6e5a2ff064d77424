// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryFit.h"

#include "Coding/Frames/cslfPushPull.h"
#include "cslfGeometryDepths.h"
#include "cslfSameSurface.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cslf
{
namespace
{
constexpr unsigned short None = GeometryDepths::None;

/// The stored depth that means 1.
constexpr double MostDepth = 65535.0;

/// How far the colours of texels at silhouettes may come from, in texels.
constexpr int Reach = 3;

/// The alpha of a texel that shows more of a surface than of what is beside it.
constexpr unsigned char MostlyCovered = 128;

struct Place
{
  int X;
  int Y;
};

int SquareOf(const Place& place)
{
  return place.X * place.X + place.Y * place.Y;
}

/// The texels around one, nearest first.
std::vector<Place> ListPlacesAround()
{
  std::vector<Place> places;
  for (int y = -Reach; y <= Reach; ++y)
  {
    for (int x = -Reach; x <= Reach; ++x)
    {
      if (x != 0 || y != 0)
      {
        places.push_back({ x, y });
      }
    }
  }
  std::stable_sort(places.begin(), places.end(),
    [](const Place& a, const Place& b) { return SquareOf(a) < SquareOf(b); });
  return places;
}

/// One tile of a viewpoint.
class TileFit
{
public:
  TileFit(int resolution, int tile, const std::vector<unsigned short>& depths, bool hasCoverage,
    const ViewpointSamples& samples)
    : Resolution(resolution)
    , Number(tile)
    , HasCoverage(hasCoverage)
    , Drawn(depths.data())
    , Depths(samples.Get<unsigned short>(KnownChannel::Depth))
    , Bytes(samples.Get<unsigned char>(KnownChannel::Color))
    , Floats(samples.Get<float>(KnownChannel::Color))
    , Coverage(samples)
    , Planes(3, Patch(resolution))
  {
  }

  GeometryFit Fit()
  {
    for (int y = 0; y < this->Resolution; ++y)
    {
      for (int x = 0; x < this->Resolution; ++x)
      {
        this->FindColor({ x, y });
      }
    }
    for (Patch& plane : this->Planes)
    {
      Fill(plane);
    }
    this->Write();
    return this->Result;
  }

private:
  std::size_t IndexOf(const Place& place) const
  {
    return (static_cast<std::size_t>(place.Y) * TileCount + this->Number) * this->Resolution +
      place.X;
  }

  bool HasSurface(std::size_t texel) const
  {
    return this->Depths[texel]<None&& this->Coverage.GetCoverage(texel)> 0;
  }

  /// Whether the samples of a texel lie on the surface that the geometry has at another.
  bool IsOn(std::size_t texel, std::size_t drawn, double distance) const
  {
    return this->HasSurface(texel) &&
      AreOnOneSurface(this->Depths[texel] / MostDepth, this->Drawn[drawn] / MostDepth, distance);
  }

  /// Without association with alpha.
  glm::vec3 GetColor(std::size_t texel) const
  {
    glm::vec3 color;
    const float alpha = this->Floats ? this->Floats[4 * texel + 3] : this->Bytes[4 * texel + 3];
    const float scale = (this->Floats ? 1.0F : 255.0F) / std::max(alpha, 1e-6F);
    for (int k = 0; k < 3; ++k)
    {
      const std::size_t value = 4 * texel + k;
      color[k] = scale * (this->Floats ? this->Floats[value] : this->Bytes[value]);
    }
    return color;
  }

  void FindColor(const Place& place)
  {
    const std::size_t texel = this->IndexOf(place);
    const bool isDrawn = this->Drawn[texel] < None;
    const bool hasSurface = this->HasSurface(texel);
    this->Result.Texels += isDrawn || hasSurface ? 1 : 0;
    std::optional<glm::vec3> color;
    if (isDrawn)
    {
      color = this->IsOn(texel, texel, 0.0) ? this->GetColor(texel) : this->FindNearest(place);
      this->Result.Wrong += color ? 0 : 1;
    }
    else if (hasSurface)
    {
      // Beside a silhouette, the nearest sample has hit something, but the centre has not.
      const bool isCovered =
        !this->HasCoverage || this->Coverage.GetCoverage(texel) > MostlyCovered;
      this->Result.Wrong += isCovered ? 1 : 0;
    }
    if (!color && (!this->HasCoverage || (isDrawn && hasSurface)))
    {
      color = this->GetColor(texel);
    }
    if (color)
    {
      this->Put(place, *color);
    }
  }

  /// The mean of the nearest texels on the surface that the geometry has here.
  std::optional<glm::vec3> FindNearest(const Place& place) const
  {
    static const std::vector<Place> around = ListPlacesAround();
    glm::vec3 sum(0.0F);
    int count = 0;
    int square = 0;
    for (const Place& step : around)
    {
      if (count > 0 && SquareOf(step) > square)
      {
        break;
      }
      const Place other = { place.X + step.X, place.Y + step.Y };
      if (std::min(other.X, other.Y) >= 0 && std::max(other.X, other.Y) < this->Resolution &&
        this->IsOn(
          this->IndexOf(other), this->IndexOf(place), std::max(std::abs(step.X), std::abs(step.Y))))
      {
        sum += this->GetColor(this->IndexOf(other));
        square = SquareOf(step);
        ++count;
      }
    }
    return count > 0 ? std::make_optional(sum / static_cast<float>(count)) : std::nullopt;
  }

  void Put(const Place& place, const glm::vec3& color)
  {
    for (int k = 0; k < 3; ++k)
    {
      Patch& plane = this->Planes[k];
      plane.Values[plane.IndexOf(place.X, place.Y)] = color[k];
      plane.Weights[plane.IndexOf(place.X, place.Y)] = 1.0F;
    }
  }

  void Write() const
  {
    for (int y = 0; y < this->Resolution; ++y)
    {
      for (int x = 0; x < this->Resolution; ++x)
      {
        const std::size_t texel = this->IndexOf({ x, y });
        const bool isCovered = !this->HasCoverage || this->Drawn[texel] < None;
        for (int k = 0; k < 4; ++k)
        {
          const float value = k < 3 ? this->Planes[k].Values[this->Planes[k].IndexOf(x, y)]
            : !isCovered            ? 0.0F
            : this->Floats          ? 1.0F
                                    : 255.0F;
          if (this->Floats)
          {
            this->Floats[4 * texel + k] = value;
          }
          else
          {
            this->Bytes[4 * texel + k] =
              static_cast<unsigned char>(std::clamp(value + 0.5F, 0.0F, 255.0F));
          }
        }
      }
    }
  }

  int Resolution;
  int Number;
  bool HasCoverage;
  const unsigned short* Drawn;
  const unsigned short* Depths;
  unsigned char* Bytes;
  float* Floats;
  ColorTexels Coverage;
  std::vector<Patch> Planes; ///< red, green, blue
  GeometryFit Result;
};

template <typename Component>
void Apply(
  const std::vector<unsigned short>& depths, bool hasCoverage, Component full, Component* colors)
{
  for (std::size_t texel = 0; texel < depths.size(); ++texel)
  {
    const bool isCovered = !hasCoverage || depths[texel] < None;
    Component* color = colors + 4 * texel;
    color[3] = full;
    if (!isCovered)
    {
      std::fill_n(color, 4, Component(0));
    }
  }
}
}

GeometryFit FitToGeometry(int resolution, const std::vector<unsigned short>& depths,
  bool hasCoverage, const ViewpointSamples& samples)
{
  GeometryFit fit;
  for (int tile = 0; tile < TileCount; ++tile)
  {
    fit += TileFit(resolution, tile, depths, hasCoverage, samples).Fit();
  }
  return fit;
}

void ApplyGeometry(
  const std::vector<unsigned short>& depths, bool hasCoverage, const ViewpointSamples& samples)
{
  std::copy(depths.begin(), depths.end(), samples.Get<unsigned short>(KnownChannel::Depth));
  if (auto* floats = samples.Get<float>(KnownChannel::Color))
  {
    Apply(depths, hasCoverage, 1.0F, floats);
  }
  else
  {
    Apply(depths, hasCoverage, static_cast<unsigned char>(255),
      samples.Get<unsigned char>(KnownChannel::Color));
  }
}
}
