// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surface points as seen by rays, side by side.
 */
#ifndef cslfSurfaceLanes_h
#define cslfSurfaceLanes_h

#include "PathTracing/Scene/cslfRayLanes.h"

namespace cslf
{
/// Like SurfaceHit. Lanes without a hit are not set.
struct SurfaceLanes
{
  Vec3Lanes GeometricNormal;
  Vec3Lanes ShadingNormal;
  Vec3Lanes LeavePosition;
  Vec3Lanes PassPosition;
  LaneMask Inside;
  Vec3Lanes BaseColor;
  Lanes<float> Metallic;
  Lanes<float> Alpha;
  Vec3Lanes Emission; ///< of emissive lanes
  const SurfaceMaterial* Material[LaneCount];

  std::uint32_t Shining = 0;    ///< a bit for each emissive lane
  std::uint32_t Scattering = 0; ///< a bit for each lane that is not Lambertian

  /// Like SurfaceHit::GetReceiverNormal, with the position.
  LightReceiver GetReceiver(int lane) const
  {
    return { this->LeavePosition.Get(lane), this->GetReceiverNormal(lane) };
  }
  glm::vec3 GetReceiverNormal(int lane) const
  {
    return this->Material[lane]->Transmission > 0.0f ? glm::vec3(0.0f)
                                                     : this->ShadingNormal.Get(lane);
  }

  SurfaceHit Get(int lane) const;
  /// Sets all but the bits.
  void Set(int lane, const SurfaceHit& surface);
};

/// Finds the surfaces that rays hit.
void FindSurfaces(
  const Scene& scene, const RayLanes& rays, const HitLanes& hits, SurfaceLanes& surfaces);
}

#endif
