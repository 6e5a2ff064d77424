// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfOpenSides.h"
#include "Pipeline/cslfParallelFor.h"

#include "PathTracing/Paths/cslfSurfaceLanes.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfMeshEdges.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <unordered_map>

namespace cslf
{
namespace
{
// The number of walks from each side, until one leads out. If only one in a hundred would, as
// inside a body with a small hole, most sides are left to path tracing, which then rarely needs
// them.
constexpr std::uint32_t Walks = 16;

// The number of surfaces on a walk.
constexpr std::uint32_t Steps = 4;

// Triangles with a height below this many spacings are combined with their neighbours, if the
// spacing, or this share of their lengths, is larger than the distance of their centres.
constexpr float LowHeight = 0.5f;
constexpr float LengthPart = 0.125f;

// The number of such groups between two reports of progress.
constexpr vtkIdType GroupsAtOnce = 4096;

/// A walk over surfaces that count as white, so that it does not end by chance.
class Walk
{
public:
  Walk(const Scene& scene, const PathIntegrator& paths, std::uint64_t hash, std::uint32_t index)
    : World(scene)
    , Paths(paths)
    , Stream(hash, index)
  {
    // One lane is used.
    this->Streams.Hash[0] = hash;
    this->Streams.Index[0] = index;
    this->Points.LitLobes[0] = Lobes::All;
  }

  /// Whether it finds a way out, or light.
  bool Escapes(Hit hit, std::uint64_t& rays)
  {
    SurfaceHit surface = this->World.GetSurface(hit);
    glm::vec3 outgoing = surface.GeometricNormal;
    for (std::uint32_t step = 1; step <= Steps; ++step)
    {
      if (surface.Material->IsEmissive())
      {
        return true;
      }
      this->Stream.NextVertex();
      surface.BaseColor = glm::vec3(1.0f);
      this->Points.Surfaces.Set(0, surface);
      this->Points.Surfaces.Scattering = surface.Material->IsLambertian() ? 0 : 1;
      this->Points.Lit[0] = -1;
      const BSDF& bsdf = this->Points.MakeScattering(0, outgoing);
      Vec3Lanes light;
      light.Set(0, glm::vec3(0.0f));
      rays += this->Paths.GetLight().Sample(this->Points, this->Streams, step, light);
      if (light.Get(0) != glm::vec3(0.0f))
      {
        return true;
      }
      BSDFSample sample;
      if (!bsdf.Sample(
            this->Stream.Get1D(Dimension::Lobe), this->Stream.Get2D(Dimension::Direction), sample))
      {
        return false;
      }
      const Frame frame(surface.ShadingNormal);
      const Ray ray{ surface.GetStart(sample.Direction.z), frame.ToWorld(sample.Direction) };
      ++rays;
      hit = this->World.Intersect(ray);
      if (!hit.IsValid())
      {
        return true;
      }
      surface = this->World.GetSurface(ray, hit);
      outgoing = -ray.Direction;
    }
    return false;
  }

private:
  const Scene& World;
  const PathIntegrator& Paths;
  SampleStream Stream;
  StreamLanes Streams{};
  ScatterLanes Points{};
};

/// Triangles of a mesh that are combined.
class Groups
{
public:
  Groups(const Mesh& mesh, float spacing, const LayoutProgress& progress)
    : Surface(mesh)
    , Spacing(spacing)
  {
    const auto count = static_cast<std::uint32_t>(mesh.Triangles.size());
    std::vector<std::uint32_t> groups; // of each triangle
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    for (std::uint32_t triangle = 0; triangle < count; ++triangle)
    {
      progress.Step();
      std::uint32_t group = this->GetCount();
      std::uint64_t key = 0;
      if (this->FindKey(triangle, key))
      {
        group = numbers.emplace(key, group).first->second;
      }
      groups.push_back(group);
      this->Ends.resize(std::max<std::size_t>(this->Ends.size(), group + 1), 0);
      ++this->Ends[group];
    }
    std::partial_sum(this->Ends.begin(), this->Ends.end(), this->Ends.begin());
    std::vector<std::uint32_t> next(1, 0);
    next.insert(next.end(), this->Ends.begin(), this->Ends.end());
    this->Members.resize(count);
    for (std::uint32_t triangle = 0; triangle < count; ++triangle)
    {
      this->Members[next[groups[triangle]]++] = triangle;
    }
  }

  std::uint32_t GetCount() const { return static_cast<std::uint32_t>(this->Ends.size()); }
  const std::uint32_t* Begin(std::size_t group) const
  {
    return this->Members.data() + (group > 0 ? this->Ends[group - 1] : 0);
  }
  const std::uint32_t* End(std::size_t group) const
  {
    return this->Members.data() + this->Ends[group];
  }

private:
  /// The key that a low triangle shares with its neighbours: the position of its centre, rounded by
  /// its length and the spacing, and the axis closest to its normal. False for other triangles.
  bool FindKey(std::uint32_t triangle, std::uint64_t& key) const
  {
    const glm::uvec3& corners = this->Surface.Triangles[triangle];
    const glm::vec3& a = this->Surface.Vertices[corners.x];
    const glm::vec3& b = this->Surface.Vertices[corners.y];
    const glm::vec3& c = this->Surface.Vertices[corners.z];
    const float length = this->Surface.GetLongestEdge(triangle);
    if (!(2.0f * this->Surface.GetArea(triangle) < LowHeight * this->Spacing * length))
    {
      return false;
    }
    int level = 0;
    float side = this->Spacing;
    for (; side < LengthPart * length; side *= 2.0f)
    {
      ++level;
    }
    const glm::ivec3 cell(glm::floor((a + b + c) / (3.0f * side)));
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    key = MixBits(MixBits(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y)),
      MixBits(static_cast<std::uint32_t>(cell.z),
        static_cast<std::uint64_t>(6 * level + 2 * axis + (normal[axis] < 0.0f ? 1 : 0))));
    return true;
  }

  const Mesh& Surface;
  float Spacing;
  std::vector<std::uint32_t> Ends; // of the groups, in the list of their members
  std::vector<std::uint32_t> Members;
};

/// Whether an opaque closed body can be bright inside.
bool MayHoldLight(const Scene& scene)
{
  return !scene.GetPointLights().empty() ||
    std::any_of(scene.GetMeshes().begin(), scene.GetMeshes().end(),
      [](const Mesh& other) { return other.Material.IsEmissive(); });
}

/// Whether one side of all triangles of a group faces the inside of a closed body.
bool AreInside(
  const std::vector<std::uint8_t>& insides, const Groups& groups, std::size_t group, bool back)
{
  return std::all_of(groups.Begin(group), groups.End(group),
    [&insides, back](std::uint32_t triangle) { return insides[triangle] == (back ? 2 : 1); });
}

bool IsOpen(const Scene& scene, const PathIntegrator& paths, Hit place, const Groups& groups,
  std::size_t group, std::uint64_t hash, std::uint64_t& rays)
{
  const std::size_t count = groups.End(group) - groups.Begin(group);
  for (std::uint32_t i = 0; i < Walks; ++i)
  {
    const SampleStream stream(hash, i);
    const glm::vec2 point = SampleTriangle(stream.Get2D(Dimension::Pixel));
    place.Triangle = groups.Begin(group)[count > 1 ? MixBits(hash, i) % count : 0];
    place.U = point.x;
    place.V = point.y;
    if (Walk(scene, paths, hash, i).Escapes(place, rays))
    {
      return true;
    }
  }
  return false;
}
}

OpenSides::OpenSides(const Scene& scene, const PathIntegrator& paths, std::uint32_t seed,
  float spacing, const LayoutProgress& progress)
{
  std::atomic<std::uint64_t> allRays{ 0 };
  const bool areDark = !MayHoldLight(scene);
  for (std::uint32_t index = 0; index < scene.GetMeshes().size(); ++index)
  {
    const Mesh& mesh = scene.GetMeshes()[index];
    if (!mesh.CanHoldLattice())
    {
      continue;
    }
    const std::size_t first = this->Sides.size();
    this->Sides.resize(first + mesh.Triangles.size(), 0);
    const Groups groups(mesh, spacing, progress);
    std::vector<std::uint8_t> insides(mesh.Triangles.size(), 0);
    if (!mesh.CanBePassed())
    {
      insides = FindInsides(mesh, progress);
    }
    const auto findSides = [&](vtkIdType begin, vtkIdType end)
    {
      std::uint64_t rays = 0;
      for (vtkIdType group = begin; group < end; ++group)
      {
        std::uint8_t sides = 0;
        for (const bool back : { false, true })
        {
          Hit place;
          place.Mesh = index;
          place.Back = back;
          const std::size_t triangle = first + *groups.Begin(group);
          const std::uint64_t hash = MixBits(2 * triangle + (back ? 1 : 0), seed);
          if (!mesh.Material.Hides(back) && !(areDark && AreInside(insides, groups, group, back)) &&
            IsOpen(scene, paths, place, groups, group, hash, rays))
          {
            sides |= back ? Back : Front;
          }
        }
        std::for_each(groups.Begin(group), groups.End(group),
          [this, first, sides](std::uint32_t triangle) { this->Sides[first + triangle] = sides; });
      }
      allRays += rays;
    };
    const vtkIdType count = groups.GetCount();
    for (vtkIdType begin = 0; begin < count; begin += GroupsAtOnce)
    {
      progress.Step(LayoutProgress::StepsOfReport);
      ParallelFor(begin, std::min(begin + GroupsAtOnce, count), 0, findSides);
    }
    this->Insides.insert(this->Insides.end(), insides.begin(), insides.end());
  }
  this->Rays = allRays;
}
}
