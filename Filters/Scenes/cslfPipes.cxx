// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace cslf
{
namespace
{
using Color = std::array<double, 3>;

/// A point of a sheet, of coordinates in [0,1].
using Sheet = std::function<glm::dvec3(double u, double v)>;

const double FullTurn = glm::radians(360.0);

/// A sheet without thickness.
void AddSheet(vtkRenderer* renderer, int columns, int rows, const Color& color, const Sheet& sheet)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  for (int row = 0; row <= rows; ++row)
  {
    for (int column = 0; column <= columns; ++column)
    {
      const glm::dvec3 place =
        sheet(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
      const vtkIdType point = points->InsertNextPoint(place.x, place.y, place.z);
      if (row > 0 && column > 0)
      {
        const vtkIdType below = point - columns - 1;
        triangles->InsertNextCell({ below - 1, below, point });
        triangles->InsertNextCell({ below - 1, point, point - 1 });
      }
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  vtkActor* actor = AddSurface(renderer, normals->GetOutput());
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
}

/// A place on a curve in a plane, and the direction of the curve there.
struct Bend
{
  glm::dvec2 Position;
  glm::dvec2 Direction;
};

/// Follows straight lines and arcs. Each part begins in the direction in which the one before ends.
class Path
{
public:
  explicit Path(const glm::dvec2& start)
    : End{ start, glm::dvec2(1.0, 0.0) }
  {
    this->Bends.push_back(this->End);
  }

  Path& GoStraight(double length)
  {
    this->End.Position += length * this->End.Direction;
    this->Bends.push_back(this->End);
    return *this;
  }

  /// To the left by an angle in degrees, to the right if it is negative.
  Path& GoRound(double radius, double degrees)
  {
    constexpr int steps = 24;
    const glm::dvec2 start = this->End.Direction;
    const double side = degrees < 0.0 ? -1.0 : 1.0;
    const glm::dvec2 toCenter = side * radius * glm::dvec2(-start.y, start.x);
    const glm::dvec2 center = this->End.Position + toCenter;
    for (int i = 1; i <= steps; ++i)
    {
      const double angle = glm::radians(degrees) * i / steps;
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      this->End.Position =
        center - glm::dvec2(c * toCenter.x - s * toCenter.y, s * toCenter.x + c * toCenter.y);
      this->End.Direction = { c * start.x - s * start.y, s * start.x + c * start.y };
      this->Bends.push_back(this->End);
    }
    return *this;
  }

  int CountParts() const { return static_cast<int>(this->Bends.size()) - 1; }
  const Bend& Get(double u) const
  {
    return this->Bends[static_cast<std::size_t>(std::lround(u * this->CountParts()))];
  }

private:
  Bend End;
  std::vector<Bend> Bends;
};

/// A pipe along a path in the plane of two axes: all around, or a part of the circumference that
/// begins at an angle from the path's left. Both are fractions of the circumference.
void AddPipe(vtkRenderer* renderer, const Color& color, const Path& path, const glm::dvec3& origin,
  const glm::dvec3& x, const glm::dvec3& y, double radius, double start = 0.0, double part = 1.0)
{
  const glm::dvec3 z = glm::cross(x, y);
  AddSheet(renderer, path.CountParts(), 64, color,
    [&](double u, double v)
    {
      const Bend& bend = path.Get(u);
      const glm::dvec3 left = -bend.Direction.y * x + bend.Direction.x * y;
      const double angle = FullTurn * (start + part * v);
      return origin + bend.Position.x * x + bend.Position.y * y +
        radius * (std::cos(angle) * left + std::sin(angle) * z);
    });
}

/// Half a sphere that opens in a direction.
void AddBowl(vtkRenderer* renderer, const Color& color, const glm::dvec3& center, double radius,
  const glm::dvec3& direction)
{
  const glm::dvec3 z = glm::normalize(direction);
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.3, 0.9, 0.2), z));
  const glm::dvec3 y = glm::cross(z, x);
  AddSheet(renderer, 72, 24, color,
    [&](double u, double v)
    {
      // A small hole at the bottom avoids triangles without area.
      const double height = glm::radians(0.5 + 89.5 * v);
      return center +
        radius *
        (std::sin(height) * (std::cos(FullTurn * u) * x + std::sin(FullTurn * u) * y) -
          std::cos(height) * z);
    });
}
}

void AddPipes(vtkRenderer* renderer)
{
  const Color copper = { 0.85, 0.50, 0.30 };
  const Color blue = { 0.25, 0.45, 0.80 };
  const Color green = { 0.35, 0.65, 0.35 };
  const Color yellow = { 0.90, 0.75, 0.25 };
  const Color white = { 0.85, 0.85, 0.85 };
  const glm::dvec3 x(1.0, 0.0, 0.0);
  const glm::dvec3 y(0.0, 1.0, 0.0);
  const glm::dvec3 z(0.0, 0.0, 1.0);

  // The floor, a sheet as well.
  AddSheet(renderer, 20, 20, white,
    [](double u, double v) { return glm::dvec3(12.0 * u - 6.0, 0.0, 5.0 - 10.0 * v); });
  // A pipe that comes from the front and returns there, and one that rises and turns to the front.
  AddPipe(renderer, copper,
    Path(glm::dvec2(-3.5, 0.0)).GoStraight(4.0).GoRound(1.3, 180.0).GoStraight(4.5),
    { -4.2, 0.9, 0.0 }, -z, x, 0.75);
  AddPipe(renderer, blue,
    Path(glm::dvec2(0.05, 0.0)).GoStraight(2.2).GoRound(1.2, -90.0).GoStraight(1.0),
    { 0.6, 0.0, -2.8 }, y, -z, 0.85);
  // One with two bends, and half pipes that open upwards and downwards.
  AddPipe(renderer, yellow,
    Path(glm::dvec2(0.0, 0.0))
      .GoStraight(1.0)
      .GoRound(1.0, 60.0)
      .GoRound(1.0, -60.0)
      .GoStraight(1.0),
    { 0.6, 0.65, 1.2 }, x, z, 0.55);
  AddPipe(renderer, green, Path(glm::dvec2(0.0, 0.0)).GoStraight(5.0).GoRound(2.0, 35.0),
    { -5.0, 3.2, -3.0 }, x, y, 0.7, 0.25, 0.5);
  AddPipe(renderer, green, Path(glm::dvec2(0.0, 0.0)).GoStraight(3.0), { 2.2, 0.0, 3.4 }, x, -z,
    0.8, 0.0, 0.5);
  AddBowl(renderer, blue, { 4.2, 0.95, -0.2 }, 0.9, { -0.3, 1.0, 0.7 });
  AddBowl(renderer, copper, { 4.0, 1.3, -3.0 }, 1.2, { -0.2, 0.2, 1.0 });
  AddBowl(renderer, yellow, { 0.5, 0.71, 3.8 }, 0.7, { 0.1, -1.0, 0.05 });
}
}
