// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that spheres, tubes and instances reflect diffusely, as fits: in each cell of a shape
 * it is an affine function of the position and the normal.
 *
 * It is the light that is found by sampling directions, without that sampled at its sources, whose
 * shadows are too sharp for fits. Like all values of the cache, it is that of a white surface.
 */
#ifndef cslfShapeLight_h
#define cslfShapeLight_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "cslfCacheShare.h"
#include "cslfShapeLayout.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace cslf
{
/// An affine function of the position in a cell and the normal.
struct ShapeFit
{
  /// 1, and the components of the normal and of the position.
  static constexpr int Count = 7;
  using Terms = std::array<float, Count>;

  glm::vec3 Factors[Count] = {};
  std::uint32_t IsKnown = 0;

  static Terms MakeTerms(const glm::vec3& normal, const glm::vec3& offset)
  {
    return { 1.0f, normal.x, normal.y, normal.z, offset.x, offset.y, offset.z };
  }

  glm::vec3 Get(const Terms& terms) const
  {
    glm::vec3 sum(0.0f);
    for (int i = 0; i < Count; ++i)
    {
      sum += terms[i] * this->Factors[i];
    }
    return glm::max(sum, glm::vec3(0.0f));
  }
};

class VTKCSLF_EXPORT ShapeLight
{
public:
  struct Settings
  {
    int Samples = 256; ///< paths of a cell
    std::uint32_t Seed = 0;
    std::uint64_t MaximumPaths = 0; ///< if not 0, only shapes with about so many are estimated
    CacheShare* Share = nullptr;    ///< the ranks that estimate together; null for this one alone

    /// Whether what a ray hits is the inside of a closed body without light, as in
    /// OpenSides::IsInside. Samples that see such hits do not count. May be empty.
    std::function<bool(const Ray& ray, const Hit& hit)> IsInside;
  };

  ShapeLight() = default;
  explicit ShapeLight(ShapeLayout layout)
    : Layout(std::move(layout))
  {
  }

  /// Whether light is stored for a mesh.
  bool Has(std::uint32_t mesh) const { return !this->Fits.empty() && this->Layout.Has(mesh); }

  /// The light of a surface point of such a mesh, if it were white. False if it is unknown.
  bool Get(const Hit& hit, const SurfaceHit& surface, glm::vec3& light) const
  {
    const ShapeLayout::Place place = this->Layout.Find(hit, surface);
    if (place.Cell == ShapeLayout::None || !this->Fits[place.Cell].IsKnown)
    {
      return false;
    }
    light = this->Fits[place.Cell].Get(ShapeFit::MakeTerms(surface.ShadingNormal, place.Offset));
    return true;
  }

  /// Estimates the light of all cells. The paths may use the last estimate. `goOn` gets the
  /// progress, in [0,1]. Returns false if it did, and then changes nothing.
  bool Estimate(const Scene& scene, const PathIntegrator& paths, const Settings& settings,
    const std::function<bool(double)>& goOn);

  const ShapeLayout& GetLayout() const { return this->Layout; }

  /// The cells whose light is known.
  std::size_t GetNumberOfFits() const
  {
    return std::count_if(
      this->Fits.begin(), this->Fits.end(), [](const ShapeFit& fit) { return fit.IsKnown != 0; });
  }
  std::uint64_t GetNumberOfRays() const { return this->Rays; }

  /// The share of all paths that the last estimate has taken.
  double GetShare() const { return this->Share; }

  /// Writes or reads all data.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    this->Layout.Exchange(archive);
    archive.Array(this->Fits);
  }

private:
  ShapeLayout Layout;
  std::vector<ShapeFit> Fits; // of the cells; empty if nothing is known
  std::uint64_t Rays = 0;
  double Share = 1.0;
};
}

#endif
