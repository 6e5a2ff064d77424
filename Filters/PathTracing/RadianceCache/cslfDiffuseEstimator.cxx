// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDiffuseEstimator.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

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
  const glm::dvec3 albedo = receiver.Reflection.DiffuseAlbedo();
  std::vector<glm::dvec3> sums; // of BlockSize samples each
  double nearness = 0.0;
  std::uint64_t rays = 0;
  int count = 0;
  for (int end = this->Limits.FirstSamples; end <= this->Limits.LastSamples; end *= 2)
  {
    while (count < end)
    {
      glm::dvec3 sum(0.0);
      for (int i = 0; i < BlockSize; ++i, ++count)
      {
        const SampleStream stream(hash, static_cast<std::uint32_t>(count));
        sum += glm::dvec3(sample(receiver, stream, rays, nearness));
      }
      sums.push_back(sum / albedo);
    }
    glm::dvec3 error;
    estimate.Value = Mean(sums, count, error);
    const glm::vec3 noise =
      this->Limits.Display(glm::dvec3(estimate.Value) + error, receiver.Surface.BaseColor) -
      this->Limits.Display(estimate.Value, receiver.Surface.BaseColor);
    estimate.Noise = std::max({ noise.x, noise.y, noise.z });
    if (estimate.Noise < this->Limits.Noise)
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
        { receiver.Surface, receiver.Local, receiver.Reflection, Lobes::Diffuse }, stream, rays);
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
      start.Depth = this->Limits.Depth;
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
