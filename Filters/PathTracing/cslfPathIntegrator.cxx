// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPathIntegrator.h"

#include "cslfBSDF.h"
#include "cslfFrame.h"
#include "cslfSampling.h"

#include <limits>

namespace cslf
{
namespace
{
// From this many reflections on, paths of little weight end early.
constexpr int RouletteDepth = 3;

// The largest chance of going on, so that paths end between white surfaces too.
constexpr float LargestSurvival = 0.95f;

/// Russian roulette on the path's weight, without the compression that leaving the glass undoes.
/// False where the path ends.
bool Survive(glm::vec3& beta, float compression, float u)
{
  const float weight = std::max({ beta.x, beta.y, beta.z }) / compression;
  const float survival = std::min(weight, LargestSurvival);
  if (u >= survival)
  {
    return false;
  }
  beta /= survival;
  return true;
}
}

/// A surface point of the path and how it reflects towards the previous one.
struct PathIntegrator::Vertex
{
  const SurfaceHit& Surface;
  const Frame& Local;
  const BSDF& Reflection;
};

glm::vec3 PathIntegrator::GetRadiance(Ray ray, Hit hit, SampleStream stream) const
{
  glm::vec3 radiance(0.0f);
  glm::vec3 beta(1.0f);
  float compression = 1.0f;
  // The density of the ray's direction; a given ray is like a mirror's.
  float pdf = std::numeric_limits<float>::infinity();
  for (int depth = 0;; ++depth)
  {
    // Add the environment where the path leaves the scene.
    if (!hit.IsValid())
    {
      return radiance + beta * this->EnvironmentLight(ray.Direction, pdf);
    }

    // Add what the surface emits.
    const SurfaceHit surface = this->World.GetSurface(ray, hit);
    radiance += beta * this->EmittedLight(ray, hit, surface, pdf);
    if (depth >= this->Settings.MaximumDepth)
    {
      return radiance;
    }

    // Add light that is sampled at its sources.
    stream.NextVertex();
    const Frame frame(surface.ShadingNormal);
    const BSDF bsdf(
      *surface.Material, surface.GetMaterialPoint(), frame.ToLocal(-ray.Direction), surface.Inside);
    if (!bsdf.IsMirror())
    {
      radiance += beta * this->DirectLight({ surface, frame, bsdf }, stream);
    }

    // Choose the direction in which the path goes on.
    BSDFSample sample;
    if (!bsdf.Sample(stream.Get1D(Dimension::Lobe), stream.Get2D(Dimension::Direction), sample))
    {
      return radiance;
    }
    beta *= sample.Weight;
    compression *= sample.Compression;
    pdf = sample.Pdf;

    // End paths that carry little.
    if (depth >= RouletteDepth && !Survive(beta, compression, stream.Get1D(Dimension::Roulette)))
    {
      return radiance;
    }
    ray = { surface.GetStart(sample.Direction.z), frame.ToWorld(sample.Direction) };
    hit = this->World.Intersect(ray);
  }
}

glm::vec3 PathIntegrator::EnvironmentLight(const glm::vec3& direction, float pdf) const
{
  const Environment& environment = this->World.GetEnvironment();
  float weight = 1.0f;
  if (environment.CanSample() && this->Settings.LightSampling && !std::isinf(pdf))
  {
    weight = this->Settings.BSDFSampling ? PowerHeuristic(pdf, environment.Pdf(direction)) : 0.0f;
  }
  return weight * environment.GetRadiance(direction);
}

glm::vec3 PathIntegrator::EmittedLight(
  const Ray& ray, const Hit& hit, const SurfaceHit& surface, float pdf) const
{
  if (!surface.Material->IsEmissive())
  {
    return glm::vec3(0.0f);
  }
  float weight = 1.0f;
  if (this->Settings.LightSampling && !std::isinf(pdf) && surface.EmissionImportance > 0.0f)
  {
    const float cosine = -glm::dot(ray.Direction, surface.GeometricNormal);
    weight = this->Settings.BSDFSampling
      ? PowerHeuristic(
          pdf, this->World.GetAreaLights().Pdf(surface.EmissionImportance, hit.Distance, cosine))
      : 0.0f;
  }
  return weight * surface.Emission;
}

glm::vec3 PathIntegrator::DirectLight(const Vertex& vertex, const SampleStream& stream) const
{
  glm::vec3 radiance(0.0f);
  if (this->Settings.LightSampling)
  {
    if (!this->World.GetAreaLights().IsEmpty())
    {
      radiance += this->Arrive(vertex,
        this->World.GetAreaLights().Sample(
          vertex.Surface.LeavePosition, stream.Get2D(Dimension::AreaLight)));
    }
    if (this->World.GetEnvironment().CanSample())
    {
      radiance += this->Arrive(
        vertex, this->World.GetEnvironment().Sample(stream.Get2D(Dimension::Environment)));
    }
  }
  for (const DirectionalLight& light : this->World.GetDirectionalLights())
  {
    radiance += this->Arrive(vertex, light.Sample());
  }
  for (const PointLight& light : this->World.GetPointLights())
  {
    radiance += this->Arrive(vertex, light.Sample(vertex.Surface.LeavePosition));
  }
  return radiance;
}

glm::vec3 PathIntegrator::Arrive(const Vertex& vertex, const LightSample& light) const
{
  // Is there light, and does the surface see it?
  const glm::vec3 none(0.0f);
  if (!(light.Pdf > 0.0f))
  {
    return none;
  }
  const glm::vec3 local = vertex.Local.ToLocal(light.Direction);
  glm::vec3 reflected = vertex.Reflection.EvaluateCosine(local);
  if (reflected == none)
  {
    return none;
  }
  reflected *= this->World.GetTransmittance(
    { vertex.Surface.GetStart(local.z), light.Direction }, light.Distance);
  if (reflected == none)
  {
    return none;
  }

  // Share the estimate with the BSDF's own samples, which never meet a light without extent.
  if (std::isinf(light.Pdf))
  {
    return reflected * light.Radiance;
  }
  const float weight =
    this->Settings.BSDFSampling ? PowerHeuristic(light.Pdf, vertex.Reflection.Pdf(local)) : 1.0f;
  return reflected * light.Radiance * (weight / light.Pdf);
}
}
