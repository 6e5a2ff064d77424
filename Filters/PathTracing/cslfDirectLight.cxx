// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDirectLight.h"

#include "cslfSampling.h"

#include <cmath>

namespace cslf
{
glm::vec3 DirectLight::GetEnvironment(const glm::vec3& direction, float pdf) const
{
  const Environment& environment = this->World.GetEnvironment();
  float weight = 1.0f;
  if (environment.CanSample() && this->LightSampling && !std::isinf(pdf))
  {
    weight = this->BSDFSampling ? PowerHeuristic(pdf, environment.Pdf(direction)) : 0.0f;
  }
  return weight * environment.GetRadiance(direction);
}

glm::vec3 DirectLight::GetEmission(const Ray& ray, const glm::vec3& normal, const Hit& hit,
  const SurfaceHit& surface, float pdf) const
{
  if (!surface.Material->IsEmissive())
  {
    return glm::vec3(0.0f);
  }
  float weight = 1.0f;
  if (this->LightSampling && !std::isinf(pdf))
  {
    const float sampled =
      this->World.GetLocalLights().GetPdf({ ray.Origin, normal }, ray.Direction, hit);
    weight = this->BSDFSampling ? PowerHeuristic(pdf, sampled) : (sampled > 0.0f ? 0.0f : 1.0f);
  }
  return weight * surface.Emission;
}

bool DirectLight::CanSample() const
{
  const bool extended = this->LightSampling &&
    (this->World.GetLocalLights().HasSurfaces() || this->World.GetEnvironment().CanSample());
  return extended || !this->World.GetDirectionalLights().empty() ||
    !this->World.GetPointLights().empty();
}

bool DirectLight::CanSampleOne() const
{
  const LocalLights& lights = this->World.GetLocalLights();
  return (this->LightSampling && lights.HasSurfaces()) || lights.HasPoints();
}

LightSample DirectLight::SampleOne(const LightReceiver& receiver, const glm::vec2& u) const
{
  // Lights without extent are sampled even if light sampling is off.
  LightSample sample = this->World.GetLocalLights().Sample(receiver, u);
  sample.Pdf = this->LightSampling || std::isinf(sample.Pdf) ? sample.Pdf : 0.0f;
  return sample;
}

glm::vec3 DirectLight::Sample(
  const ScatteringPoint& point, const SampleStream& stream, std::uint64_t& rays) const
{
  glm::vec3 radiance(0.0f);
  if (this->CanSampleOne())
  {
    const glm::vec2 u = stream.Get2D(Dimension::LocalLight);
    radiance += this->Arrive(point, this->SampleOne(point.Surface.GetReceiver(), u), rays);
  }
  const Environment& environment = this->World.GetEnvironment();
  if (this->LightSampling && environment.CanSample())
  {
    radiance += this->Arrive(point, environment.Sample(stream.Get2D(Dimension::Environment)), rays);
  }
  for (const DirectionalLight& light : this->World.GetDirectionalLights())
  {
    radiance += this->Arrive(point, light.Sample(), rays);
  }
  for (const PointLight& light : this->World.GetLocalLights().GetFewPoints())
  {
    radiance += this->Arrive(point, light.Sample(point.Surface.LeavePosition), rays);
  }
  return radiance;
}

glm::vec3 DirectLight::Arrive(
  const ScatteringPoint& point, const LightSample& light, std::uint64_t& rays) const
{
  // Check that there is light and that it is visible.
  const glm::vec3 none(0.0f);
  if (!(light.Pdf > 0.0f))
  {
    return none;
  }
  const glm::vec3 local = point.Local.ToLocal(light.Direction);
  glm::vec3 reflected = point.Reflection.EvaluateCosine(local, point.Open);
  if (reflected == none)
  {
    return none;
  }
  ++rays;
  reflected *= this->World.GetTransmittance(
    { point.Surface.GetStart(local.z), light.Direction }, light.Distance);
  if (reflected == none)
  {
    return none;
  }

  // Combine the estimate with the BSDF's own samples, which never hit a light without extent.
  if (std::isinf(light.Pdf))
  {
    return reflected * light.Radiance;
  }
  const float weight =
    this->BSDFSampling ? PowerHeuristic(light.Pdf, point.Reflection.Pdf(local, point.Open)) : 1.0f;
  return reflected * light.Radiance * (weight / light.Pdf);
}
}
