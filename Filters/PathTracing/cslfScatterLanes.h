// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surface points and how they scatter light towards the ones before them on their paths, side by
 * side. What matte surfaces do is told by lanes; all others have a BSDF each.
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
  std::optional<BSDF> Scattering[LaneCount]; ///< of what is not matte
  LaneMask Lit;                              ///< whether light is asked for
  Lobes LitLobes[LaneCount];                 ///< of what is not matte: the lobes asked about
};

/// Light that arrives at surface points, as LightSample.
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
