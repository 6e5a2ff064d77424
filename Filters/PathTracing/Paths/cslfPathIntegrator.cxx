// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPathIntegrator.h"

#include "cslfPathBatch.h"
#include "cslfPathStep.h"

namespace cslf
{
StoredLight::~StoredLight() = default;

PathIntegrator::PathIntegrator(
  const Scene& scene, const PathSettings& settings, const StoredLight* stored)
  : World(scene)
  , Settings(settings)
  , Light(scene, settings.LightSampling, settings.BSDFSampling)
  , Stored(stored)
{
  if (stored && stored->IsComplete())
  {
    for (const Mesh& mesh : scene.GetMeshes())
    {
      this->LookUps.push_back(mesh.IsDiffuse() && mesh.CanHoldLattice() ? 1 : 0);
    }
  }
}

bool PathIntegrator::CanLookUp(const Hit& hit) const
{
  return !this->LookUps.empty() && this->LookUps[hit.Mesh] && this->Stored->Covers(hit);
}

glm::vec3 PathIntegrator::LookUp(const Hit& hit) const
{
  return this->World.GetBaseColor(hit) * this->Stored->Get(hit);
}

bool PathIntegrator::LookUp(
  const Ray& ray, const Hit& hit, glm::vec3& radiance, float tolerances) const
{
  if (this->CanLookUp(hit))
  {
    radiance = this->LookUp(hit);
    return true;
  }
  if (this->Stored && this->Stored->LookUpShape(ray, hit, radiance))
  {
    return true;
  }
  return !this->LookUps.empty() && this->Stored->Covers(hit) &&
    this->Stored->LookUpRough(ray, hit, tolerances, radiance);
}

void PathIntegrator::Follow(PathBatch& batch, std::uint64_t& rays) const
{
  batch.Begin();
  for (int vertex = 0; batch.GetNumberOfPackets() > 0; ++vertex)
  {
    PathStep step(*this, batch, vertex);
    for (int i = 0; i < batch.GetNumberOfPackets(); ++i)
    {
      PathPacket& packet = batch.GetPacket(i);
      HitLanes later;
      HitLanes& hits = vertex == 0 ? batch.GetFirstHits(i) : later;
      if (vertex > 0 || !batch.AreFirstHitsKnown())
      {
        this->World.Intersect(packet.Rays, hits);
        rays += static_cast<std::uint64_t>(Count(packet.Rays.Active));
      }
      rays += step.Advance(packet, hits, batch.GetRadiances());
    }
    batch.Compact();
  }
}
}
