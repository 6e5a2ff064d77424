// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryMaker.h"

#include "Geometry/cslfGeometryData.h"
#include "Geometry/cslfReduction.h"
#include "Geometry/cslfSurfaceError.h"
#include "Geometry/cslfSurfaceMesh.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "Quality/cslfTexelChoice.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfSeenPlaces.h"
#include "cslfShapeGroups.h"
#include "cslfTessellation.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vtkAdaptiveSubdivisionFilter.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
// Divides large triangles.

/// Divides triangles until no edge is longer than `longest`, or than a larger length with which
/// there are at most `most` triangles. The surface stays the same, but what its points have can
/// vary within it.
void Subdivide(SurfaceMesh& mesh, double longest, std::size_t most);

/// The length of the longest edge of each triangle.
std::vector<double> FindLongestEdges(const SurfaceMesh& mesh)
{
  std::vector<double> lengths;
  lengths.reserve(mesh.Triangles.size());
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    const glm::dvec3 a(mesh.Points[corners.x]);
    const glm::dvec3 b(mesh.Points[corners.y]);
    const glm::dvec3 c(mesh.Points[corners.z]);
    lengths.push_back(std::max({ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) }));
  }
  return lengths;
}

/// About how many triangles there are if all edges are divided into equal parts. Each halving
/// divides a triangle into four.
double CountDivided(const std::vector<double>& edges, double longest)
{
  double count = 0.0;
  for (const double edge : edges)
  {
    count += edge > longest ? std::pow(4.0, std::ceil(std::log2(edge / longest))) : 1.0;
  }
  return count;
}

SurfaceMesh Divide(const SurfaceMesh& mesh, double longest)
{
  vtkNew<vtkAdaptiveSubdivisionFilter> divider;
  divider->SetInputData(MakePolyData(mesh, glm::dvec3(0.0), glm::dvec3(1.0)));
  divider->SetMaximumEdgeLength(longest);
  divider->SetMaximumTriangleArea(VTK_DOUBLE_MAX);
  divider->Update();
  return MakeMesh(divider->GetOutput());
}

void Subdivide(SurfaceMesh& mesh, double longest, std::size_t most)
{
  const std::vector<double> edges = FindLongestEdges(mesh);
  const double all = edges.empty() ? 0.0 : *std::max_element(edges.begin(), edges.end());
  for (; longest > 0.0 && longest < all; longest *= 2.0)
  {
    if (CountDivided(edges, longest) <= static_cast<double>(most))
    {
      SurfaceMesh divided = Divide(mesh, longest);
      if (divided.Triangles.size() <= most)
      {
        mesh = std::move(divided);
        return;
      }
    }
  }
}

/// How far the surface may move, in texels at the cube's centre.
constexpr double MaximumTexels = 0.1;

/// Triangles are divided where light or colours vary until there are so many, or not at all if
/// there are more already.
constexpr std::size_t MaximumLitTriangles = 200000;

/// The share of the surface that may be lost where it moves so little: bodies can be thinner than
/// that. If more is lost, the surface may move a fraction of it, and then of that, and so on.
constexpr double MaximumLoss = 0.002;
constexpr float TolerancePart = 0.25f;
constexpr int PartLimit = 3;

/// Spheres, tubes and instances may become as coarse as this.
constexpr int Coarsest = 3;

/// Still coarser ones are only tried if these differ less from the scene, by this factor.
constexpr double MinimumGain = 0.9;

/// The most triangles before hidden ones are removed.
constexpr std::size_t MaximumTessellated = 16u << 20;

/// The edge of the cells in which something is seen, in texels at the cube's centre. Viewpoints of
/// all sides see a texel's surface by many rays.
constexpr double CellTexels = 1.0;

/// Unless there are too many triangles, those within this number of cells are kept too: other views
/// may see them.
constexpr int WideCells = 4;

/// The viewpoints along a side of a face, and the most texels along a side of their pictures, that
/// decide what is seen. The field's own may be fewer, but its colours show what they miss.
constexpr int LookingViewpoints = 9;
constexpr int ResolutionLimit = 128;

/// The longest edge of a triangle, in texels at the cube's centre, unless there are too many
/// triangles: so colours that are not fitted are near each other, and those that are have enough
/// samples.
constexpr double LongestTexels = 32.0;

///@{
/// The progress of the geometry when its surface is found, in order, and lit.
constexpr double SurfaceShare = 0.5;
constexpr double SortedShare = 0.55;
constexpr double LitShare = 0.9;
///@}

///@{
/// The progress when the viewpoints have looked, and that of each round of the surface.
constexpr double LookShare = 0.1;
constexpr double TessellatedShare = 0.1;
constexpr double SeenShare = 0.3;
constexpr double SimplifiedShare = 0.6;
///@}

/// How many times more triangles bodies of groups may have than other surfaces: their file has
/// those of one.
constexpr std::size_t GroupFactor = 5;
constexpr std::size_t MaximumBodyTriangles = std::size_t(1) << 20;

/// How far bodies stay within the cube, as a share of its edges.
constexpr double CubeMargin = 1e-5;

/// The number of points at which the error is measured.
constexpr std::size_t MeasuredPoints = 20000;

/// The progress of one of several parts that take about as long.
Progress InPart(const Progress& progress, int part, int parts)
{
  return Within(progress, double(part) / parts, double(part + 1) / parts);
}

std::vector<const Mesh*> ListMeshes(const Scene& scene)
{
  std::vector<const Mesh*> meshes;
  for (const Mesh& mesh : scene.GetMeshes())
  {
    meshes.push_back(&mesh);
  }
  return meshes;
}

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

/// Knows what the viewpoints see of a scene.
SeenPlaces LookAround(
  const Scene& scene, const GeometrySettings& settings, double texel, const Progress& progress)
{
  const Layout pictures(
    LookingViewpoints, std::min(settings.Grid.GetResolution(), ResolutionLimit));
  const double cell = CellTexels * texel * settings.Grid.GetResolution() / pictures.GetResolution();
  SeenPlaces seen(scene, static_cast<float>(cell));
  const auto makeRays = [&](int tile)
  {
    return MakeFieldRays(
      pictures, settings.Box, settings.Frame, tile / TileCount, tile % TileCount);
  };
  seen.Look(TileCount * pictures.GetSlices(), pictures.GetResolution(), makeRays, progress);
  return seen;
}

void Stretch(const glm::vec3& factors, std::vector<glm::vec3>& points)
{
  for (glm::vec3& point : points)
  {
    point *= factors;
  }
}

/// Removes triangles where that moves the surface by much less than a texel. Points of the
/// scene's surface must then be at most `most` from it (root mean square), and nearly none lost;
/// otherwise fewer triangles are removed, or none. Distances are measured after stretching.
void SimplifyWell(SurfaceMesh& surface, glm::vec3 stretch, std::vector<glm::vec3> points,
  double texel, double most, const Progress& progress)
{
  Stretch(stretch, points);
  auto tolerance = static_cast<float>(MaximumTexels * texel);
  for (int part = 0; part <= PartLimit; ++part, tolerance *= TolerancePart)
  {
    const Progress step = InPart(progress, part, PartLimit + 1);
    SurfaceMesh simple = surface;
    Stretch(stretch, simple.Points);
    ChangeApart(simple, Within(step, 0.0, 0.5),
      [tolerance](SurfaceMesh& changed) { Simplify(changed, tolerance); });
    const SurfaceError error = MeasureError(points, simple, texel, Within(step, 0.5, 1.0));
    if (error.Loss <= MaximumLoss && error.RootMeanSquare <= most)
    {
      Stretch(1.0f / stretch, simple.Points);
      surface = std::move(simple);
      return;
    }
  }
}

/// Whether coarser tessellations have fewer triangles.
bool CanBeCoarser(const std::vector<const Mesh*>& meshes)
{
  return std::any_of(meshes.begin(), meshes.end(),
    [](const Mesh* mesh)
    { return mesh->Shape != Mesh::Shapes::Triangles || !mesh->Instances.empty(); });
}

/// The size of texels at the cube's centre, and how far surfaces may lie from it, in scene space.
/// Distances are measured after stretching: along axes on which the cube is shorter, texels are
/// smaller.
struct Scale
{
  explicit Scale(const GeometrySettings& settings)
  {
    const glm::dvec3& edges = settings.Box.Edges;
    const double longest = std::max({ edges.x, edges.y, edges.z });
    this->Texel = 0.5 * longest / (settings.Frame.Radius * settings.Grid.GetResolution());
    this->Stretch = glm::vec3(longest / edges);
    this->Tolerance = static_cast<float>(MaximumTexels * this->Texel) /
      std::max({ this->Stretch.x, this->Stretch.y, this->Stretch.z });
  }

  double Texel;
  glm::vec3 Stretch;
  float Tolerance;
};

/// The surface of meshes that the viewpoints see, with few enough triangles. Coarser shapes may
/// lose less than a further reduction of fine ones.
Geometry FindSurface(const std::vector<const Mesh*>& meshes, const SurfaceRegions& regions,
  const SeenPlaces& seen, const SeenPlaces& nearlySeen, std::size_t most, const Scale& scale,
  const Progress& progress)
{
  const double texel = scale.Texel;
  int coarseness = 0;
  while (coarseness < Coarsest && CountTriangles(meshes, coarseness) > MaximumTessellated)
  {
    ++coarseness;
  }
  std::vector<glm::vec3> points;
  Geometry best;
  best.Error.Loss = 2.0;
  std::size_t previous = std::numeric_limits<std::size_t>::max();
  const bool hasCoarser = CanBeCoarser(meshes);
  const int rounds = hasCoarser ? Coarsest + 1 - coarseness : 1;
  bool isBetter = true;
  for (int round = 0; isBetter && round < rounds; ++round, ++coarseness)
  {
    const Progress step = InPart(progress, round, rounds);
    SurfaceMesh surface =
      Tessellate(meshes, { scale.Tolerance, coarseness, MaximumTessellated, &regions },
        Within(step, 0.0, TessellatedShare));
    const std::size_t count = surface.Triangles.size();
    if (count >= std::exchange(previous, count))
    {
      break;
    }
    nearlySeen.KeepSeen(surface, Within(step, TessellatedShare, SeenShare));
    ChangeApart(surface, Within(step, SeenShare, SeenShare), Weld);
    if (points.empty())
    {
      points = SpreadPoints(surface, MeasuredPoints);
      seen.KeepSeen(points);
    }
    SimplifyWell(surface, scale.Stretch, points, texel,
      MaximumTexels * texel * (1 << 2 * coarseness), Within(step, SeenShare, SimplifiedShare));
    const bool isEnough = surface.Triangles.size() <= most;
    if (!isEnough)
    {
      // With borders that stay, too little could be removed.
      surface.Regions.clear();
      seen.KeepSeen(surface, Within(step, SimplifiedShare, SimplifiedShare));
      ChangeApart(surface, Within(step, SimplifiedShare, SimplifiedShare), Weld);
    }
    const SurfaceError error =
      ReduceWell(surface, most, points, texel, Within(step, SimplifiedShare, 1.0));
    const double least = best.Error.GetMeanSquare(texel);
    isBetter = !isEnough && error.GetMeanSquare(texel) < MinimumGain * least;
    if (error.GetMeanSquare(texel) < least)
    {
      best.Surface = std::move(surface);
      best.Error = error;
      best.IsReduced = !isEnough || round > 0;
    }
  }
  return best;
}

/// Appends the values of other points, of which there may be none. Both have the arrays of the
/// scene.
void JoinArrays(const std::vector<SurfaceArray>& others, std::size_t first, std::size_t all,
  std::vector<SurfaceArray>& arrays)
{
  const bool areNew = arrays.empty();
  if (areNew)
  {
    arrays = others;
  }
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    for (std::size_t c = 0; c < arrays[i].Components.size(); ++c)
    {
      std::vector<double>& values = arrays[i].Components[c].Values;
      values.resize(areNew ? 0 : first);
      values.resize(first, vtkMath::Nan());
      if (!others.empty())
      {
        const std::vector<double>& more = others[i].Components[c].Values;
        values.insert(values.end(), more.begin(), more.end());
      }
      values.resize(all, vtkMath::Nan());
    }
  }
}

/// The bodies of groups, within bounds, with the colours of their points.
void AddGroups(const Scene& scene, const std::vector<InstanceGroup>& groups, const glm::vec3& low,
  const glm::vec3& high, SurfaceLightSettings settings, const StoredLight* light,
  const Progress& progress, Geometry& geometry)
{
  SurfaceMesh bodies;
  for (const InstanceGroup& group : groups)
  {
    Append(group, bodies);
    for (const InstanceGroup::Placement& placement : group.Placements)
    {
      settings.Sources.insert(
        settings.Sources.end(), group.Prototype.Triangles.size(), placement.Source);
    }
  }
  for (glm::vec3& point : bodies.Points)
  {
    point = glm::clamp(point, low, high);
  }
  SideColors colors = FitLight(scene, light, settings, progress, bodies);
  const std::size_t first = geometry.Surface.Points.size();
  const std::size_t all = first + bodies.Points.size();
  const auto join = [=](auto& values, const auto& more)
  {
    values.resize(first);
    values.insert(values.end(), more.begin(), more.end());
    values.resize(all);
  };
  MappedPoints& mapped = geometry.Colors.Mapped;
  if (!mapped.IsEmpty() || !colors.Mapped.IsEmpty())
  {
    // Both have the maps of the scene.
    mapped.Maps = mapped.IsEmpty() ? colors.Mapped.Maps : mapped.Maps;
    join(mapped.Numbers, colors.Mapped.Numbers);
    join(mapped.Scalars, colors.Mapped.Scalars);
    JoinArrays(colors.Mapped.Arrays, first, all, mapped.Arrays);
  }
  for (const int side : { 0, 1 })
  {
    join(geometry.Colors.Sides[side], colors.Sides[side]);
    join(geometry.Colors.Exact[side], colors.Exact[side]);
  }
  for (const glm::uvec3& corners : bodies.Triangles)
  {
    geometry.Surface.Triangles.push_back(static_cast<std::uint32_t>(first) + corners);
  }
  geometry.Surface.Points.insert(
    geometry.Surface.Points.end(), bodies.Points.begin(), bodies.Points.end());
}

/// Lets the backs of closed bodies be like their fronts: nobody sees them.
void DropBacks(Geometry& geometry)
{
  std::vector<char> areClosed;
  for (const InstanceGroup& group : geometry.Groups)
  {
    const std::size_t count = group.Prototype.Points.size() * group.Placements.size();
    areClosed.insert(areClosed.end(), count, group.IsClosed ? 1 : 0);
  }
  const std::size_t first = geometry.Surface.Points.size() - areClosed.size();
  areClosed.insert(areClosed.begin(), first, 0);
  std::vector<glm::vec4>& backs = geometry.Colors.Sides[1];
  for (std::size_t point = first; point < areClosed.size(); ++point)
  {
    if (areClosed[point] != 0 && !backs.empty())
    {
      backs[point] = glm::vec4(0.0f);
      geometry.Colors.Exact[1][point] = geometry.Colors.Exact[0][point];
    }
  }
  SurfaceSide kept;
  for (std::size_t i = 0; i < geometry.Sides[1].Points.size(); ++i)
  {
    if (areClosed[geometry.Sides[1].Points[i]] == 0)
    {
      kept.Points.push_back(geometry.Sides[1].Points[i]);
      kept.Rays.push_back(geometry.Sides[1].Rays[i]);
    }
  }
  geometry.Sides[1] = std::move(kept);
}

/// How far what is seen of the scene lies from the geometry.
SurfaceError MeasureAll(const Scene& scene, const SeenPlaces& seen, const Scale& scale,
  const SurfaceMesh& surface, const Progress& progress)
{
  const SurfaceMesh whole = Tessellate(
    ListMeshes(scene), { scale.Tolerance, 0, MaximumTessellated }, Within(progress, 0.0, 0.5));
  std::vector<glm::vec3> points = SpreadPoints(whole, MeasuredPoints);
  seen.KeepSeen(points);
  return MeasureError(points, surface, scale.Texel, Within(progress, 0.5, 1.0));
}
}

std::string FindGeometryError(const Scene& scene)
{
  const ShapeCounts shapes = CountShapes(scene);
  if (scene.GetVolumes())
  {
    return "it contains volumes";
  }
  if (scene.GetMeshes().empty())
  {
    return "it has no surfaces";
  }
  if (shapes.Opaque == 0 && shapes.Omitted > 0)
  {
    return "all surfaces are translucent, or visible from one side only";
  }
  return CountTriangles(ListMeshes(scene), Coarsest) > MaximumTessellated
    ? "there are too many shapes"
    : "";
}

ShapeCounts CountShapes(const Scene& scene)
{
  ShapeCounts counts;
  for (const Mesh& mesh : scene.GetMeshes())
  {
    const std::size_t shapes = mesh.GetNumberOfShapes();
    const auto opaqueInstances = static_cast<std::size_t>(std::count_if(mesh.Instances.begin(),
      mesh.Instances.end(), [](const MeshInstance& instance) { return IsOpaque(instance); }));
    std::size_t opaque = 0;
    for (std::uint32_t shape = 0; shape < shapes; ++shape)
    {
      opaque += IsOpaque(mesh, shape) ? 1 : 0;
    }
    opaque *= mesh.Instances.empty() ? 1 : opaqueInstances;
    counts.Opaque += opaque;
    counts.Omitted += shapes * std::max<std::size_t>(1, mesh.Instances.size()) - opaque;
  }
  return counts;
}

std::optional<Geometry> MakeGeometry(
  const Scene& scene, const GeometrySettings& settings, const Progress& progress)
try
{
  const Scale scale(settings);
  const double texel = scale.Texel;
  const SeenPlaces seen = LookAround(scene, settings, texel, Within(progress, 0.0, LookShare));
  const SeenPlaces nearlySeen = seen.Widen(WideCells);
  const Progress none = Within(progress, LookShare, LookShare);
  // Colours of floats have no compact form for bodies.
  const std::size_t most = settings.ClampsColors
    ? std::min(GroupFactor * settings.MaximumTriangles, MaximumBodyTriangles)
    : 0;
  ShapeGroups groups =
    FindShapeGroups(scene, nearlySeen, { static_cast<float>(texel), scale.Tolerance, most }, none);
  Geometry geometry;
  const SurfaceRegions regions(scene.GetMeshes(), static_cast<float>(texel), none);
  if (!groups.Others.empty())
  {
    geometry = FindSurface(groups.Others, regions, seen, nearlySeen, settings.MaximumTriangles,
      scale, Within(progress, LookShare, SurfaceShare));
  }
  // Coarse spheres and tubes reach a little beyond the scene's bounds.
  const Box bounds = scene.GetBounds();
  for (glm::vec3& point : geometry.Surface.Points)
  {
    point = glm::clamp(point, glm::vec3(bounds.Low), glm::vec3(bounds.High));
  }
  ChangeApart(geometry.Surface, Within(progress, SurfaceShare, SortedShare),
    [longest = LongestTexels * texel, most = settings.MaximumTriangles](SurfaceMesh& changed)
    {
      changed.Regions.clear();
      Weld(changed);
      Subdivide(changed, longest, most);
      Weld(changed);
      SortForDrawing(changed);
    });
  SurfaceLightSettings lighting;
  lighting.Regions = &regions;
  lighting.Texel = static_cast<float>(texel);
  lighting.Exposure = settings.Exposure;
  lighting.ClampsColors = settings.ClampsColors;
  lighting.HasCreases = !geometry.IsReduced;
  lighting.Tolerance = settings.Tolerance;
  lighting.MaximumTriangles = std::min(
    settings.MaximumTriangles, std::max(MaximumLitTriangles, geometry.Surface.Triangles.size()));
  geometry.Colors = FitLight(
    scene, settings.Light, lighting, Within(progress, SortedShare, LitShare), geometry.Surface);
  if (!groups.Groups.empty())
  {
    lighting.KeepsMesh = true;
    const glm::dvec3 half = (0.5 - CubeMargin) * settings.Box.Edges;
    const auto toScene = [&](const glm::dvec3& point)
    { return glm::vec3((point - settings.Frame.Center) / settings.Frame.Radius); };
    AddGroups(scene, groups.Groups, toScene(settings.Box.Center - half),
      toScene(settings.Box.Center + half), lighting, settings.Light,
      Within(progress, LitShare, LitShare), geometry);
    geometry.Groups = std::move(groups.Groups);
    geometry.Error =
      MeasureAll(scene, seen, scale, geometry.Surface, Within(progress, LitShare, LitShare));
  }
  FindSides(scene, static_cast<float>(texel), geometry.Surface, Within(progress, LitShare, 1.0),
    geometry.Colors, geometry.Sides);
  DropBacks(geometry);
  return geometry;
}
catch (const Aborted&)
{
  return std::nullopt;
}
}
