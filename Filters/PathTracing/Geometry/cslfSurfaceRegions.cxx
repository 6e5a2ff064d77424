// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceRegions.h"

#include "Geometry/cslfSurfaceMesh.h"
#include "Pipeline/cslfColorMap.h"
#include "cslfTessellation.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vtkSMPTools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace cslf
{
namespace
{
/// How much sRGB-encoded colours differ where they jump.
constexpr float ColorJump = 4.0f / 255.0f;

/// The same for places on a map and for arrays, as a share of the range.
constexpr double ValueJump = 0.005;

/// The smallest region, in square texels.
constexpr float MinimumArea = 1.0f;

/// The triangles between two reports of progress.
constexpr std::size_t TrianglesOfReport = 1 << 16;

bool Differ(const glm::vec3& one, const glm::vec3& other)
{
  const auto encode = [](float value)
  { return 1.055f * std::pow(std::max(value, 0.0f), 1.0f / 2.4f); };
  for (int i = 0; i < 3 && one != other; ++i)
  {
    if (std::abs(encode(one[i]) - encode(other[i])) > ColorJump)
    {
      return true;
    }
  }
  return false;
}

/// Finds the regions of one mesh of triangles.
class RegionFinder
{
public:
  RegionFinder(const Mesh& mesh, const Progress& progress)
    : Source(mesh)
    , GoOn(progress)
  {
    std::size_t count = 0;
    this->Places = NumberPlaces(mesh.Vertices, count);
    this->HasCopies = count < mesh.Vertices.size();
    this->VariesByShape = mesh.Coloring == Mesh::ColorsOf::Triangles ||
      mesh.EmissionsOf == Mesh::ColorsOf::Triangles || !mesh.ShapeArrays.empty();
    for (std::size_t i = 0; i < mesh.GetNumberOfArrays(); ++i)
    {
      this->AddSteps(mesh.GetArray(i));
    }
  }

  /// Whether values can jump at all.
  bool CanHaveSeveral() const { return this->HasCopies || this->VariesByShape; }

  /// Numbers from 0 of the triangles, where 0 is that of regions with less area. Nothing if there
  /// is but one.
  std::vector<std::uint32_t> Find(float minimumArea)
  {
    this->Join();
    const std::vector<glm::uvec3>& triangles = this->Source.Triangles;
    std::vector<float> areas(triangles.size(), 0.0f);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      areas[this->FindRoot(i)] += this->Source.GetArea(i);
    }
    std::vector<std::uint32_t> numbers(triangles.size(), 0);
    std::uint32_t count = 0;
    bool hasSmall = false;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      const std::uint32_t root = this->FindRoot(i);
      const bool isSmall = areas[root] < minimumArea;
      // Roots come first.
      numbers[i] = isSmall ? 0 : root == i ? ++count : numbers[root];
      hasSmall = hasSmall || isSmall;
    }
    return count + (hasSmall ? 1 : 0) > 1 ? numbers : std::vector<std::uint32_t>();
  }

private:
  struct Use
  {
    std::uint64_t Edge;
    std::uint32_t Triangle;
    std::uint32_t Corner;
  };

  void AddSteps(const SurfaceArray& array)
  {
    for (const SurfaceArray::Component& component : array.Components)
    {
      double low = HUGE_VAL;
      double high = -HUGE_VAL;
      for (const double value : component.Values)
      {
        low = value < low ? value : low;
        high = value > high ? value : high;
      }
      this->Steps.push_back(array.IsInteger ? 0.0 : std::max(ValueJump * (high - low), 0.0));
    }
  }

  std::uint32_t FindRoot(std::uint32_t triangle)
  {
    for (; this->Next[triangle] != triangle; triangle = this->Next[triangle])
    {
      this->Next[triangle] = this->Next[this->Next[triangle]];
    }
    return triangle;
  }

  void Join()
  {
    const std::vector<glm::uvec3>& triangles = this->Source.Triangles;
    std::vector<Use> uses;
    uses.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      for (std::uint32_t k = 0; k < 3; ++k)
      {
        const std::uint64_t a = this->Places[triangles[i][static_cast<int>(k)]];
        const std::uint64_t b = this->Places[triangles[i][static_cast<int>((k + 1) % 3)]];
        uses.push_back({ std::min(a, b) << 32 | std::max(a, b), i, k });
      }
    }
    vtkSMPTools::Sort(uses.begin(), uses.end(),
      [](const Use& a, const Use& b)
      { return a.Edge != b.Edge ? a.Edge < b.Edge : a.Triangle < b.Triangle; });
    this->Next.resize(triangles.size());
    std::iota(this->Next.begin(), this->Next.end(), 0U);
    for (std::size_t first = 0; first < uses.size(); ++first)
    {
      if (first % TrianglesOfReport == 0)
      {
        OrAbort(this->GoOn)(static_cast<double>(first) / static_cast<double>(uses.size()));
      }
      if (first + 1 < uses.size() && uses[first].Edge == uses[first + 1].Edge &&
        !this->Jumps(uses[first], uses[first + 1]))
      {
        const std::uint32_t one = this->FindRoot(uses[first].Triangle);
        const std::uint32_t other = this->FindRoot(uses[first + 1].Triangle);
        this->Next[std::max(one, other)] = std::min(one, other);
      }
    }
  }

  /// The place of a corner in a triangle.
  static TrianglePoint GetCorner(std::uint32_t triangle, std::uint32_t corner)
  {
    return { triangle, corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f };
  }

  /// Whether anything differs at either end of an edge of two triangles.
  bool Jumps(const Use& one, const Use& other) const
  {
    for (std::uint32_t end = 0; end < 2; ++end)
    {
      const std::uint32_t corner = (one.Corner + end) % 3;
      const std::uint32_t vertex = this->Source.Triangles[one.Triangle][static_cast<int>(corner)];
      const auto find = [&](std::uint32_t k)
      {
        return this->Places[this->Source.Triangles[other.Triangle][static_cast<int>(k)]] ==
          this->Places[vertex];
      };
      const std::uint32_t same = find(other.Corner) ? other.Corner : (other.Corner + 1) % 3;
      const std::uint32_t copy = this->Source.Triangles[other.Triangle][static_cast<int>(same)];
      if ((this->VariesByShape || vertex != copy) &&
        this->Differ(GetCorner(one.Triangle, corner), GetCorner(other.Triangle, same)))
      {
        return true;
      }
    }
    return false;
  }

  bool Differ(const TrianglePoint& one, const TrianglePoint& other) const
  {
    const Mesh& mesh = this->Source;
    // Colours of instances do not matter within one.
    return (!mesh.HasInstanceColors &&
             (cslf::Differ(mesh.GetBaseColor(one), mesh.GetBaseColor(other)) ||
               cslf::Differ(mesh.GetEmission(one), mesh.GetEmission(other)))) ||
      this->HasOtherPlace(one, other) || this->HasOtherValues(one, other);
  }

  bool HasOtherPlace(const TrianglePoint& one, const TrianglePoint& other) const
  {
    const ColorMap* map = this->Source.HasInstanceColors ? nullptr : this->Source.FindMap();
    if (!map || map->IsOneColor)
    {
      return false;
    }
    const glm::vec2 difference =
      glm::abs(this->Source.GetMapPlace(one) - this->Source.GetMapPlace(other));
    return difference.x > ValueJump * map->GetSteps() || difference.y > 0.5f;
  }

  bool HasOtherValues(const TrianglePoint& one, const TrianglePoint& other) const
  {
    std::size_t step = 0;
    for (std::size_t i = 0; i < this->Source.GetNumberOfArrays(); ++i)
    {
      for (std::size_t c = 0; c < this->Source.GetArray(i).Components.size(); ++c)
      {
        const double a = this->Source.GetArrayValue(i, c, one);
        const double b = this->Source.GetArrayValue(i, c, other);
        if (std::abs(a - b) > this->Steps[step++] || std::isnan(a) != std::isnan(b))
        {
          return true;
        }
      }
    }
    return false;
  }

  const Mesh& Source;
  const Progress& GoOn;
  std::vector<std::uint32_t> Places; // of the vertices: those at one place have one number
  std::vector<std::uint32_t> Next;   // of the triangles: another one of the region
  std::vector<double> Steps;         // of each component of arrays, what is no jump yet
  bool HasCopies = false;
  bool VariesByShape = false;
};
}

SurfaceRegions::SurfaceRegions(
  const std::vector<Mesh>& meshes, float texel, const Progress& progress)
  : First(meshes.data())
  , OfShapes(meshes.size())
{
  auto next = static_cast<std::uint32_t>(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const Mesh& mesh = meshes[i];
    OrAbort(progress)(static_cast<double>(i) / static_cast<double>(meshes.size()));
    if (mesh.Shape != Mesh::Shapes::Triangles || mesh.Triangles.empty())
    {
      continue;
    }
    RegionFinder finder(mesh, progress);
    if (!finder.CanHaveSeveral())
    {
      continue;
    }
    const float scale = mesh.Instances.empty() ? 1.0f : FindLargestScale(mesh);
    const float edge = scale > 0.0f ? texel / scale : 0.0f;
    std::vector<std::uint32_t>& numbers = this->OfShapes[i];
    numbers = finder.Find(MinimumArea * edge * edge);
    // The first of them is the mesh's own number.
    std::uint32_t most = 0;
    for (std::uint32_t& number : numbers)
    {
      most = std::max(most, number);
      number = number == 0 ? static_cast<std::uint32_t>(i) : next + number - 1;
    }
    next += most;
  }
}
}
