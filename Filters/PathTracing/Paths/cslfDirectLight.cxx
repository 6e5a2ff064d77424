// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDirectLight.h"

#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "PathTracing/Volumes/cslfPhaseFunction.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"
#include "SIMD/cslfVectorize.h"
#include "cslfSurfaceLanes.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace cslf
{
namespace
{
/// The part of the light of given directions that is reflected.
struct ReflectedLanes
{
  Vec3Lanes Part;
  Lanes<float> Pdf; // the density of the BSDF's own samples for the direction
};

/// As if all surfaces were Lambertian.
CSLF_VECTORIZE void ReflectLambertian(const ScatterLanes& points, const LightLanes& light,
  ReflectedLanes& reflected, ShadowLanes& shadows)
{
  const SurfaceLanes& surfaces = points.Surfaces;
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const glm::vec3 direction = light.Direction.Get(i);
    const glm::vec3 local = Frame(surfaces.ShadingNormal.Get(i)).ToLocal(direction);
    const glm::vec3 part = Lambert::EvaluateCosine(local) * surfaces.BaseColor.Get(i);
    reflected.Part.Set(i, part);
    reflected.Pdf[i] = Lambert::Pdf(local);
    shadows.Rays.Active[i] =
      light.Pdf[i] > 0.0f && part.x + part.y + part.z > 0.0f ? points.Lit[i] : 0;
    shadows.Rays.Origin.Set(i, surfaces.LeavePosition.Get(i));
    shadows.Rays.Direction.Set(i, direction);
    shadows.Distance[i] = light.Distance[i];
  }
}

/// Any other surface.
void Reflect(const ScatterLanes& points, int lane, const LightLanes& light,
  ReflectedLanes& reflected, ShadowLanes& shadows)
{
  const SurfaceLanes& surfaces = points.Surfaces;
  const BSDF& bsdf = *points.Scattering[lane];
  const Lobes lobes = points.LitLobes[lane];
  const glm::vec3 local =
    Frame(surfaces.ShadingNormal.Get(lane)).ToLocal(light.Direction.Get(lane));
  const glm::vec3 part = bsdf.EvaluateCosine(local, lobes);
  const bool active = points.Lit[lane] != 0 && light.Pdf[lane] > 0.0f && part != glm::vec3(0.0f);
  shadows.Rays.Active[lane] = active ? -1 : 0;
  if (active)
  {
    reflected.Part.Set(lane, part);
    reflected.Pdf[lane] = bsdf.Pdf(local, lobes);
    shadows.Rays.Origin.Set(
      lane, local.z < 0.0f ? surfaces.PassPosition.Get(lane) : surfaces.LeavePosition.Get(lane));
  }
}

/// A point in a medium.
void ScatterMedium(const ScatterLanes& points, int lane, const LightLanes& light,
  ReflectedLanes& reflected, ShadowLanes& shadows)
{
  const float phase = EvaluatePhase(
    glm::dot(points.Paths.Get(lane), light.Direction.Get(lane)), points.Anisotropy[lane]);
  const glm::vec3 part = phase * points.Surfaces.BaseColor.Get(lane);
  reflected.Part.Set(lane, part);
  reflected.Pdf[lane] = phase;
  shadows.Rays.Active[lane] =
    light.Pdf[lane] > 0.0f && part != glm::vec3(0.0f) ? points.Lit[lane] : 0;
}

/// Adds the arriving light, and combines the estimate with the BSDF's own samples, which never hit
/// a light without extent.
CSLF_VECTORIZE void AddLight(const LightLanes& light, const ReflectedLanes& reflected,
  const Lanes<float>& transmittance, bool shared, Vec3Lanes& radiance)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const float pdf = light.Pdf[i];
    const bool isExtended = !std::isinf(pdf);
    const float density = isExtended ? pdf : 1.0f;
    const float weight = shared && isExtended ? PowerHeuristic(density, reflected.Pdf[i]) : 1.0f;
    const glm::vec3 sum = radiance.Get(i) +
      reflected.Part.Get(i) * light.Radiance.Get(i) * (transmittance[i] * weight / density);
    radiance.Set(i, Choose(transmittance[i] > 0.0f, sum, radiance.Get(i)));
  }
}
}

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

std::uint64_t DirectLight::Arrive(
  const ScatterLanes& points, const LightLanes& light, Vec3Lanes& radiance) const
{
  ReflectedLanes reflected;
  ShadowLanes shadows;
  ReflectLambertian(points, light, reflected, shadows);
  ForEachLane(points.Surfaces.Scattering,
    [&](int lane) { Reflect(points, lane, light, reflected, shadows); });
  ForEachLane(
    points.Media, [&](int lane) { ScatterMedium(points, lane, light, reflected, shadows); });
  const int count = Count(shadows.Rays.Active);
  if (count > 0)
  {
    this->World.FindTransmittances(shadows);
    AddLight(light, reflected, shadows.Transmittance, this->BSDFSampling, radiance);
  }
  return static_cast<std::uint64_t>(count);
}

std::uint64_t DirectLight::Sample(const ScatterLanes& points, const StreamLanes& streams,
  std::uint32_t vertex, Vec3Lanes& radiance) const
{
  std::uint64_t rays = 0;
  LightLanes light;
  const auto sample = [&](const auto& take)
  {
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      light.Set(lane, points.Lit[lane] != 0 ? take(lane) : LightSample());
    }
    rays += this->Arrive(points, light, radiance);
  };
  Lanes<float> x;
  Lanes<float> y;
  if (this->CanSampleOne())
  {
    streams.Get2D(vertex, Dimension::LocalLight, x, y);
    sample(
      [&](int lane) {
        return this->SampleOne(points.Surfaces.GetReceiver(lane), { x[lane], y[lane] });
      });
  }
  const Environment& environment = this->World.GetEnvironment();
  if (this->LightSampling && environment.CanSample())
  {
    streams.Get2D(vertex, Dimension::Environment, x, y);
    sample([&](int lane) { return environment.Sample({ x[lane], y[lane] }); });
  }
  for (const DirectionalLight& source : this->World.GetDirectionalLights())
  {
    sample([&](int) { return source.Sample(); });
  }
  for (const PointLight& source : this->World.GetLocalLights().GetFewPoints())
  {
    sample([&](int lane) { return source.Sample(points.Surfaces.LeavePosition.Get(lane)); });
  }
  return rays;
}
}
