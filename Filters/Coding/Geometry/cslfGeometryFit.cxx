// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryFit.h"

#include "Coding/Frames/cslfColorFrames.h"
#include "Coding/Frames/cslfPushPull.h"
#include "cslfColor.h"
#include "cslfSameSurface.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

namespace cslf
{
namespace
{
constexpr unsigned short None = GeometryTexels::None;

/// The stored depth that means 1.
constexpr double MaximumDepth = 65535.0;

/// How far the colours of texels at silhouettes may come from, in texels.
constexpr int Reach = 3;

/// The alpha of texels that show more of a surface than of what is beside it, and of opaque ones.
constexpr unsigned char MostlyCovered = 128;
constexpr unsigned char Opaque = 192;

struct Texel
{
  int X;
  int Y;
};

int SquareOf(const Texel& place)
{
  return place.X * place.X + place.Y * place.Y;
}

/// The texels around one, nearest first.
std::vector<Texel> ListPlacesAround()
{
  std::vector<Texel> places;
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
    [](const Texel& a, const Texel& b) { return SquareOf(a) < SquareOf(b); });
  return places;
}

/// One tile of a viewpoint.
class TileFit
{
public:
  TileFit(int resolution, int tile, const DrawnTexels& drawn, bool hasCoverage,
    const ViewpointSamples& samples)
    : Resolution(resolution)
    , Number(tile)
    , HasCoverage(hasCoverage)
    , IsFilled(hasCoverage || !drawn.Colors.empty())
    , Drawn(drawn.Depths.data())
    , Known(drawn.Colors.empty() ? nullptr : drawn.Colors.data())
    , Depths(samples.Get<unsigned short>(KnownChannel::Depth))
    , Bytes(samples.Get<unsigned char>(KnownChannel::Color))
    , Floats(samples.Get<float>(KnownChannel::Color))
    , Coverage(samples)
    , Planes(3, Patch(resolution))
    , AreChanged(static_cast<std::size_t>(resolution) * resolution, hasCoverage ? 1 : 0)
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
      if (this->IsFilled)
      {
        Fill(plane);
      }
    }
    this->Write();
    return this->Result;
  }

private:
  std::size_t IndexOf(const Texel& place) const
  {
    return (static_cast<std::size_t>(place.Y) * TileCount + this->Number) * this->Resolution +
      place.X;
  }

  bool HasSurface(std::size_t texel) const
  {
    const bool isNear = this->Depths[texel] < None;
    return isNear && this->Coverage.GetCoverage(texel) > 0;
  }

  /// Whether the samples of a texel lie on the surface that the geometry has at another.
  bool IsOn(std::size_t texel, std::size_t drawn, double distance) const
  {
    return this->HasSurface(texel) &&
      AreOnOneSurface(
        this->Depths[texel] / MaximumDepth, this->Drawn[drawn] / MaximumDepth, distance);
  }

  /// Without association with alpha, and within what a video can hold.
  glm::vec3 GetColor(std::size_t texel) const
  {
    glm::vec3 color;
    const float alpha = this->Floats ? this->Floats[4 * texel + 3] : this->Bytes[4 * texel + 3];
    const float scale = (this->Floats ? 1.0F : 255.0F) / std::max(alpha, 1e-6F);
    const float most = this->Floats ? static_cast<float>(MaximumRadiance) : 255.0F;
    for (int k = 0; k < 3; ++k)
    {
      const std::size_t place = 4 * texel + k;
      const float value = scale * (this->Floats ? this->Floats[place] : this->Bytes[place]);
      color[k] = value >= 0.0F ? std::min(value, most) : 0.0F; // also if it is not a number
    }
    return color;
  }

  bool IsInside(const Texel& place) const
  {
    return std::min(place.X, place.Y) >= 0 && std::max(place.X, place.Y) < this->Resolution;
  }

  /// Whether a texel inside of the geometry's outlines shows something through it.
  bool IsTorn(const Texel& place) const
  {
    if (!this->HasCoverage || this->Coverage.GetCoverage(this->IndexOf(place)) >= Opaque)
    {
      return false;
    }
    for (int k = 0; k < 9; ++k)
    {
      const Texel other = { place.X + k % 3 - 1, place.Y + k / 3 - 1 };
      if (!this->IsInside(other) || this->Drawn[this->IndexOf(other)] == None)
      {
        return false;
      }
    }
    return true;
  }

  bool IsMostlyCovered(std::size_t texel) const
  {
    return !this->HasCoverage || this->Coverage.GetCoverage(texel) > MostlyCovered;
  }

  /// Whether a texel that the geometry does not cover lies at a silhouette: the nearest sample has
  /// hit something, but the centre has not. Wires thinner than a texel have no such neighbours.
  bool IsAtSilhouette(const Texel& place) const
  {
    if (this->IsMostlyCovered(this->IndexOf(place)))
    {
      return false;
    }
    for (int k = 0; k < 9; ++k)
    {
      const Texel other = { place.X + k % 3 - 1, place.Y + k / 3 - 1 };
      if (this->IsInside(other) && this->Drawn[this->IndexOf(other)] < None &&
        this->IsMostlyCovered(this->IndexOf(other)))
      {
        return true;
      }
    }
    return false;
  }

  void FindColor(const Texel& place)
  {
    const std::size_t texel = this->IndexOf(place);
    const bool isDrawn = this->Drawn[texel] < None;
    const bool hasSurface = this->HasSurface(texel);
    this->Result.Texels += isDrawn || hasSurface ? 1 : 0;
    const bool isOwn = isDrawn && this->IsOn(texel, texel, 0.0);
    std::optional<glm::vec3> color;
    if (isDrawn && !isOwn)
    {
      color = this->FindNearest(place);
    }
    const bool isLost = isDrawn ? !isOwn && !color : hasSurface && !this->IsAtSilhouette(place);
    this->Result.Wrong += isLost || (isDrawn && this->IsTorn(place)) ? 1 : 0;
    if (this->Known && this->Known[texel].w > 0)
    {
      this->Compare(texel, isOwn);
      this->SetChanged(place);
      return;
    }
    if (color)
    {
      this->SetChanged(place);
    }
    else if (this->HasCoverage ? isDrawn && hasSurface
                               : this->IsFilled && this->Coverage.GetCoverage(texel) > 0)
    {
      color = this->GetColor(texel);
    }
    if (color)
    {
      this->Put(place, *color);
    }
  }

  /// A texel whose colour is the geometry's.
  void Compare(std::size_t texel, bool isOwn)
  {
    ++this->Result.Colored;
    if (isOwn)
    {
      ++this->Result.Compared;
      const glm::dvec3 difference =
        glm::dvec3(this->GetColor(texel)) - glm::dvec3(this->Known[texel]);
      this->Result.ColorSquares += glm::dot(difference, difference) / (255.0 * 255.0);
    }
  }

  void SetChanged(const Texel& place)
  {
    this->AreChanged[this->Planes[0].IndexOf(place.X, place.Y)] = 1;
  }

  /// The mean light of the nearest texels on the surface that the geometry has here.
  std::optional<glm::vec3> FindNearest(const Texel& place) const
  {
    static const std::vector<Texel> around = ListPlacesAround();
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    int square = 0;
    for (const Texel& step : around)
    {
      if (weights > 0.0 && SquareOf(step) > square)
      {
        break;
      }
      const Texel other = { place.X + step.X, place.Y + step.Y };
      if (this->IsInside(other) &&
        this->IsOn(
          this->IndexOf(other), this->IndexOf(place), std::max(std::abs(step.X), std::abs(step.Y))))
      {
        const double weight = this->Coverage.GetCoverage(this->IndexOf(other));
        sum += weight * this->ToLight(this->GetColor(this->IndexOf(other)));
        square = SquareOf(step);
        weights += weight;
      }
    }
    return weights > 0.0 ? std::make_optional(this->FromLight(sum / weights)) : std::nullopt;
  }

  ///@{
  /// Bytes are encoded, floats are light.
  glm::dvec3 ToLight(const glm::vec3& color) const
  {
    glm::dvec3 light(color);
    for (int k = 0; k < 3 && this->Bytes; ++k)
    {
      light[k] = SRGBToLinear(light[k] / 255.0);
    }
    return light;
  }
  glm::vec3 FromLight(glm::dvec3 light) const
  {
    for (int k = 0; k < 3 && this->Bytes; ++k)
    {
      light[k] = 255.0 * LinearToSRGB(light[k]);
    }
    return light;
  }
  ///@}

  void Put(const Texel& place, const glm::vec3& color)
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
        const std::size_t place = this->Planes[0].IndexOf(x, y);
        if (this->AreChanged[place] != 0)
        {
          this->Floats ? this->Write(this->IndexOf({ x, y }), place, 1.0F, this->Floats)
                       : this->Write(this->IndexOf({ x, y }), place, 255.0F, this->Bytes);
        }
      }
    }
  }

  template <typename Component>
  void Write(std::size_t texel, std::size_t place, float full, Component* colors) const
  {
    Component* color = colors + 4 * texel;
    const float rounding = std::is_integral<Component>::value ? 0.5F : 0.0F;
    // Alpha that is computed is not coded, so colours need not be associated with it.
    const float scale = this->HasCoverage ? 1.0F : static_cast<float>(color[3]) / full;
    for (int k = 0; k < 3; ++k)
    {
      color[k] = static_cast<Component>(scale * this->Planes[k].Values[place] + rounding);
    }
    if (this->HasCoverage)
    {
      color[3] = static_cast<Component>(this->Drawn[texel] < None ? full : 0.0F);
    }
  }

  int Resolution;
  int Number;
  bool HasCoverage;
  bool IsFilled; ///< whether colours without a meaning continue those around
  const unsigned short* Drawn;
  const DrawnTexels::Color* Known;
  const unsigned short* Depths;
  unsigned char* Bytes;
  float* Floats;
  ColorTexels Coverage;
  std::vector<Patch> Planes; ///< red, green, blue
  std::vector<char> AreChanged;
  GeometryFit Result;
};

template <typename Component>
void Apply(const DrawnTexels& drawn, bool hasCoverage, Component full, Component* colors,
  unsigned short* depths)
{
  for (std::size_t texel = 0; texel < drawn.Depths.size(); ++texel)
  {
    Component* color = colors + 4 * texel;
    const bool isCovered = hasCoverage ? drawn.Depths[texel] < None : color[3] > Component(0);
    depths[texel] = isCovered ? drawn.Depths[texel] : None;
    if (hasCoverage)
    {
      color[3] = isCovered ? full : Component(0);
    }
    if (!isCovered)
    {
      std::fill_n(color, 3, Component(0));
    }
    else if (!drawn.Colors.empty() && drawn.Colors[texel].w > 0)
    {
      const int alpha = static_cast<int>(color[3]); // only bytes have such colours
      for (int k = 0; k < 3; ++k)
      {
        color[k] = static_cast<Component>((2 * alpha * drawn.Colors[texel][k] + 255) / 510);
      }
    }
  }
}
}

GeometryFit FitToGeometry(
  int resolution, const DrawnTexels& drawn, bool hasCoverage, const ViewpointSamples& samples)
{
  GeometryFit fit;
  for (int tile = 0; tile < TileCount; ++tile)
  {
    fit += TileFit(resolution, tile, drawn, hasCoverage, samples).Fit();
  }
  return fit;
}

void ApplyGeometry(const DrawnTexels& drawn, bool hasCoverage, const ViewpointSamples& samples)
{
  auto* depths = samples.Get<unsigned short>(KnownChannel::Depth);
  if (auto* floats = samples.Get<float>(KnownChannel::Color))
  {
    Apply(drawn, hasCoverage, 1.0F, floats, depths);
  }
  else
  {
    Apply(drawn, hasCoverage, static_cast<unsigned char>(255),
      samples.Get<unsigned char>(KnownChannel::Color), depths);
  }
}
}
