// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDiffuseEstimator.h"

#include "PathTracing/cslfSampling.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace cslf
{
namespace
{
// Samples that are added up before anything is asked; a power of two.
constexpr int BlockSize = 8;

// The parts of a sequence whose means tell its noise. Each is a low-discrepancy sequence itself;
// all together are better than their differences tell.
constexpr int Parts = 8;

// The part of what a point sees that may be nearer than its reach: where a flat angle is seen from
// its edge, little of it, and of what it adds to the light.
constexpr float NearShare = 1.0f / 32.0f;

MaterialPoint MakeWhite(const SurfaceHit& surface)
{
  MaterialPoint point = surface.GetMaterialPoint();
  point.BaseColor = glm::vec3(1.0f);
  return point;
}

/// The mean of `count` samples, and its standard error.
glm::dvec3 Mean(const std::vector<glm::dvec3>& sums, int count, glm::dvec3& error)
{
  const std::size_t length = sums.size() / Parts;
  glm::dvec3 total(0.0);
  glm::dvec3 squares(0.0);
  for (std::size_t part = 0; part < Parts; ++part)
  {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < length; ++i)
    {
      sum += sums[part * length + i];
    }
    total += sum;
    squares += sum * sum;
  }
  const glm::dvec3 variance =
    glm::max(squares - total * total / double(Parts), 0.0) / (Parts - 1.0);
  error = glm::sqrt(variance * double(Parts)) / double(count);
  return total / double(count);
}
}

/// A point of the surface as a white one.
struct DiffuseEstimator::Receiver
{
  SurfaceHit Surface;
  Frame Local;
  BSDF Reflection;

  Receiver(const Scene& scene, const Hit& place)
    : Surface(scene.GetSurface(place))
    , Local(Surface.ShadingNormal)
    , Reflection(*Surface.Material, MakeWhite(Surface),
        this->Local.ToLocal(this->Surface.GeometricNormal), this->Surface.Inside)
  {
  }
};

/// What is known of a point so far.
struct DiffuseEstimator::Samples
{
  std::vector<glm::dvec3> Sums; // of BlockSize samples each
  IncidentFit Incident;
  bool FitsIncident = false;
  std::vector<float> Distances; // of what was seen, in any order
  std::uint64_t Rays = 0;
};

template <typename Add>
SurfaceEstimate DiffuseEstimator::Average(const Hit& place, std::uint64_t key, Add add)
{
  SurfaceEstimate estimate;
  estimate.Reach = std::numeric_limits<float>::infinity();
  const Receiver receiver(this->World, place);
  if (!receiver.Reflection.HasDiffuse())
  {
    return estimate;
  }
  const std::uint64_t hash = MixBits(key, this->Limits.Seed);
  Samples samples;
  const GlossyLobe* lobe = this->Limits.Lobes.empty() ? nullptr : &this->Limits.Lobes[place.Mesh];
  samples.FitsIncident = lobe && lobe->IsKnown();
  int count = 0;
  for (int end = this->Limits.FirstSamples; end <= this->Limits.LastSamples; end *= 2)
  {
    samples.Sums.resize(end / BlockSize, glm::dvec3(0.0));
    add(receiver, hash, count, end, samples);
    count = end;
    glm::dvec3 error;
    estimate.Value = Mean(samples.Sums, count, error);
    const glm::vec3 noise =
      this->Limits.Display(glm::dvec3(estimate.Value) + error, receiver.Surface.BaseColor) -
      this->Limits.Display(estimate.Value, receiver.Surface.BaseColor);
    estimate.Noise = std::max({ noise.x, noise.y, noise.z });
    if (estimate.Noise < this->Limits.Noise)
    {
      break;
    }
  }
  const auto near = static_cast<std::size_t>(NearShare * static_cast<float>(count));
  if (near < samples.Distances.size())
  {
    const auto reach = samples.Distances.begin() + static_cast<std::ptrdiff_t>(near);
    std::nth_element(samples.Distances.begin(), reach, samples.Distances.end());
    estimate.Reach = *reach;
  }
  if (samples.FitsIncident)
  {
    estimate.Incident = samples.Incident.Solve(receiver.Local, lobe->GetSize());
  }
  this->Rays.fetch_add(samples.Rays, std::memory_order_relaxed);
  return estimate;
}

SurfaceEstimate DiffuseEstimator::SampleLights(const Hit& place, std::uint64_t key)
{
  return this->Average(place, key,
    [this](const Receiver& receiver, std::uint64_t hash, int begin, int end, Samples& samples)
    {
      const glm::dvec3 albedo = receiver.Reflection.DiffuseAlbedo();
      const ScatteringPoint point{ receiver.Surface, receiver.Local, receiver.Reflection,
        Lobes::Diffuse };
      for (int i = begin; i < end; ++i)
      {
        const SampleStream stream(hash, static_cast<std::uint32_t>(i));
        samples.Sums[i / BlockSize] +=
          glm::dvec3(this->Paths.GetLight().Sample(point, stream, samples.Rays)) / albedo;
      }
    });
}

SurfaceEstimate DiffuseEstimator::Gather(const Hit& place, std::uint64_t key)
{
  return this->Average(place, key,
    [this](const Receiver& receiver, std::uint64_t hash, int begin, int end, Samples& samples)
    { this->LookAround(receiver, hash, begin, end, samples); });
}

void DiffuseEstimator::LookAround(
  const Receiver& receiver, std::uint64_t hash, int begin, int end, Samples& samples) const
{
  RayPacket packet;
  std::fill_n(packet.Active, RayPacket::Size, -1);
  std::fill_n(packet.Query.ray.org_x, RayPacket::Size, receiver.Surface.LeavePosition.x);
  std::fill_n(packet.Query.ray.org_y, RayPacket::Size, receiver.Surface.LeavePosition.y);
  std::fill_n(packet.Query.ray.org_z, RayPacket::Size, receiver.Surface.LeavePosition.z);
  for (int i = begin; i < end; i += RayPacket::Size)
  {
    const Frame frame = GatherDirections::Turn(receiver.Local, hash, i);
    const GatherDirections::Packet& local = this->Directions.Get(hash, i);
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      const float x = local.X[lane];
      const float y = local.Y[lane];
      const float z = local.Z[lane];
      packet.Query.ray.dir_x[lane] = x * frame.X.x + y * frame.Y.x + z * frame.Z.x;
      packet.Query.ray.dir_y[lane] = x * frame.X.y + y * frame.Y.y + z * frame.Z.y;
      packet.Query.ray.dir_z[lane] = x * frame.X.z + y * frame.Y.z + z * frame.Z.z;
    }
    this->World.Intersect(packet);
    samples.Rays += RayPacket::Size;
    PacketRadiance light;
    alignas(64) int known[RayPacket::Size];
    this->Known.Get(packet, light, known);
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      const int index = i / GatherDirections::Length * GatherDirections::Length + local.Index[lane];
      if (!known[lane])
      {
        light.Set(lane,
          this->Follow(packet, lane, local.Z[lane] * InversePi,
            receiver.Surface.GetReceiver().Normal,
            SampleStream(hash, static_cast<std::uint32_t>(index)), samples.Rays));
      }
      if (packet.IsHit(lane))
      {
        samples.Distances.push_back(packet.Query.ray.tfar[lane]);
      }
      const glm::vec3 radiance(light.Red[lane], light.Green[lane], light.Blue[lane]);
      if (samples.FitsIncident &&
        samples.Incident.GetNumberOfSamples() < std::size_t(GatherDirections::Length))
      {
        const glm::vec3 direction = packet.GetRay(lane).Direction;
        samples.Incident.Add(
          { glm::dot(direction, receiver.Local.X), glm::dot(direction, receiver.Local.Y) },
          radiance);
      }
      const float weight = receiver.Reflection.DiffuseTransmission(local.Z[lane]);
      samples.Sums[index / BlockSize] += glm::dvec3(weight * radiance);
    }
  }
}

glm::vec3 DiffuseEstimator::Follow(const RayPacket& packet, int lane, float pdf,
  const glm::vec3& normal, const SampleStream& stream, std::uint64_t& rays) const
{
  return this->Paths.GetRadiance(
    { packet.GetRay(lane), packet.GetHit(lane), this->Limits.Depth, pdf, normal, true }, stream,
    rays);
}
}
