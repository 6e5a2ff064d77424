// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfChartMaker.h"

#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "cslfMeshEdges.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace cslf
{
namespace
{
// Triangles with a height below this many spacings are too small for their own lattice: the light
// within them is not resolved.
constexpr float SmallHeight = 0.5f;

// Triangles that are this many times longer than high, and this many spacings long, are too thin,
// because the lattice of a triangle is finest across it.
constexpr float ThinAspect = 4.0f;
constexpr float ThinLength = 4.0f;

// The light of a chart may need this many times more points than its cells have corners.
constexpr std::size_t PointsOfChart = 4;

// The least cosine between the normal of a chart and those of its triangles.
constexpr float MinimumCosine = 0.8f;

// The most triangles at an edge among which neighbours are looked for: where thousands meet, each
// would otherwise look at all others.
constexpr std::ptrdiff_t MaximumAtEdge = 16;

// The smallest cosine between shading normals of adjacent triangles. Those of small triangles are
// not resolved.
constexpr float SmoothCosine = 0.9998f; // 1 degree
constexpr float SmallCosine = 0.97f;    // 14 degrees

// A chart folds over itself if two of its triangles differ in height by this many spacings.
constexpr float FoldHeight = 1.5f;

// The most cells of a chart, and the most relative to those that its area would fill.
constexpr float CellsOfChart = 64.0f;
constexpr float CellsOfArea = 8.0f;

// The work on a member of a chart, compared with steps of simple loops.
constexpr std::size_t StepsOfMember = 8;

struct Facet
{
  std::uint32_t Triangle;
  std::uint8_t Sides;
  bool IsSmall;
  bool IsLarge; // longer than a brick
  glm::vec3 Normal;
  float Area;
  std::uint32_t Corners[3]; // vertices at the same position have the same number
};

float Largest(float a, float b, float c)
{
  return std::max({ a, b, c });
}

/// Heights of a surface over a plane, in squares one spacing wide. Detects folds.
class HeightMap
{
public:
  explicit HeightMap(float side)
    : Side(side)
  {
  }

  void Clear() { this->Heights.clear(); }

  /// Adds a triangle, unless it lies over or under existing ones.
  bool Add(const glm::vec3 corners[3])
  {
    this->Found.clear();
    if (!this->Rasterize(corners))
    {
      return false;
    }
    for (const auto& [square, height] : this->Found)
    {
      this->Heights.emplace(square, height);
    }
    return true;
  }

private:
  /// Collects the squares of a triangle. False if its height differs from existing heights.
  bool Rasterize(const glm::vec3 corners[3])
  {
    const float low = std::min({ corners[0].y, corners[1].y, corners[2].y });
    const float high = Largest(corners[0].y, corners[1].y, corners[2].y);
    const int last = static_cast<int>(std::floor(high / this->Side));
    for (int row = static_cast<int>(std::floor(low / this->Side)); row <= last; ++row)
    {
      float left = 0.0f;
      float right = 0.0f;
      this->FindSpan(corners, row, left, right);
      const int end = static_cast<int>(std::floor(right / this->Side));
      for (int column = static_cast<int>(std::floor(left / this->Side)); column <= end; ++column)
      {
        const float height = this->GetHeight(corners, column, row);
        const std::uint64_t square = (std::uint64_t(static_cast<std::uint32_t>(row)) << 32) |
          static_cast<std::uint32_t>(column);
        const auto there = this->Heights.find(square);
        if (there != this->Heights.end() &&
          std::abs(there->second - height) > FoldHeight * this->Side)
        {
          return false;
        }
        this->Found.emplace_back(square, height);
      }
    }
    return true;
  }

  /// The extent of a triangle within a row of squares.
  void FindSpan(const glm::vec3 corners[3], int row, float& left, float& right) const
  {
    const float bottom = static_cast<float>(row) * this->Side;
    const float top = bottom + this->Side;
    left = Largest(corners[0].x, corners[1].x, corners[2].x);
    right = std::min({ corners[0].x, corners[1].x, corners[2].x });
    for (int i = 0; i < 3; ++i)
    {
      const glm::vec3& a = corners[i];
      const glm::vec3& b = corners[(i + 1) % 3];
      const float begin = std::clamp(bottom, std::min(a.y, b.y), std::max(a.y, b.y));
      const float end = std::clamp(top, std::min(a.y, b.y), std::max(a.y, b.y));
      if (begin > top || end < bottom)
      {
        continue;
      }
      const float slope = a.y == b.y ? 0.0f : (b.x - a.x) / (b.y - a.y);
      const float first = a.y == b.y ? a.x : a.x + slope * (begin - a.y);
      const float second = a.y == b.y ? b.x : a.x + slope * (end - a.y);
      left = std::min({ left, first, second });
      right = Largest(right, first, second);
    }
  }

  /// The height of the triangle nearest to a square's centre.
  float GetHeight(const glm::vec3 corners[3], int column, int row) const
  {
    const float low = std::min({ corners[0].z, corners[1].z, corners[2].z });
    const float high = Largest(corners[0].z, corners[1].z, corners[2].z);
    const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float x = (static_cast<float>(column) + 0.5f) * this->Side - corners[0].x;
    const float y = (static_cast<float>(row) + 0.5f) * this->Side - corners[0].y;
    const float height = corners[0].z - (normal.x * x + normal.y * y) / normal.z;
    return std::isfinite(height) ? std::clamp(height, low, high) : low;
  }

  float Side;
  std::unordered_map<std::uint64_t, float> Heights; // by square
  std::vector<std::pair<std::uint64_t, float>> Found;
};

/// Makes the charts of one mesh.
class MeshCharter
{
public:
  MeshCharter(const Scene& scene, std::uint32_t mesh, const OpenSides& sides,
    const std::vector<std::uint32_t>& clusters, const ChartSettings& settings,
    const LayoutProgress& progress)
    : Surface(scene.GetMeshes()[mesh])
    , Clusters(clusters)
    , Index(mesh)
    , Settings(settings)
    , Progress(progress)
    , Heights(settings.Spacing)
  {
    this->FindFacets(sides.GetData() + scene.GetTriangleIndex(mesh, 0));
    this->JoinFacets();
  }

  void AddTo(std::vector<SurfaceChart>& charts)
  {
    for (std::uint32_t seed = 0; seed < this->Facets.size(); ++seed)
    {
      if (!this->IsTaken[seed])
      {
        this->Grow(seed);
        std::vector<SurfaceChart::Member> members = this->MakeMembers();
        if (this->IsUseful(members))
        {
          charts.emplace_back(this->Index, std::move(members), this->Settings.BrickSize);
        }
      }
    }
  }

private:
  const glm::vec3& GetPosition(const Facet& facet, int corner) const
  {
    return this->Surface.Vertices[this->Surface.Triangles[facet.Triangle][corner]];
  }

  /// Whether a chart has fewer points than its triangles, if these can share points at vertices.
  bool IsUseful(const std::vector<SurfaceChart::Member>& members) const
  {
    std::unordered_set<std::uint32_t> shared;
    for (const std::uint32_t member : this->Frontier)
    {
      const Facet& facet = this->Facets[member];
      if (this->Clusters.empty() || facet.IsLarge)
      {
        return true;
      }
      const glm::uvec3& corners = this->Surface.Triangles[facet.Triangle];
      for (int corner = 0; corner < 3; ++corner)
      {
        shared.insert(this->Clusters[corners[corner]]);
      }
    }
    const glm::ivec2 cells = SurfaceChart::FindRectangle(members, this->Settings.BrickSize).Cells;
    return PointsOfChart * std::size_t(cells.x + 1) * static_cast<std::size_t>(cells.y + 1) <
      shared.size();
  }

  void FindFacets(const std::uint8_t* sides)
  {
    for (std::uint32_t triangle = 0; triangle < this->Surface.Triangles.size(); ++triangle)
    {
      this->Progress.Step();
      Facet facet{};
      facet.Triangle = triangle;
      facet.Sides = sides[triangle];
      facet.Area = this->Surface.GetArea(triangle);
      const float length = this->Surface.GetLongestEdge(triangle);
      const float height = 2.0f * facet.Area / length;
      facet.IsSmall = height < SmallHeight * this->Settings.Spacing;
      const bool isThin =
        length > ThinAspect * height && length > ThinLength * this->Settings.Spacing;
      facet.IsLarge = length >= this->Settings.BrickSize;
      if (facet.Sides == 0 || !(facet.IsSmall || isThin) || !(facet.Area > 0.0f))
      {
        continue;
      }
      const glm::vec3 corners[3] = { this->GetPosition(facet, 0), this->GetPosition(facet, 1),
        this->GetPosition(facet, 2) };
      facet.Normal = FindFront(corners);
      this->Facets.push_back(facet);
    }
    this->IsTaken.resize(this->Facets.size(), 0);
  }

  /// Finds neighbours. Vertices may differ in everything but their position.
  void JoinFacets()
  {
    const VertexPlaces places = NumberPlaces(this->Surface, this->Progress);
    this->Edges.reserve(3 * this->Facets.size());
    for (std::uint32_t index = 0; index < this->Facets.size(); ++index)
    {
      this->Progress.Step();
      Facet& facet = this->Facets[index];
      const glm::uvec3& corners = this->Surface.Triangles[facet.Triangle];
      for (int corner = 0; corner < 3; ++corner)
      {
        facet.Corners[corner] = places.Numbers[corners[corner]];
      }
      for (int edge = 0; edge < 3; ++edge)
      {
        this->Edges.push_back(this->MakeEdge(index, edge));
      }
    }
    SortEdges(this->Edges, places.Count, this->Progress);
  }

  MeshEdge MakeEdge(std::uint32_t index, int edge) const
  {
    const Facet& facet = this->Facets[index];
    return { facet.Corners[edge], facet.Corners[(edge + 1) % 3], index };
  }

  /// Collects the members of a chart around a facet.
  void Grow(std::uint32_t seed)
  {
    this->Frontier.clear();
    this->Axes = Frame(this->Facets[seed].Normal);
    this->Origin = this->GetPosition(this->Facets[seed], 0);
    this->Heights.Clear();
    this->IsPlane = true;
    this->Area = 0.0f;
    this->Low = glm::vec2(0.0f);
    this->High = glm::vec2(0.0f);
    this->Take(seed);
    for (std::size_t next = 0; next < this->Frontier.size(); ++next)
    {
      this->Progress.Step(StepsOfMember);
      const std::uint32_t facet = this->Frontier[next];
      for (int edge = 0; edge < 3; ++edge)
      {
        const MeshEdge key = this->MakeEdge(facet, edge);
        auto other = std::lower_bound(this->Edges.begin(), this->Edges.end(), key,
          [](const MeshEdge& candidate, const MeshEdge& value)
          { return candidate.IsBefore(value); });
        const auto end = other + std::min(MaximumAtEdge, this->Edges.end() - other);
        for (; other != end && other->IsAlong(key); ++other)
        {
          if (!this->IsTaken[other->Triangle] && this->IsSmooth(facet, edge, other->Triangle))
          {
            this->Take(other->Triangle);
          }
        }
      }
    }
  }

  /// A facet's shading normal at a corner.
  glm::vec3 GetNormal(const Facet& facet, int corner) const
  {
    if (this->Surface.Normals.empty())
    {
      return facet.Normal;
    }
    const glm::vec3 normal = this->Surface.Normals[this->Surface.Triangles[facet.Triangle][corner]];
    const float length = glm::length(normal);
    return length > 0.0f ? (glm::dot(normal, facet.Normal) < 0.0f ? -1.0f : 1.0f) / length * normal
                         : facet.Normal;
  }

  glm::vec3 GetNormalAt(const Facet& facet, std::uint32_t corner) const
  {
    const int index = facet.Corners[0] == corner ? 0 : facet.Corners[1] == corner ? 1 : 2;
    return this->GetNormal(facet, index);
  }

  /// Whether the light of two facets is equal, or nearly so, along their edge.
  bool IsSmooth(std::uint32_t first, int edge, std::uint32_t second) const
  {
    const Facet& a = this->Facets[first];
    const Facet& b = this->Facets[second];
    const float least = a.IsSmall && b.IsSmall ? SmallCosine : SmoothCosine;
    for (const int corner : { edge, (edge + 1) % 3 })
    {
      if (glm::dot(this->GetNormal(a, corner), this->GetNormalAt(b, a.Corners[corner])) < least)
      {
        return false;
      }
    }
    return true;
  }

  /// Makes a facet a member, if it fits.
  void Take(std::uint32_t index)
  {
    const Facet& facet = this->Facets[index];
    if (glm::dot(facet.Normal, this->Axes.Z) < MinimumCosine)
    {
      return;
    }
    glm::vec3 corners[3];
    this->GetLocal(facet, corners);
    glm::vec2 low = this->Low;
    glm::vec2 high = this->High;
    for (const glm::vec3& corner : corners)
    {
      low = glm::min(low, glm::vec2(corner));
      high = glm::max(high, glm::vec2(corner));
    }
    const glm::vec2 cells = glm::ceil((high - low) / this->Settings.BrickSize);
    const float filled =
      (this->Area + facet.Area) / (this->Settings.BrickSize * this->Settings.BrickSize);
    const bool isFirst = this->Frontier.empty();
    if ((!isFirst && cells.x * cells.y > CellsOfChart + CellsOfArea * filled) ||
      !this->AddHeight(corners, isFirst))
    {
      return;
    }
    this->IsTaken[index] = 1;
    this->Frontier.push_back(index);
    this->Area += facet.Area;
    this->Low = low;
    this->High = high;
  }

  void GetLocal(const Facet& facet, glm::vec3 corners[3]) const
  {
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = this->Axes.ToLocal(this->GetPosition(facet, i) - this->Origin);
    }
  }

  /// Whether a facet does not fold the chart over itself. As long as all facets lie in a plane,
  /// none can do so noticeably.
  bool AddHeight(const glm::vec3 corners[3], bool isFirst)
  {
    const float flat = 0.25f * this->Settings.Spacing;
    const bool isFlat =
      Largest(std::abs(corners[0].z), std::abs(corners[1].z), std::abs(corners[2].z)) < flat;
    if (this->IsPlane && (isFlat || isFirst))
    {
      return true;
    }
    if (this->IsPlane)
    {
      this->IsPlane = false;
      for (const std::uint32_t member : this->Frontier)
      {
        glm::vec3 others[3];
        this->GetLocal(this->Facets[member], others);
        this->Heights.Add(others);
      }
    }
    return this->Heights.Add(corners);
  }

  /// The members of a chart, turned so that its longest edge runs along a side.
  std::vector<SurfaceChart::Member> MakeMembers() const
  {
    glm::vec2 axis(1.0f, 0.0f);
    float longest = 0.0f;
    std::vector<SurfaceChart::Member> members;
    for (const std::uint32_t index : this->Frontier)
    {
      const Facet& facet = this->Facets[index];
      SurfaceChart::Member member{ facet.Triangle, facet.Sides, {} };
      glm::vec3 corners[3];
      this->GetLocal(facet, corners);
      for (int i = 0; i < 3; ++i)
      {
        member.Corners[i] = glm::vec2(corners[i]);
        const glm::vec2 edge(corners[(i + 1) % 3] - corners[i]);
        const float length = glm::length(edge);
        if (length > longest)
        {
          longest = length;
          axis = edge / length;
        }
      }
      members.push_back(member);
    }
    for (SurfaceChart::Member& member : members)
    {
      for (glm::vec2& corner : member.Corners)
      {
        corner = { corner.x * axis.x + corner.y * axis.y, corner.y * axis.x - corner.x * axis.y };
      }
    }
    return members;
  }

  const Mesh& Surface;
  const std::vector<std::uint32_t>& Clusters;
  std::uint32_t Index;
  ChartSettings Settings;
  std::vector<Facet> Facets;
  const LayoutProgress& Progress;
  std::vector<MeshEdge> Edges; // of the facets, sorted; their triangles are numbers of facets
  std::vector<std::uint8_t> IsTaken;

  // The current chart.
  std::vector<std::uint32_t> Frontier; // its members, in order
  Frame Axes{ glm::vec3(0.0f, 0.0f, 1.0f) };
  glm::vec3 Origin{ 0.0f };
  HeightMap Heights;
  bool IsPlane = true;
  float Area = 0.0f;
  glm::vec2 Low{ 0.0f };
  glm::vec2 High{ 0.0f };
};
}

std::vector<SurfaceChart> MakeCharts(const Scene& scene, const OpenSides& sides,
  const VertexClusters& clusters, const ChartSettings& settings, const LayoutProgress& progress)
{
  std::vector<SurfaceChart> charts;
  for (std::uint32_t mesh = 0; mesh < scene.GetMeshes().size(); ++mesh)
  {
    if (scene.GetMeshes()[mesh].CanHoldLattice())
    {
      MeshCharter(scene, mesh, sides, clusters[mesh], settings, progress).AddTo(charts);
    }
  }
  return charts;
}
}
