// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMesh.h"

#include "PathTracing/Materials/cslfDisplayedColor.h"
#include "Pipeline/cslfColorMap.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfColor.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// The number of points from which a triangle's emission is estimated, along each side of a square,
// and the number along a tube.
constexpr int EmissionSamples = 8;
}

std::uint32_t Mesh::GetNumberOfShapes() const
{
  switch (this->Shape)
  {
    case Shapes::Spheres:
      return static_cast<std::uint32_t>(this->Vertices.size());
    case Shapes::Tubes:
      return static_cast<std::uint32_t>(this->Vertices.size() / 2);
    default:
      return static_cast<std::uint32_t>(this->Triangles.size());
  }
}

float Mesh::GetLongestEdge(std::uint32_t triangle) const
{
  const glm::uvec3& corners = this->Triangles[triangle];
  const glm::vec3& a = this->Vertices[corners.x];
  const glm::vec3& b = this->Vertices[corners.y];
  const glm::vec3& c = this->Vertices[corners.z];
  return std::max({ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) });
}

float Mesh::GetArea(std::uint32_t triangle) const
{
  const glm::uvec3& corners = this->Triangles[triangle];
  const glm::vec3& a = this->Vertices[corners.x];
  return 0.5f *
    glm::length(glm::cross(this->Vertices[corners.y] - a, this->Vertices[corners.z] - a));
}

bool Mesh::HasOneColor() const
{
  return this->NeutralAlbedo < 0.0f && (this->Colors.empty() || this->Coloring == ColorsOf::None) &&
    !this->HasInstanceColors && !this->Textures.BaseColor;
}

glm::vec3 Mesh::GetColor(const TrianglePoint& point) const
{
  if (this->HasInstanceColors)
  {
    return this->Instances[point.Instance].Color;
  }
  if (this->Colors.empty() || this->Coloring == ColorsOf::None)
  {
    return this->Material.BaseColor;
  }
  if (this->Coloring == ColorsOf::Triangles)
  {
    return this->Colors[point.Triangle];
  }
  const glm::vec3 color = this->Interpolate(this->Colors, point);
  return this->HoldsDisplayed() ? FromDisplayed(color) / this->DisplayedWhite : color;
}

bool Mesh::CanHaveMap() const
{
  return !this->HasInstanceEmissions && this->EmissionsOf == ColorsOf::None &&
    !this->Textures.Emission && this->Material.Emission == glm::vec3(0.0f) &&
    (this->Material.Unlit || this->Material.IsLambertian());
}

const ColorMap* Mesh::FindMap() const
{
  return this->Map && this->CanHaveMap() && this->Map->IsOpaque() ? this->Map.get() : nullptr;
}

const Texture* Mesh::FindImage() const
{
  const Texture* texture = this->Textures.BaseColor.get();
  const bool isAlone = !this->Map && this->Coloring == ColorsOf::None && !this->HasInstanceColors &&
    this->Shape == Shapes::Triangles;
  return texture && isAlone && this->CanHaveMap() && !texture->IsTranslucent() ? texture : nullptr;
}

glm::vec2 Mesh::GetMapPlace(const TrianglePoint& point) const
{
  if (this->Map->IsOneColor)
  {
    return this->Map->GetPlace(0.0);
  }
  if (this->HasInstanceColors)
  {
    return this->Instances[point.Instance].MapPlace;
  }
  if (!this->MapPlaces.empty())
  {
    return this->Coloring == ColorsOf::Triangles ? this->MapPlaces[point.Triangle]
                                                 : this->Interpolate(this->MapPlaces, point);
  }
  const glm::vec2 place = this->Interpolate(this->TexCoords, point);
  return { place.x * static_cast<float>(this->Map->Colors.size()), place.y > 0.5f ? 1.0f : 0.0f };
}

glm::vec3 Mesh::GetMapFactor() const
{
  return this->Coloring == ColorsOf::None && !this->HasInstanceColors && !this->Map->IsOneColor
    ? this->Material.BaseColor
    : glm::vec3(1.0f);
}

glm::vec3 Mesh::GetBaseColor(const TrianglePoint& point) const
{
  if (this->NeutralAlbedo >= 0.0f)
  {
    return glm::vec3(this->NeutralAlbedo);
  }
  const glm::vec3 color = this->GetColor(point);
  return this->Textures.BaseColor
    ? color * glm::vec3(this->Textures.BaseColor->Get(this->Interpolate(this->TexCoords, point)))
    : color;
}

float Mesh::MeasureAlbedo() const
{
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  const auto count = static_cast<std::uint32_t>(
    this->HasInstanceColors ? this->Instances.size() : this->GetNumberOfShapes());
  for (std::uint32_t i = 0; i < count; ++i)
  {
    TrianglePoint point;
    point.Instance = this->HasInstanceColors ? i : TrianglePoint::None;
    point.Triangle = this->HasInstanceColors ? 0 : i;
    point.U = this->Shape == Shapes::Triangles ? 1.0f / 3.0f : 0.5f;
    point.V = point.U;
    const double weight =
      this->Shape == Shapes::Triangles && !this->HasInstanceColors ? this->GetArea(i) : 1.0;
    sum += weight * glm::dvec3(this->GetBaseColor(point));
    weights += weight;
  }
  return weights > 0.0 ? static_cast<float>(glm::dot(sum / weights, LuminanceWeights)) : 0.0f;
}

MaterialPoint Mesh::GetMaterialPoint(const TrianglePoint& point) const
{
  MaterialPoint result{ this->GetBaseColor(point), this->Material.Metallic, this->Material.Alpha };
  if (this->Textures.MetallicRoughness)
  {
    const glm::vec4 factors =
      this->Textures.MetallicRoughness->Get(this->Interpolate(this->TexCoords, point));
    result.Metallic = this->Material.Metallic * factors.z;
    result.Alpha = SurfaceMaterial::ToAlpha(this->Material.Roughness * factors.y);
  }
  return result;
}

bool Mesh::IsTranslucent() const
{
  const bool instances = std::any_of(this->Instances.begin(), this->Instances.end(),
    [](const MeshInstance& instance) { return instance.Opacity < 1.0f; });
  return instances || this->Material.Opacity < 1.0f || !this->Opacities.empty() ||
    (this->Textures.BaseColor && this->Textures.BaseColor->IsTranslucent());
}

float Mesh::GetOpacity(const TrianglePoint& point) const
{
  float opacity = this->Material.Opacity;
  if (!this->Opacities.empty() && this->Coloring != ColorsOf::None)
  {
    opacity *= this->Coloring == ColorsOf::Vertices ? this->Interpolate(this->Opacities, point)
                                                    : this->Opacities[point.Triangle];
  }
  if (this->Textures.BaseColor && this->Textures.BaseColor->IsTranslucent())
  {
    opacity *= this->Textures.BaseColor->Get(this->Interpolate(this->TexCoords, point)).w;
  }
  if (point.Instance != TrianglePoint::None)
  {
    opacity *= this->Instances[point.Instance].Opacity;
  }
  const float cutoff = this->Material.OpacityCutoff;
  return cutoff > 0.0f ? (opacity < cutoff ? 0.0f : 1.0f) : opacity;
}

glm::vec3 Mesh::GetEmissionFactor(const TrianglePoint& point) const
{
  if (this->HasInstanceEmissions && point.Instance != TrianglePoint::None)
  {
    return this->Instances[point.Instance].Emission;
  }
  switch (this->EmissionsOf)
  {
    case ColorsOf::Vertices:
    {
      const glm::vec3 emission = this->Interpolate(this->Emissions, point);
      return this->HoldsDisplayed() ? FromDisplayed(emission) : emission;
    }
    case ColorsOf::Triangles:
      return this->Emissions[point.Triangle];
    default:
      return this->Material.Emission;
  }
}

glm::vec3 Mesh::GetEmission(const TrianglePoint& point) const
{
  glm::vec3 emission = this->GetEmissionFactor(point);
  if (this->Textures.Emission)
  {
    emission *= glm::vec3(this->Textures.Emission->Get(this->Interpolate(this->TexCoords, point)));
  }
  return this->Material.Unlit ? emission + this->GetBaseColor(point) : emission;
}

void Mesh::PrepareRounding()
{
  this->LengthsOfRounding.clear();
  this->LengthsOfRounding.reserve(this->Triangles.size());
  for (std::uint32_t triangle = 0; triangle < this->Triangles.size(); ++triangle)
  {
    const float edge = this->GetLongestEdge(triangle);
    const float area = this->GetArea(triangle);
    this->LengthsOfRounding.push_back(area > 0.0f ? 0.5f * edge * edge * edge / area : 0.0f);
  }
}

void Mesh::PrepareEmission()
{
  this->EmissionImportances.clear();
  if (this->Material.IsEmissive() && !this->Material.Unlit &&
    (this->Textures.Emission || this->IsTranslucent() || this->EmissionsOf != ColorsOf::None))
  {
    const std::uint32_t count = this->GetNumberOfShapes();
    this->EmissionImportances.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      this->EmissionImportances.push_back(this->EstimateEmission(i));
    }
  }
}

float Mesh::GetEmissionImportance(std::uint32_t shape) const
{
  return this->EmissionImportances.empty() ? Luminance(this->Material.Emission)
                                           : this->EmissionImportances[shape];
}

float Mesh::EstimateEmission(std::uint32_t shape) const
{
  const bool isPlain = !this->Textures.Emission && !this->IsTranslucent();
  const auto get = [&](float u, float v) { return Luminance(this->GetEmission({ shape, u, v })); };
  if (isPlain && this->HoldsDisplayed() && this->EmissionsOf == ColorsOf::Vertices)
  {
    // Light is about the square of displayed values. These rules integrate it exactly.
    return this->Shape == Shapes::Triangles
      ? (get(0.5f, 0.0f) + get(0.0f, 0.5f) + get(0.5f, 0.5f)) / 3.0f
      : (get(0.0f, 0.0f) + 4.0f * get(0.5f, 0.0f) + get(1.0f, 0.0f)) / 6.0f;
  }
  if (isPlain)
  {
    // The mean of linear values is the value in the middle.
    const float middle = this->Shape == Shapes::Triangles ? 1.0f / 3.0f : 0.5f;
    return get(middle, middle);
  }
  const int rows = this->Shape == Shapes::Triangles ? EmissionSamples : 1;
  const int columns = this->Shape == Shapes::Spheres ? 1 : EmissionSamples;
  float sum = 0.0f;
  for (int i = 0; i < rows * columns; ++i)
  {
    glm::vec2 place =
      (glm::vec2(i % columns, i / columns) + 0.5f) / glm::vec2(float(columns), float(rows));
    place = this->Shape == Shapes::Triangles ? SampleTriangle(place) : place;
    const TrianglePoint point{ shape, place.x, place.y };
    sum += this->GetOpacity(point) * Luminance(this->GetEmission(point));
  }
  return sum / static_cast<float>(rows * columns);
}

glm::vec3 Mesh::BendNormal(
  const glm::vec3& normal, const glm::vec3 edges[2], const TrianglePoint& point) const
{
  // The directions in which the texture's coordinates grow, along the surface.
  const glm::uvec3& corners = this->Triangles[point.Triangle];
  const glm::vec2 steps[2] = { this->TexCoords[corners.y] - this->TexCoords[corners.x],
    this->TexCoords[corners.z] - this->TexCoords[corners.x] };
  const float turn = steps[0].x * steps[1].y - steps[0].y * steps[1].x;
  const float side = std::copysign(1.0f, turn);
  const glm::vec3 alongU = side * (steps[1].y * edges[0] - steps[0].y * edges[1]);
  const glm::vec3 alongV = side * (steps[0].x * edges[1] - steps[1].x * edges[0]);
  const glm::vec3 z = glm::normalize(normal);
  const glm::vec3 tangent = alongU - glm::dot(alongU, z) * z;
  const float length = glm::length(tangent);
  if (turn == 0.0f || !(length > 0.0f))
  {
    return normal;
  }
  const glm::vec3 x = tangent / length;
  glm::vec3 y = glm::cross(z, x);
  y = glm::dot(y, alongV) < 0.0f ? -y : y;

  const glm::vec3 bent =
    2.0f * glm::vec3(this->Textures.Normal->Get(this->Interpolate(this->TexCoords, point))) - 1.0f;
  const float scale = this->Material.NormalScale;
  return scale * bent.x * x + scale * bent.y * y + bent.z * z;
}
}
