// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDiffuseLookUp.h"

#include "SIMD/cslfVectorize.h"
#include "cslfRadianceCache.h"

#include <algorithm>
#include <limits>

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
      surface.IsKnown = true;
      surface.FirstTriangle = static_cast<std::uint32_t>(scene.GetTriangleIndex(i, 0));
      surface.Varies = mesh.HasOneColor() ? 0 : -1;
      surface.Color = mesh.HasOneColor() ? mesh.Material.BaseColor : glm::vec3(1.0f);
    }
    this->Surfaces.push_back(surface);
  }
  this->HasShapes = cache->GetShapes().GetNumberOfFits() > 0;
  if (std::none_of(this->Surfaces.begin(), this->Surfaces.end(),
        [](const Surface& surface) { return surface.IsKnown; }))
  {
    this->Surfaces.clear();
  }
}

bool DiffuseLookUp::Get(
  const RayPacket& packet, PacketRadiance& radiance, int known[RayPacket::Size]) const
{
  const bool isAll = this->GetOnLattices(packet, radiance, known);
  return isAll || (this->HasShapes && this->AddShapes(packet, radiance, known));
}

bool DiffuseLookUp::AddShapes(
  const RayPacket& packet, PacketRadiance& radiance, int known[RayPacket::Size]) const
{
  bool isAll = true;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    glm::vec3 found;
    if (!known[lane] && packet.IsHit(lane))
    {
      if (this->Cache->LookUpShape(packet.GetRay(lane), packet.GetHit(lane), found))
      {
        known[lane] = -1;
        radiance.Set(lane, found);
      }
      isAll = isAll && known[lane] != 0;
    }
  }
  return isAll;
}

bool DiffuseLookUp::GetOnLattices(
  const RayPacket& packet, PacketRadiance& radiance, int known[RayPacket::Size]) const
{
  if (this->Surfaces.empty())
  {
    std::fill_n(known, RayPacket::Size, 0);
    radiance = {};
    return false;
  }
  LatticePacket places;
  const Finds finds =
    FindPlaces(this->Surfaces.data(), this->Cache->GetSides().GetData(), packet, known, places);
  if (!finds.Some)
  {
    radiance = {};
    return !finds.Others;
  }
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
  return !finds.Others;
}

CSLF_VECTORIZE DiffuseLookUp::Finds DiffuseLookUp::FindPlaces(const Surface* surfaces,
  const std::uint8_t* sides, const RayPacket& packet, int* known, LatticePacket& places)
{
  const RTCRay16& ray = packet.Query.ray;
  const RTCHit16& hit = packet.Query.hit;
  alignas(64) int open[RayPacket::Size];
  const auto findTriangle = [&](int lane)
  {
    const bool isHit = hit.geomID[lane] != Hit::None;
    const Surface& surface = surfaces[isHit ? hit.geomID[lane] : 0];
    const bool canBeKnown = isHit && surface.IsKnown;
    places.Triangle[lane] = canBeKnown ? surface.FirstTriangle + hit.primID[lane] : 0;
    open[lane] = canBeKnown ? sides[places.Triangle[lane]] : 0;
  };

  // Coherent rays mostly see one triangle.
  std::uint32_t differences = 0;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    differences |= hit.geomID[lane] ^ hit.geomID[0];
    differences |= hit.primID[lane] ^ hit.primID[0];
  }
  findTriangle(0);
  if (differences == 0)
  {
    std::fill_n(places.Triangle, RayPacket::Size, places.Triangle[0]);
    std::fill_n(open, RayPacket::Size, open[0]);
  }
  for (int lane = 1; differences != 0 && lane < RayPacket::Size; ++lane)
  {
    findTriangle(lane);
  }

  int others = 0;
  int some = 0;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int isHit = static_cast<int>(hit.geomID[lane]) == -1 ? 0 : -1;
    const float away = hit.Ng_x[lane] * ray.dir_x[lane] + hit.Ng_y[lane] * ray.dir_y[lane] +
      hit.Ng_z[lane] * ray.dir_z[lane];
    const int back = away > 0.0f ? 1 : 0;
    const int isKnown = -((open[lane] >> back) & 1);
    known[lane] = isKnown;
    others |= isHit & ~isKnown;
    some |= isKnown;
    places.Back[lane] = back;
    places.U[lane] = isKnown ? hit.u[lane] : 0.0f;
    places.V[lane] = isKnown ? hit.v[lane] : 0.0f;
  }
  return { some != 0, others != 0 };
}

CSLF_VECTORIZE int DiffuseLookUp::Colorize(const Surface* surfaces, const RayPacket& packet,
  const int* known, const LatticePacket& values, PacketRadiance& radiance)
{
  // Coherent rays mostly see one mesh, whose record need not be gathered.
  int lowest = std::numeric_limits<int>::max();
  int highest = 0;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int mesh = static_cast<int>(packet.Query.hit.geomID[lane]) & known[lane];
    const int high = mesh;
    const int low = mesh | (~known[lane] & std::numeric_limits<int>::max());
    lowest = low < lowest ? low : lowest;
    highest = high > highest ? high : highest;
  }
  if (lowest == highest)
  {
    const glm::vec3 color = surfaces[highest].Color;
    CSLF_LANE_LOOP
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      radiance.Red[lane] = known[lane] ? color.x * values.Red[lane] : 0.0f;
      radiance.Green[lane] = known[lane] ? color.y * values.Green[lane] : 0.0f;
      radiance.Blue[lane] = known[lane] ? color.z * values.Blue[lane] : 0.0f;
    }
    return surfaces[highest].Varies;
  }
  int varies = 0;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int mesh = static_cast<int>(packet.Query.hit.geomID[lane]) & known[lane];
    radiance.Red[lane] = known[lane] ? surfaces[mesh].Color.x * values.Red[lane] : 0.0f;
    radiance.Green[lane] = known[lane] ? surfaces[mesh].Color.y * values.Green[lane] : 0.0f;
    radiance.Blue[lane] = known[lane] ? surfaces[mesh].Color.z * values.Blue[lane] : 0.0f;
    varies |= surfaces[mesh].Varies & known[lane];
  }
  return varies;
}
}
