// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceRegions.h"

#include "Geometry/cslfSurfaceMesh.h"
#include "Pipeline/cslfColorMap.h"
#include "cslfTessellation.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
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
/// What is a jump: differences of sRGB-encoded colours that are larger, and of places on a map and
/// values of arrays, as shares of their range.
struct Jump
{
  float Color;
  double Value;
};

/// Between triangles that are alike, between wide parts, and between narrow ones, whose values may
/// vary smoothly.
constexpr Jump AnyJump{ 0.5f / 255.0f, 1e-5 };
constexpr Jump LargeJump{ 4.0f / 255.0f, 1e-3 };
constexpr Jump SmallJump{ 0.1f, 0.1 };

/// What is a seam of a texture, and how often regions are divided because of seams.
constexpr Jump SeamJump{ 2.0f, 1e-3 };
constexpr int MaximumSplits = 8;

/// Twice the area over the perimeter, in texels, which is the width of a strip and half that of a
/// square: of what is large, and of the smallest region.
constexpr float LargeWidth = 0.75f;
constexpr float MinimumWidth = 0.4f;

/// The triangles between two reports of progress.
constexpr std::size_t TrianglesOfReport = 1 << 16;

bool Differ(const glm::vec3& one, const glm::vec3& other, float jump)
{
  const auto encode = [](float value)
  { return 1.055f * std::pow(std::max(value, 0.0f), 1.0f / 2.4f); };
  for (int i = 0; i < 3 && one != other; ++i)
  {
    if (std::abs(encode(one[i]) - encode(other[i])) > jump)
    {
      return true;
    }
  }
  return false;
}

/// Finds the regions of one mesh.
class RegionFinder
{
public:
  RegionFinder(const Mesh& mesh, const Progress& progress)
    : Source(mesh)
    , GoOn(progress)
  {
    if (mesh.Shape == Mesh::Shapes::Triangles)
    {
      std::size_t count = 0;
      this->Places = NumberPlaces(mesh.Vertices, count);
      this->HasCopies = count < mesh.Vertices.size();
    }
    this->VariesByShape = mesh.Shape == Mesh::Shapes::Spheres ||
      mesh.Coloring == Mesh::ColorsOf::Triangles || mesh.EmissionsOf == Mesh::ColorsOf::Triangles ||
      !mesh.ShapeArrays.empty();
    for (std::size_t i = 0; i < mesh.GetNumberOfArrays(); ++i)
    {
      this->AddRanges(mesh.GetArray(i));
    }
  }

  /// Whether values can jump at all.
  bool CanHaveSeveral() const
  {
    const Mesh& mesh = this->Source;
    const bool varies = !mesh.HasOneColor() || mesh.EmissionsOf != Mesh::ColorsOf::None ||
      mesh.Textures.Emission || mesh.GetNumberOfArrays() > 0;
    return varies && (this->HasCopies || this->VariesByShape);
  }

  /// Numbers from 0 of the shapes, where 0 is that of regions that are too small. Nothing if there
  /// is but one. Given the edge of a texel.
  std::vector<std::uint32_t> Find(float texel)
  {
    const std::uint32_t count = this->Source.GetNumberOfShapes();
    this->Next.resize(count);
    std::iota(this->Next.begin(), this->Next.end(), 0U);
    if (this->Source.Shape != Mesh::Shapes::Triangles)
    {
      this->JoinShapes();
      return this->Number(std::vector<float>(count, HUGE_VALF), 0.0f);
    }
    this->ListUses();
    this->JoinTriangles([](const Use&, const Use&) { return AnyJump; });
    const std::vector<float> widths = this->MeasureWidths();
    const float large = LargeWidth * texel;
    this->JoinTriangles(
      [&](const Use& one, const Use& other)
      {
        return widths[one.Triangle] >= large && widths[other.Triangle] >= large ? LargeJump
                                                                                : SmallJump;
      });
    const bool hasCellColors = this->Source.Coloring == Mesh::ColorsOf::Triangles;
    for (std::uint32_t i = 0; i < count && hasCellColors; ++i)
    {
      if (widths[i] < large)
      {
        this->SmallOnes.push_back(i);
      }
    }
    std::vector<std::uint32_t> numbers = this->Number(this->MeasureWidths(), MinimumWidth * texel);
    if (this->Source.FindImage())
    {
      this->SplitAtSeams(numbers);
    }
    return numbers;
  }

  /// The corners of small cells, after Find.
  SurfaceRegions::SmallCells FindSmallCells(const std::vector<std::uint32_t>& numbers) const
  {
    using Corner = SurfaceRegions::Corner;
    SurfaceRegions::SmallCells cells;
    if (this->SmallOnes.empty() || !this->HasRegions)
    {
      return cells;
    }
    struct Meeting
    {
      std::uint64_t Key; ///< the region and the place
      std::uint32_t Row;
      int Corner;
    };
    cells.Rows.assign(this->Source.Triangles.size(), SurfaceRegions::None);
    cells.Corners.resize(this->SmallOnes.size());
    std::vector<Meeting> meetings;
    meetings.reserve(3 * this->SmallOnes.size());
    for (std::uint32_t row = 0; row < this->SmallOnes.size(); ++row)
    {
      const std::uint32_t triangle = this->SmallOnes[row];
      // Those of regions that are too small have nothing in common.
      if (!numbers.empty() && numbers[triangle] == 0)
      {
        continue;
      }
      cells.Rows[triangle] = row;
      const std::uint64_t region = numbers.empty() ? 0 : numbers[triangle];
      for (int k = 0; k < 3; ++k)
      {
        meetings.push_back(
          { region << 32 | this->Places[this->Source.Triangles[triangle][k]], row, k });
      }
    }
    vtkSMPTools::Sort(meetings.begin(), meetings.end(),
      [](const Meeting& a, const Meeting& b) {
        return a.Key != b.Key ? a.Key < b.Key
          : a.Row != b.Row    ? a.Row < b.Row
                              : a.Corner < b.Corner;
      });
    const ColorMap* map = this->Source.HasInstanceColors ? nullptr : this->Source.FindMap();
    for (std::size_t first = 0; first < meetings.size();)
    {
      Corner mean;
      float sum = 0.0f;
      std::size_t end = first;
      for (; end < meetings.size() && meetings[end].Key == meetings[first].Key; ++end)
      {
        const std::uint32_t triangle = this->SmallOnes[meetings[end].Row];
        const float area = this->Source.GetArea(triangle);
        const TrianglePoint middle{ triangle, 1.0f / 3.0f, 1.0f / 3.0f };
        mean.Color += area * this->Source.GetBaseColor(middle);
        mean.Place += area * (map ? this->Source.GetMapPlace(middle) : glm::vec2(0.0f));
        sum += area;
      }
      mean.Color /= sum;
      mean.Place /= sum;
      for (; first < end; ++first)
      {
        cells.Corners[meetings[first].Row][meetings[first].Corner] = mean;
      }
    }
    return cells;
  }

private:
  struct Use
  {
    std::uint64_t Edge;
    std::uint32_t Triangle;
    std::uint32_t Corner;
  };

  void AddRanges(const SurfaceArray& array)
  {
    for (const SurfaceArray::Component& component : array.Components)
    {
      std::array<double, 2> range{ HUGE_VAL, -HUGE_VAL };
      for (const double value : component.Values)
      {
        range[0] = std::isfinite(value) ? std::min(range[0], value) : range[0];
        range[1] = std::isfinite(value) ? std::max(range[1], value) : range[1];
      }
      this->Ranges.push_back(range[0] <= range[1] ? range : std::array<double, 2>{});
    }
  }

  std::uint32_t FindRoot(std::uint32_t shape)
  {
    for (; this->Next[shape] != shape; shape = this->Next[shape])
    {
      this->Next[shape] = this->Next[this->Next[shape]];
    }
    return shape;
  }

  void JoinTwo(std::uint32_t one, std::uint32_t other)
  {
    one = this->FindRoot(one);
    other = this->FindRoot(other);
    this->Next[std::max(one, other)] = std::min(one, other);
  }

  /// Twice the area over the perimeter of that to which each triangle is joined.
  std::vector<float> MeasureWidths()
  {
    const std::vector<glm::uvec3>& triangles = this->Source.Triangles;
    std::vector<float> areas(triangles.size(), 0.0f);
    std::vector<float> perimeters(triangles.size(), 0.0f);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      areas[this->FindRoot(i)] += this->Source.GetArea(i);
    }
    for (std::size_t first = 0; first < this->Uses.size();)
    {
      const Use& use = this->Uses[first];
      const glm::uvec3& corners = triangles[use.Triangle];
      const float length =
        glm::distance(this->Source.Vertices[corners[static_cast<int>(use.Corner)]],
          this->Source.Vertices[corners[static_cast<int>((use.Corner + 1) % 3)]]);
      std::size_t end = first;
      bool isInner = true;
      for (; end < this->Uses.size() && this->Uses[end].Edge == use.Edge; ++end)
      {
        isInner =
          isInner && this->FindRoot(this->Uses[end].Triangle) == this->FindRoot(use.Triangle);
      }
      isInner = isInner && end - first > 1;
      for (; first < end; ++first)
      {
        perimeters[this->FindRoot(this->Uses[first].Triangle)] += isInner ? 0.0f : length;
      }
    }
    std::vector<float> widths(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      const std::uint32_t root = this->FindRoot(i);
      widths[i] = perimeters[root] > 0.0f ? 2.0f * areas[root] / perimeters[root] : HUGE_VALF;
    }
    return widths;
  }

  std::vector<std::uint32_t> Number(const std::vector<float>& widths, float minimumWidth)
  {
    std::vector<std::uint32_t> numbers(widths.size(), 0);
    std::uint32_t count = 0;
    bool hasSmall = false;
    for (std::uint32_t i = 0; i < widths.size(); ++i)
    {
      const std::uint32_t root = this->FindRoot(i);
      const bool isSmall = widths[i] < minimumWidth;
      // Roots come first.
      numbers[i] = isSmall ? 0 : root == i ? ++count : numbers[root];
      hasSmall = hasSmall || isSmall;
    }
    this->HasRegions = count > 0;
    return count + (hasSmall ? 1 : 0) > 1 ? numbers : std::vector<std::uint32_t>();
  }

  /// Where a texture begins again beside its end, as around a sphere, both are one region, because
  /// they are joined elsewhere. Such regions are divided in the middle of the texture, until none
  /// has such a seam.
  void SplitAtSeams(std::vector<std::uint32_t>& numbers) const
  {
    struct Chart
    {
      glm::vec2 Low{ HUGE_VALF };
      glm::vec2 High{ -HUGE_VALF };
      glm::vec2 Jumps{ 0.0f }; ///< the sum of those along each axis, at seams
    };
    const std::uint32_t count = this->Source.GetNumberOfShapes();
    const auto findMiddle = [this](std::uint32_t triangle)
    {
      return this->Source.Interpolate(
        this->Source.TexCoords, TrianglePoint{ triangle, 1.0f / 3.0f, 1.0f / 3.0f });
    };
    std::vector<std::uint32_t> parts = numbers;
    parts.resize(count, 0);
    for (int round = 0; round < MaximumSplits; ++round)
    {
      std::vector<Chart> charts(1 + std::size_t(*std::max_element(parts.begin(), parts.end())));
      bool hasSeams = false;
      for (std::size_t i = 0; i + 1 < this->Uses.size(); ++i)
      {
        const Use& one = this->Uses[i];
        const Use& other = this->Uses[i + 1];
        if (one.Edge == other.Edge && parts[one.Triangle] == parts[other.Triangle] &&
          this->Jumps(one, other, SeamJump))
        {
          charts[parts[one.Triangle]].Jumps +=
            glm::abs(findMiddle(one.Triangle) - findMiddle(other.Triangle));
          hasSeams = true;
        }
      }
      if (!hasSeams)
      {
        break;
      }
      for (std::uint32_t i = 0; i < count; ++i)
      {
        Chart& chart = charts[parts[i]];
        chart.Low = glm::min(chart.Low, findMiddle(i));
        chart.High = glm::max(chart.High, findMiddle(i));
      }
      std::vector<std::uint32_t> others(charts.size(), 0);
      auto next = static_cast<std::uint32_t>(charts.size());
      for (std::uint32_t i = 0; i < count; ++i)
      {
        const Chart& chart = charts[parts[i]];
        const int axis = chart.Jumps.y > chart.Jumps.x ? 1 : 0;
        if (chart.Jumps[axis] > 0.0f &&
          findMiddle(i)[axis] > 0.5f * (chart.Low[axis] + chart.High[axis]))
        {
          std::uint32_t& other = others[parts[i]];
          other = other == 0 ? next++ : other;
          parts[i] = other;
        }
      }
      numbers = parts;
    }
  }

  /// Spheres, and tubes that follow each other, are one where they are alike.
  void JoinShapes()
  {
    for (std::uint32_t i = 1; i < this->Next.size(); ++i)
    {
      if (!this->Differ({ i - 1, 1.0f, 0.0f }, { i, 0.0f, 0.0f }, AnyJump))
      {
        this->JoinTwo(i - 1, i);
      }
    }
  }

  void ListUses()
  {
    const std::vector<glm::uvec3>& triangles = this->Source.Triangles;
    this->Uses.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      for (std::uint32_t k = 0; k < 3; ++k)
      {
        const std::uint64_t a = this->Places[triangles[i][static_cast<int>(k)]];
        const std::uint64_t b = this->Places[triangles[i][static_cast<int>((k + 1) % 3)]];
        this->Uses.push_back({ std::min(a, b) << 32 | std::max(a, b), i, k });
      }
    }
    vtkSMPTools::Sort(this->Uses.begin(), this->Uses.end(),
      [](const Use& a, const Use& b)
      { return a.Edge != b.Edge ? a.Edge < b.Edge : a.Triangle < b.Triangle; });
  }

  /// Joins triangles that meet at an edge without a jump, of which `getJump` tells what is one.
  template <typename GetJump>
  void JoinTriangles(const GetJump& getJump)
  {
    for (std::size_t i = 0; i + 1 < this->Uses.size(); ++i)
    {
      if (i % TrianglesOfReport == 0)
      {
        OrAbort(this->GoOn)(static_cast<double>(i) / static_cast<double>(this->Uses.size()));
      }
      const Use& one = this->Uses[i];
      const Use& other = this->Uses[i + 1];
      if (one.Edge == other.Edge && !this->Jumps(one, other, getJump(one, other)))
      {
        this->JoinTwo(one.Triangle, other.Triangle);
      }
    }
  }

  /// The place of a corner in a triangle.
  static TrianglePoint GetCorner(std::uint32_t triangle, std::uint32_t corner)
  {
    return { triangle, corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f };
  }

  /// Whether anything differs at either end of an edge of two triangles.
  bool Jumps(const Use& one, const Use& other, const Jump& jump) const
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
        this->Differ(GetCorner(one.Triangle, corner), GetCorner(other.Triangle, same), jump))
      {
        return true;
      }
    }
    return false;
  }

  bool Differ(const TrianglePoint& one, const TrianglePoint& other, const Jump& jump) const
  {
    const Mesh& mesh = this->Source;
    // Colours of instances do not matter within one.
    return (!mesh.HasInstanceColors &&
             (cslf::Differ(mesh.GetBaseColor(one), mesh.GetBaseColor(other), jump.Color) ||
               cslf::Differ(mesh.GetEmission(one), mesh.GetEmission(other), jump.Color))) ||
      this->HasOtherPlace(one, other, jump) || this->HasOtherValues(one, other, jump);
  }

  bool HasOtherPlace(const TrianglePoint& one, const TrianglePoint& other, const Jump& jump) const
  {
    const ColorMap* map = this->Source.HasInstanceColors ? nullptr : this->Source.FindMap();
    if (this->Source.FindImage())
    {
      const glm::vec2 difference = glm::abs(this->Source.Interpolate(this->Source.TexCoords, one) -
        this->Source.Interpolate(this->Source.TexCoords, other));
      return std::max(difference.x, difference.y) > jump.Value;
    }
    if (!map || map->IsOneColor)
    {
      return false;
    }
    const glm::vec2 difference =
      glm::abs(this->Source.GetMapPlace(one) - this->Source.GetMapPlace(other));
    return difference.x > jump.Value * map->GetSteps() || difference.y > 0.5f;
  }

  /// Integers may stand for things: no difference is too small for them, but that of small parts.
  bool HasOtherValues(const TrianglePoint& one, const TrianglePoint& other, const Jump& jump) const
  {
    std::size_t component = 0;
    for (std::size_t i = 0; i < this->Source.GetNumberOfArrays(); ++i)
    {
      const SurfaceArray& array = this->Source.GetArray(i);
      const double step = array.IsInteger && jump.Value < SmallJump.Value ? 0.0 : jump.Value;
      for (std::size_t c = 0; c < array.Components.size(); ++c)
      {
        const auto& [low, high] = this->Ranges[component++];
        // What is infinite is at the ends of the range, and what is no number stays so.
        const double a = std::clamp(this->Source.GetArrayValue(i, c, one), low, high);
        const double b = std::clamp(this->Source.GetArrayValue(i, c, other), low, high);
        if (std::abs(a - b) > step * (high - low) || std::isnan(a) != std::isnan(b))
        {
          return true;
        }
      }
    }
    return false;
  }

  const Mesh& Source;
  const Progress& GoOn;
  std::vector<std::uint32_t> Places;         // of the vertices: those at one place have one number
  std::vector<Use> Uses;                     // of edges
  std::vector<std::uint32_t> SmallOnes;      // triangles of small cells
  std::vector<std::uint32_t> Next;           // of the shapes: another one of the region
  std::vector<std::array<double, 2>> Ranges; // of each component of arrays
  bool HasCopies = false;
  bool VariesByShape = false;
  bool HasRegions = false; // whether any is large enough
};
}

SurfaceRegions::SurfaceRegions(
  const std::vector<Mesh>& meshes, float texel, const Progress& progress)
  : First(meshes.data())
  , OfShapes(meshes.size())
  , Small(meshes.size())
{
  auto next = static_cast<std::uint32_t>(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const Mesh& mesh = meshes[i];
    OrAbort(progress)(static_cast<double>(i) / static_cast<double>(meshes.size()));
    if (mesh.Vertices.empty())
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
    numbers = finder.Find(edge);
    if (!mesh.HasInstanceColors)
    {
      this->Small[i] = finder.FindSmallCells(numbers);
    }
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

glm::vec3 SurfaceRegions::GetBaseColor(const Mesh& mesh, const TrianglePoint& point) const
{
  const std::array<Corner, 3>* corners = this->FindCorners(mesh, point.Triangle);
  return corners ? (1.0f - point.U - point.V) * (*corners)[0].Color +
      point.U * (*corners)[1].Color + point.V * (*corners)[2].Color
                 : mesh.GetBaseColor(point);
}

glm::vec2 SurfaceRegions::GetMapPlace(const Mesh& mesh, const TrianglePoint& point) const
{
  const std::array<Corner, 3>* corners = this->FindCorners(mesh, point.Triangle);
  return corners ? (1.0f - point.U - point.V) * (*corners)[0].Place +
      point.U * (*corners)[1].Place + point.V * (*corners)[2].Place
                 : mesh.GetMapPlace(point);
}
}
