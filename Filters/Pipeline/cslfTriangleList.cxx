// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTriangleList.h"

#include "Pipeline/cslfArrayLayout.h"

#include "cslfPolygonFill.h"
#include "cslfValidPolyData.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkTriangleStrip.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// The time that VTK takes for a polygon grows with the square of its corners: 30 ms for these.
constexpr vtkIdType MaximumOrdinaryCorners = 4096;

// Corners of polygons with at most that many are searched.
constexpr vtkIdType FewSearchedCorners = 16;

constexpr const char* SourceName = "CSLF:SourceCell";

// What rounding may change, in parts of a polygon's area.
constexpr double Rounding = 1e-6;

// The smallest vector area of a polygon that VTK's triangles fill, in parts of their areas. It is
// less than 1 if the polygon is not flat.
constexpr double MinimumOrdinaryVectorArea = 0.1;

// Triangles that face away from the polygon fill what is not part of it. Of polygons that are not
// flat, they may be steep: the cosine of the largest angle.
constexpr double MinimumNormalCosine = -0.5;

/// Checks the triangles that VTK made of a polygon.
class PolygonCheck
{
public:
  /// The corners, in order, and the corners of all triangles.
  std::vector<glm::dvec3> Corners;
  std::vector<glm::dvec3> TriangleCorners;

  /// Whether the triangles fill the polygon by the even-odd rule.
  bool IsFilled(FillBudget& budget)
  {
    const std::size_t all = this->Corners.size();
    this->RemoveDoubled();
    const glm::dvec3 normal = this->GetVectorArea();
    const std::size_t count = this->TriangleCorners.size() / 3 + 2;
    if ((count != this->Corners.size() && count != all) || !this->FaceAlong(normal))
    {
      return false;
    }
    // Ears that all face one way cover each point as often as the outline winds around it. That is
    // at most once if the outline is simple, and otherwise if the areas agree.
    if (this->Corners.size() <= 4 || !MayTouchItself(this->Corners, normal))
    {
      return true;
    }
    const PolygonFill fill = FillPolygon(this->Corners, normal, budget);
    const double area = 0.5 * glm::length(normal);
    return fill.IsTangled || std::abs(fill.Area - area) <= Rounding * area;
  }

private:
  /// Removes corners at the place of the one before. VTK may do so, too.
  void RemoveDoubled()
  {
    const auto end = std::unique(this->Corners.begin(), this->Corners.end());
    this->Corners.erase(end, this->Corners.end());
    while (this->Corners.size() > 1 && this->Corners.front() == this->Corners.back())
    {
      this->Corners.pop_back();
    }
  }

  /// The polygon's normal, twice as long as its area.
  glm::dvec3 GetVectorArea() const
  {
    const glm::dvec3 first = this->Corners.front();
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < this->Corners.size(); ++i)
    {
      sum += glm::cross(this->Corners[i] - first, this->Corners[i + 1] - first);
    }
    return sum;
  }

  /// Whether the triangles have the vector area of the polygon, and all face along it.
  bool FaceAlong(const glm::dvec3& normal)
  {
    glm::dvec3 sum(0.0);
    double area = 0.0;
    double least = 0.0; // along the normal
    for (std::size_t i = 0; i + 2 < this->TriangleCorners.size(); i += 3)
    {
      const glm::dvec3& first = this->TriangleCorners[i];
      const glm::dvec3 part =
        glm::cross(this->TriangleCorners[i + 1] - first, this->TriangleCorners[i + 2] - first);
      const double size = glm::length(part);
      sum += part;
      area += size;
      const double along = glm::dot(part, normal);
      if (along < MinimumNormalCosine * size * glm::length(normal))
      {
        least = std::min(least, along);
      }
    }
    return area > 0.0 && glm::length(normal) >= MinimumOrdinaryVectorArea * area &&
      least >= -Rounding * area * glm::length(normal) &&
      glm::length(sum - normal) <= Rounding * area;
  }
};

/// Whether the two triangles of a polygon of four corners face alike, whichever diagonal it has.
bool IsConvexQuad(vtkPolyData* data, const vtkIdType* points)
{
  const glm::dvec3 first = GetPoint(data, points[0]);
  const glm::dvec3 a = GetPoint(data, points[1]) - first;
  const glm::dvec3 b = GetPoint(data, points[2]) - first;
  const glm::dvec3 c = GetPoint(data, points[3]) - first;
  return glm::dot(glm::cross(a, b), glm::cross(b, c)) > 0.0 &&
    glm::dot(glm::cross(a, c), glm::cross(b - a, c - a)) > 0.0;
}

/// Appends triangles, and points where edges cross, to data.
class FillAppender
{
public:
  explicit FillAppender(vtkPolyData* data)
    : Data(data)
  {
  }

  /// Appends the fill of a polygon with these corners. Returns the number of triangles.
  vtkIdType Add(const PolygonFill& fill, const std::vector<vtkIdType>& corners)
  {
    std::vector<vtkIdType> points = corners;
    for (const PolygonCrossing& crossing : fill.Crossings)
    {
      this->OwnPoints();
      points.push_back(this->AddPoint(crossing, points));
    }
    for (std::size_t i = 0; i + 2 < fill.Triangles.size(); i += 3)
    {
      const vtkIdType triangle[3] = { points[fill.Triangles[i]], points[fill.Triangles[i + 1]],
        points[fill.Triangles[i + 2]] };
      this->Data->GetPolys()->InsertNextCell(3, triangle);
    }
    return static_cast<vtkIdType>(fill.Triangles.size() / 3);
  }

private:
  /// Copies the points and their data, which are the input's, before the first change.
  void OwnPoints()
  {
    if (this->IsOwner)
    {
      return;
    }
    this->IsOwner = true;
    vtkNew<vtkPoints> points;
    points->SetDataType(this->Data->GetPoints()->GetDataType());
    points->DeepCopy(this->Data->GetPoints());
    this->Data->SetPoints(points);
    vtkNew<vtkPointData> attributes;
    attributes->DeepCopy(this->Data->GetPointData());
    this->Data->GetPointData()->ShallowCopy(attributes);
  }

  vtkIdType AddPoint(const PolygonCrossing& crossing, const std::vector<vtkIdType>& points)
  {
    vtkNew<vtkIdList> from;
    double sum = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      from->InsertNextId(points[crossing.Points[i]]);
      sum += crossing.Weights[i];
    }
    double weights[4];
    const glm::dvec3 first = GetPoint(this->Data, from->GetId(0));
    glm::dvec3 place = first;
    for (int i = 0; i < 4; ++i)
    {
      weights[i] = crossing.Weights[i] / sum;
      place += weights[i] * (GetPoint(this->Data, from->GetId(i)) - first);
    }
    const vtkIdType point = this->Data->GetPoints()->InsertNextPoint(place.x, place.y, place.z);
    for (int i = 0; i < this->Data->GetPointData()->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = this->Data->GetPointData()->GetAbstractArray(i);
      array->InsertNextTuple(from->GetId(0), array);
      array->InterpolateTuple(point, from, array, weights);
    }
    return point;
  }

  vtkPolyData* Data;
  bool IsOwner = false;
};

/// Triangulates the polygons and strips of data.
class PolygonTriangulation
{
public:
  explicit PolygonTriangulation(vtkPolyData* data)
    : Data(data)
    , FirstPolygon(data->GetNumberOfVerts() + data->GetNumberOfLines())
  {
  }

  Triangulation Run()
  {
    this->SelectOrdinary();
    this->TriangulateOrdinary();
    this->CheckOrdinary();
    this->RemoveWrong();
    FillAppender appender(this->Result.Triangles);
    for (vtkIdType polygon : this->ToFill)
    {
      this->Fill(polygon, appender);
    }
    this->CopyCellData();
    this->Result.Triangles->Squeeze();
    return this->Result;
  }

private:
  /// Selects the polygons that VTK gets.
  void SelectOrdinary()
  {
    const auto isPointFinite = [this](vtkIdType point)
    { return IsFinite(GetPoint(this->Data, point)); };
    bool areFinite = true;
    for (vtkIdType i = 0; areFinite && i < this->Data->GetNumberOfPoints(); ++i)
    {
      areFinite = isPointFinite(i);
    }
    ForEachCell(this->Data->GetPolys(),
      [&](vtkIdType polygon, vtkIdType count, const vtkIdType* points)
      {
        const bool isFinite =
          areFinite || count <= 3 || std::all_of(points, points + count, isPointFinite);
        if (!isFinite || count < 3)
        {
          this->Result.NotFinite += isFinite ? 0 : 1;
          this->Result.WithoutArea += isFinite ? 1 : 0;
        }
        else if (count > MaximumOrdinaryCorners)
        {
          this->ToFill.push_back(polygon);
        }
        else
        {
          this->Ordinary.push_back(polygon);
        }
      });
  }

  /// The polygons that VTK gets.
  vtkSmartPointer<vtkCellArray> GetOrdinary()
  {
    vtkSmartPointer<vtkCellArray> polygons = this->Data->GetPolys();
    if (static_cast<vtkIdType>(this->Ordinary.size()) == polygons->GetNumberOfCells())
    {
      return polygons;
    }
    auto ordinary = vtkSmartPointer<vtkCellArray>::New();
    vtkNew<vtkIdList> points;
    for (vtkIdType polygon : this->Ordinary)
    {
      polygons->GetCellAtId(polygon, points);
      ordinary->InsertNextCell(points);
    }
    return ordinary;
  }

  /// Lets VTK make triangles, which know their cell.
  void TriangulateOrdinary()
  {
    vtkNew<vtkIdTypeArray> sources;
    sources->SetName(SourceName);
    sources->Allocate(static_cast<vtkIdType>(this->Ordinary.size()));
    for (vtkIdType polygon : this->Ordinary)
    {
      sources->InsertNextValue(this->FirstPolygon + polygon);
    }
    vtkNew<vtkPolyData> ordinary;
    ordinary->SetPoints(this->Data->GetPoints());
    ordinary->SetPolys(this->GetOrdinary());
    ordinary->GetCellData()->AddArray(sources);
    vtkNew<vtkTriangleFilter> triangulate;
    triangulate->SetInputData(ordinary);
    triangulate->Update();
    this->Result.Triangles = triangulate->GetOutput();
    this->Result.Triangles->GetPointData()->PassData(this->Data->GetPointData());
    this->Result.Triangles->GetFieldData()->PassData(this->Data->GetFieldData());
    this->Sources = vtkIdTypeArray::SafeDownCast(
      this->Result.Triangles->GetCellData()->GetAbstractArray(SourceName));
    this->AddStrips();
  }

  /// Not by VTK's filter, which in version 9.6 loses which cells the triangles are of.
  void AddStrips()
  {
    if (this->Data->GetNumberOfStrips() == 0)
    {
      return;
    }
    if (!this->Sources)
    {
      this->Sources = vtkSmartPointer<vtkIdTypeArray>::New();
      this->Sources->SetName(SourceName);
    }
    vtkNew<vtkCellArray> triangles;
    triangles->DeepCopy(this->Result.Triangles->GetPolys());
    const vtkIdType firstStrip = this->FirstPolygon + this->Data->GetNumberOfPolys();
    ForEachCell(this->Data->GetStrips(),
      [&](vtkIdType strip, vtkIdType count, const vtkIdType* points)
      {
        const vtkIdType before = triangles->GetNumberOfCells();
        vtkTriangleStrip::DecomposeStrip(static_cast<int>(count), points, triangles);
        for (vtkIdType i = before; i < triangles->GetNumberOfCells(); ++i)
        {
          this->Sources->InsertNextValue(firstStrip + strip);
        }
      });
    this->Result.Triangles->SetPolys(triangles);
  }

  /// Finds the polygons that VTK's triangles do not fill.
  void CheckOrdinary()
  {
    const vtkIdType count = this->Sources ? this->Sources->GetNumberOfTuples() : 0;
    PolygonCheck check;
    vtkIdType end = 0;
    for (vtkIdType polygon : this->Ordinary)
    {
      const vtkIdType begin = end;
      while (end < count && this->Sources->GetValue(end) == this->FirstPolygon + polygon)
      {
        ++end;
      }
      vtkIdType corners = 0;
      const vtkIdType* points = nullptr;
      this->Data->GetPolys()->GetCellAtId(polygon, corners, points);
      if (corners == 3 || (corners == 4 && end - begin == 2 && IsConvexQuad(this->Data, points)))
      {
        continue;
      }
      this->GetCorners(polygon, begin, end, check);
      if (!check.IsFilled(this->Budget))
      {
        this->ToFill.push_back(polygon);
        this->Wrong.emplace_back(begin, end);
      }
    }
  }

  /// The places of a polygon's corners, and of the corners of its triangles.
  void GetCorners(vtkIdType polygon, vtkIdType begin, vtkIdType end, PolygonCheck& check) const
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    this->Data->GetPolys()->GetCellAtId(polygon, count, points);
    check.Corners.clear();
    for (vtkIdType i = 0; i < count; ++i)
    {
      check.Corners.push_back(GetPoint(this->Data, points[i]));
    }
    check.TriangleCorners.clear();
    for (vtkIdType triangle = begin; triangle < end; ++triangle)
    {
      vtkIdType three = 0;
      const vtkIdType* corners = nullptr;
      this->Result.Triangles->GetPolys()->GetCellAtId(triangle, three, corners);
      for (vtkIdType i = 0; i < three; ++i)
      {
        // Reading a point again takes longer than a short search.
        const vtkIdType* found = count <= FewSearchedCorners
          ? std::find(points, points + count, corners[i])
          : points + count;
        check.TriangleCorners.push_back(found < points + count ? check.Corners[found - points]
                                                               : GetPoint(this->Data, corners[i]));
      }
    }
  }

  /// Removes the triangles of polygons that they do not fill.
  void RemoveWrong()
  {
    if (this->ToFill.empty())
    {
      return;
    }
    vtkNew<vtkCellArray> kept;
    vtkNew<vtkIdTypeArray> sources;
    auto wrong = this->Wrong.begin();
    ForEachCell(this->Result.Triangles->GetPolys(),
      [&](vtkIdType triangle, vtkIdType count, const vtkIdType* points)
      {
        while (wrong != this->Wrong.end() && triangle >= wrong->second)
        {
          ++wrong;
        }
        if (wrong == this->Wrong.end() || triangle < wrong->first)
        {
          kept->InsertNextCell(count, points);
          sources->InsertNextValue(this->Sources->GetValue(triangle));
        }
      });
    this->Result.Triangles->SetPolys(kept);
    this->Sources = sources;
  }

  void Fill(vtkIdType polygon, FillAppender& appender)
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    this->Data->GetPolys()->GetCellAtId(polygon, count, points);
    std::vector<glm::dvec3> corners;
    for (vtkIdType i = 0; i < count; ++i)
    {
      corners.push_back(GetPoint(this->Data, points[i]));
    }
    const PolygonFill fill = FillPolygon(corners, FindPolygonNormal(corners), this->Budget);
    this->Result.Filled += fill.Triangles.empty() ? 0 : 1;
    this->Result.Tangled += fill.IsTangled ? 1 : 0;
    this->Result.WithoutArea += !fill.IsTangled && fill.Triangles.empty() ? 1 : 0;
    const vtkIdType triangles = appender.Add(fill, { points, points + count });
    for (vtkIdType i = 0; i < triangles; ++i)
    {
      this->Sources->InsertNextValue(this->FirstPolygon + polygon);
    }
  }

  void CopyCellData()
  {
    vtkCellData* attributes = this->Result.Triangles->GetCellData();
    attributes->Initialize();
    const vtkIdType count = this->Sources ? this->Sources->GetNumberOfTuples() : 0;
    const auto all = KeepNumeric(this->Data->GetCellData());
    attributes->CopyAllocate(all, count);
    const bool isEmpty = all->GetNumberOfArrays() == 0;
    for (vtkIdType i = 0; !isEmpty && i < count; ++i)
    {
      attributes->CopyData(all, this->Sources->GetValue(i), i);
    }
  }

  vtkPolyData* Data;
  vtkIdType FirstPolygon; // in the cells of the data
  Triangulation Result;
  std::vector<vtkIdType> Ordinary;                    // polygons that VTK gets
  std::vector<vtkIdType> ToFill;                      // others
  vtkSmartPointer<vtkIdTypeArray> Sources;            // of each triangle, its cell
  std::vector<std::pair<vtkIdType, vtkIdType>> Wrong; // ranges of triangles
  FillBudget Budget;
};

/// Whether all cells are triangles.
bool HasTrianglesOnly(vtkPolyData* data)
{
  bool areTriangles = data->GetNumberOfPolys() == data->GetNumberOfCells();
  ForEachCell(data->GetPolys(),
    [&areTriangles](vtkIdType, vtkIdType count, const vtkIdType*)
    { areTriangles = areTriangles && count == 3; });
  return areTriangles;
}
}

bool IsFinite(const glm::dvec3& point)
{
  constexpr double limit = std::numeric_limits<float>::max();
  return std::abs(point.x) < limit && std::abs(point.y) < limit && std::abs(point.z) < limit;
}

glm::dvec3 GetPoint(vtkPolyData* data, vtkIdType index)
{
  double point[3];
  data->GetPoint(index, point);
  return { point[0], point[1], point[2] };
}

Triangulation TriangulatePolygons(vtkPolyData* data)
{
  if (!HasTrianglesOnly(data))
  {
    return PolygonTriangulation(data).Run();
  }
  Triangulation same;
  same.Triangles = vtkSmartPointer<vtkPolyData>::New();
  same.Triangles->ShallowCopy(data);
  return same;
}

vtkSmartPointer<vtkPolyData> Triangulate(vtkPolyData* data)
{
  return TriangulatePolygons(data).Triangles;
}

std::vector<unsigned int> ListCorners(vtkPolyData* triangles)
{
  std::vector<unsigned int> list;
  list.reserve(3 * triangles->GetNumberOfPolys());
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  const auto cells = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    cells->GetCurrentCell(count, corners);
    for (vtkIdType i = 0; i < count; ++i)
    {
      list.push_back(static_cast<unsigned int>(corners[i]));
    }
  }
  return list;
}
}
