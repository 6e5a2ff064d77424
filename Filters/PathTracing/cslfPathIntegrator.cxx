// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPathIntegrator.h"

#include "RadianceCache/cslfRadianceCache.h"
#include "cslfPathPacket.h"
#include "cslfPathStep.h"
#include "cslfRoulette.h"

#include <algorithm>
#include <limits>

namespace cslf
{
namespace
{
// The allowed error of a look-up, in the cache's tolerances, if hundreds of paths are averaged.
constexpr float TolerancesOfMany = 8.0f;
}

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
      this->LookUps.push_back(mesh.IsDiffuse() && mesh.CanHoldLattice());
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

glm::vec3 PathIntegrator::GetRadiance(
  const Ray& ray, const Hit& hit, SampleStream stream, std::uint64_t& rays) const
{
  Start start;
  start.First = ray;
  start.Seen = hit;
  return this->GetRadiance(start, stream, rays);
}

glm::vec3 PathIntegrator::GetRadiance(
  const Start& start, SampleStream stream, std::uint64_t& rays) const
{
  Ray ray = start.First;
  Hit hit = start.Seen;
  float pdf = start.Pdf;
  glm::vec3 normal = start.Normal;
  glm::vec3 radiance(0.0f);
  glm::vec3 beta(1.0f);
  float compression = 1.0f;
  const float tolerances = start.IsOneOfMany ? TolerancesOfMany : 1.0f;
  for (int depth = start.Depth;; ++depth)
  {
    // Add the environment where the path leaves the scene.
    if (!hit.IsValid())
    {
      return radiance + beta * this->Light.GetEnvironment(ray.Direction, pdf);
    }

    // End if the cache knows everything.
    glm::vec3 known;
    if (depth > 0 && depth < this->Settings.MaximumDepth &&
      this->LookUp(ray, hit, known, tolerances))
    {
      return radiance + beta * known;
    }

    // Add what the surface emits.
    const SurfaceHit surface = this->World.GetSurface(ray, hit);
    radiance += beta * this->Light.GetEmission(ray, normal, hit, surface, pdf);
    if (depth >= this->Settings.MaximumDepth)
    {
      return radiance;
    }

    // Add the diffuse light that the cache knows, and exclude it from later steps.
    stream.NextVertex();
    const Frame frame(surface.ShadingNormal);
    const BSDF bsdf(
      *surface.Material, surface.GetMaterialPoint(), frame.ToLocal(-ray.Direction), surface.Inside);
    const float lobe = bsdf.HasSpecular() ? stream.Get1D(Dimension::Lobe) : 1.0f;
    Lobes lit = Lobes::All;
    Lobes open = Lobes::All;
    float openProbability = 1.0f;
    if (this->Cache && this->Cache->Covers(hit) && bsdf.HasDiffuse())
    {
      radiance += beta * bsdf.DiffuseAlbedo() * this->Cache->Get(hit);
      lit = Lobes::Specular;
      open = Lobes::Specular;
      if (!this->Cache->IsComplete())
      {
        const float specular = bsdf.GetSpecularProbability(Lobes::All);
        open = lobe < specular ? Lobes::Specular : Lobes::Diffuse;
        openProbability = lobe < specular ? specular : 1.0f - specular;
      }
    }

    // Add light that is sampled at its sources.
    if (bsdf.Has(lit) && !bsdf.IsMirror(lit))
    {
      radiance += beta * this->Light.Sample({ surface, frame, bsdf, lit }, stream, rays);
    }

    // Choose the direction in which the path continues.
    BSDFSample sample;
    if (!bsdf.Has(open) || !bsdf.Sample(lobe, stream.Get2D(Dimension::Direction), sample, open))
    {
      return radiance;
    }
    beta *= sample.Weight / openProbability;
    compression *= sample.Compression;
    pdf = sample.Pdf;
    normal = surface.GetReceiver().Normal;

    // End paths of little weight.
    if ((depth >= RouletteDepth || start.IsOneOfMany) &&
      !Survive(beta, compression, stream.Get1D(Dimension::Roulette)))
    {
      return radiance;
    }
    ray = { surface.GetStart(sample.Direction.z), frame.ToWorld(sample.Direction) };
    ++rays;
    hit = this->World.Intersect(ray);
  }
}

void PathIntegrator::Follow(PathBatch& batch, std::uint64_t& rays) const
{
  batch.Begin();
  for (int vertex = 0; batch.GetNumberOfPackets() > 0; ++vertex)
  {
    PathStep step(*this, batch.GetDepth() + vertex, vertex + 1);
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
    batch.GoOn();
  }
}
}
