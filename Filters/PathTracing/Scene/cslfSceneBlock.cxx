// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneBlock.h"

#include "PathTracing/Shapes/cslfTriangles.h"
#include "Pipeline/cslfValidPolyData.h"
#include "cslfColor.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// Instances with a smaller volume, relative to the cube of their extent, are flat.
constexpr double MinimumVolume = 1e-12;

// The tracer computes in floats.
constexpr double RadianceLimit = 1e30;

/// The array of points' own radii, or null.
vtkDataArray* FindRadii(const SceneBlock& block)
{
  const bool tubes = block.Shape == Mesh::Shapes::Tubes;
  const char* name = tubes ? vtkCSLFMaterial::LineRadiusName() : vtkCSLFMaterial::PointRadiusName();
  vtkDataArray* radii = block.Data->GetPointData()->GetArray(name);
  return radii && radii->GetNumberOfComponents() == 1 ? radii : nullptr;
}

/// A matrix in vtkMatrix4x4's order, by rows. False if it is not a finite affine transform.
bool ReadMatrix(vtkDataArray* matrices, vtkIdType index, glm::dmat4& matrix)
{
  for (int i = 0; i < 16; ++i)
  {
    const double value = matrices->GetComponent(index, i);
    if (!std::isfinite(value))
    {
      return false;
    }
    matrix[i % 4][i / 4] = value;
  }
  return matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0 && matrix[3][3] == 1.0;
}

bool HasExtent(const glm::dmat4& matrix)
{
  const glm::dmat3 linear(matrix);
  const double size =
    std::max({ glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]) });
  return std::abs(glm::determinant(linear)) > MinimumVolume * size * size * size;
}

void ReadColor(vtkDataArray* colors, vtkIdType index, BlockInstance& instance)
{
  const auto get = [&](int component) { return colors->GetComponent(index, component) / 255.0; };
  instance.Color = SRGBToLinear(glm::dvec3(get(0), get(1), get(2)));
  instance.Opacity = colors->GetNumberOfComponents() > 3 ? static_cast<float>(get(3)) : 1.0f;
  instance.HasColor = true;
}
}

glm::vec3 GetRadiance(vtkDataArray* array, vtkIdType tuple)
{
  glm::vec3 radiance(0.0f);
  for (int i = 0; i < 3; ++i)
  {
    const double value = array->GetComponent(tuple, i);
    radiance[i] = value > 0.0 && value < RadianceLimit ? static_cast<float>(value) : 0.0f;
  }
  return radiance;
}

RoundSelection SelectRound(vtkPolyData* data, Mesh::Shapes shape)
{
  RoundSelection selection;
  const bool tubes = shape == Mesh::Shapes::Tubes;
  const vtkIdType first = tubes ? data->GetNumberOfVerts() : 0;
  vtkCellArray* cells = tubes ? data->GetLines() : data->GetVerts();
  ForEachCell(cells,
    [&](vtkIdType cell, vtkIdType count, const vtkIdType* points)
    {
      if (IsGhost(data, first + cell))
      {
        return;
      }
      if (!std::all_of(points, points + count,
            [data](vtkIdType point) { return IsFinite(GetPoint(data, point)); }))
      {
        ++selection.Removed;
        return;
      }
      for (vtkIdType i = tubes ? 1 : 0; i < count; ++i)
      {
        selection.Parts.push_back({ { points[tubes ? i - 1 : i], points[i] }, first + cell });
      }
    });
  return selection;
}

InstanceSelection SelectInstances(vtkPolyData* data)
{
  InstanceSelection selection;
  vtkFieldData* fields = data->GetFieldData();
  selection.IsPresent = fields->HasArray(vtkCSLFInstances::InstanceMatrix()) != 0;
  if (!selection.IsPresent)
  {
    return selection;
  }
  // Arrays of strings exist, but are null here.
  vtkDataArray* matrices = fields->GetArray(vtkCSLFInstances::InstanceMatrix());
  vtkDataArray* colors = fields->GetArray(vtkCSLFInstances::InstanceColor());
  const bool hasColors = fields->HasArray(vtkCSLFInstances::InstanceColor()) != 0;
  vtkDataArray* emissions = fields->GetArray(vtkCSLFInstances::InstanceEmission());
  const bool hasEmissions = fields->HasArray(vtkCSLFInstances::InstanceEmission()) != 0;
  selection.IsBroken = !matrices || matrices->GetNumberOfComponents() != 16 ||
    (hasColors &&
      (!colors || colors->GetNumberOfTuples() != matrices->GetNumberOfTuples() ||
        colors->GetDataType() != VTK_UNSIGNED_CHAR || colors->GetNumberOfComponents() < 3)) ||
    (hasEmissions &&
      (!emissions || emissions->GetNumberOfTuples() != matrices->GetNumberOfTuples() ||
        emissions->GetNumberOfComponents() != 3));
  vtkDataArray* scalars = fields->GetArray(vtkCSLFInstances::InstanceScalar());
  const bool hasScalars = !selection.IsBroken && scalars &&
    scalars->GetNumberOfTuples() == matrices->GetNumberOfTuples() &&
    scalars->GetNumberOfComponents() == 1;
  for (vtkIdType i = 0; !selection.IsBroken && i < matrices->GetNumberOfTuples(); ++i)
  {
    BlockInstance instance;
    if (!ReadMatrix(matrices, i, instance.ToWorld))
    {
      ++selection.Removed;
      continue;
    }
    if (!HasExtent(instance.ToWorld))
    {
      continue;
    }
    if (colors)
    {
      ReadColor(colors, i, instance);
    }
    if (emissions)
    {
      instance.Emission = GetRadiance(emissions, i);
      instance.HasEmission = true;
    }
    if (hasScalars)
    {
      instance.Scalar = scalars->GetTuple1(i);
      instance.HasScalar = true;
    }
    selection.Places.push_back(instance);
  }
  return selection;
}

bool SceneBlock::HasTextures() const
{
  return this->Textures.BaseColor || this->Textures.MetallicRoughness || this->Textures.Normal ||
    this->Textures.Emission;
}

void SceneBlock::AddTo(glm::dvec3& lower, glm::dvec3& upper, double margin) const
{
  if (this->Triangles.empty() && this->Round.empty())
  {
    return;
  }
  glm::dvec3 low(VTK_DOUBLE_MAX);
  glm::dvec3 high(VTK_DOUBLE_MIN);
  const auto add = [&](vtkIdType index)
  {
    const glm::dvec3 point = GetPoint(this->Data, index);
    low = glm::min(low, point - margin);
    high = glm::max(high, point + margin);
  };
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell : this->Triangles)
  {
    this->Data->GetPolys()->GetCellAtId(cell, corners);
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
    {
      add(corners->GetId(i));
    }
  }
  for (const RoundPart& part : this->Round)
  {
    add(part.Points[0]);
    add(part.Points[1]);
  }
  if (this->Instances.empty())
  {
    lower = glm::min(lower, low);
    upper = glm::max(upper, high);
    return;
  }
  for (const BlockInstance& instance : this->Instances)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::dvec4 point((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
        (corner & 4) != 0 ? high.z : low.z, 1.0);
      const glm::dvec3 placed(instance.ToWorld * point);
      lower = glm::min(lower, placed);
      upper = glm::max(upper, placed);
    }
  }
}

bool SceneBlock::HasRadii() const
{
  return FindRadii(*this) != nullptr;
}

double SceneBlock::GetRadius(vtkIdType point) const
{
  vtkDataArray* radii = FindRadii(*this);
  const double radius = radii ? radii->GetComponent(point, 0) : this->StandardRadius;
  return std::isfinite(radius) ? std::max(radius, 0.0) : 0.0;
}

double SceneBlock::GetLargestRadius() const
{
  double largest = 0.0;
  for (const RoundPart& part : this->Round)
  {
    largest =
      std::max({ largest, this->GetRadius(part.Points[0]), this->GetRadius(part.Points[1]) });
  }
  return largest;
}

vtkIdType SceneBlock::RemovePartsWithoutRadius()
{
  const auto hasNone = [this](const RoundPart& part)
  { return this->GetRadius(part.Points[0]) == 0.0 && this->GetRadius(part.Points[1]) == 0.0; };
  const auto end = std::remove_if(this->Round.begin(), this->Round.end(), hasNone);
  const auto removed = static_cast<vtkIdType>(this->Round.end() - end);
  this->Round.erase(end, this->Round.end());
  return removed;
}
}
