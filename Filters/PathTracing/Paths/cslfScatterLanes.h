// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surface points and their scattering towards the previous points of their paths, side by side.
 * Lanes describe Lambertian surfaces; all others have a BSDF each.
 */
#ifndef cslfScatterLanes_h
#define cslfScatterLanes_h

#include "PathTracing/Materials/cslfBSDF.h"
#include "PathTracing/Materials/cslfFrame.h"
#include "cslfSurfaceLanes.h"

#include <optional>

namespace cslf
{
struct ScatterLanes
{
  SurfaceLanes Surfaces;
  std::optional<BSDF> Scattering[LaneCount]; ///< of surfaces that are not Lambertian
  LaneMask Lit;                              ///< whether light is requested
  Lobes LitLobes[LaneCount]; ///< of surfaces that are not Lambertian: the requested lobes

  /// Makes the BSDF of a lane for light that leaves in a direction of the scene.
  const BSDF& MakeScattering(int lane, const glm::vec3& outgoing)
  {
    const SurfaceLanes& surfaces = this->Surfaces;
    const MaterialPoint point{ surfaces.BaseColor.Get(lane), surfaces.Metallic[lane],
      surfaces.Alpha[lane] };
    return this->Scattering[lane].emplace(*surfaces.Material[lane], point,
      Frame(surfaces.ShadingNormal.Get(lane)).ToLocal(outgoing), surfaces.Inside[lane] != 0);
  }
};

/// Light that arrives at surface points, like LightSample.
struct LightLanes
{
  Vec3Lanes Direction;
  Vec3Lanes Radiance;
  Lanes<float> Pdf;
  Lanes<float> Distance;

  void Set(int lane, const LightSample& sample)
  {
    this->Direction.Set(lane, sample.Direction);
    this->Radiance.Set(lane, sample.Radiance);
    this->Pdf[lane] = sample.Pdf;
    this->Distance[lane] = sample.Distance;
  }
};
}

#endif
