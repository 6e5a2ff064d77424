// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceLight.h"

#include "Geometry/cslfColorFit.h"
#include "PathTracing/Materials/cslfLobe.h"
#include "Pipeline/cslfParallelFor.h"
#include "Quality/cslfTexelChoice.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfColor.h"
#include "cslfSceneArrays.h"
#include "cslfSceneMaps.h"

#include <vtkMath.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

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

/// What two rays meet from both sides is at one place if it is not further apart than this share of
/// the distance from which they start.
constexpr float SameShare = 1e-3f;

/// The samples of a triangle: one for each so many square texels, within limits.
constexpr float SampleArea = 2.0f;
constexpr int MinimumSamples = 4;
constexpr int MaximumSamples = 256;

/// How little samples weigh that nobody sees, beside others.
constexpr float HiddenWeight = 1e-3f;

/// The largest tolerance of colours whose light is rough.
constexpr double DetailTolerance = 1.0 / 128.0;

/// The RMS error of values of arrays in a triangle that is small enough, as a share of the range:
/// about a third of what 1 of 100 places may have.
constexpr double ArrayTolerance = 0.0015;

/// How far borders of regions may have moved, in texels: about as far as surfaces.
constexpr float MaximumStray = 0.2f;

/// Places on an image that are further away than so many edges of a triangle are not its own.
constexpr float SeamEdges = 4.0f;

/// How far points that divide edges may move to lie on the surface, in texels.
constexpr float MaximumShift = 0.25f;

/// How often triangles are divided, and the shortest edge that is divided, in texels.
constexpr int MaximumRounds = 12;
constexpr float ShortestTexels = 2.0f;

/// The same for values of arrays, which are known in any detail.
constexpr float ShortestArrayTexels = 0.5f;

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
  bool IsMet = false;     ///< whether it is the side that was aimed at
  bool IsNearest = false; ///< and what the other aim meets there is not nearer to the point
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
  const auto getOffset = [distance](const Aim& aim)
  { return aim.IsMet ? std::abs(aim.Target.Distance - distance) : HUGE_VALF; };
  for (const int side : { 0, 1 })
  {
    aims[side].IsNearest =
      aims[side].IsMet && getOffset(aims[side]) <= getOffset(aims[1 - side]) + SameShare * distance;
  }
  return aims;
}

/// The region of what a ray hits.
std::uint32_t FindRegion(const Scene& scene, const SurfaceRegions& regions, const Hit& hit)
{
  return regions.Get(scene.GetMeshes()[hit.Mesh], hit.GetPlace().Triangle);
}

/// Whether one of several rays from where an aim begins, away from the surface, meets nothing: of
/// all directions, or of the first and each further `step`.
bool IsSeen(const Scene& scene, const Ray& aim, int first = 0, int step = 1)
{
  const Frame frame(-aim.Direction);
  for (int i = first; i < Directions; i += step)
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

/// Moves a point along its normal onto a region of the scene's surfaces, if that is not further
/// away than that.
glm::vec3 ProjectOnto(const Scene& scene, const SurfaceRegions& regions, const glm::vec3& point,
  const glm::vec3& normal, float furthest, std::uint32_t region)
{
  glm::vec3 nearest = point;
  float least = furthest;
  for (const float side : { 1.0f, -1.0f })
  {
    const Ray ray{ point + side * furthest * normal, -side * normal };
    const Hit hit = scene.Intersect(ray);
    if (hit.IsValid() && FindRegion(scene, regions, hit) == region &&
      std::abs(hit.Distance - furthest) < least)
    {
      least = std::abs(hit.Distance - furthest);
      nearest = ray.Origin + hit.Distance * ray.Direction;
    }
  }
  return nearest;
}

/// What is known of a place of a surface.
struct SampledPoint
{
  /// What is known of its light.
  enum class Light
  {
    Known,
    Missing, ///< it hardly gets any, so that little of it is seen
    Unknown
  };

  Light Is = Light::Missing;
  glm::vec3 Color{ 0.0f };  ///< or the light, if a map tells its colours
  glm::vec3 Detail{ 0.0f }; ///< its colour under white light, for comparison with that around it
  double Brightness = 1.0;  ///< how much brighter the surface is than the colour
  glm::vec3 Place{ 0.0f };  ///< on the map
};

/// Whether a triangle's samples in other regions than its own are so few that its border has only
/// moved: on each side they fill less than `most` square texels, or are one.
bool AreStray(const std::vector<std::array<std::uint32_t, 2>>& regions,
  const TriangleSamples& samples, float most)
{
  const float area = samples.Area / static_cast<float>(regions.size());
  for (const int side : { 0, 1 })
  {
    const auto others = std::count_if(regions.begin(), regions.end(),
      [&](const std::array<std::uint32_t, 2>& found)
      { return found[side] != TriangleSamples::None && found[side] != samples.Region; });
    if (others > 1 && static_cast<float>(others) * area > most)
    {
      return false;
    }
  }
  return true;
}

/// Whether samples of a triangle, by their aims, are seen, where that matters. Those of a small
/// triangle see about the same: they share the directions.
std::vector<std::array<char, 2>> FindSeen(const Scene& scene,
  const std::vector<std::array<Aim, 2>>& aims, const std::vector<std::array<char, 2>>& matter)
{
  const auto count = static_cast<int>(aims.size());
  const bool isSmall = count == MinimumSamples;
  std::vector<std::array<char, 2>> seen(aims.size(), { 0, 0 });
  for (const int side : { 0, 1 })
  {
    bool isAnySeen = false;
    for (int i = 0; i < count && !isAnySeen; ++i)
    {
      if (matter[i][side] != 0)
      {
        seen[i][side] = IsSeen(scene, aims[i][side].Path, isSmall ? i : 0, isSmall ? count : 1);
        isAnySeen = isSmall && seen[i][side] != 0;
      }
    }
    for (int i = 0; i < count && isAnySeen; ++i)
    {
      seen[i][side] = 1;
    }
  }
  return seen;
}

/// Some samples of a triangle may lie beyond a seam of its texture: they are much further from the
/// others than its edges are long, in pixels.
void DropBeyondSeams(float edges, std::vector<std::array<SampledPoint, 2>>& points)
{
  glm::vec2 middle(0.0f);
  for (int axis = 0; axis < 2; ++axis)
  {
    std::vector<float> values;
    for (const std::array<SampledPoint, 2>& both : points)
    {
      for (const SampledPoint& point : both)
      {
        if (point.Is == SampledPoint::Light::Known)
        {
          values.push_back(point.Place[axis]);
        }
      }
    }
    if (values.empty())
    {
      return;
    }
    const auto median = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), median, values.end());
    middle[axis] = *median;
  }
  const float most = SeamEdges * edges + 1.0f;
  for (std::array<SampledPoint, 2>& both : points)
  {
    for (SampledPoint& point : both)
    {
      if (point.Is == SampledPoint::Light::Known &&
        glm::distance(glm::vec2(point.Place), middle) > most)
      {
        point.Is = SampledPoint::Light::Missing;
      }
    }
  }
}

/// Samples triangles of a surface.
class LightSampler
{
public:
  LightSampler(const Scene& scene, const StoredLight* light, const SurfaceLightSettings& settings,
    const SceneMaps& maps, const SceneArrays& arrays)
    : World(scene)
    , Stored(light)
    , Settings(settings)
    , Maps(maps)
    , Arrays(arrays)
  {
  }

  /// The triangle belongs to `source`, a mesh, or what it meets tells.
  TriangleSamples Sample(
    const SurfaceMesh& mesh, const glm::uvec3& corners, const std::uint32_t* source) const;

private:
  bool FindRadiance(
    const Aim& aim, glm::vec3& radiance, glm::vec3& white, SampledPoint& point) const;
  glm::vec3 FindLight(const Aim& aim) const;
  SampledPoint FindPoint(const Aim& aim) const;
  glm::vec3 Encode(const glm::vec3& radiance) const;

  const Scene& World;
  const StoredLight* Stored;
  const SurfaceLightSettings& Settings;
  const SceneMaps& Maps;
  const SceneArrays& Arrays;
};

// The radiance, and what it is under white light. False if it is not known.
bool LightSampler::FindRadiance(
  const Aim& aim, glm::vec3& radiance, glm::vec3& white, SampledPoint& point) const
{
  const Mesh& mesh = this->World.GetMeshes()[aim.Target.Mesh];
  white = glm::vec3(0.0f);
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
      point.Is = SampledPoint::Light::Missing;
      return false;
    }
    const glm::vec3 emission = mesh.GetEmission(aim.Target.GetPlace());
    white = this->Settings.Regions->GetBaseColor(mesh, aim.Target.GetPlace());
    radiance = white * this->Stored->Get(aim.Target) + emission;
  }
  else if (!this->Stored || !this->Stored->LookUpShape(aim.Path, aim.Target, radiance))
  {
    // Rough surfaces look different from elsewhere, even if their light is stored.
    point.Is = this->Stored && this->Stored->IsComplete() && mesh.IsDiffuse()
      ? SampledPoint::Light::Missing
      : SampledPoint::Light::Unknown;
    return false;
  }
  point.Is = SampledPoint::Light::Known;
  return true;
}

// The radiance of a surface whose radiance is known, if its map gave white.
glm::vec3 LightSampler::FindLight(const Aim& aim) const
{
  const Mesh& mesh = this->World.GetMeshes()[aim.Target.Mesh];
  glm::vec3 light(1.0f);
  if (!OnlyEmits(mesh) && mesh.CanHoldLattice())
  {
    light = this->Stored->Get(aim.Target);
  }
  else if (!OnlyEmits(mesh))
  {
    this->Stored->GetShape(aim.Target, this->World.GetSurface(aim.Path, aim.Target), light);
  }
  return this->Maps.GetFactor(mesh) * light;
}

SampledPoint LightSampler::FindPoint(const Aim& aim) const
{
  SampledPoint point;
  // What is not met may be missing from the scene, or hidden.
  glm::vec3 radiance;
  glm::vec3 white;
  if (!aim.IsNearest || !this->FindRadiance(aim, radiance, white, point))
  {
    return point;
  }
  if (this->Maps.GetNumber(aim.Target.Mesh) > 0)
  {
    const glm::dvec3 light(this->FindLight(aim));
    for (int c = 0; c < 3; ++c)
    {
      point.Color[c] = static_cast<float>(EncodeLight(this->Settings.Exposure * light[c]));
    }
    const Mesh& mesh = this->World.GetMeshes()[aim.Target.Mesh];
    const TrianglePoint place = aim.Target.GetPlace();
    const glm::dvec3 base(this->Settings.Regions->GetBaseColor(mesh, place));
    point.Detail = glm::vec3(LinearToSRGB(base));
    point.Place = glm::vec3(this->Maps.GetPlace(mesh, *this->Settings.Regions, place), 0.0f);
  }
  else
  {
    point.Color = this->Encode(radiance);
    const glm::dvec3 exposed = this->Settings.Exposure * glm::dvec3(radiance);
    const glm::dvec3 shown = glm::min(exposed, glm::dvec3(1.0));
    point.Brightness =
      this->Settings.ClampsColors && std::max({ exposed.x, exposed.y, exposed.z }) > 1.0
      ? (exposed.x + exposed.y + exposed.z) / (shown.x + shown.y + shown.z)
      : 1.0;
    point.Detail = glm::vec3(LinearToSRGB(glm::dvec3(white)));
  }
  point.Is = std::isfinite(point.Color.x + point.Color.y + point.Color.z)
    ? SampledPoint::Light::Known
    : SampledPoint::Light::Unknown;
  return point;
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

TriangleSamples LightSampler::Sample(
  const SurfaceMesh& mesh, const glm::uvec3& corners, const std::uint32_t* source) const
{
  TriangleSamples samples;
  samples.Arrays.resize(this->Arrays.GetNumberOfTriples());
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
  std::vector<glm::vec3> places;
  std::vector<std::array<Aim, 2>> aims;
  std::vector<std::array<std::uint32_t, 2>> regions(count);
  std::uint32_t body = 0; // the mesh of the region
  int votes = 0;
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
    places.push_back(place);
    aims.push_back(AimAtSides(this->World, place.x * a + place.y * b + place.z * c, samples.Normal,
      this->Settings.KeepsMesh ? NearShare * furthest : furthest, furthest));
    for (const int side : { 0, 1 })
    {
      const Aim& aim = aims.back()[side];
      std::uint32_t& region = regions[i][side];
      region = TriangleSamples::None;
      if (aim.IsMet)
      {
        region = FindRegion(this->World, *this->Settings.Regions, aim.Target);
      }
      if (aim.IsNearest)
      {
        body = votes == 0 ? aim.Target.Mesh : body;
        samples.Region = votes == 0 ? region : samples.Region;
        votes += samples.Region == region ? 1 : -1;
      }
    }
  }
  const bool hasRegion = samples.Region != TriangleSamples::None;
  samples.IsRound = hasRegion && this->World.GetMeshes()[body].Shape != Mesh::Shapes::Triangles;
  samples.Map = source ? this->Maps.GetNumber(*source)
    : hasRegion        ? this->Maps.GetNumber(body)
                       : std::uint8_t(0);
  samples.PlaceTolerance = samples.Map > 0 ? this->Maps.GetTolerance(samples.Map) : 0.0f;
  const float edges = glm::distance(a, b) + glm::distance(b, c) + glm::distance(c, a);
  const bool dropsOthers = !this->Settings.KeepsMesh &&
    AreStray(regions, samples, MaximumStray * edges / this->Settings.Texel);
  std::vector<std::array<SampledPoint, 2>> points(count);
  std::vector<std::array<char, 2>> matter(count);
  for (int i = 0; i < count; ++i)
  {
    for (const int side : { 0, 1 })
    {
      const Aim& aim = aims[i][side];
      SampledPoint& point = points[i][side];
      point = this->FindPoint(aim);
      // Light and colours do not mix, nor do regions whose border is the triangle's.
      if (aim.IsMet &&
        (this->Maps.GetNumber(aim.Target.Mesh) != samples.Map ||
          (dropsOthers && regions[i][side] != samples.Region)))
      {
        point.Is = SampledPoint::Light::Missing;
      }
    }
  }
  if (samples.Map > 0 && this->Maps.IsImage(samples.Map))
  {
    DropBeyondSeams(
      edges / this->Settings.Texel * this->Maps.GetPixelsOfTexel(samples.Map), points);
  }
  for (int i = 0; i < count; ++i)
  {
    for (const int side : { 0, 1 })
    {
      matter[i][side] = points[i][side].Is != SampledPoint::Light::Missing;
    }
  }
  const std::vector<std::array<char, 2>> seen = FindSeen(this->World, aims, matter);
  SampleSums details[2];
  double brightness[2] = {};
  float baseSquare = 0.0f;
  std::vector<glm::vec3> values(samples.Arrays.size(), glm::vec3(0.0f));
  for (int i = 0; i < count; ++i)
  {
    for (const int side : { 0, 1 })
    {
      const Aim& aim = aims[i][side];
      const SampledPoint& point = points[i][side];
      if (point.Is == SampledPoint::Light::Known)
      {
        const bool isSeen = seen[i][side] != 0;
        const float weight = isSeen ? 1.0f : HiddenWeight;
        const float area = weight * samples.Area / static_cast<float>(count);
        samples.Sides[side].Add(places[i], point.Color, area);
        samples.Places.Add(places[i], point.Place, area);
        this->Arrays.Get(aim.Target.Mesh, aim.Target.GetPlace(), values);
        for (std::size_t k = 0; k < values.size(); ++k)
        {
          samples.Arrays[k].Add(places[i], values[k], area);
        }
        samples.MaximumLight =
          std::max({ samples.MaximumLight, point.Color.x, point.Color.y, point.Color.z });
        details[side].Add(places[i], samples.Map > 0 ? glm::vec3(0.0f) : point.Detail, area);
        baseSquare += area * glm::dot(point.Detail, point.Detail) / 3.0f;
        // What is brighter than white would outshine what hides it, along its edges.
        brightness[side] += area * (isSeen ? point.Brightness : 1.0);
      }
      else if (point.Is == SampledPoint::Light::Unknown && samples.AreComplete[side])
      {
        samples.AreComplete[side] = seen[i][side] == 0;
      }
    }
  }
  samples.BaseSquare =
    samples.Map > 0 && samples.Places.Weight > 0.0f ? baseSquare / samples.Places.Weight : 1.0f;
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

namespace
{
/// Gives points scalars, or places on images.
void SetPlaces(const std::vector<glm::vec2>& places, MappedPoints& points)
{
  SurfaceArray onImages;
  onImages.Name = TexturePlacesName;
  onImages.IsInteger = true;
  onImages.Components = { { "X", {} }, { "Y", {} } };
  bool hasImages = false;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const bool isOnImage = points.Has(i) && points.GetMap(i).IsImage();
    hasImages = hasImages || isOnImage;
    points.Scalars.push_back(
      points.Has(i) && !isOnImage ? points.GetMap(i).GetValue(places[i]) : 0.0);
    for (int axis = 0; axis < 2; ++axis)
    {
      onImages.Components[axis].Values.push_back(isOnImage
          ? std::round(double(points.GetMap(i).Layout.Steps) * places[i][axis])
          : vtkMath::Nan());
    }
  }
  if (hasImages)
  {
    points.Arrays.push_back(std::move(onImages));
  }
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
  SceneMaps maps;
  SceneArrays arrays;
  if (settings.ClampsColors)
  {
    maps = SceneMaps(meshes, settings.Texel, progress);
    arrays = SceneArrays(scene, maps.GetNumbers());
  }
  const LightSampler sampler(scene, light, settings, maps, arrays);
  const auto project = [&](const glm::vec3& point, const glm::vec3& normal, std::uint32_t region)
  {
    return ProjectOnto(
      scene, *settings.Regions, point, normal, MaximumShift * settings.Texel, region);
  };
  ColorFit fit(mesh,
    { ShortestTexels * settings.Texel, ShortestArrayTexels * settings.Texel, settings.ClampsColors,
      settings.HasCreases, settings.KeepsMesh, settings.Tolerance,
      std::min(settings.Tolerance, DetailTolerance), ArrayTolerance, settings.MaximumTriangles,
      project });
  const auto sample = [&](const Progress& part)
  {
    const std::vector<std::size_t> triangles = fit.ListNew();
    ParallelFor(0, static_cast<vtkIdType>(triangles.size()), OrAbort(part),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const std::size_t triangle = triangles[i];
          const bool hasSource = triangle < settings.Sources.size();
          fit.SetSamples(triangle,
            sampler.Sample(
              mesh, mesh.Triangles[triangle], hasSource ? &settings.Sources[triangle] : nullptr));
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
  FittedValues values;
  SideColors colors = fit.Finish(values);
  if (!values.Places.empty())
  {
    colors.Mapped.Maps = maps.TakeMaps();
    SetPlaces(values.Places, colors.Mapped);
    if (!values.Arrays.empty())
    {
      std::vector<SurfaceArray> own = arrays.MakeArrays(values.Arrays);
      std::move(own.begin(), own.end(), std::back_inserter(colors.Mapped.Arrays));
    }
  }
  return colors;
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
