// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surface points and their scattering towards the previous points of their paths, side by side.
 * Lanes describe diffuse surfaces; all others have a BSDF each.
 */
#ifndef cslfScatterLanes_h
#define cslfScatterLanes_h

#include "cslfBSDF.h"
#include "cslfSurfaceLanes.h"

#include <optional>

namespace cslf
{
struct ScatterLanes
{
  SurfaceLanes Surfaces;
  std::optional<BSDF> Scattering[LaneCount]; ///< of surfaces that are not diffuse
  LaneMask Lit;                              ///< whether light is requested
  Lobes LitLobes[LaneCount]; ///< of surfaces that are not diffuse: the requested lobes
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
