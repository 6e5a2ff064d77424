// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPathIntegrator.h"

#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Rays/cslfRayPacket.h"
#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "PathTracing/Volumes/cslfPhaseFunction.h"
#include "PathTracing/Volumes/cslfVolumeSet.h"
#include "SIMD/cslfVectorize.h"
#include "cslfDirectLight.h"
#include "cslfPathBatch.h"
#include "cslfSurfaceLanes.h"

#include <glm/vec3.hpp>

#include <algorithm>

namespace cslf
{
/// Advances one packet of paths by one step.
class PathStep
{
public:
  /// Of a batch's paths, which made `vertex` reflections.
  PathStep(const PathIntegrator& paths, const PathBatch& batch, int vertex);

  /// Evaluates the rays' hits and continues the paths. Adds the results to the radiances of the
  /// batch's paths. Returns the number of shadow rays.
  std::uint64_t Advance(PathPacket& paths, const HitLanes& hits, PathBatch& batch);

private:
  void PassVolumes(PathPacket& paths, const HitLanes& hits, float* coverages);
  void FindCollisions(const PathPacket& paths, const Lanes<float>& shifts,
    const Lanes<float>& numbers, Lanes<float>& far);
  std::uint64_t Scatter(PathPacket& paths);
  void Continue(PathPacket& paths);
  void AddEnvironment(PathPacket& paths, const HitLanes& hits);
  void EndWhereKnown(PathPacket& paths, const HitLanes& hits);
  void AddEmission(const PathPacket& paths, const HitLanes& hits);
  void MakeScattering(const PathPacket& paths);
  void AddStored(const PathPacket& paths, const HitLanes& hits);
  void AddFit(int lane, const Hit& hit, const BSDF* bsdf, const PathPacket& paths);
  void ChooseLobes(int lane, const BSDF& bsdf);
  std::uint64_t AddLight(const PathPacket& paths);
  void ChooseDirections(PathPacket& paths);
  void EndByChance(PathPacket& paths);

  const PathIntegrator& Paths;
  const Scene& World;
  const PathSettings& Settings;
  const DirectLight& Light;
  const StoredLight* Stored;
  int Depth;
  std::uint32_t Vertex;
  bool AreAveraged; // as in PathBatch

  // Of the packet.
  VeilLanes Veils;                  // in front of the hits, if the scene has volumes
  Vec3Lanes VeilWeight;             // of the light of these
  std::uint32_t OverBackground = 0; // a bit for each ray to the eye that meets no surface
  std::uint32_t Collided = 0;       // a bit for each path that is scattered by a volume
  Collision Collisions[LaneCount];  // of these
  Lanes<float> Opacities;           // the shares of the rays that collide
  PathPacket Scattered;             // the paths from there on
  Vec3Lanes Found;                  // the radiance that the step adds
  ScatterLanes Points;
  LaneMask Continues;    // whether paths may continue from Lambertian surfaces
  Lanes<float> Lobe;     // on other surfaces, the random number that chooses it
  Lobes Open[LaneCount]; // on other surfaces, the lobes in which the path may continue
  Lanes<float> OpenProbability;
  Vec3Lanes Local; // the next direction
};

namespace
{
// Russian roulette, which ends paths at random.

// From this many reflections on, paths of little weight end early.
constexpr int RouletteDepth = 3;

// The largest probability of continuing, so that paths between white surfaces end, too.
constexpr float MaximumSurvival = 0.95f;

/// The probability that a path continues, from its weight without the compression that is undone on
/// leaving glass.
inline float GetSurvival(const glm::vec3& beta, float compression)
{
  const float weight = std::max(std::max(beta.x, beta.y), beta.z) / compression;
  return std::min(weight, MaximumSurvival);
}

// The allowed error of a look-up, in the cache's tolerances, if hundreds of paths are averaged.
constexpr float TolerancesOfMany = 8.0f;

/// Adds an environment without image to rays that miss, and ends these paths.
CSLF_VECTORIZE void AddGradient(
  const SkyGradient& environment, const HitLanes& hits, PathPacket& paths, Vec3Lanes& found)
{
  const SkyGradient gradient = environment;
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const std::int32_t missed = hits.Mesh[i] == Hit::None ? -1 : 0;
    const glm::vec3 radiance = paths.Beta.Get(i) * gradient.Get(paths.Rays.Direction.Get(i));
    found.Set(i, Choose((missed & paths.Rays.Active[i]) != 0, radiance, glm::vec3(0.0f)));
    paths.Rays.Active[i] &= ~missed;
  }
}

CSLF_VECTORIZE void AddWeighted(const Vec3Lanes& beta, const Vec3Lanes& light, Vec3Lanes& found)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    found.Set(i, found.Get(i) + beta.Get(i) * light.Get(i));
  }
}

/// The next directions if all surfaces were Lambertian: the weight of a sample is the base colour.
CSLF_VECTORIZE void SampleLambertian(const Lanes<float>& x, const Lanes<float>& y,
  const SurfaceLanes& surfaces, const LaneMask& open, PathPacket& paths, Vec3Lanes& local)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const glm::vec3 direction = Lambert::Sample({ x[i], y[i] });
    const float pdf = Lambert::Pdf(direction);
    local.Set(i, direction);
    paths.Pdf[i] = pdf;
    paths.Beta.Set(i, paths.Beta.Get(i) * surfaces.BaseColor.Get(i));
    paths.Rays.Active[i] = pdf > 0.0f ? paths.Rays.Active[i] & open[i] : 0;
  }
}

/// Russian roulette.
CSLF_VECTORIZE void SurviveAll(const Lanes<float>& x, PathPacket& paths)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const glm::vec3 beta = paths.Beta.Get(i);
    const float survival = GetSurvival(beta, paths.Compression[i]);
    paths.Rays.Active[i] = x[i] < survival ? paths.Rays.Active[i] : 0;
    paths.Beta.Set(i, beta / survival);
  }
}

CSLF_VECTORIZE void Leave(const SurfaceLanes& surfaces, const Vec3Lanes& local, PathPacket& paths)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const glm::vec3 direction = local.Get(i);
    const glm::vec3 world = Frame(surfaces.ShadingNormal.Get(i)).ToWorld(direction);
    const glm::vec3 origin =
      Choose(direction.z < 0.0f, surfaces.PassPosition.Get(i), surfaces.LeavePosition.Get(i));
    paths.Rays.Origin.Set(i, origin);
    paths.Rays.Direction.Set(i, world);
    paths.Normal.Set(i, surfaces.ShadingNormal.Get(i));
    paths.Bin[i] = GetRayBin(origin, world);
  }
}

/// Adds the results of a packet's paths to the radiances of the batch.
void Deposit(const Vec3Lanes& found, const PathPacket& paths, glm::vec3* radiances)
{
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const glm::vec3 radiance = found.Get(lane);
    if (radiance.x + radiance.y + radiance.z > 0.0f)
    {
      radiances[paths.Path[lane]] += radiance;
    }
  }
}
}

PathStep::PathStep(const PathIntegrator& paths, const PathBatch& batch, int vertex)
  : Paths(paths)
  , World(paths.World)
  , Settings(paths.Settings)
  , Light(paths.Light)
  , Stored(paths.Stored)
  , Depth(batch.GetDepth() + vertex)
  , Vertex(static_cast<std::uint32_t>(vertex) + 1)
  , AreAveraged(batch.AreAveraged())
{
}

std::uint64_t PathStep::Advance(PathPacket& paths, const HitLanes& hits, PathBatch& batch)
{
  std::uint64_t rays = 0;
  if (this->World.GetVolumes())
  {
    this->PassVolumes(paths, hits, batch.GetCoverages());
    this->AddEnvironment(paths, hits);
    AddWeighted(this->VeilWeight, this->Veils.Radiance, this->Found);
    rays += this->Scatter(paths);
  }
  else
  {
    this->AddEnvironment(paths, hits);
  }
  if (this->Stored && this->Depth > 0 && this->Depth < this->Settings.MaximumDepth)
  {
    this->EndWhereKnown(paths, hits);
  }
  if (IsAny(paths.Rays.Active))
  {
    FindSurfaces(this->World, paths.Rays, hits, this->Points.Surfaces);
    this->AddEmission(paths, hits);
    if (this->Depth < this->Settings.MaximumDepth)
    {
      this->Points.Lit = paths.Rays.Active;
      this->MakeScattering(paths);
      this->AddStored(paths, hits);
      rays = this->AddLight(paths);
      this->ChooseDirections(paths);
      if (this->AreAveraged || this->Depth >= RouletteDepth)
      {
        this->EndByChance(paths);
      }
      Leave(this->Points.Surfaces, this->Local, paths);
      ForEachLane(this->Points.Surfaces.Scattering,
        [&](int lane) { paths.Normal.Set(lane, this->Points.Surfaces.GetReceiverNormal(lane)); });
    }
    else
    {
      std::fill_n(paths.Rays.Active.Values, LaneCount, 0);
    }
  }
  this->Continue(paths);
  Deposit(this->Found, paths, batch.GetRadiances());
  return rays;
}

/// Attenuates what rays see by the volumes in front of it, and ends the paths that these hide or
/// scatter.
void PathStep::PassVolumes(PathPacket& paths, const HitLanes& hits, float* coverages)
{
  const VolumeSet& volumes = *this->World.GetVolumes();
  Lanes<float> far;
  this->OverBackground = 0; // a field shows these over any background
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    far[lane] = hits.IsValid(lane) ? hits.Distance[lane] : VolumeSet::Everywhere;
    const bool isOver = this->Depth == 0 && !hits.IsValid(lane) &&
      !this->Settings.ShowsEnvironment && paths.Rays.Active[lane] != 0;
    this->OverBackground |= isOver ? 1u << lane : 0u;
  }
  Lanes<float> shifts;
  Lanes<float> numbers;
  paths.Streams.Get2D(this->Vertex, Dimension::Pixel, shifts, numbers);
  this->Collided = 0;
  std::fill_n(this->Opacities.Values, LaneCount, 0.0f);
  if (volumes.IsAnyLit())
  {
    this->FindCollisions(paths, shifts, numbers, far);
  }
  volumes.Integrate(paths.Rays, far, shifts, this->Veils);
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    if (paths.Rays.Active[lane] == 0)
    {
      this->VeilWeight.Set(lane, glm::vec3(0.0f));
      continue;
    }
    const float transmittance = this->Veils.Transmittance[lane];
    this->VeilWeight.Set(lane, paths.Beta.Get(lane));
    paths.Beta.Set(lane, transmittance * paths.Beta.Get(lane));
    const bool isOver = (this->OverBackground >> lane & 1u) != 0;
    const bool isScattered = (this->Collided >> lane & 1u) != 0;
    if (isOver)
    {
      coverages[paths.Path[lane]] = 1.0f - transmittance * (1.0f - this->Opacities[lane]);
    }
    paths.Rays.Active[lane] = isOver || isScattered || transmittance == 0.0f ? 0 : -1;
  }
}

/// Finds out which rays volumes scatter, and where: there they end. Those of rays to the eye are
/// distributed evenly.
void PathStep::FindCollisions(const PathPacket& paths, const Lanes<float>& shifts,
  const Lanes<float>& numbers, Lanes<float>& far)
{
  const VolumeSet& volumes = *this->World.GetVolumes();
  if (this->Depth == 0)
  {
    volumes.FindOpacities(paths.Rays, far, shifts, this->Opacities);
    // All rays over the background collide, and stand for their share. Where volumes shine as
    // well, a part of the rays does, because what shines behind the collision counts, too.
    const std::uint32_t forced = volumes.IsAnyUnlit() ? 0u : this->OverBackground;
    RayLanes colliding = paths.Rays;
    Lanes<float> places;
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      const bool isForced = (forced >> lane & 1u) != 0;
      places[lane] = (isForced ? this->Opacities[lane] : 1.0f) * numbers[lane];
      const bool collides = places[lane] < this->Opacities[lane];
      colliding.Active[lane] = collides ? colliding.Active[lane] : 0;
      this->Opacities[lane] = isForced ? this->Opacities[lane] : collides ? 1.0f : 0.0f;
    }
    this->Collided = volumes.FindCollisions(colliding, far, shifts, places, this->Collisions);
  }
  else
  {
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      const std::uint64_t seed =
        MixBits(MixBits(paths.Streams.Hash[lane], paths.Streams.Index[lane]), this->Vertex);
      const bool isFound = paths.Rays.Active[lane] != 0 &&
        volumes.FindCollision(paths.Rays.Get(lane), far[lane], seed, this->Collisions[lane]);
      this->Collided |= isFound ? 1u << lane : 0u;
    }
  }
  ForEachLane(this->Collided, [&](int lane) { far[lane] = this->Collisions[lane].Distance; });
}

/// Adds the light that volumes scatter at collisions, and chooses how these paths continue.
std::uint64_t PathStep::Scatter(PathPacket& paths)
{
  if (this->Collided == 0)
  {
    return 0;
  }
  PathPacket& next = this->Scattered;
  std::fill_n(next.Rays.Active.Values, LaneCount, 0);
  std::fill_n(this->Points.Lit.Values, LaneCount, 0);
  this->Points.Surfaces.Scattering = 0;
  Lanes<float> x;
  Lanes<float> y;
  Lanes<float> roulette;
  paths.Streams.Get2D(this->Vertex, Dimension::Direction, x, y);
  paths.Streams.Get1D(this->Vertex, Dimension::Roulette, roulette);
  const bool isLast = this->Depth >= this->Settings.MaximumDepth;
  Vec3Lanes betas;
  Clear(betas);
  ForEachLane(isLast ? 0u : this->Collided,
    [&](int lane)
    {
      const Collision& collision = this->Collisions[lane];
      const Ray ray = paths.Rays.Get(lane);
      const glm::vec3 position = ray.Origin + collision.Distance * ray.Direction;
      this->Points.SetMedium(lane, position, ray.Direction, collision.Albedo, collision.Anisotropy);
      this->Points.Lit[lane] = -1;
      const bool isOver = (this->OverBackground >> lane & 1u) != 0;
      const float share = isOver ? this->Opacities[lane] : 1.0f;
      const glm::vec3 beta = share * paths.Beta.Get(lane);
      betas.Set(lane, beta);
      const glm::vec3 direction =
        SamplePhase(ray.Direction, collision.Anisotropy, { x[lane], y[lane] });
      next.Rays.Origin.Set(lane, position);
      next.Rays.Direction.Set(lane, direction);
      next.Pdf[lane] = EvaluatePhase(glm::dot(ray.Direction, direction), collision.Anisotropy);
      const glm::vec3 weight = beta * collision.Albedo;
      const float survival = this->AreAveraged || this->Depth >= RouletteDepth
        ? GetSurvival(weight, paths.Compression[lane])
        : 1.0f;
      next.Beta.Set(lane, weight / survival);
      next.Rays.Active[lane] = roulette[lane] < survival && weight != glm::vec3(0.0f) ? -1 : 0;
    });
  std::uint64_t rays = 0;
  if (IsAny(this->Points.Lit) && this->Light.CanSample())
  {
    Vec3Lanes light;
    Clear(light);
    rays = this->Light.Sample(this->Points, paths.Streams, this->Vertex, light);
    AddWeighted(betas, light, this->Found);
  }
  this->Points.Media = 0;
  return rays;
}

/// Continues the paths that volumes have scattered, among those that surfaces have reflected.
void PathStep::Continue(PathPacket& paths)
{
  ForEachLane(this->Collided,
    [&](int lane)
    {
      const PathPacket& next = this->Scattered;
      paths.Rays.Active[lane] = next.Rays.Active[lane];
      paths.Rays.Origin.Set(lane, next.Rays.Origin.Get(lane));
      paths.Rays.Direction.Set(lane, next.Rays.Direction.Get(lane));
      paths.Beta.Set(lane, next.Beta.Get(lane));
      paths.Pdf[lane] = next.Pdf[lane];
      paths.Normal.Set(lane, glm::vec3(0.0f));
      paths.Bin[lane] = GetRayBin(next.Rays.Origin.Get(lane), next.Rays.Direction.Get(lane));
    });
}

void PathStep::AddEnvironment(PathPacket& paths, const HitLanes& hits)
{
  const Environment& environment = this->World.GetEnvironment();
  if (environment.GetImage().Pixels.empty())
  {
    AddGradient(environment.GetGradient(), hits, paths, this->Found);
    return;
  }
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    glm::vec3 radiance(0.0f);
    if (!hits.IsValid(lane) && paths.Rays.Active[lane] != 0)
    {
      radiance = paths.Beta.Get(lane) *
        this->Light.GetEnvironment(paths.Rays.Direction.Get(lane), paths.Pdf[lane]);
      paths.Rays.Active[lane] = 0;
    }
    this->Found.Set(lane, radiance);
  }
}

/// Adds the light of surfaces that the cache covers completely, and ends these paths.
void PathStep::EndWhereKnown(PathPacket& paths, const HitLanes& hits)
{
  const float tolerances = this->AreAveraged ? TolerancesOfMany : 1.0f;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    glm::vec3 known;
    if (paths.Rays.Active[lane] != 0 &&
      this->Paths.LookUp(paths.Rays.Get(lane), hits.Get(lane), known, tolerances))
    {
      this->Found.Set(lane, this->Found.Get(lane) + paths.Beta.Get(lane) * known);
      paths.Rays.Active[lane] = 0;
    }
  }
}

void PathStep::AddEmission(const PathPacket& paths, const HitLanes& hits)
{
  ForEachLane(this->Points.Surfaces.Shining,
    [&](int lane)
    {
      const glm::vec3 emission = this->Light.GetEmission(paths.Rays.Get(lane),
        paths.Normal.Get(lane), hits.Get(lane), this->Points.Surfaces.Get(lane), paths.Pdf[lane]);
      this->Found.Set(lane, this->Found.Get(lane) + paths.Beta.Get(lane) * emission);
    });
}

/// Makes the BSDFs of surfaces that are not Lambertian.
void PathStep::MakeScattering(const PathPacket& paths)
{
  const SurfaceLanes& surfaces = this->Points.Surfaces;
  if (surfaces.Scattering == 0)
  {
    return;
  }
  paths.Streams.Get1D(this->Vertex, Dimension::Lobe, this->Lobe);
  ForEachLane(surfaces.Scattering,
    [&](int lane)
    {
      this->Points.MakeScattering(lane, -paths.Rays.Direction.Get(lane));
      this->Points.LitLobes[lane] = Lobes::All;
      this->Open[lane] = Lobes::All;
      this->OpenProbability[lane] = 1.0f;
    });
}

/// Adds the diffuse light that is stored, and excludes it from later steps.
void PathStep::AddStored(const PathPacket& paths, const HitLanes& hits)
{
  std::fill_n(this->Continues.Values, LaneCount, -1);
  for (int lane = 0; this->Stored && lane < LaneCount; ++lane)
  {
    if (paths.Rays.Active[lane] == 0)
    {
      continue;
    }
    const Hit hit = hits.Get(lane);
    const bool isLambertian = (this->Points.Surfaces.Scattering >> lane & 1u) == 0;
    const BSDF* bsdf = isLambertian ? nullptr : &*this->Points.Scattering[lane];
    if (this->Stored->HasShape(hit.Mesh))
    {
      this->AddFit(lane, hit, bsdf, paths);
      continue;
    }
    if (!this->Stored->Covers(hit) || !(isLambertian || bsdf->Has(Lobes::Diffuse)))
    {
      continue;
    }
    const glm::vec3 albedo =
      isLambertian ? this->Points.Surfaces.BaseColor.Get(lane) : bsdf->GetDiffuse().GetAlbedo();
    this->Found.Set(
      lane, this->Found.Get(lane) + paths.Beta.Get(lane) * albedo * this->Stored->Get(hit));
    if (isLambertian)
    {
      this->Points.Lit[lane] = 0;
      this->Continues[lane] = this->Stored->IsComplete() ? 0 : -1;
      continue;
    }
    this->Points.LitLobes[lane] = Lobes::Specular;
    this->Open[lane] = Lobes::Specular;
    if (!this->Stored->IsComplete())
    {
      this->ChooseLobes(lane, *bsdf);
    }
  }
}

/// Adds the diffuse light that is stored as a fit, and excludes it from later steps. Light that is
/// sampled at its sources is not part of it.
void PathStep::AddFit(int lane, const Hit& hit, const BSDF* bsdf, const PathPacket& paths)
{
  const bool isLit = this->Light.CanSample();
  glm::vec3 light;
  if ((bsdf && (isLit || !bsdf->Has(Lobes::Diffuse))) ||
    !this->Stored->GetShape(hit, this->Points.Surfaces.Get(lane), light))
  {
    return;
  }
  const glm::vec3 albedo =
    bsdf ? bsdf->GetDiffuse().GetAlbedo() : this->Points.Surfaces.BaseColor.Get(lane);
  this->Found.Set(lane, this->Found.Get(lane) + paths.Beta.Get(lane) * albedo * light);
  if (bsdf)
  {
    this->Open[lane] = Lobes::Specular;
  }
  else
  {
    this->Continues[lane] = 0;
  }
}

/// Chooses whether the path continues from diffuse or from other lobes, and keeps the rest of the
/// random number for the choice among these.
void PathStep::ChooseLobes(int lane, const BSDF& bsdf)
{
  const float specular = bsdf.GetProbability(Lobes::Specular);
  float& number = this->Lobe[lane];
  const bool isSpecular = number < specular;
  this->Open[lane] = isSpecular ? Lobes::Specular : Lobes::Diffuse;
  this->OpenProbability[lane] = isSpecular ? specular : 1.0f - specular;
  number = (isSpecular ? number : number - specular) / this->OpenProbability[lane];
}

/// Adds light that is sampled at its sources.
std::uint64_t PathStep::AddLight(const PathPacket& paths)
{
  if (!this->Light.CanSample())
  {
    return 0;
  }
  ForEachLane(this->Points.Surfaces.Scattering,
    [&](int lane)
    {
      const BSDF& bsdf = *this->Points.Scattering[lane];
      const Lobes lobes = this->Points.LitLobes[lane];
      this->Points.Lit[lane] =
        bsdf.Has(lobes) && !bsdf.IsMirror(lobes) ? this->Points.Lit[lane] : 0;
    });
  if (!IsAny(this->Points.Lit))
  {
    return 0;
  }
  Vec3Lanes light;
  Clear(light);
  const std::uint64_t rays = this->Light.Sample(this->Points, paths.Streams, this->Vertex, light);
  AddWeighted(paths.Beta, light, this->Found);
  return rays;
}

/// Chooses the directions in which the paths continue.
void PathStep::ChooseDirections(PathPacket& paths)
{
  Lanes<float> x;
  Lanes<float> y;
  paths.Streams.Get2D(this->Vertex, Dimension::Direction, x, y);
  const std::uint32_t others = this->Points.Surfaces.Scattering;
  Vec3Lanes betas;
  LaneMask active;
  if (others != 0)
  {
    betas = paths.Beta;
    active = paths.Rays.Active;
  }
  SampleLambertian(x, y, this->Points.Surfaces, this->Continues, paths, this->Local);
  ForEachLane(others,
    [&](int lane)
    {
      const BSDF& bsdf = *this->Points.Scattering[lane];
      BSDFSample sample;
      const bool goesOn = bsdf.Has(this->Open[lane]) &&
        bsdf.Sample(this->Lobe[lane], { x[lane], y[lane] }, sample, this->Open[lane]);
      paths.Rays.Active[lane] = goesOn ? active[lane] : 0;
      paths.Beta.Set(lane, betas.Get(lane) * sample.Weight / this->OpenProbability[lane]);
      paths.Compression[lane] *= sample.Compression;
      paths.Pdf[lane] = sample.Pdf;
      this->Local.Set(lane, sample.Direction);
    });
}

/// Ends paths of little weight.
void PathStep::EndByChance(PathPacket& paths)
{
  Lanes<float> x;
  paths.Streams.Get1D(this->Vertex, Dimension::Roulette, x);
  SurviveAll(x, paths);
}

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
      rays += step.Advance(packet, hits, batch);
    }
    batch.Compact();
  }
}
}
