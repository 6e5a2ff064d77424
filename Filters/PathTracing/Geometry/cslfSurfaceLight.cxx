// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceLight.h"

#include "Geometry/cslfColorFit.h"
#include "PathTracing/Materials/cslfLobe.h"
#include "Pipeline/cslfParallelFor.h"
#include "Quality/cslfTexelChoice.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfColor.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
/// The number of directions that decide whether a point can be seen on a side.
constexpr int Directions = 64;

/// How far in front of a point rays start, in texels, and how far they may go, in multiples of
/// that: simplified surfaces lie elsewhere.
constexpr float StartTexels = 0.5f;

/// Those at bodies that are as exact as the scene's start at this share of that: others may be
/// near.
constexpr float NearShare = 0.125f;
constexpr float MaximumReach = 4.0f;

/// The samples of a triangle: one for each so many square texels, within limits.
constexpr float SampleArea = 2.0f;
constexpr int MinimumSamples = 4;
constexpr int MaximumSamples = 256;

/// How little samples weigh that nobody sees, beside others.
constexpr float HiddenWeight = 1e-3f;

/// The largest tolerance of colours whose light is rough.
constexpr double DetailTolerance = 1.0 / 128.0;

/// How often triangles are divided, and the shortest edge that is divided, in texels.
constexpr int MaximumRounds = 12;
constexpr float ShortestTexels = 2.0f;

/// Whether a surface is shown without light.
bool OnlyEmits(const Mesh& mesh)
{
  return mesh.IsBlack() || mesh.Material.Unlit;
}

/// What a ray meets.
enum class Met
{
  Nothing,
  Front,
  Back
};

/// A ray that aims at a side of a surface from near it, and what it hits. A closed surface of
/// spheres or tubes has no back that anybody sees.
struct Aim
{
  Ray Path;
  Hit Target;
  Met What = Met::Nothing;
  bool IsMet = false; ///< whether it is the side that was aimed at
};

Aim AimAt(const Scene& scene, const Ray& ray, float reach)
{
  Aim aim;
  aim.Path = ray;
  aim.Target = scene.Intersect(ray);
  if (!aim.Target.IsValid() || aim.Target.Distance > reach)
  {
    return aim;
  }
  if (!scene.GetSurface(ray, aim.Target).Inside)
  {
    aim.What = Met::Front;
  }
  else if (scene.GetMeshes()[aim.Target.Mesh].Shape == Mesh::Shapes::Triangles)
  {
    aim.What = Met::Back;
  }
  return aim;
}

/// Aims at the front and the back of a point, from a distance, or from further away if nothing is
/// met: twice as far, and so on.
std::array<Aim, 2> AimAtSides(const Scene& scene, const glm::vec3& point, const glm::vec3& normal,
  float distance, float furthest)
{
  std::array<Aim, 2> aims{ AimAt(scene, { point + distance * normal, -normal },
                             MaximumReach * distance),
    AimAt(scene, { point - distance * normal, normal }, MaximumReach * distance) };
  if (distance < furthest && aims[0].What != Met::Front && aims[1].What != Met::Back)
  {
    return AimAtSides(scene, point, normal, 2.0f * distance, furthest);
  }
  // Otherwise the corners of the scene's polygons are in no consistent order.
  const bool isOrdered = aims[0].What == Met::Front || aims[1].What == Met::Back;
  for (const int side : { 0, 1 })
  {
    aims[side].IsMet = aims[side].What == (side == 0 ? Met::Front : Met::Back) ||
      (!isOrdered && aims[side].What != Met::Nothing);
  }
  return aims;
}

/// Whether one of several rays from where an aim begins, away from the surface, meets nothing.
bool IsSeen(const Scene& scene, const Ray& aim)
{
  const Frame frame(-aim.Direction);
  for (int i = 0; i < Directions; ++i)
  {
    const glm::vec3 direction = frame.ToWorld(SampleCosineHemisphere(
      { static_cast<float>(RobertsNumber(i, 0)), static_cast<float>(RobertsNumber(i, 1)) }));
    if (!scene.Intersect({ aim.Origin, direction }).IsValid())
    {
      return true;
    }
  }
  return false;
}

/// Samples triangles of a surface.
class LightSampler
{
public:
  LightSampler(const Scene& scene, const StoredLight* light, const SurfaceLightSettings& settings)
    : World(scene)
    , Stored(light)
    , Settings(settings)
  {
  }

  TriangleSamples Sample(const SurfaceMesh& mesh, const glm::uvec3& corners) const;

private:
  /// What is known of the light of a surface.
  enum class Light
  {
    Known,
    Missing, ///< it hardly gets any, so that little of it is seen
    Unknown
  };

  Light FindColor(const Aim& aim, glm::vec3& color, glm::vec3& detail, double& brightness) const;
  glm::vec3 Encode(const glm::vec3& radiance) const;

  const Scene& World;
  const StoredLight* Stored;
  SurfaceLightSettings Settings;
};

// A colour, what it is under white light, for comparison with that around it, and how much brighter
// the surface is.
LightSampler::Light LightSampler::FindColor(
  const Aim& aim, glm::vec3& color, glm::vec3& detail, double& brightness) const
{
  const Mesh& mesh = this->World.GetMeshes()[aim.Target.Mesh];
  glm::vec3 radiance;
  glm::vec3 white(0.0f);
  if (OnlyEmits(mesh))
  {
    radiance = mesh.GetEmission(aim.Target.GetPlace());
    white = radiance;
  }
  else if (this->Stored && this->Stored->IsComplete() && mesh.Material.IsLambertian() &&
    mesh.CanHoldLattice())
  {
    if (!this->Stored->Covers(aim.Target))
    {
      return Light::Missing;
    }
    const glm::vec3 emission = mesh.GetEmission(aim.Target.GetPlace());
    white = this->World.GetBaseColor(aim.Target);
    radiance = white * this->Stored->Get(aim.Target) + emission;
  }
  else if (!this->Stored || !this->Stored->LookUpShape(aim.Path, aim.Target, radiance))
  {
    // Rough surfaces look different from elsewhere, even if their light is stored.
    return this->Stored && this->Stored->IsComplete() && mesh.IsDiffuse() ? Light::Missing
                                                                          : Light::Unknown;
  }
  color = this->Encode(radiance);
  const glm::dvec3 exposed = static_cast<double>(this->Settings.Exposure) * glm::dvec3(radiance);
  const glm::dvec3 shown = glm::min(exposed, glm::dvec3(1.0));
  brightness = this->Settings.ClampsColors && std::max({ exposed.x, exposed.y, exposed.z }) > 1.0
    ? (exposed.x + exposed.y + exposed.z) / (shown.x + shown.y + shown.z)
    : 1.0;
  detail = glm::vec3(LinearToSRGB(glm::dvec3(white)));
  return std::isfinite(color.x + color.y + color.z) ? Light::Known : Light::Unknown;
}

glm::vec3 LightSampler::Encode(const glm::vec3& radiance) const
{
  glm::vec3 color;
  for (int i = 0; i < 3; ++i)
  {
    const double exposed = this->Settings.Exposure * radiance[i];
    color[i] = static_cast<float>(this->Settings.ClampsColors || exposed < 1.0
        ? LinearToSRGB(exposed)
        : 1.055 * std::pow(exposed, 1.0 / 2.4) - 0.055);
  }
  return color;
}

TriangleSamples LightSampler::Sample(const SurfaceMesh& mesh, const glm::uvec3& corners) const
{
  TriangleSamples samples;
  const glm::vec3& a = mesh.Points[corners.x];
  const glm::vec3& b = mesh.Points[corners.y];
  const glm::vec3& c = mesh.Points[corners.z];
  const glm::vec3 across = glm::cross(b - a, c - a);
  const float length = glm::length(across);
  if (!(length > 0.0f))
  {
    return samples;
  }
  samples.Normal = across / length;
  samples.Area = 0.5f * length / (this->Settings.Texel * this->Settings.Texel);
  const int count = static_cast<int>(std::clamp(std::ceil(samples.Area / SampleArea),
    static_cast<float>(MinimumSamples), static_cast<float>(MaximumSamples)));
  int votes = 0;
  SampleSums details[2];
  double brightness[2] = {};
  for (int i = 0; i < count; ++i)
  {
    auto u = static_cast<float>(RobertsNumber(i, 0));
    auto v = static_cast<float>(RobertsNumber(i, 1));
    if (u + v > 1.0f)
    {
      u = 1.0f - u;
      v = 1.0f - v;
    }
    const glm::vec3 place(1.0f - u - v, u, v);
    const float furthest = StartTexels * this->Settings.Texel;
    const auto aims = AimAtSides(this->World, place.x * a + place.y * b + place.z * c,
      samples.Normal, this->Settings.KeepsMesh ? NearShare * furthest : furthest, furthest);
    for (const int side : { 0, 1 })
    {
      const Aim& aim = aims[side];
      glm::vec3 color;
      glm::vec3 detail;
      double brighter = 1.0;
      // What is not met may be missing from the scene, or hidden.
      const Light light =
        aim.IsMet ? this->FindColor(aim, color, detail, brighter) : Light::Missing;
      if (light == Light::Known)
      {
        const float weight = IsSeen(this->World, aim.Path) ? 1.0f : HiddenWeight;
        const float area = weight * samples.Area / static_cast<float>(count);
        samples.Sides[side].Add(place, color, area);
        details[side].Add(place, detail, area);
        brightness[side] += area * brighter;
      }
      else if (light == Light::Unknown && samples.AreComplete[side])
      {
        samples.AreComplete[side] = !IsSeen(this->World, aim.Path);
      }
      if (aim.IsMet)
      {
        samples.Body = votes == 0 ? aim.Target.Mesh : samples.Body;
        samples.IsRound = this->World.GetMeshes()[samples.Body].Shape != Mesh::Shapes::Triangles;
        votes += samples.Body == aim.Target.Mesh ? 1 : -1;
      }
    }
  }
  for (const int side : { 0, 1 })
  {
    samples.Detail = std::max(samples.Detail, details[side].GetLeastError());
    const double weight = samples.Sides[side].Weight;
    samples.Brightness[side] = weight > 0.0 ? static_cast<float>(brightness[side] / weight) : 1.0f;
    samples.AreComplete[side] = samples.AreComplete[side] && samples.Area <= SampleArea * count;
  }
  return samples;
}
}

SideColors FitLight(const Scene& scene, const StoredLight* light,
  const SurfaceLightSettings& settings, const Progress& progress, SurfaceMesh& mesh)
{
  const std::vector<Mesh>& meshes = scene.GetMeshes();
  if (!light && std::none_of(meshes.begin(), meshes.end(), OnlyEmits))
  {
    return {};
  }
  const LightSampler sampler(scene, light, settings);
  ColorFit fit(mesh,
    { ShortestTexels * settings.Texel, settings.ClampsColors, settings.HasCreases,
      settings.KeepsMesh, settings.Tolerance, std::min(settings.Tolerance, DetailTolerance),
      settings.MaximumTriangles });
  const auto sample = [&](const Progress& part)
  {
    const std::vector<std::size_t> triangles = fit.ListNew();
    ParallelFor(0, static_cast<vtkIdType>(triangles.size()), OrAbort(part),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          fit.SetSamples(triangles[i], sampler.Sample(mesh, mesh.Triangles[triangles[i]]));
        }
      });
    fit.Solve(OrAbort(part));
  };
  double done = 0.0;
  sample(Within(progress, done, 0.5));
  for (int round = 0; round < MaximumRounds && fit.Refine(); ++round)
  {
    done = 0.5 * (1.0 + done);
    sample(Within(progress, done, 0.5 * (1.0 + done)));
  }
  return fit.Finish();
}

void FindSides(const Scene& scene, float texel, const SurfaceMesh& mesh, const Progress& progress,
  const SideColors& colors, SurfaceSides& sides)
{
  const std::vector<glm::vec3> normals = FindNormals(mesh);
  std::vector<std::array<char, 2>> seen(mesh.Points.size());
  std::vector<std::array<Ray, 2>> rays(mesh.Points.size());
  ParallelFor(0, static_cast<vtkIdType>(mesh.Points.size()), OrAbort(progress),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const float distance = StartTexels * texel;
        const auto aims = AimAtSides(scene, mesh.Points[i], normals[i], distance, distance);
        for (const int side : { 0, 1 })
        {
          rays[i][side] = aims[side].Path;
          const bool isKnown = !colors.Sides[side].empty() && colors.Sides[side][i].w > 0.0f;
          seen[i][side] = !isKnown && aims[side].IsMet && IsSeen(scene, aims[side].Path);
        }
      }
    });
  for (const int side : { 0, 1 })
  {
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      if (seen[i][side])
      {
        sides[side].Points.push_back(i);
        sides[side].Rays.emplace_back();
        sides[side].Rays.back().Origin = rays[i][side].Origin;
        sides[side].Rays.back().Direction = rays[i][side].Direction;
      }
    }
  }
}
}
