// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfVolumeSet.h"

#include "RandomNumbers/cslfSampleStream.h"
#include "SIMD/cslfVectorize.h"
#include "cslfColor.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// Rays end where less of the light than this passes: below half a level of 8 bits.
constexpr float LeastTransmittance = 1.0f / 1024.0f;

// The steps that find a depth, in those that find colours.
constexpr float DepthStep = 2.0f;

// The most steps along a ray, and the shortest as a share of its length.
constexpr float MaximumSteps = 65536.0f;
constexpr float LeastStep = 1e-6f;

// Tracking of light goes on at random below this transmittance.
constexpr float RouletteTransmittance = 0.1f;

/// 1 - exp(-x) for x >= 0, to a few roundings of 1, in arithmetic that compilers vectorise. The
/// polynomial is 2^x in [0,1], exact at both ends, with a relative error of 1e-7.
inline float GetOpacity(float depth)
{
  const float power = depth < 80.0f ? -1.44269504f * depth : -115.0f;
  const float whole = static_cast<float>(static_cast<int>(power) - 1);
  const float x = power - whole; // in [0,1]
  const float value = 1.0f +
    x *
      (0.69315174f +
        x * (0.24015927f + x * (0.055818676f + x * (0.0089909959f + x * 0.0018793183f))));
  const std::int32_t bits = (static_cast<std::int32_t>(whole) + 127) << 23;
  float scale;
  std::memcpy(&scale, &bits, sizeof(scale));
  // Differences from 1 are not precise where there is little.
  const float thin = depth * (1.0f - depth * (0.5f - depth * (1.0f / 6.0f)));
  return depth < 0.02f ? thin : 1.0f - value * scale;
}

/// The state of integration along a packet of rays.
struct SumLanes
{
  Vec3Lanes Light; // displayed
  Lanes<float> Transmittance;

  SumLanes()
  {
    Clear(this->Light);
    std::fill_n(this->Transmittance.Values, LaneCount, 1.0f);
  }
};

CSLF_VECTORIZE void Composite(const MediumLanes& medium, const Lanes<float>& steps, SumLanes& sums)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const float extinction = medium.Extinction[i];
    const float opacity = GetOpacity(extinction * steps[i]);
    const float inverse = extinction > 0.0f ? 1.0f / extinction : 0.0f;
    const float weight = sums.Transmittance[i] * opacity;
    sums.Light.Set(i, sums.Light.Get(i) + weight * inverse * medium.Light.Get(i));
    sums.Transmittance[i] -= weight;
  }
}

/// Ends rays where hardly any light passes.
CSLF_VECTORIZE void EndWhereDark(const SumLanes& sums, LaneMask& active)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    active[i] = sums.Transmittance[i] > LeastTransmittance ? active[i] : 0;
  }
}

/// The steps of rays.
struct StepLanes
{
  LaneMask Active;
  Lanes<float> At;     // where they begin
  Lanes<float> Length; // of each
  Lanes<float> End;    // of the last one
  Lanes<float> Steps;  // 0 for rays that have ended
  Lanes<float> Middles;

  void Begin(int lane, float near, float end, float longest)
  {
    const bool isActive = near < end;
    this->Active[lane] = isActive ? -1 : 0;
    this->At[lane] = isActive ? near : 0.0f;
    this->End[lane] = end;
    // Not so short that they would be lost in rounding.
    const float most = std::min(MaximumSteps, std::max((end - near) / (LeastStep * end), 1.0f));
    const float count = std::min(std::ceil((end - near) / longest), std::floor(most));
    this->Length[lane] = isActive ? (end - near) / std::max(count, 1.0f) : 0.0f;
  }
};

CSLF_VECTORIZE void FindMiddles(const Lanes<float>& shifts, StepLanes& steps)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    steps.Steps[i] = steps.Active[i] != 0 ? steps.Length[i] : 0.0f;
    steps.Middles[i] = steps.At[i] + shifts[i] * steps.Length[i];
  }
}

CSLF_VECTORIZE void Advance(StepLanes& steps)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    steps.At[i] += steps.Steps[i];
    const bool isBefore = steps.At[i] + 0.5f * steps.Length[i] < steps.End[i];
    steps.Active[i] = isBefore ? steps.Active[i] : 0;
  }
}

/// Random numbers of one ray.
class RaySequence
{
public:
  explicit RaySequence(std::uint64_t seed)
    : State(seed)
  {
  }

  /// In [0,1).
  float Next()
  {
    this->State = MixBits(this->State, 1);
    return static_cast<float>(this->State >> 40) * 0x1p-24f;
  }

  /// An optical depth.
  float NextDepth() { return -std::log1p(-this->Next()); }

private:
  std::uint64_t State;
};

/// Identifies a ray.
std::uint64_t HashRay(const Ray& ray)
{
  std::uint32_t bits[6];
  std::memcpy(&bits[0], &ray.Origin.x, sizeof(float));
  std::memcpy(&bits[1], &ray.Origin.y, sizeof(float));
  std::memcpy(&bits[2], &ray.Origin.z, sizeof(float));
  std::memcpy(&bits[3], &ray.Direction.x, sizeof(float));
  std::memcpy(&bits[4], &ray.Direction.y, sizeof(float));
  std::memcpy(&bits[5], &ray.Direction.z, sizeof(float));
  std::uint64_t hash = 0;
  for (int i = 0; i < 6; i += 2)
  {
    hash = MixBits(hash, (std::uint64_t(bits[i]) << 32) | bits[i + 1]);
  }
  return hash;
}

/// A parameter after a step, which is another one however short the step is.
float Proceed(float at, float step)
{
  return std::max(at + step, std::nextafter(at, std::numeric_limits<float>::infinity()));
}

/// Calls `visit(at, bound)` for the tentative collisions of a ray with a volume, in their order,
/// with a bound of the extinction there, until it returns false.
template <typename Visit>
void ForEachCollision(const Volume& volume, const Ray& ray, float near, float far,
  RaySequence& numbers, const Visit& visit)
{
  float depth = numbers.NextDepth();
  const float rate = volume.GetRate(ray.Direction);
  volume.ForEachPart(ray, near, far,
    [&](float begin, float end, float bound)
    {
      const float majorant = rate * bound;
      float at = begin;
      while (majorant > 0.0f)
      {
        const float step = depth / majorant;
        if (at + step >= end)
        {
          depth -= (end - at) * majorant;
          return true;
        }
        at = Proceed(at, step);
        depth = numbers.NextDepth();
        if (!visit(at, bound))
        {
          return false;
        }
      }
      return true;
    });
}

/// A ray's share of light that a volume lets through (ratio tracking: Novak, Selle and Jarosz, ACM
/// TOG 33(6), 2014).
float TrackRatio(const Volume& volume, const Ray& ray, float near, float far, RaySequence& numbers)
{
  float transmittance = 1.0f;
  ForEachCollision(volume, ray, near, far, numbers,
    [&](float at, float bound)
    {
      glm::vec3 color;
      transmittance *= 1.0f - volume.Get(ray.Origin + at * ray.Direction, color) / bound;
      if (transmittance >= RouletteTransmittance)
      {
        return true;
      }
      const float survival = std::max(transmittance / RouletteTransmittance, 0.0f);
      const bool survives = numbers.Next() < survival;
      transmittance = survives ? RouletteTransmittance : 0.0f;
      return survives;
    });
  return transmittance;
}

/// The first real collision of a ray with a volume; infinite if there is none.
float TrackDelta(const Volume& volume, const Ray& ray, float near, float far, RaySequence& numbers,
  glm::vec3& color)
{
  float found = std::numeric_limits<float>::infinity();
  ForEachCollision(volume, ray, near, far, numbers,
    [&](float at, float bound)
    {
      const float extinction = volume.Get(ray.Origin + at * ray.Direction, color);
      const bool isReal = numbers.Next() * bound < extinction;
      found = isReal ? at : found;
      return !isReal;
    });
  return found;
}
}

VolumeSet::VolumeSet(std::vector<Volume> volumes)
  : Volumes(std::move(volumes))
{
  const auto isEmpty = [](const Volume& volume) { return volume.IsEmpty(); };
  this->Volumes.erase(
    std::remove_if(this->Volumes.begin(), this->Volumes.end(), isEmpty), this->Volumes.end());
  this->Bounds = { glm::dvec3(std::numeric_limits<double>::max()),
    glm::dvec3(std::numeric_limits<double>::lowest()) };
  for (const Volume& volume : this->Volumes)
  {
    this->AnyLit = this->AnyLit || volume.IsLit();
    this->AnyUnlit = this->AnyUnlit || !volume.IsLit();
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::dvec3 point = volume.GetCorner(corner);
      this->Bounds.Low = glm::min(this->Bounds.Low, point);
      this->Bounds.High = glm::max(this->Bounds.High, point);
    }
  }
}

Box VolumeSet::GetBounds() const
{
  return this->Bounds;
}

bool VolumeSet::MayMeet(const Ray& ray, float far) const
{
  float near;
  float end;
  return std::any_of(this->Volumes.begin(), this->Volumes.end(),
    [&](const Volume& volume) { return volume.FindSpan(ray, far, near, end); });
}

bool VolumeSet::MayMeet(const RayPacket& packet) const
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const float far = packet.IsHit(lane) ? packet.Query.ray.tfar[lane] : Everywhere;
    if (packet.Active[lane] && this->MayMeet(packet.GetRay(lane), far))
    {
      return true;
    }
  }
  return false;
}

/// Calls `visit(medium, begins, steps, active)` for each step along the rays, until none is active.
/// Each ray has steps of one length, at most `scale` of the volumes' steps. The medium of a step is
/// that at a place inside it, the same in all steps of a ray.
template <typename Visit>
void VolumeSet::March(const RayLanes& rays, const Lanes<float>& far, const Lanes<float>& shifts,
  Kinds kinds, float scale, const Visit& visit) const
{
  std::vector<VolumeSpans> spans;
  Lanes<float> near;
  Lanes<float> end;
  std::fill_n(near.Values, LaneCount, std::numeric_limits<float>::max());
  std::fill_n(end.Values, LaneCount, 0.0f);
  Lanes<float> longest; // by the volumes that the ray meets
  std::fill_n(longest.Values, LaneCount, std::numeric_limits<float>::max());
  for (const Volume& volume : this->Volumes)
  {
    spans.emplace_back();
    if (!IsOf(kinds, volume))
    {
      continue;
    }
    volume.FindSpans(rays.Origin, rays.Direction, far, rays.Active, spans.back());
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      if (spans.back().Near[lane] < spans.back().Far[lane])
      {
        near[lane] = std::min(near[lane], spans.back().Near[lane]);
        end[lane] = std::max(end[lane], spans.back().Far[lane]);
        longest[lane] = std::min(longest[lane], volume.GetStep());
      }
    }
  }
  StepLanes steps;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    steps.Begin(lane, near[lane], end[lane], scale * longest[lane]);
  }
  MediumLanes medium;
  while (IsAny(steps.Active))
  {
    cslf::FindMiddles(shifts, steps);
    medium.Clear();
    for (std::size_t i = 0; i < spans.size(); ++i)
    {
      if (IsOf(kinds, this->Volumes[i]))
      {
        this->Volumes[i].AddMedium(spans[i], steps.Middles, steps.Active, medium);
      }
    }
    visit(medium, steps.At, steps.Steps, steps.Active);
    Advance(steps);
  }
}

void VolumeSet::Integrate(
  const RayLanes& rays, const Lanes<float>& far, const Lanes<float>& shifts, VeilLanes& veils) const
{
  SumLanes sums;
  if (this->AnyUnlit)
  {
    this->March(rays, far, shifts, Kinds::Unlit, 1.0f,
      [&sums](
        const MediumLanes& medium, const Lanes<float>&, const Lanes<float>& steps, LaneMask& active)
      {
        Composite(medium, steps, sums);
        EndWhereDark(sums, active);
      });
  }
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const float transmittance = sums.Transmittance[lane];
    const bool isOpaque = transmittance <= LeastTransmittance;
    const float opacity = 1.0f - transmittance;
    glm::vec3 radiance(0.0f);
    if (opacity > 0.0f)
    {
      const glm::dvec3 displayed = glm::dvec3(sums.Light.Get(lane) / opacity);
      radiance = (isOpaque ? 1.0f : opacity) *
        glm::vec3(SRGBToLinear(glm::clamp(displayed, glm::dvec3(0.0), glm::dvec3(1.0))));
    }
    veils.Radiance.Set(lane, radiance);
    veils.Transmittance[lane] = isOpaque ? 0.0f : transmittance;
  }
}

bool VolumeSet::FindCollision(
  const Ray& ray, float far, std::uint64_t seed, Collision& collision) const
{
  bool isFound = false;
  std::uint64_t number = 0;
  for (const Volume& volume : this->Volumes)
  {
    float near;
    float end;
    RaySequence numbers(MixBits(seed, number++));
    if (!volume.IsLit() || !volume.FindSpan(ray, far, near, end))
    {
      continue;
    }
    glm::vec3 color;
    const float distance = TrackDelta(volume, ray, near, end, numbers, color);
    if (distance < far)
    {
      far = distance;
      collision = { distance, glm::vec3(SRGBToLinear(glm::dvec3(color))),
        volume.GetData().Anisotropy };
      isFound = true;
    }
  }
  return isFound;
}

void VolumeSet::FindOpacities(const RayLanes& rays, const Lanes<float>& far,
  const Lanes<float>& shifts, Lanes<float>& opacities) const
{
  SumLanes sums;
  this->March(rays, far, shifts, Kinds::Lit, 1.0f,
    [&sums](const MediumLanes& medium, const Lanes<float>&, const Lanes<float>& steps, LaneMask&)
    { Composite(medium, steps, sums); });
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    opacities[lane] = 1.0f - sums.Transmittance[lane];
  }
}

std::uint32_t VolumeSet::FindCollisions(const RayLanes& rays, const Lanes<float>& far,
  const Lanes<float>& shifts, const Lanes<float>& opacities, Collision collisions[]) const
{
  SumLanes sums;
  std::uint32_t found = 0;
  this->March(rays, far, shifts, Kinds::Lit, 1.0f,
    [&](const MediumLanes& medium, const Lanes<float>& begins, const Lanes<float>& steps,
      LaneMask& active)
    {
      const SumLanes before = sums;
      Composite(medium, steps, sums);
      for (int lane = 0; lane < LaneCount; ++lane)
      {
        const float passed = 1.0f - opacities[lane];
        if (active[lane] != 0 && medium.Extinction[lane] > 0.0f &&
          sums.Transmittance[lane] < passed)
        {
          const float depth = std::log(before.Transmittance[lane] / passed);
          const float step = std::clamp(depth / medium.Extinction[lane], 0.0f, steps[lane]);
          // The medium is that of the step.
          const Ray ray = rays.Get(lane);
          this->FindMedium(
            ray, begins[lane] + shifts[lane] * steps[lane], HashRay(ray), collisions[lane]);
          collisions[lane].Distance = begins[lane] + step;
          found |= 1u << lane;
          active[lane] = 0;
        }
      }
    });
  return found;
}

/// One of the lit media of a point, at random by their extinction.
void VolumeSet::FindMedium(const Ray& ray, float at, std::uint64_t seed, Collision& collision) const
{
  RaySequence numbers(seed);
  collision = {};
  float sum = 0.0f;
  for (const Volume& volume : this->Volumes)
  {
    float near;
    float end;
    if (!volume.IsLit() || !volume.FindSpan(ray, Everywhere, near, end) || at < near || at > end)
    {
      continue;
    }
    glm::vec3 color;
    const float extinction =
      volume.GetRate(ray.Direction) * volume.Get(ray.Origin + at * ray.Direction, color);
    sum += extinction;
    if (extinction > 0.0f && numbers.Next() * sum <= extinction)
    {
      collision.Albedo = glm::vec3(SRGBToLinear(glm::dvec3(color)));
      collision.Anisotropy = volume.GetData().Anisotropy;
    }
  }
}

void VolumeSet::Attenuate(
  const RayLanes& rays, const Lanes<float>& far, Lanes<float>& transmittances) const
{
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    if (rays.Active[lane] == 0 || !(transmittances[lane] > 0.0f))
    {
      continue;
    }
    const Ray ray = rays.Get(lane);
    const float limit = std::min(far[lane], Everywhere);
    RaySequence numbers(HashRay(ray));
    for (const Volume& volume : this->Volumes)
    {
      float near;
      float end;
      if (volume.FindSpan(ray, limit, near, end))
      {
        transmittances[lane] *= TrackRatio(volume, ray, near, end, numbers);
      }
    }
  }
}

void VolumeSet::FindMiddles(RayPacket& packet) const
{
  RayLanes rays;
  Lanes<float> far;
  Lanes<float> shifts;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const Ray ray = packet.GetRay(lane);
    rays.Active[lane] = packet.Active[lane];
    rays.Origin.Set(lane, ray.Origin);
    rays.Direction.Set(lane, ray.Direction);
    far[lane] = packet.IsHit(lane) ? packet.Query.ray.tfar[lane] : Everywhere;
    shifts[lane] = 0.5f;
  }
  // What all of them hide, then where half of what is seen is hidden.
  SumLanes all;
  this->March(rays, far, shifts, Kinds::All, DepthStep,
    [&all](const MediumLanes& medium, const Lanes<float>&, const Lanes<float>& steps, LaneMask&)
    { Composite(medium, steps, all); });
  SumLanes sums;
  this->March(rays, far, shifts, Kinds::All, DepthStep,
    [&](const MediumLanes& medium, const Lanes<float>& begins, const Lanes<float>& steps,
      LaneMask& active)
    {
      const SumLanes before = sums;
      Composite(medium, steps, sums);
      for (int lane = 0; lane < LaneCount; ++lane)
      {
        const float seen = packet.IsHit(lane) ? 1.0f : 1.0f - all.Transmittance[lane];
        const float half = 1.0f - 0.5f * seen;
        if (active[lane] != 0 && sums.Transmittance[lane] <= half &&
          sums.Transmittance[lane] < before.Transmittance[lane])
        {
          const float depth = std::log(before.Transmittance[lane] / half);
          const float step =
            medium.Extinction[lane] > 0.0f ? depth / medium.Extinction[lane] : 0.0f;
          packet.Query.ray.tfar[lane] = begins[lane] + std::clamp(step, 0.0f, steps[lane]);
          packet.Query.hit.geomID[lane] = 0;
          active[lane] = 0;
        }
      }
    });
}
}
