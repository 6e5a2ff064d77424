// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDiffuseLookUp.h"

#include "PathTracing/cslfVectorize.h"
#include "cslfRadianceCache.h"

#include <algorithm>

namespace cslf
{
DiffuseLookUp::DiffuseLookUp(const Scene& scene, const RadianceCache* cache)
  : World(scene)
  , Cache(cache)
{
  if (!cache || !cache->IsComplete())
  {
    return;
  }
  const std::vector<Mesh>& meshes = scene.GetMeshes();
  for (std::uint32_t i = 0; i < meshes.size(); ++i)
  {
    const Mesh& mesh = meshes[i];
    Surface surface;
    if (mesh.IsDiffuse() && mesh.CanHoldLattice() && !mesh.Triangles.empty())
    {
      surface.IsKnown = -1;
      surface.FirstTriangle = static_cast<int>(scene.GetTriangleIndex(i, 0));
      surface.Varies = mesh.HasOneColor() ? 0 : -1;
      surface.Color = mesh.HasOneColor() ? mesh.Material.BaseColor : glm::vec3(1.0f);
    }
    this->Surfaces.push_back(surface);
  }
  if (std::none_of(this->Surfaces.begin(), this->Surfaces.end(),
        [](const Surface& surface) { return surface.IsKnown; }))
  {
    this->Surfaces.clear();
  }
}

bool DiffuseLookUp::Get(
  const RayPacket& packet, PacketRadiance& radiance, int known[RayPacket::Size]) const
{
  if (this->Surfaces.empty())
  {
    std::fill_n(known, RayPacket::Size, 0);
    radiance = {};
    return false;
  }
  LatticePacket places;
  const int missed =
    FindPlaces(this->Surfaces.data(), this->Cache->GetSides().GetData(), packet, known, places);
  this->Cache->Get(places);
  if (Colorize(this->Surfaces.data(), packet, known, places, radiance))
  {
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      if (known[lane] && this->Surfaces[packet.Query.hit.geomID[lane]].Varies)
      {
        radiance.Set(lane,
          this->World.GetBaseColor(packet.GetHit(lane)) *
            glm::vec3(places.Red[lane], places.Green[lane], places.Blue[lane]));
      }
    }
  }
  return missed == 0;
}

CSLF_VECTORIZE int DiffuseLookUp::FindPlaces(const Surface* surfaces, const std::uint8_t* sides,
  const RayPacket& packet, int* known, LatticePacket& places)
{
  const RTCRay16& ray = packet.Query.ray;
  const RTCHit16& hit = packet.Query.hit;
  int missed = 0;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int isHit = static_cast<int>(hit.geomID[lane]) == -1 ? 0 : -1;
    const int mesh = static_cast<int>(hit.geomID[lane]) & isHit;
    const float away = hit.Ng_x[lane] * ray.dir_x[lane] + hit.Ng_y[lane] * ray.dir_y[lane] +
      hit.Ng_z[lane] * ray.dir_z[lane];
    const int back = away > 0.0f ? 1 : 0;
    const int canBeKnown = surfaces[mesh].IsKnown & isHit;
    const int triangle =
      (surfaces[mesh].FirstTriangle + static_cast<int>(hit.primID[lane])) & canBeKnown;
    const int isOpen = -((sides[triangle] >> back) & 1);
    const int isKnown = isOpen & canBeKnown;
    known[lane] = isKnown;
    missed |= isHit & ~isKnown;
    places.Wanted[lane] = isKnown;
    places.Triangle[lane] = static_cast<std::uint32_t>(triangle);
    places.Back[lane] = back;
    places.U[lane] = isKnown ? hit.u[lane] : 0.0f;
    places.V[lane] = isKnown ? hit.v[lane] : 0.0f;
  }
  return missed;
}

CSLF_VECTORIZE int DiffuseLookUp::Colorize(const Surface* surfaces, const RayPacket& packet,
  const int* known, const LatticePacket& values, PacketRadiance& radiance)
{
  int varies = 0;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int mesh = static_cast<int>(packet.Query.hit.geomID[lane]) & known[lane];
    const float keep = known[lane] ? 1.0f : 0.0f;
    radiance.Red[lane] = keep * surfaces[mesh].Color.x * values.Red[lane];
    radiance.Green[lane] = keep * surfaces[mesh].Color.y * values.Green[lane];
    radiance.Blue[lane] = keep * surfaces[mesh].Color.z * values.Blue[lane];
    varies |= surfaces[mesh].Varies & known[lane];
  }
  return varies;
}
}
