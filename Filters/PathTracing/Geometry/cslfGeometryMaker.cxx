// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryMaker.h"

#include "Geometry/cslfReduction.h"
#include "Geometry/cslfSurfaceError.h"
#include "Geometry/cslfViewpointChoice.h"
#include "PathTracing/Texels/cslfFieldRays.h"
#include "Pipeline/cslfParallelFor.h"
#include "Quality/cslfRobertsSequence.h"
#include "cslfSeenPlaces.h"
#include "cslfTessellation.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace cslf
{
namespace
{
/// How far the surface may move, in texels at the cube's centre.
constexpr double MostTexels = 0.1;

/// Spheres, tubes and instances may become as coarse as this.
constexpr int Coarsest = 3;

/// Still coarser ones are only tried if these differ less from the scene, by this factor.
constexpr double LeastGain = 0.9;

/// The most triangles before hidden ones are removed.
constexpr std::size_t MostTessellated = 16u << 20;

/// The edge of the cells in which something is seen, in texels at the cube's centre. Viewpoints of
/// all sides see a texel's surface by many rays.
constexpr double CellTexels = 1.0;

/// Unless there are too many triangles, those within this number of cells are kept too: other views
/// may see them.
constexpr int WideCells = 4;

/// The most viewpoints along a side of a face, and texels along a side of their pictures, that
/// decide what is seen.
constexpr int MostViewpoints = 9;
constexpr int MostResolution = 128;

/// The number of viewpoints that decide from which side a point is seen.
constexpr std::size_t MostTries = 32;

/// How far in front of a point rays start to find its colour, in texels at the cube's centre.
constexpr double StartTexels = 0.5;

/// The number of points at which the error is measured.
constexpr std::size_t MeasuredPoints = 20000;

/// Points that are evenly spread over a surface.
std::vector<glm::vec3> SpreadPoints(const SurfaceMesh& surface, std::size_t count)
{
  std::vector<double> sums;
  sums.reserve(surface.Triangles.size());
  double sum = 0.0;
  for (const glm::uvec3& corners : surface.Triangles)
  {
    const glm::vec3& first = surface.Points[corners.x];
    sum +=
      glm::length(glm::cross(surface.Points[corners.y] - first, surface.Points[corners.z] - first));
    sums.push_back(sum);
  }
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; sum > 0.0 && i < count; ++i)
  {
    const double place = (double(i) + 0.5) / double(count) * sum;
    const std::size_t triangle = std::min<std::size_t>(
      std::lower_bound(sums.begin(), sums.end(), place) - sums.begin(), sums.size() - 1);
    auto u = static_cast<float>(RobertsNumber(static_cast<int>(i), 0));
    auto v = static_cast<float>(RobertsNumber(static_cast<int>(i), 1));
    if (u + v > 1.0f)
    {
      u = 1.0f - u;
      v = 1.0f - v;
    }
    const glm::uvec3& corners = surface.Triangles[triangle];
    points.push_back((1.0f - u - v) * surface.Points[corners.x] + u * surface.Points[corners.y] +
      v * surface.Points[corners.z]);
  }
  return points;
}

/// Finds out from which side points are seen.
class Watcher
{
public:
  Watcher(const Scene& scene, const GeometrySettings& settings, const std::vector<int>& slices,
    float tolerance)
    : World(scene)
    , Tolerance(tolerance)
  {
    this->Viewpoints.reserve(slices.size());
    for (const int slice : slices)
    {
      const glm::dvec3 place = settings.Grid.ViewpointPosition(settings.Grid.ViewpointOf(slice));
      this->Viewpoints.emplace_back(settings.Frame.PointToScene(settings.Box.PointToWorld(place)));
    }
    // Steps of the golden ratio that reach all of them.
    this->Stride = static_cast<std::size_t>(0.618 * double(this->Viewpoints.size())) | 1u;
    while (std::gcd(this->Stride, this->Viewpoints.size()) != 1)
    {
      this->Stride += 2;
    }
  }

  /// Whether a point is seen from the back of a plane through it, and not from the front, judged by
  /// some viewpoints that depend on a number.
  bool IsSeenFromBehind(const glm::vec3& point, const glm::vec3& normal, std::size_t number) const
  {
    const glm::vec3* viewpoint = this->FindViewpoint(point, number);
    return viewpoint && glm::dot(normal, *viewpoint - point) < 0.0f;
  }

private:
  const glm::vec3* FindViewpoint(const glm::vec3& point, std::size_t number) const
  {
    const std::size_t count = this->Viewpoints.size();
    for (std::size_t i = 0; i < std::min(MostTries, count); ++i)
    {
      const glm::vec3& viewpoint = this->Viewpoints[(number + i) * this->Stride % count];
      const float distance = glm::distance(viewpoint, point);
      const Hit hit = this->World.Intersect({ viewpoint, (point - viewpoint) / distance });
      if (!hit.IsValid() || hit.Distance > distance - this->Tolerance)
      {
        return &viewpoint;
      }
    }
    return nullptr;
  }

  const Scene& World;
  float Tolerance;
  std::vector<glm::vec3> Viewpoints;
  std::size_t Stride; // to the next one, which is far away
};

std::vector<RayGrid> AimAtPoints(const Watcher& watcher, const SurfaceMesh& mesh, double distance)
{
  const std::vector<glm::vec3> normals = FindNormals(mesh);
  std::vector<RayGrid> rays(mesh.Points.size());
  ParallelFor(0, static_cast<vtkIdType>(rays.size()), 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const glm::vec3& point = mesh.Points[i];
        const bool isBehind = watcher.IsSeenFromBehind(point, normals[i], i);
        const glm::dvec3 normal = (isBehind ? -1.0 : 1.0) * glm::dvec3(normals[i]);
        rays[i].Origin = glm::dvec3(point) + distance * normal;
        rays[i].Direction = -normal;
      }
    });
  return rays;
}

/// Knows what the viewpoints see of a scene.
SeenPlaces LookAround(const Scene& scene, const GeometrySettings& settings,
  const std::vector<int>& slices, double texel)
{
  const Layout pictures(
    settings.Grid.GetViewpoints(), std::min(settings.Grid.GetResolution(), MostResolution));
  const double cell = CellTexels * texel * settings.Grid.GetResolution() / pictures.GetResolution();
  SeenPlaces seen(scene, static_cast<float>(cell));
  seen.Look(TileCount * static_cast<int>(slices.size()), pictures.GetResolution(),
    [&](int tile)
    {
      return MakeFieldRays(
        pictures, settings.Box, settings.Frame, slices[tile / TileCount], tile % TileCount);
    });
  return seen;
}

/// The surface that the viewpoints see, with few enough triangles. Coarser shapes may lose less
/// than a further reduction of fine ones.
Geometry FindSurface(const Scene& scene, const GeometrySettings& settings,
  const std::vector<int>& slices, double texel)
{
  const std::vector<Mesh>& meshes = scene.GetMeshes();
  const auto tolerance = static_cast<float>(MostTexels * texel);
  const SeenPlaces seen = LookAround(scene, settings, slices, texel);
  const SeenPlaces nearlySeen = seen.Widen(WideCells);
  int coarseness = 0;
  while (coarseness < Coarsest && CountTriangles(meshes, coarseness) > MostTessellated)
  {
    ++coarseness;
  }
  std::vector<glm::vec3> points;
  Geometry best;
  best.Error.Loss = 2.0;
  std::size_t previous = std::numeric_limits<std::size_t>::max();
  for (bool isBetter = true; isBetter && coarseness <= Coarsest; ++coarseness)
  {
    SurfaceMesh surface = Tessellate(meshes, { tolerance, coarseness, MostTessellated });
    const std::size_t count = surface.Triangles.size();
    if (count >= std::exchange(previous, count))
    {
      break;
    }
    nearlySeen.KeepSeen(surface);
    Weld(surface);
    if (points.empty())
    {
      points = SpreadPoints(surface, MeasuredPoints);
      seen.KeepSeen(points);
    }
    Simplify(surface, tolerance);
    const bool isEnough = surface.Triangles.size() <= settings.MostTriangles;
    if (!isEnough)
    {
      seen.KeepSeen(surface);
      Weld(surface);
    }
    const SurfaceError error = ReduceWell(surface, settings.MostTriangles, points, texel);
    const double least = best.Error.GetMeanSquare(texel);
    isBetter = !isEnough && error.GetMeanSquare(texel) < LeastGain * least;
    if (error.GetMeanSquare(texel) < least)
    {
      best.Surface = std::move(surface);
      best.Error = error;
    }
  }
  return best;
}
}

std::string FindGeometryFault(const Scene& scene)
{
  const std::vector<Mesh>& meshes = scene.GetMeshes();
  if (std::any_of(meshes.begin(), meshes.end(),
        [](const Mesh& mesh) {
          return mesh.IsTranslucent() || mesh.Material.Hides(false) || mesh.Material.Hides(true);
        }))
  {
    return "surfaces are translucent, or visible from one side only";
  }
  return CountTriangles(meshes, Coarsest) > MostTessellated ? "there are too many shapes" : "";
}

Geometry MakeGeometry(const Scene& scene, const GeometrySettings& settings)
{
  const glm::dvec3& edges = settings.Box.Edges;
  const double texel = 0.5 * std::max({ edges.x, edges.y, edges.z }) /
    (settings.Frame.Radius * settings.Grid.GetResolution());
  const std::vector<int> slices = ChooseSlices(settings.Grid, MostViewpoints);
  Geometry geometry = FindSurface(scene, settings, slices, texel);
  // Coarse spheres and tubes reach a little beyond the scene's bounds.
  const Box bounds = scene.GetBounds();
  for (glm::vec3& point : geometry.Surface.Points)
  {
    point = glm::clamp(point, glm::vec3(bounds.Low), glm::vec3(bounds.High));
  }
  SortForDrawing(geometry.Surface);
  const double start = StartTexels * texel;
  geometry.Rays =
    AimAtPoints({ scene, settings, slices, static_cast<float>(start) }, geometry.Surface, start);
  return geometry;
}
}
