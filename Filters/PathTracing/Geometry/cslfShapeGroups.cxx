// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShapeGroups.h"

#include "Geometry/cslfGeometryData.h"
#include "PathTracing/Shapes/cslfTube.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "cslfTessellation.h"

#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkNew.h>
#include <vtkPlatonicSolidSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

namespace cslf
{
namespace
{
/// Fewer bodies are no group.
constexpr std::size_t MinimumBodies = 32;

/// The largest radius of a ball or stick, and of an instance, in texels: the light of larger ones
/// needs more points.
constexpr float MaximumRadiusTexels = 6.0f;
constexpr float MaximumInstanceTexels = 16.0f;

/// How far outlines of balls and sticks may be off, in texels.
constexpr float OutlineTexels = 0.1f;

/// Balls are a platonic solid, whose triangles may be divided into four, that often. The first
/// kinds are for more balls than others allow: their colours cannot follow the light around a ball.
struct BallKind
{
  int Solid;
  int Divisions;
};
constexpr std::array<BallKind, 5> BallKinds{ { { VTK_SOLID_TETRAHEDRON, 0 },
  { VTK_SOLID_OCTAHEDRON, 0 }, { VTK_SOLID_ICOSAHEDRON, 0 }, { VTK_SOLID_ICOSAHEDRON, 1 },
  { VTK_SOLID_ICOSAHEDRON, 2 } } };
constexpr int FewestColors = 2;

/// If there are too many balls even so, some of them stand for all, and are larger (Cook,
/// Halstead, Planck, Ryu, "Stochastic Simplification of Aggregate Detail", 2007): up to this
/// radius, in texels.
constexpr float MaximumThinnedTexels = 0.5f;

/// The sides of a stick.
constexpr int MinimumStickSides = 6;
constexpr int MaximumStickSides = 24;

/// How often outlines may be four times further off, and instances have half as many triangles, if
/// there are too many.
constexpr int CoarsestBodies = 3;

/// The most points of a prototype. Files have at most 1024 numbers for the colours of a body, which
/// suffice for both sides of these.
constexpr std::size_t MaximumPrototypePoints = 170;

/// The bodies between two looks whether to go on.
constexpr std::size_t BodiesOfLook = 4096;

/// The angle of a crease, in degrees: see ColorFit.
constexpr double CreaseAngle = 40.0;

/// How far points of one corner may be apart, as a share of the prototype's size.
constexpr double Rounding = 1e-5;

float GetArea(const SurfaceMesh& mesh)
{
  float sum = 0.0f;
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    const glm::vec3& first = mesh.Points[corners.x];
    sum += 0.5f *
      glm::length(glm::cross(mesh.Points[corners.y] - first, mesh.Points[corners.z] - first));
  }
  return sum;
}

/// One of BallKinds, around the unit sphere: a convex body has a mean outline of a quarter of
/// its area (Cauchy), so this one has the sphere's.
SurfaceMesh MakeBall(const BallKind& kind)
{
  vtkNew<vtkPlatonicSolidSource> solid;
  solid->SetSolidType(kind.Solid);
  vtkNew<vtkLinearSubdivisionFilter> divider;
  divider->SetInputConnection(solid->GetOutputPort());
  divider->SetNumberOfSubdivisions(kind.Divisions);
  solid->Update();
  divider->Update();
  SurfaceMesh ball = MakeMesh(kind.Divisions > 0 ? divider->GetOutput() : solid->GetOutput());
  for (glm::vec3& point : ball.Points)
  {
    point = glm::normalize(point);
  }
  const float growth = std::sqrt(4.0f * glm::pi<float>() / GetArea(ball));
  for (glm::vec3& point : ball.Points)
  {
    point *= growth;
  }
  const glm::uvec3& corners = ball.Triangles.front();
  const glm::vec3& first = ball.Points[corners.x];
  if (glm::dot(first, glm::cross(ball.Points[corners.y] - first, ball.Points[corners.z] - first)) <
    0.0f)
  {
    for (glm::uvec3& triangle : ball.Triangles)
    {
      std::swap(triangle.y, triangle.z);
    }
  }
  return ball;
}

/// How far a regular polygon with the area of the unit circle reaches beyond it.
float GetExcess(int sides)
{
  const float angle = glm::two_pi<float>() / static_cast<float>(sides);
  return std::sqrt(angle / std::sin(angle)) - 1.0f;
}

/// A cylinder without ends around Z, from 0 to 1, whose outline is that of the radius 1.
SurfaceMesh MakeStick(int sides)
{
  SurfaceMesh stick;
  const float radius = 1.0f + GetExcess(sides);
  for (int side = 0; side < sides; ++side)
  {
    const float angle = glm::two_pi<float>() * static_cast<float>(side) / static_cast<float>(sides);
    for (const float height : { 0.0f, 1.0f })
    {
      stick.Points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    const auto a = static_cast<std::uint32_t>(2 * side);
    const auto b = static_cast<std::uint32_t>(2 * ((side + 1) % sides));
    stick.Triangles.emplace_back(a, b, b + 1);
    stick.Triangles.emplace_back(a, b + 1, a + 1);
  }
  return stick;
}

/// A prototype of instances of triangles. Points at creases have one copy for each side of them, so
/// that each can have a colour. If it is closed, its front is outside.
InstanceGroup MakePrototype(const SurfaceMesh& mesh)
{
  // Points of a corner may differ by rounding.
  vtkNew<vtkCleanPolyData> joiner;
  joiner->SetInputData(MakePolyData(mesh, glm::dvec3(0.0), glm::dvec3(1.0)));
  joiner->SetTolerance(Rounding);
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(joiner->GetOutputPort());
  edges->FeatureEdgesOff();
  edges->Update();
  InstanceGroup group;
  group.IsClosed = edges->GetOutput()->GetNumberOfCells() == 0;
  vtkNew<vtkPolyDataNormals> splitter;
  splitter->SetInputConnection(joiner->GetOutputPort());
  splitter->SetConsistency(group.IsClosed);
  splitter->SetAutoOrientNormals(group.IsClosed);
  splitter->SetFeatureAngle(CreaseAngle);
  splitter->Update();
  group.Prototype = MakeMesh(splitter->GetOutput());
  return group;
}

struct Ball
{
  glm::vec3 Center;
  float Radius;
};

/// The balls and sticks of a scene, by how fine they are.
class ShapeSorter
{
public:
  /// Outlines may be off by that many texels. Balls smaller than these are of that kind or a later
  /// one.
  ShapeSorter(const Scene& scene, const SeenPlaces& seen, float texel, float excessTexels,
    int firstKind, const Progress& progress)
    : World(scene)
    , Seen(seen)
    , Texel(texel)
    , MaximumExcess(excessTexels * texel)
    , FirstKind(firstKind)
    , GoOn(progress)
  {
    for (std::size_t i = 0; i < BallKinds.size(); ++i)
    {
      this->Balls[i].Prototype = MakeBall(BallKinds[i]);
      this->Balls[i].IsClosed = true;
      this->Balls[i].IsBall = true;
      this->Excess[i] = glm::length(this->Balls[i].Prototype.Points.front()) - 1.0f;
    }
    for (int sides = MinimumStickSides; sides <= MaximumStickSides; sides += SideStep)
    {
      this->Sticks.emplace_back().Prototype = MakeStick(sides);
      this->Sticks.back().IsClosed = true;
    }
  }

  void AddSpheres(const Mesh& mesh)
  {
    this->Source = this->FindNumber(mesh);
    for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
    {
      this->AddBall({ mesh.Vertices[shape], mesh.Radii[shape] });
    }
  }

  void AddTubes(const Mesh& mesh)
  {
    this->Source = this->FindNumber(mesh);
    for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
    {
      const std::size_t first = 2 * std::size_t(shape);
      this->AddStick(Tube(
        mesh.Vertices[first], mesh.Vertices[first + 1], mesh.Radii[first], mesh.Radii[first + 1]));
    }
  }

  /// False if the prototype has too many points.
  bool AddInstances(const Mesh& mesh, const InstanceGroup& all)
  {
    if (all.Prototype.Triangles.empty())
    {
      return true;
    }
    InstanceGroup group;
    if (mesh.Shape == Mesh::Shapes::Triangles)
    {
      group = MakePrototype(all.Prototype);
    }
    else
    {
      group.Prototype = all.Prototype;
      group.IsClosed = true;
    }
    if (group.Prototype.Points.size() > MaximumPrototypePoints)
    {
      return false;
    }
    this->Source = this->FindNumber(mesh);
    for (const InstanceGroup::Placement& placement : all.Placements)
    {
      this->Add(placement, group);
    }
    this->Instances.push_back(std::move(group));
    return true;
  }

  /// The groups that have bodies.
  std::vector<InstanceGroup> Take()
  {
    std::vector<InstanceGroup> groups;
    const auto take = [&groups](InstanceGroup& group)
    {
      if (!group.Placements.empty())
      {
        groups.push_back(std::move(group));
      }
    };
    std::for_each(this->Balls.begin(), this->Balls.end(), take);
    std::for_each(this->Sticks.begin(), this->Sticks.end(), take);
    std::for_each(this->Instances.begin(), this->Instances.end(), take);
    return groups;
  }

private:
  static constexpr int SideStep = 2;

  /// How far rays start from surfaces, in radii, and the most surfaces that they pass.
  static constexpr float Gap = 1e-3f;
  static constexpr int MaximumSteps = 16;

  /// Adds a body if any of it is seen.
  void Add(const InstanceGroup::Placement& placement, InstanceGroup& group)
  {
    if (this->Bodies++ % BodiesOfLook == 0)
    {
      OrAbort(this->GoOn)(0.0);
    }
    std::vector<glm::vec3> points;
    for (const glm::vec3& point : group.Prototype.Points)
    {
      points.push_back(placement.Linear * point + placement.Offset);
    }
    this->Seen.KeepSeen(points);
    if (!points.empty())
    {
      group.Placements.push_back(placement);
      group.Placements.back().Source = this->Source;
    }
  }

  std::uint32_t FindNumber(const Mesh& mesh) const
  {
    return static_cast<std::uint32_t>(&mesh - this->World.GetMeshes().data());
  }

  void AddBall(const Ball& ball)
  {
    const int first = ball.Radius <= this->Texel ? this->FirstKind : FewestColors;
    const auto fine = std::find_if(this->Excess.begin() + first, this->Excess.end() - 1,
      [&](float excess) { return excess * ball.Radius <= this->MaximumExcess; });
    const auto found = fine - this->Excess.begin();
    this->Add({ glm::mat3(ball.Radius), ball.Center }, this->Balls[found]);
  }

  void AddStick(const Tube& tube)
  {
    if (tube.IsSphere())
    {
      this->AddBall({ tube.Start, tube.Radius });
      return;
    }
    int sides = MinimumStickSides;
    while (sides < MaximumStickSides && this->MaximumExcess < GetExcess(sides) * tube.Radius)
    {
      sides += SideStep;
    }
    const glm::vec3 other =
      std::abs(tube.Axis.x) < 0.5f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 across = glm::normalize(glm::cross(tube.Axis, other));
    const glm::vec3 up = glm::cross(tube.Axis, across);
    this->Add(
      { glm::mat3(tube.Radius * across, tube.Radius * up, tube.Length * tube.Axis), tube.Start },
      this->Sticks[(sides - MinimumStickSides) / SideStep]);
    for (const float end : { 0.0f, 1.0f })
    {
      const glm::vec3 out = (2.0f * end - 1.0f) * tube.Axis;
      if (!this->IsWithinOthers(tube.GetCenter(end), tube.Radius, out, across, up))
      {
        this->AddBall({ tube.GetCenter(end), tube.Radius });
      }
    }
  }

  /// Whether most of some points of a round end lie in other bodies.
  bool IsWithinOthers(const glm::vec3& center, float radius, const glm::vec3& out,
    const glm::vec3& across, const glm::vec3& up) const
  {
    const glm::vec3 directions[] = { out, out + across, out - across, out + up, out - up };
    const auto within = std::count_if(std::begin(directions), std::end(directions),
      [&](const glm::vec3& direction)
      {
        const glm::vec3 normal = glm::normalize(direction);
        return this->IsWithinShape(
          { center + (1.0f + Gap) * radius * normal, normal }, Gap * radius);
      });
    return 2 * static_cast<std::size_t>(within) > std::size(directions);
  }

  /// Whether a ray begins in a sphere or tube: it leaves one that it did not enter.
  bool IsWithinShape(Ray ray, float gap) const
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> entered;
    for (int step = 0; step < MaximumSteps; ++step)
    {
      const Hit hit = this->World.Intersect(ray);
      if (!hit.IsValid())
      {
        return false;
      }
      const std::pair<std::uint32_t, std::uint32_t> body(hit.Mesh, hit.GetPlace().Triangle);
      if (!this->World.GetSurface(ray, hit).Inside)
      {
        entered.push_back(body);
      }
      else if (this->World.GetMeshes()[hit.Mesh].Shape != Mesh::Shapes::Triangles &&
        std::find(entered.begin(), entered.end(), body) == entered.end())
      {
        return true;
      }
      ray.Origin += (hit.Distance + gap) * ray.Direction;
    }
    return false;
  }

  const Scene& World;
  const SeenPlaces& Seen;
  float Texel;
  float MaximumExcess;
  int FirstKind;
  const Progress& GoOn;
  std::size_t Bodies = 0;
  std::uint32_t Source = 0; // of the bodies that are added
  std::array<InstanceGroup, BallKinds.size()> Balls;
  std::array<float, BallKinds.size()> Excess{};
  std::vector<InstanceGroup> Sticks;
  std::vector<InstanceGroup> Instances;
};

float FindRadius(const std::vector<glm::vec3>& points)
{
  glm::vec3 low(points.front());
  glm::vec3 high(points.front());
  for (const glm::vec3& point : points)
  {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  return 0.5f * glm::distance(low, high);
}

/// Whether all shapes are small and opaque.
bool IsOfSmallShapes(const Mesh& mesh, float maximum)
{
  const bool areTubes = mesh.Shape == Mesh::Shapes::Tubes;
  if (mesh.GetNumberOfShapes() < MinimumBodies || mesh.Shape == Mesh::Shapes::Triangles ||
    (areTubes &&
      std::any_of(
        mesh.Joints.begin(), mesh.Joints.end(), [](std::uint32_t joint) { return joint != 0; })))
  {
    return false;
  }
  for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
  {
    const std::size_t first = (areTubes ? 2 : 1) * std::size_t(shape);
    if (!IsOpaque(mesh, shape) || !(mesh.Radii[first] <= maximum) ||
      (areTubes &&
        (mesh.Radii[first] != mesh.Radii[first + 1] ||
          glm::distance(mesh.Vertices[first], mesh.Vertices[first + 1]) > 2.0f * maximum)))
    {
      return false;
    }
  }
  return true;
}

/// Whether all instances are small and opaque.
bool IsOfSmallInstances(const Mesh& mesh, float maximum)
{
  if (mesh.Instances.size() < MinimumBodies || mesh.Vertices.empty())
  {
    return false;
  }
  float radius = FindRadius(mesh.Vertices);
  if (!mesh.Radii.empty())
  {
    radius += *std::max_element(mesh.Radii.begin(), mesh.Radii.end());
  }
  for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
  {
    if (!IsOpaque(mesh, shape))
    {
      return false;
    }
  }
  return FindLargestScale(mesh) * radius <= maximum &&
    std::all_of(mesh.Instances.begin(), mesh.Instances.end(),
      [](const MeshInstance& instance) { return IsOpaque(instance); });
}

std::size_t CountTriangles(const std::vector<InstanceGroup>& groups)
{
  std::size_t count = 0;
  for (const InstanceGroup& group : groups)
  {
    count += group.Prototype.Triangles.size() * group.Placements.size();
  }
  return count;
}

/// Keeps as many balls as the limit allows, with the area of all. False if they were too large.
bool ThinBalls(std::vector<InstanceGroup>& groups, std::size_t maximumTriangles, float texel)
{
  std::size_t balls = 0;
  float radius = 0.0f;
  for (const InstanceGroup& group : groups)
  {
    for (const InstanceGroup::Placement& placement : group.Placements)
    {
      radius = group.IsBall ? std::max(radius, placement.Linear[0][0]) : radius;
    }
    balls += group.IsBall ? group.Prototype.Triangles.size() * group.Placements.size() : 0;
  }
  const std::size_t others = CountTriangles(groups) - balls;
  if (others >= maximumTriangles)
  {
    return false;
  }
  const double share = static_cast<double>(maximumTriangles - others) /
    static_cast<double>(std::max<std::size_t>(balls, 1));
  const auto growth = static_cast<float>(1.0 / std::sqrt(share));
  if (growth * radius > MaximumThinnedTexels * texel)
  {
    return false;
  }
  for (InstanceGroup& group : groups)
  {
    if (group.IsBall)
    {
      // Any of them, not in step with the order of the points of a scan.
      const auto rank = [&group](std::size_t i) { return MixBits(i, group.Placements.size()); };
      std::vector<std::size_t> order(group.Placements.size());
      std::iota(order.begin(), order.end(), std::size_t(0));
      const auto kept = static_cast<std::ptrdiff_t>(share * static_cast<double>(order.size()));
      std::nth_element(order.begin(), order.begin() + kept, order.end(),
        [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
      std::sort(order.begin(), order.begin() + kept);
      std::vector<InstanceGroup::Placement> placements;
      for (std::ptrdiff_t i = 0; i < kept; ++i)
      {
        placements.push_back(group.Placements[order[i]]);
        placements.back().Linear *= growth;
      }
      group.Placements = std::move(placements);
    }
  }
  groups.erase(std::remove_if(groups.begin(), groups.end(),
                 [](const InstanceGroup& group) { return group.Placements.empty(); }),
    groups.end());
  return CountTriangles(groups) <= maximumTriangles;
}
}

ShapeGroups FindShapeGroups(const Scene& scene, const SeenPlaces& seen,
  const ShapeGroupSettings& settings, const Progress& progress)
{
  ShapeGroups result;
  std::vector<const Mesh*> small;
  for (const Mesh& mesh : scene.GetMeshes())
  {
    const bool isSmall = mesh.Instances.empty()
      ? IsOfSmallShapes(mesh, MaximumRadiusTexels * settings.Texel)
      : IsOfSmallInstances(mesh, MaximumInstanceTexels * settings.Texel);
    (isSmall && settings.MaximumTriangles > 0 ? small : result.Others).push_back(&mesh);
  }
  for (int attempt = 0; attempt <= CoarsestBodies + FewestColors && !small.empty(); ++attempt)
  {
    const int coarseness = std::min(attempt, CoarsestBodies);
    const int firstKind = FewestColors - (attempt - coarseness);
    ShapeSorter sorter(scene, seen, settings.Texel,
      OutlineTexels * static_cast<float>(1 << 2 * coarseness), firstKind, progress);
    std::vector<const Mesh*> detailed;
    for (const Mesh* mesh : small)
    {
      if (!mesh->Instances.empty())
      {
        const InstanceGroup all = TessellateInstances(
          *mesh, { settings.Tolerance, coarseness, settings.MaximumTriangles }, progress);
        if (!sorter.AddInstances(*mesh, all))
        {
          detailed.push_back(mesh);
        }
      }
      else if (mesh->Shape == Mesh::Shapes::Spheres)
      {
        sorter.AddSpheres(*mesh);
      }
      else
      {
        sorter.AddTubes(*mesh);
      }
    }
    result.Groups = sorter.Take();
    if (CountTriangles(result.Groups) <= settings.MaximumTriangles ||
      (firstKind == 0 && ThinBalls(result.Groups, settings.MaximumTriangles, settings.Texel)))
    {
      result.Others.insert(result.Others.end(), detailed.begin(), detailed.end());
      return result;
    }
  }
  result.Groups.clear();
  result.Others.insert(result.Others.end(), small.begin(), small.end());
  return result;
}
}
