// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The radiance of the hits of a packet of rays, if a cache alone determines it.
 */
#ifndef cslfDiffuseLookUp_h
#define cslfDiffuseLookUp_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Rays/cslfRayPacket.h"

#include <cstdint>
#include <vector>

namespace cslf
{
class RadianceCache;
class Scene;
struct LatticePacket;

/// The radiance along each ray of a packet.
struct PacketRadiance
{
  alignas(64) float Red[RayPacket::Size];
  alignas(64) float Green[RayPacket::Size];
  alignas(64) float Blue[RayPacket::Size];

  void Set(int lane, const glm::vec3& radiance)
  {
    this->Red[lane] = radiance.x;
    this->Green[lane] = radiance.y;
    this->Blue[lane] = radiance.z;
  }
};

class VTKCSLF_EXPORT DiffuseLookUp
{
public:
  /// Finds nothing if there is no cache, or one that is not complete.
  DiffuseLookUp(const Scene& scene, const RadianceCache* cache);

  /// Sets the radiance of rays whose hits look the same from all directions, and 0 for all others.
  /// `known` becomes -1 for those, else 0. False if it is 0 for any hit.
  bool Get(const RayPacket& packet, PacketRadiance& radiance, int known[RayPacket::Size]) const;

private:
  bool GetOnLattices(
    const RayPacket& packet, PacketRadiance& radiance, int known[RayPacket::Size]) const;
  bool AddShapes(
    const RayPacket& packet, PacketRadiance& radiance, int known[RayPacket::Size]) const;

  /// Of a mesh.
  struct Surface
  {
    bool IsKnown = false; // whether the cache alone determines its radiance
    std::uint32_t FirstTriangle = 0;
    glm::vec3 Color{ 1.0f };
    int Varies = 0; // -1 if it is black everywhere, else 0
  };

  /// The hits of a packet.
  struct Finds
  {
    bool Some;   // whether any is known
    bool Others; // whether any is unknown
  };

  static Finds FindPlaces(const Surface* surfaces, const std::uint8_t* sides,
    const RayPacket& packet, int* known, LatticePacket& places);
  static int Colorize(const Surface* surfaces, const RayPacket& packet, const int* known,
    const LatticePacket& values, PacketRadiance& radiance);

  const Scene& World;
  const RadianceCache* Cache;
  std::vector<Surface> Surfaces; // of the meshes; empty if nothing is known
  bool HasShapes = false;
};
}

#endif
