// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryMesh.h"

#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"
#include "cslfClosedParts.h"
#include "cslfColor.h"

#include <vtkDataArray.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cslf
{
namespace
{
/// The colours in an array. None without one.
std::vector<glm::vec4> GetColors(vtkDataArray* array)
{
  std::vector<glm::vec4> colors;
  for (vtkIdType point = 0; array && point < array->GetNumberOfTuples(); ++point)
  {
    colors.push_back(GetColor(array, point));
  }
  return colors;
}

/// The sRGB-encoded colour of a brighter surface.
float Brighten(float color, double factor)
{
  const double light = factor * SRGBToLinear(color);
  return static_cast<float>(
    light > 1.0 ? 1.055 * std::pow(light, 1.0 / 2.4) - 0.055 : LinearToSRGB(light));
}

/// Colours are associated with alpha, which is 1 for those that are exact, and half of that or less
/// for others. Exact ones become as bright as their surface.
void MarkExact(const PointColorArrays& arrays, bool isBack, std::vector<glm::vec4>& colors)
{
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    if (colors[i].w > 0.0f)
    {
      const auto point = static_cast<vtkIdType>(i);
      colors[i] /= colors[i].w;
      colors[i] *= arrays.IsExact(point, isBack) ? 1.0f : 0.5f;
      const double brightness = arrays.GetBrightness(point, isBack);
      for (int c = 0; brightness > 1.0 && c < 3; ++c)
      {
        colors[i][c] = Brighten(colors[i][c], brightness);
      }
    }
  }
}

/// Gives mapped points the light of a side in place of their colours there. Those without a colour
/// are not exact.
void SetLight(const MappedPoints& points, std::size_t side, std::vector<glm::vec4>& colors)
{
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    if (points.Has(i))
    {
      colors[i] = glm::vec4(points.Light[side][i], colors[i].w > 0.0f ? colors[i].w : 0.5f);
    }
  }
}

/// Takes the mapped points, and their light, after MarkExact.
void TakeMappedPoints(vtkPolyData* triangles, GeometryMesh& mesh)
{
  mesh.Mapped = FindMappedPoints(triangles);
  std::array<std::vector<glm::vec3>, 2>& light = mesh.Mapped.Light;
  if (light[0] != light[1] && mesh.BackColors.empty())
  {
    mesh.BackColors = mesh.Colors;
  }
  SetLight(mesh.Mapped, 0, mesh.Colors);
  SetLight(mesh.Mapped, 1, mesh.BackColors);
  light = {};
}

bool AreBright(const std::vector<glm::vec4>& colors)
{
  return std::any_of(colors.begin(), colors.end(),
    [](const glm::vec4& color) {
      return std::max({ color.x, color.y, color.z }) > 1.0f;
    });
}

/// After MarkExact.
bool AreExact(const std::vector<glm::vec4>& colors)
{
  return std::all_of(
    colors.begin(), colors.end(), [](const glm::vec4& color) { return color.w == 1.0f; });
}

/// Takes the triangles of balls apart.
void TakeBalls(vtkPolyData* geometry, const Cube& box, GeometryMesh& mesh)
{
  mesh.Balls = FindBalls(geometry, box, { mesh.PointsCC, mesh.Corners, mesh.Colors });
  std::vector<std::uint32_t> others;
  for (std::size_t i = 0; i < mesh.Corners.size(); ++i)
  {
    (mesh.Balls.AreTriangles[i / 3] ? mesh.BallCorners : others).push_back(mesh.Corners[i]);
  }
  mesh.Corners = std::move(others);
  mesh.Balls.AreTriangles.clear();
  for (const BallGroup& group : mesh.Balls.Groups)
  {
    for (const glm::vec4& sphere : group.Spheres)
    {
      const glm::vec3 center = glm::vec3(sphere) / group.Scale;
      const glm::vec3 radius = sphere.w / group.Scale;
      mesh.MinimumCC = glm::max(glm::min(mesh.MinimumCC, center - radius), glm::vec3(-1.0f));
      mesh.MaximumCC = glm::min(glm::max(mesh.MaximumCC, center + radius), glm::vec3(1.0f));
    }
  }
}

bool AreOpaque(const std::vector<glm::vec4>& colors)
{
  return std::all_of(
    colors.begin(), colors.end(), [](const glm::vec4& color) { return color.w > 0.0f; });
}
}

std::shared_ptr<const GeometryMesh> MakeGeometryMesh(
  vtkPolyData* geometry, const Description& field, std::string& fault)
{
  const Cube& box = field.Box;
  fault = DescribeGeometryError(geometry, box);
  if (!fault.empty() || !IsUsefulGeometry(geometry))
  {
    return nullptr;
  }
  const vtkSmartPointer<vtkPolyData> triangles = Triangulate(geometry);
  auto mesh = std::make_shared<GeometryMesh>();
  mesh->PointsCC.reserve(triangles->GetNumberOfPoints());
  for (vtkIdType point = 0; point < triangles->GetNumberOfPoints(); ++point)
  {
    double place[3];
    triangles->GetPoint(point, place);
    mesh->PointsCC.emplace_back(box.PointToCube({ place[0], place[1], place[2] }));
  }
  const PointColorArrays colors = FindPointColors(triangles);
  mesh->Colors = GetColors(colors.Front);
  mesh->Colors.resize(mesh->PointsCC.size(), glm::vec4(0.0f));
  mesh->BackColors = GetColors(colors.Back);
  // Colours of another type have another encoding.
  const Channel& shown = *field.FindChannel(KnownChannel::Color);
  mesh->IsLinear = shown.Encoding == LinearEncoding;
  mesh->HasExactColors = colors.Exact && colors.Front->GetDataType() == shown.Type;
  if (mesh->HasExactColors)
  {
    MarkExact(colors, false, mesh->Colors);
    MarkExact(colors, true, mesh->BackColors);
  }
  TakeMappedPoints(triangles, *mesh);
  mesh->IsBright = mesh->HasExactColors && shown.Type == VTK_UNSIGNED_CHAR &&
    (AreBright(mesh->Colors) || AreBright(mesh->BackColors));
  mesh->HasColors = AreOpaque(mesh->Colors) && AreOpaque(mesh->BackColors);
  mesh->IsComplete = IsCompleteGeometry(geometry);
  mesh->IsAlone = mesh->HasExactColors && mesh->IsComplete && !field.MayShowEnvironment() &&
    AreExact(mesh->Colors) && AreExact(mesh->BackColors);
  mesh->Corners = ListCorners(triangles);
  for (const std::uint32_t corner : mesh->Corners)
  {
    mesh->MinimumCC = glm::min(mesh->MinimumCC, mesh->PointsCC[corner]);
    mesh->MaximumCC = glm::max(mesh->MaximumCC, mesh->PointsCC[corner]);
  }
  if (IsOpaqueGeometry(geometry))
  {
    mesh->Cells = std::make_shared<SurfaceCells>(field, mesh->PointsCC, mesh->Corners);
  }
  if (mesh->IsAlone && colors.Front->GetDataType() == VTK_UNSIGNED_CHAR)
  {
    TakeBalls(geometry, box, *mesh);
  }
  const ClosedParts parts = SortClosedParts(mesh->PointsCC, mesh->Corners);
  mesh->ClosedCorners = parts.Corners;
  for (std::size_t point = 0; point < mesh->BackColors.size(); ++point)
  {
    if (parts.IsTurned[point])
    {
      std::swap(mesh->Colors[point], mesh->BackColors[point]);
    }
  }
  return mesh;
}

std::size_t GeometryMesh::CountLevels() const
{
  const MeshLevels* levels = this->FindLevels();
  return levels ? std::max(levels->Levels.size(), this->Balls.CountLevels()) : 0;
}

bool GeometryMesh::IsCoarse(std::size_t level) const
{
  const MeshLevels* levels = level > 0 ? this->FindLevels() : nullptr;
  return levels && !levels->Levels.empty();
}

MeshLevel GeometryMesh::GetLevel(std::size_t level) const
{
  if (!this->IsCoarse(level))
  {
    return { 0, this->ClosedCorners, this->Corners.size() };
  }
  const std::vector<MeshLevel>& levels = this->FindLevels()->Levels;
  return levels[std::min(level, levels.size()) - 1];
}

std::size_t GeometryMesh::CountTriangles(std::size_t level) const
{
  return this->GetLevel(level).CountTriangles() + 2 * this->Balls.CountAtLevel(level);
}
}
