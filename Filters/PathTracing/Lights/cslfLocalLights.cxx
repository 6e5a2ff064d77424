// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLocalLights.h"

#include "PathTracing/Rays/cslfHitGeometry.h"
#include "PathTracing/Shapes/cslfRoundView.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace cslf
{
namespace
{
// Added to the cone of a spot light, in radians, so that rounding excludes nothing.
constexpr double SpotSlack = 1e-3;

/// The ratio of the densities of directions in the scene and in an instance's mesh, if they are
/// stretched by a factor.
float GetCrowding(const MeshInstance& instance, float stretch)
{
  const float size = GetSize(instance);
  const float part = stretch / size;
  return part * part * part / std::abs(glm::determinant(instance.Linear / size));
}

SphereView GetSphere(const Mesh& mesh, std::uint32_t sphere, const glm::vec3& from)
{
  return { from, mesh.Vertices[sphere], mesh.Radii[sphere] };
}
}

Emitter::Emitter(const Mesh& mesh, std::uint32_t shape, std::uint32_t instance)
  : Source(&mesh)
  , Place{ shape, 0.0f, 0.0f, instance }
{
  if (mesh.Shape == Mesh::Shapes::Triangles)
  {
    const glm::uvec3& corners = mesh.Triangles[shape];
    this->Corner = ToScene(mesh, instance, mesh.Vertices[corners.x]);
    this->EdgeU = ToScene(mesh, instance, mesh.Vertices[corners.y]) - this->Corner;
    this->EdgeV = ToScene(mesh, instance, mesh.Vertices[corners.z]) - this->Corner;
    this->Normal = glm::cross(this->EdgeU, this->EdgeV);
    const MeshInstance* placed = this->GetInstance();
    if (placed && glm::determinant(placed->Linear / GetSize(*placed)) < 0.0f)
    {
      this->Normal = -this->Normal; // a reflection keeps the front's side
    }
  }
}

const MeshInstance* Emitter::GetInstance() const
{
  return this->Place.Instance == TrianglePoint::None
    ? nullptr
    : &this->Source->Instances[this->Place.Instance];
}

float Emitter::GetImportance() const
{
  const MeshInstance* instance = this->GetInstance();
  return this->Source->GetEmissionImportance(this->Place.Triangle) *
    (instance ? instance->Opacity : 1.0f);
}

LightBounds Emitter::GetBounds() const
{
  if (this->Source)
  {
    return this->Source->Shape == Mesh::Shapes::Triangles ? this->GetTriangleBounds()
                                                          : this->GetRoundBounds();
  }
  LightBounds bounds;
  bounds.Lower = this->Point->Position;
  bounds.Upper = this->Point->Position;
  bounds.Power = Luminance(this->Point->Intensity);
  if (this->Point->Axis != glm::vec3(0.0f))
  {
    bounds.Kind = LightBounds::Kinds::Spots;
    bounds.Axis = this->Point->Axis;
    bounds.Angle =
      std::min(std::acos(double(this->Point->ConeCosine)) + SpotSlack, std::acos(-1.0));
  }
  return bounds;
}

LightBounds Emitter::GetTriangleBounds() const
{
  LightBounds bounds;
  const glm::vec3 ends[2] = { this->Corner + this->EdgeU, this->Corner + this->EdgeV };
  bounds.Lower = glm::min(this->Corner, glm::min(ends[0], ends[1]));
  bounds.Upper = glm::max(this->Corner, glm::max(ends[0], ends[1]));
  const glm::dvec3 normal(this->Normal);
  const double length = glm::length(normal);
  bounds.Power = 0.5 * length * this->GetImportance();
  if (length > 0.0)
  {
    bounds.Kind = LightBounds::Kinds::Surfaces;
    bounds.Axis = normal / length;
  }
  return bounds;
}

LightBounds Emitter::GetRoundBounds() const
{
  const Mesh& mesh = *this->Source;
  const bool isTube = mesh.Shape == Mesh::Shapes::Tubes;
  const MeshInstance* instance = this->GetInstance();
  const glm::mat3 rows = glm::transpose(instance ? instance->Linear : glm::mat3(1.0f));
  const std::size_t ends = isTube ? 2 : 1;
  const std::size_t first = ends * this->Place.Triangle;
  LightBounds bounds;
  for (std::size_t i = first; i < first + ends; ++i)
  {
    const glm::vec3 center = ToScene(mesh, this->Place.Instance, mesh.Vertices[i]);
    const glm::vec3 reach =
      mesh.Radii[i] * glm::vec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    bounds.Lower = glm::min(bounds.Lower, center - reach);
    bounds.Upper = glm::max(bounds.Upper, center + reach);
  }
  // A convex body shows a quarter of its surface, on average over all directions.
  double area = 0.0;
  if (isTube)
  {
    const Tube tube = GetTube(mesh, this->Place.Triangle);
    const double radius = tube.GetRadius(0.5f);
    area = Pi * (0.5 * radius * tube.Length + radius * radius);
  }
  else
  {
    area = Pi * double(mesh.Radii[first]) * mesh.Radii[first];
  }
  const double volume = std::abs(glm::determinant(glm::dmat3(rows)));
  bounds.Power = area * std::pow(volume, 2.0 / 3.0) * this->GetImportance();
  return bounds;
}

LightSample Emitter::Sample(const glm::vec3& from, const glm::vec2& u) const
{
  if (this->Point)
  {
    return this->Point->Sample(from);
  }
  return this->Source->Shape == Mesh::Shapes::Triangles ? this->SampleTriangle(from, u)
                                                        : this->SampleRound(from, u);
}

float Emitter::GetTrianglePdf(const glm::vec3& direction, float distance) const
{
  const float seen = std::abs(glm::dot(this->Normal, direction));
  return seen > 0.0f ? 2.0f * distance * distance / seen : 0.0f;
}

LightSample Emitter::SampleTriangle(const glm::vec3& from, const glm::vec2& u) const
{
  LightSample sample;
  const glm::vec2 point = cslf::SampleTriangle(u);
  const glm::vec3 path = this->Corner + point.x * this->EdgeU + point.y * this->EdgeV - from;
  const float distance = glm::length(path);
  const bool fromBack = glm::dot(this->Normal, path) > 0.0f;
  if (distance > 0.0f && !this->Source->Material.Hides(fromBack))
  {
    sample.Distance = distance;
    sample.Direction = path / distance;
    const TrianglePoint place{ this->Place.Triangle, point.x, point.y, this->Place.Instance };
    sample.Radiance = this->Source->GetOpacity(place) * this->Source->GetEmission(place);
    sample.Pdf = this->GetTrianglePdf(sample.Direction, distance);
  }
  return sample;
}

LightSample Emitter::SampleRound(const glm::vec3& from, const glm::vec2& u) const
{
  // An instance is sampled like its mesh, with the point transformed to the mesh's space.
  const Mesh& mesh = *this->Source;
  const MeshInstance* instance = this->GetInstance();
  const glm::vec3 place = instance ? InvertLinear(*instance) * (from - instance->Offset) : from;
  RoundSample round = mesh.Shape == Mesh::Shapes::Tubes
    ? TubeView(place, GetTube(mesh, this->Place.Triangle)).Sample(u)
    : GetSphere(mesh, this->Place.Triangle, place).Sample(u);
  LightSample sample;
  if (!(round.Pdf > 0.0f))
  {
    return sample;
  }
  sample.Direction = round.Direction;
  sample.Distance = round.Distance;
  sample.Pdf = round.Pdf;
  if (instance)
  {
    const glm::vec3 path = instance->Linear * round.Direction;
    const float stretch = glm::length(path);
    sample.Direction = path / stretch;
    sample.Distance *= stretch;
    sample.Pdf *= GetCrowding(*instance, stretch);
  }
  const TrianglePoint point{ this->Place.Triangle, round.Along, 0.0f, this->Place.Instance };
  sample.Radiance = mesh.GetOpacity(point) * mesh.GetEmission(point);
  return sample;
}

float Emitter::GetPdf(const glm::vec3& from, const glm::vec3& direction, float distance) const
{
  const Mesh& mesh = *this->Source;
  if (mesh.Shape == Mesh::Shapes::Triangles)
  {
    return this->GetTrianglePdf(direction, distance);
  }
  glm::vec3 place = from;
  glm::vec3 path = distance * direction;
  float scale = 1.0f;
  if (const MeshInstance* instance = this->GetInstance())
  {
    const glm::mat3 inverse = InvertLinear(*instance);
    place = inverse * (from - instance->Offset);
    path = inverse * path;
    scale = GetCrowding(*instance, distance / glm::length(path));
  }
  return scale *
    (mesh.Shape == Mesh::Shapes::Tubes ? TubeView(place, GetTube(mesh, this->Place.Triangle))
                                           .GetPdf(glm::normalize(path), glm::length(path))
                                       : GetSphere(mesh, this->Place.Triangle, place).GetPdf());
}

namespace
{
// Up to this many lights, a float has enough bits to choose one and a point of it.
constexpr std::size_t MaximumForOne = 64;

/// A number in [0,1) with more bits than the first of a pair, because choosing among many lights
/// uses up the bits. The added part is below the last bit.
double AddBits(const glm::vec2& u)
{
  std::uint32_t bits[2];
  std::memcpy(&bits[0], &u.x, sizeof(u.x));
  std::memcpy(&bits[1], &u.y, sizeof(u.y));
  const std::uint64_t hash = MixBits(bits[0], bits[1]);
  return double(u.x) + static_cast<double>(hash >> 40) * 0x1p-48;
}
}

LocalLights::LocalLights(const std::vector<Mesh>& meshes, const std::vector<PointLight>& points)
  : Indices(meshes.size())
  , ShapeCounts(meshes.size(), 0)
{
  std::vector<LightBounds> bounds;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const Mesh& mesh = meshes[i];
    if (!mesh.Material.IsEmissive() || mesh.Material.Unlit)
    {
      continue;
    }
    this->ShapeCounts[i] = mesh.GetNumberOfShapes();
    const std::size_t places = std::max<std::size_t>(mesh.Instances.size(), 1);
    for (std::uint32_t place = 0; place < places; ++place)
    {
      const std::uint32_t instance = mesh.Instances.empty() ? TrianglePoint::None : place;
      this->AddShapes(mesh, instance, this->Indices[i], bounds);
    }
  }
  this->SurfaceCount = this->Emitters.size();
  if (points.size() <= MaximumPoints)
  {
    this->Few = points;
  }
  else
  {
    this->AddPoints(points, bounds);
  }
  this->Tree = LightTree(bounds);
}

void LocalLights::AddShapes(const Mesh& mesh, std::uint32_t instance,
  std::vector<std::uint32_t>& indices, std::vector<LightBounds>& bounds)
{
  for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
  {
    const Emitter emitter(mesh, shape, instance);
    const LightBounds reach = emitter.GetBounds();
    indices.push_back(reach.IsEmpty() ? None : static_cast<std::uint32_t>(bounds.size()));
    if (!reach.IsEmpty())
    {
      this->Emitters.push_back(emitter);
      bounds.push_back(reach);
    }
  }
}

void LocalLights::AddPoints(const std::vector<PointLight>& points, std::vector<LightBounds>& bounds)
{
  for (const PointLight& point : points)
  {
    const Emitter emitter(point);
    const LightBounds reach = emitter.GetBounds();
    if (!reach.IsEmpty())
    {
      this->Emitters.push_back(emitter);
      bounds.push_back(reach);
    }
  }
}

LightSample LocalLights::Sample(const LightReceiver& receiver, const glm::vec2& u) const
{
  const double x = this->Emitters.size() > MaximumForOne ? AddBits(u) : double(u.x);
  const LightTree::Choice choice = this->Tree.Sample(receiver, x);
  if (!(choice.Probability > 0.0))
  {
    return {};
  }
  const float rest = std::min(static_cast<float>(choice.Remainder), BelowOne);
  LightSample sample = this->Emitters[choice.Light].Sample(receiver.Position, { rest, u.y });
  const auto probability = static_cast<float>(choice.Probability);
  if (choice.Light < this->SurfaceCount)
  {
    sample.Pdf *= probability;
  }
  else
  {
    sample.Radiance /= probability;
  }
  return sample;
}

float LocalLights::GetPdf(
  const LightReceiver& receiver, const glm::vec3& direction, const Hit& hit) const
{
  const std::vector<std::uint32_t>& indices = this->Indices[hit.Mesh];
  if (indices.empty())
  {
    return 0.0f;
  }
  const std::size_t instance = hit.Instance == TrianglePoint::None ? 0 : hit.Instance;
  const std::uint32_t light = indices[instance * this->ShapeCounts[hit.Mesh] + hit.Triangle];
  if (light == None)
  {
    return 0.0f;
  }
  const double choice = this->Tree.GetProbability(receiver, light);
  return choice > 0.0 ? static_cast<float>(choice) *
      this->Emitters[light].GetPdf(receiver.Position, direction, hit.Distance)
                      : 0.0f;
}
}
