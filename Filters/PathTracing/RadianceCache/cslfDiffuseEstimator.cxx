// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDiffuseEstimator.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <limits>

namespace cslf
{
namespace
{
// Samples whose mean counts as one observation of the noise.
constexpr int ChunkSize = 16;
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
    , Reflection(
        *Surface.Material, glm::vec3(1.0f), this->Local.ToLocal(this->Surface.GeometricNormal))
  {
  }
};

template <typename Sample>
SurfaceEstimate DiffuseEstimator::Average(const Hit& place, std::uint64_t key, Sample sample)
{
  SurfaceEstimate estimate;
  estimate.Reach = std::numeric_limits<float>::infinity();
  const Receiver receiver(this->World, place);
  if (!receiver.Reflection.HasDiffuse())
  {
    return estimate;
  }
  const std::uint64_t hash = MixBits(key, this->Limits.Seed);
  glm::dvec3 sum(0.0);
  glm::dvec3 sumOfSquares(0.0); // of chunks' means
  double nearness = 0.0;
  std::uint64_t rays = 0;
  int count = 0;
  for (int end = this->Limits.FirstSamples; end <= this->Limits.LastSamples; end *= 2)
  {
    while (count < end)
    {
      glm::dvec3 chunk(0.0);
      for (int i = 0; i < ChunkSize; ++i, ++count)
      {
        const SampleStream stream(hash, static_cast<std::uint32_t>(count));
        chunk += glm::dvec3(sample(receiver, stream, rays, nearness));
      }
      chunk /= ChunkSize;
      sum += chunk;
      sumOfSquares += chunk * chunk;
    }
    const double chunks = count / ChunkSize;
    const glm::dvec3 mean = sum / chunks;
    const glm::dvec3 variance =
      glm::max(sumOfSquares / chunks - mean * mean, 0.0) / std::max(chunks - 1.0, 1.0);
    const glm::dvec3 albedo = receiver.Reflection.DiffuseAlbedo();
    estimate.Value = mean / albedo;
    const glm::vec3 upper = (mean + glm::sqrt(variance)) / albedo;
    const glm::vec3 noise = this->Limits.Display(upper, receiver.Surface.BaseColor) -
      this->Limits.Display(estimate.Value, receiver.Surface.BaseColor);
    if (std::max({ noise.x, noise.y, noise.z }) < this->Limits.Noise)
    {
      break;
    }
  }
  if (nearness > 0.0)
  {
    estimate.Reach = static_cast<float>(count / nearness);
  }
  this->Rays.fetch_add(rays, std::memory_order_relaxed);
  return estimate;
}

SurfaceEstimate DiffuseEstimator::SampleLights(const Hit& place, std::uint64_t key)
{
  return this->Average(place, key,
    [this](const Receiver& receiver, const SampleStream& stream, std::uint64_t& rays, double&)
    {
      return this->Paths.GetLight().Sample(
        { receiver.Surface.LeavePosition, receiver.Local, receiver.Reflection, Lobes::Diffuse },
        stream, rays);
    });
}

SurfaceEstimate DiffuseEstimator::Gather(const Hit& place, std::uint64_t key)
{
  return this->Average(place, key,
    [this](const Receiver& receiver, const SampleStream& stream, std::uint64_t& rays,
      double& nearness) -> glm::vec3
    {
      BSDFSample sample;
      if (!receiver.Reflection.Sample(
            0.0f, stream.Get2D(Dimension::Direction), sample, Lobes::Diffuse))
      {
        return glm::vec3(0.0f);
      }
      PathIntegrator::Start start;
      start.First = { receiver.Surface.LeavePosition, receiver.Local.ToWorld(sample.Direction) };
      start.Seen = this->World.Intersect(start.First);
      start.Depth = 1;
      start.Pdf = sample.Pdf;
      ++rays;
      if (start.Seen.IsValid())
      {
        nearness += 1.0 / std::max(start.Seen.Distance, 1e-6f);
      }
      return sample.Weight * this->Paths.GetRadiance(start, stream, rays);
    });
}
}
