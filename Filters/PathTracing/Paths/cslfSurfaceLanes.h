// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surface points as seen by rays, side by side.
 */
#ifndef cslfSurfaceLanes_h
#define cslfSurfaceLanes_h

#include "PathTracing/Materials/cslfBSDF.h"
#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Rays/cslfRayLanes.h"
#include "PathTracing/Scene/cslfScene.h"

#include <optional>

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

struct ScatterLanes
{
  SurfaceLanes Surfaces;
  std::optional<BSDF> Scattering[LaneCount]; ///< of surfaces that are not Lambertian
  std::uint32_t Media = 0;   ///< a bit for each lane that is a point in a medium, not on a surface
  Vec3Lanes Paths;           ///< of these, the directions of the paths
  Lanes<float> Anisotropy;   ///< of these
  LaneMask Lit;              ///< whether light is requested
  Lobes LitLobes[LaneCount]; ///< of surfaces that are not Lambertian: the requested lobes

  /// Makes a lane a point in a medium, which receives light from all sides.
  void SetMedium(int lane, const glm::vec3& position, const glm::vec3& path,
    const glm::vec3& albedo, float anisotropy);

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
