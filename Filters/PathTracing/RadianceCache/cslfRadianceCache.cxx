// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRadianceCache.h"

#include "cslfDiffuseEstimator.h"
#include "cslfLatticeBuilder.h"
#include "cslfLatticeProbe.h"
#include "cslfLatticeSum.h"
#include "cslfLayoutProgress.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
// Light from sources has the sharpest edges, so every quarter of a brick is checked.
constexpr int FirstLightLevel = 2;

// The paths of a point whose light is only seen by other points, by hundreds of them at once.
constexpr int RoughSamples = 64;

// Triangles of up to 8 spacings, which contribute little to the light of other places, need only
// one such point. Triangles of up to 2 spacings, the size of
// a texel, need only one point at all.
constexpr int RoughSmallLevels = 3;
constexpr int FineSmallLevels = 1;

// The cubes, in spacings, in which points whose light is only seen by other points share one if
// their normals are alike: those see the mean of many.
constexpr float RoughClusterSize = 4.0f;

// The paths of a cell of a shape that is only seen by other points; and of one that is seen
// directly, at least. Each fit has several factors, so it needs more than a point of a lattice.
constexpr int RoughShapeSamples = 32;
constexpr int MinimumShapeSamples = 128;

// The paths on shapes from which the time for all is estimated.
constexpr std::uint64_t ProbedPaths = 100000;

// The fewest paths of a point that is seen directly.
constexpr int FirstLightSamples = 64;
constexpr int FirstGatherSamples = 128;

// The standard error of a point relative to the tolerance, as estimated from differences between
// parts of its samples. All parts together are better than that where the light is smooth.
constexpr float NoiseShare = 2.0f / 3.0f;

// The width of the area within which noise is averaged, in spacings: about that of a texel.
constexpr float NoiseWidth = 3.0f;

// The width of gaps that count as closed, in spacings: less than a quarter of a texel.
constexpr double GapWidth = 0.5;

// The simple steps of the layout for each triangle, of two rounds.
constexpr double LayoutSteps = 60.0;

// The shares of the work, for the progress.
constexpr double LayoutShare = 0.1;
constexpr double LightShare = 0.2;
constexpr double RoughShare = 0.1;
constexpr double ShapeShare = 0.2;

/// Whether all non-diffuse reflections of a mesh have the same blur.
bool IsRough(const Mesh& mesh)
{
  const SurfaceMaterial& material = mesh.Material;
  return material.IsRoughDielectric() && !mesh.Textures.MetallicRoughness && !material.IsEmissive();
}

/// The progress of what remains to be done at the end of a pass.
LayoutProgress AtEnd(const std::function<bool(double)>& goOn)
{
  return { [goOn](double) { return goOn(1.0); }, 1.0 };
}
}

RadianceCache::RadianceCache(const Scene& scene, const CacheSettings& settings)
  : World(scene)
  , Settings(settings)
  , Display(settings.Exposure, settings.DisplayRange)
{
  this->FindLobes();
}

bool RadianceCache::Build(const Progress& goOn)
{
  CacheShare* share = this->Settings.Share;
  if (!share)
  {
    return this->Fill(goOn);
  }
  const bool done = this->Fill([&goOn, share](double part) { return share->Agree(goOn(part)); });
  this->Rays = share->Sum(this->Rays);
  return done;
}

bool RadianceCache::MakeLayout(const Progress& goOn)
{
  const auto start = std::chrono::steady_clock::now();
  const PathIntegrator paths(this->World, this->Settings.Paths);
  const auto spacing = static_cast<float>(this->Settings.Spacing);
  std::size_t triangles = 0;
  for (const Mesh& mesh : this->World.GetMeshes())
  {
    triangles += mesh.Triangles.size();
  }
  const LayoutProgress progress(goOn, LayoutSteps * static_cast<double>(triangles));
  this->FindPlaces(paths, spacing, progress);
  this->ExpectedSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return goOn(1.0);
}

void RadianceCache::FindPlaces(
  const PathIntegrator& paths, float spacing, const LayoutProgress& progress)
{
  this->Sides = OpenSides(this->World, paths, this->Settings.Seed, spacing, progress);
  // All ranks do this, but it counts once.
  CacheShare* share = this->Settings.Share;
  const bool isFirst = !share || share->GetRank() == 0;
  if (share)
  {
    this->Sides.Agree(*share);
  }
  this->Rays += isFirst ? this->Sides.GetNumberOfRays() : 0;
  this->Layout = std::make_unique<LatticeLayout>(this->World, this->Sides, spacing, progress);
  this->Spacing = this->Layout->GetSpacing();
  this->Shapes = ShapeLight(ShapeLayout(this->World, static_cast<float>(this->Spacing), progress));
}

bool RadianceCache::Fill(const Progress& goOn)
{
  try
  {
    return this->MakeLayout(Within(goOn, 0.0, LayoutShare)) &&
      this->FillLayout(Within(goOn, LayoutShare, 1.0));
  }
  catch (const LayoutAborted&)
  {
    return false;
  }
}

bool RadianceCache::FillLayout(const Progress& goOn)
{
  // Light sampled at its sources has sharp shadows, which need many points with few samples.
  double done = LightShare;
  if (!this->SampleLights(Within(goOn, 0.0, done)))
  {
    return false;
  }
  const bool isHasty = this->Settings.Samples <= RoughSamples;
  if (!this->EstimateShapes(
        isHasty ? MinimumShapeSamples : RoughShapeSamples, Within(goOn, done, done + RoughShare)))
  {
    return false;
  }
  done += RoughShare;
  // With few paths for a point, finding rough light first would take more time than it saves.
  if (isHasty)
  {
    return this->GatherAtOnce(Within(goOn, done, 1.0));
  }
  // All other light: first roughly, with complete paths.
  LatticeSettings lattice = this->GetLatticeSettings();
  lattice.OnlyBright = true;
  lattice.ClusterSize = RoughClusterSize;
  lattice.SmallLevels = RoughSmallLevels;
  SurfaceLattice rough;
  if (!this->Gather(lattice, RoughSamples, RoughSamples, 2, rough, this->Incident,
        Within(goOn, done, done + RoughShare)))
  {
    return false;
  }
  done += RoughShare;
  this->Second = std::move(rough);
  this->HasSecond = true;
  this->Complete = true;
  // Then accurately, with paths that end at the first surface.
  const int samples = std::max(this->Settings.Samples / 2, MinimumShapeSamples);
  if (!this->EstimateShapes(samples, Within(goOn, done, done + ShapeShare)))
  {
    return false;
  }
  done += ShapeShare;
  SurfaceLattice fine;
  IncidentField incident;
  lattice = this->GetLatticeSettings();
  lattice.SmallLevels = FineSmallLevels;
  if (!this->Gather(lattice, FirstGatherSamples, this->Settings.Samples, 1, fine, incident,
        Within(goOn, done, 1.0)))
  {
    return false;
  }
  this->Values = AddLattices(this->Values, fine, AtEnd(goOn));
  this->Incident = std::move(incident);
  this->Second = SurfaceLattice();
  this->HasSecond = false;
  return true;
}

bool RadianceCache::GatherAtOnce(const Progress& goOn)
{
  LatticeSettings lattice = this->GetLatticeSettings();
  lattice.SmallLevels = FineSmallLevels;
  SurfaceLattice gathered;
  IncidentField incident;
  const int samples = this->Settings.Samples < RoughSamples ? RoughSamples / 2 : RoughSamples;
  if (!this->Gather(lattice, samples, samples, 1, gathered, incident, goOn))
  {
    return false;
  }
  this->Values = AddLattices(this->Values, gathered, AtEnd(goOn));
  this->Incident = std::move(incident);
  this->Complete = true;
  return true;
}

void RadianceCache::FindLobes()
{
  // Light sampled at its sources is sharper than what is stored here.
  const bool isSampled = PathIntegrator(this->World, this->Settings.Paths).GetLight().CanSample();
  for (const Mesh& mesh : this->World.GetMeshes())
  {
    const bool isKept = !isSampled && mesh.CanHoldLattice() && IsRough(mesh);
    this->Lobes.push_back(isKept ? GlossyLobe(mesh.Material) : GlossyLobe());
    this->AreEnds.push_back(!isSampled && mesh.IsDiffuse() ? 1 : 0);
  }
}

bool RadianceCache::LookUpShape(const Ray& ray, const Hit& hit, glm::vec3& radiance) const
{
  if (!this->AreEnds[hit.Mesh] || !this->Shapes.Has(hit.Mesh))
  {
    return false;
  }
  const SurfaceHit surface = this->World.GetSurface(ray, hit);
  glm::vec3 light;
  if (!this->Shapes.Get(hit, surface, light))
  {
    return false;
  }
  radiance = surface.BaseColor * light;
  return true;
}

bool RadianceCache::EstimateShapes(int samples, const Progress& goOn)
{
  if (this->Settings.Paths.MaximumDepth <= 0)
  {
    return true;
  }
  const auto start = std::chrono::steady_clock::now();
  const PathIntegrator paths(this->World, this->Settings.Paths, this);
  ShapeLight::Settings settings{ samples, this->Settings.Seed, 0, this->Settings.Share,
    this->GetInsideTest() };
  settings.MaximumPaths = this->Settings.ProbeSeconds > 0.0 ? ProbedPaths : 0;
  const std::uint64_t before = this->Shapes.GetNumberOfRays();
  const bool done = this->Shapes.Estimate(this->World, paths, settings, goOn);
  this->Rays += this->Shapes.GetNumberOfRays() - before;
  this->ExpectedSeconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
    std::max(this->Shapes.GetShare(), 1e-6);
  return done;
}

void RadianceCache::Get(LatticePacket& packet) const
{
  this->Values.Get(packet);
  if (this->HasSecond)
  {
    LatticePacket second = packet;
    this->Second.Get(second);
    for (int lane = 0; lane < LatticePacket::Size; ++lane)
    {
      packet.Red[lane] += second.Red[lane];
      packet.Green[lane] += second.Green[lane];
      packet.Blue[lane] += second.Blue[lane];
    }
  }
}

const IncidentLight* RadianceCache::GetIncident(const Hit& hit) const
{
  return this->Lobes[hit.Mesh].IsKnown()
    ? this->Incident.Get(this->Values.FindRoot(
        this->World.GetTriangleIndex(hit.Mesh, hit.Triangle), hit.Back, hit.U, hit.V))
    : nullptr;
}

bool RadianceCache::LookUpRough(
  const Ray& ray, const Hit& hit, float tolerances, glm::vec3& radiance) const
{
  const IncidentLight* light = this->GetIncident(hit);
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
  if (!this->GetReflected(hit, *light, normal, outgoing, albedo, tolerances, reflected))
  {
    return false;
  }
  radiance = (1.0f - albedo) * (this->World.GetBaseColor(hit) * this->Get(hit)) + reflected;
  return true;
}

bool RadianceCache::GetReflected(const Hit& hit, const IncidentLight& light,
  const glm::vec3& normal, const glm::vec3& outgoing, float albedo, float tolerances,
  glm::vec3& reflected) const
{
  // The accuracy must not depend on what is looked up.
  const glm::vec3 seen = ((1.0f - albedo) * this->World.GetBaseColor(hit) + albedo) * light.Mean;
  const glm::vec3 error = this->Display(seen + albedo * light.Error) - this->Display(seen);
  if (std::max({ error.x, error.y, error.z }) > tolerances * this->Settings.Tolerance)
  {
    return false;
  }
  const glm::vec3 radiance = light.Get(this->Lobes[hit.Mesh].GetMoments(normal, outgoing));
  reflected = albedo * glm::max(radiance, glm::vec3(0.0f));
  return true;
}

LatticeSettings RadianceCache::GetLatticeSettings() const
{
  LatticeSettings lattice;
  lattice.Tolerance = static_cast<float>(this->Settings.Tolerance);
  lattice.Exposure = this->Settings.Exposure;
  lattice.Display = this->Display;
  return lattice;
}

bool RadianceCache::IsInside(const Ray& ray, const Hit& hit) const
{
  if (this->World.GetMeshes()[hit.Mesh].CanHoldLattice())
  {
    return this->Sides.IsInside(this->World.GetTriangleIndex(hit.Mesh, hit.Triangle), hit.Back);
  }
  return this->Shapes.GetLayout().IsInside(hit, this->World.GetSurface(ray, hit).Inside);
}

std::function<bool(const Ray&, const Hit&)> RadianceCache::GetInsideTest() const
{
  if (!this->Sides.HasInsides() && !this->Shapes.GetLayout().HasShapes())
  {
    return nullptr;
  }
  return [this](const Ray& ray, const Hit& hit) { return this->IsInside(ray, hit); };
}

float RadianceCache::GetNoiseArea() const
{
  const float width = NoiseWidth * this->Layout->GetSpacing();
  return width * width;
}

bool RadianceCache::BuildLattice(LatticeBuilder& builder, double part, const Progress& goOn)
{
  if (this->Settings.ProbeSeconds <= 0.0)
  {
    return builder.Build(goOn);
  }
  this->ExpectedSeconds +=
    ProbeLattice(this->World, builder, part * this->Settings.ProbeSeconds, goOn);
  return goOn(1.0);
}

bool RadianceCache::SampleLights(const Progress& goOn)
{
  LatticeSettings lattice = this->GetLatticeSettings();
  lattice.FirstLevel = FirstLightLevel;
  const PathIntegrator paths(this->World, this->Settings.Paths, this);
  // The area is 0, so that each point has little noise by itself, however small its own area is:
  // differences between the values of points decide where the edges of sharp shadows are refined.
  constexpr float noiseArea = 0.0f;
  DiffuseEstimator estimator(this->World, paths, this,
    { DiffuseEstimator::Light::Sampled, FirstLightSamples,
      std::max(this->Settings.Samples, FirstLightSamples), NoiseShare * lattice.Tolerance,
      noiseArea, 0, this->Settings.Seed, lattice.Display, {}, this->Settings.Share,
      this->GetInsideTest(), static_cast<float>(GapWidth * this->Spacing) });
  LatticeBuilder builder(this->World, this->Sides, *this->Layout, lattice, estimator);
  const bool isLit = this->Settings.Paths.MaximumDepth > 0 && paths.GetLight().CanSample();
  const bool done = !isLit || this->BuildLattice(builder, LightShare, goOn);
  this->Rays += estimator.GetNumberOfRays();
  if (done)
  {
    this->Values = builder.TakeLattice(AtEnd(goOn));
  }
  return done;
}

bool RadianceCache::Gather(const LatticeSettings& lattice, int firstSamples, int lastSamples,
  int depth, SurfaceLattice& values, IncidentField& incident, const Progress& goOn)
{
  const PathIntegrator paths(this->World, this->Settings.Paths, this);
  DiffuseEstimator estimator(this->World, paths, this,
    { DiffuseEstimator::Light::Gathered, firstSamples, std::max(firstSamples, lastSamples),
      NoiseShare * lattice.Tolerance, this->GetNoiseArea(), depth, this->Settings.Seed,
      lattice.Display, this->Lobes, this->Settings.Share, this->GetInsideTest(),
      static_cast<float>(GapWidth * this->Spacing) });
  LatticeBuilder builder(this->World, this->Sides, *this->Layout, lattice, estimator);
  const bool isLit = this->Settings.Paths.MaximumDepth > 0;
  const double part = depth > 1 ? RoughShare : 1.0 - LightShare - RoughShare;
  const bool done = !isLit || this->BuildLattice(builder, part, goOn);
  this->Rays += estimator.GetNumberOfRays();
  if (done)
  {
    values = builder.TakeLattice(AtEnd(goOn));
    incident = std::move(builder.GetIncident());
  }
  return done;
}
}
