// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Rays, which may be incoherent, and their hits, side by side.
 */
#ifndef cslfRayLanes_h
#define cslfRayLanes_h

#include "SIMD/cslfLanes.h"
#include "cslfRayPacket.h"

namespace cslf
{
struct RayLanes
{
  LaneMask Active; ///< where there is a ray
  Vec3Lanes Origin;
  Vec3Lanes Direction; ///< of unit length

  Ray Get(int lane) const { return { this->Origin.Get(lane), this->Direction.Get(lane) }; }
};

/// The hits of rays. Inactive lanes have none.
struct HitLanes
{
  Lanes<float> Distance;
  Lanes<float> U;
  Lanes<float> V;
  Lanes<std::uint32_t> Mesh;
  Lanes<std::uint32_t> Triangle;
  Lanes<std::uint32_t> Instance;
  LaneMask Back;

  bool IsValid(int lane) const { return this->Mesh[lane] != Hit::None; }
  Hit Get(int lane) const
  {
    return { this->Distance[lane], this->U[lane], this->V[lane], this->Mesh[lane],
      this->Triangle[lane], this->Instance[lane], this->Back[lane] != 0 };
  }
  void Set(int lane, const Hit& hit)
  {
    this->Distance[lane] = hit.Distance;
    this->U[lane] = hit.U;
    this->V[lane] = hit.V;
    this->Mesh[lane] = hit.Mesh;
    this->Triangle[lane] = hit.Triangle;
    this->Instance[lane] = hit.Instance;
    this->Back[lane] = hit.Back ? -1 : 0;
  }
};

/// Rays to lights, and the share of light that arrives.
struct ShadowLanes
{
  RayLanes Rays;
  Lanes<float> Distance;      ///< of the light
  Lanes<float> Transmittance; ///< the result; 0 for inactive rays
};
}

#endif
