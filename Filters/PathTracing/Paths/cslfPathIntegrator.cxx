// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPathIntegrator.h"

#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "cslfPathBatch.h"
#include "cslfPathStep.h"

namespace cslf
{
PathIntegrator::PathIntegrator(
  const Scene& scene, const PathSettings& settings, const RadianceCache* cache)
  : World(scene)
  , Settings(settings)
  , Light(scene, settings.LightSampling, settings.BSDFSampling)
  , Cache(cache)
{
  if (cache && cache->IsComplete())
  {
    for (const Mesh& mesh : scene.GetMeshes())
    {
      this->LookUps.push_back(mesh.IsDiffuse() && mesh.CanHoldLattice() ? 1 : 0);
    }
  }
}

bool PathIntegrator::CanLookUp(const Hit& hit) const
{
  return !this->LookUps.empty() && this->LookUps[hit.Mesh] && this->Cache->Covers(hit);
}

glm::vec3 PathIntegrator::LookUp(const Hit& hit) const
{
  return this->World.GetBaseColor(hit) * this->Cache->Get(hit);
}

bool PathIntegrator::LookUp(
  const Ray& ray, const Hit& hit, glm::vec3& radiance, float tolerances) const
{
  if (this->CanLookUp(hit))
  {
    radiance = this->LookUp(hit);
    return true;
  }
  if (this->Cache && this->Cache->LookUpShape(ray, hit, radiance))
  {
    return true;
  }
  return !this->LookUps.empty() && this->Cache->Covers(hit) &&
    this->LookUpRough(ray, hit, tolerances, radiance);
}

bool PathIntegrator::LookUpRough(
  const Ray& ray, const Hit& hit, float tolerances, glm::vec3& radiance) const
{
  const IncidentLight* light = this->Cache->GetIncident(hit);
  if (!light)
  {
    return false;
  }
  const Mesh& mesh = this->World.GetMeshes()[hit.Mesh];
  const bool isFlat = mesh.Normals.empty() && !mesh.Textures.Normal;
  const glm::vec3 normal = isFlat ? light->Normal : this->World.GetSurface(ray, hit).ShadingNormal;
  const glm::vec3 outgoing = -ray.Direction;
  const float albedo =
    mesh.Material.DielectricSpecular.Get(glm::dot(normal, outgoing), mesh.Material.Alpha);
  glm::vec3 reflected;
  if (!this->Cache->GetReflected(hit, *light, normal, outgoing, albedo, tolerances, reflected))
  {
    return false;
  }
  radiance = (1.0f - albedo) * this->LookUp(hit) + reflected;
  return true;
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
