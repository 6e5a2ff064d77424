// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLocalLights.h"

#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"

#include <algorithm>
#include <cstring>

namespace cslf
{
namespace
{
// Up to this many lights, a float has enough bits to choose one and a point of it.
constexpr std::size_t MostForOne = 64;

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
  if (points.size() <= MostPoints)
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
  const double x = this->Emitters.size() > MostForOne ? AddBits(u) : double(u.x);
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
