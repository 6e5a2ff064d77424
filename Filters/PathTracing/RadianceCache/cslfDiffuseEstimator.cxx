// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDiffuseEstimator.h"
#include "Pipeline/cslfParallelFor.h"

#include "PathTracing/Paths/cslfSurfaceLanes.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfSampleNoise.h"
#include "cslfSurfaceEstimate.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace cslf
{
namespace
{
// The share of directions that may see something closer than the reach. At an edge between surfaces
// at a flat angle, this share and its light are small.
constexpr float NearShare = 1.0f / 32.0f;

// The same on smooth surfaces, whose curvature alone hides some directions. There, points are
// shared, so that neighbours show how the light varies.
constexpr float NearShareOfSmooth = 1.0f / 8.0f;

// Points in a small area may have this many times the acceptable noise each.
constexpr float MaximumNoise = 4.0f;

// The points after which the work may be stopped: about a second's.
constexpr vtkIdType PointsAtOnce = 8192;

SurfaceHit MakeWhite(SurfaceHit surface)
{
  surface.BaseColor = glm::vec3(1.0f);
  return surface;
}
}

/// A surface point as a white one.
struct DiffuseEstimator::Receiver
{
  SurfaceHit Surface;
  Frame Local;
  BSDF Reflection;

  Receiver(const Scene& scene, const Hit& place)
    : Surface(MakeWhite(scene.GetSurface(place)))
    , Local(Surface.ShadingNormal)
    , Reflection(*Surface.Material, Surface.GetMaterialPoint(),
        this->Local.ToLocal(this->Surface.GeometricNormal), this->Surface.Inside)
  {
  }
};

/// Samples that are taken together.
struct DiffuseEstimator::Range
{
  const Receiver& From;
  std::uint64_t Hash;
  int Begin;
  int End;
};

/// The results so far of one half of a point's samples.
struct DiffuseEstimator::Progress
{
  HalfSamples Samples;
  std::unique_ptr<IncidentFit> Fit; // null if it is not requested, or no longer
  std::vector<float> Distances;     // distances of what the first samples see, unsorted

  /// The distance exceeded by nearly all of the first samples.
  float TakeReach(int samples, float nearShare)
  {
    const auto near = static_cast<std::size_t>(nearShare * static_cast<float>(samples));
    float distance = std::numeric_limits<float>::infinity();
    if (near < this->Distances.size())
    {
      const auto reach = this->Distances.begin() + static_cast<std::ptrdiff_t>(near);
      std::nth_element(this->Distances.begin(), reach, this->Distances.end());
      distance = *reach;
    }
    this->Distances = {};
    return distance;
  }
};

/// A point in progress. Only the rank that owns it takes its samples.
struct DiffuseEstimator::Work
{
  SurfaceEstimate Estimate;
  Progress Halves[2];
  bool IsOpen[2] = { true, true }; // whether a half, as the pilot, requests more samples
  glm::vec3 Variances[2] = {};     // of one sample each, according to the pilots

  bool IsAnyOpen() const { return this->IsOpen[0] || this->IsOpen[1]; }
  void Close() { this->IsOpen[0] = this->IsOpen[1] = false; }
};

std::vector<SurfaceEstimate> DiffuseEstimator::Estimate(const Request& request)
{
  std::vector<Work> works(request.Points.size());
  Means means(works.size());
  int samples = this->Limits.FirstSamples / 2;
  double done = 0.0;
  bool needsMore = true;
  while (needsMore)
  {
    // It is not known how often samples are doubled. Each time counts as half of what remains.
    const double part = 0.5 * (1.0 - done);
    const auto goOn = [&](double taken)
    { return !request.GoOn || request.GoOn(done + part * taken); };
    if (!this->TakeSamples(request, samples, goOn, works, means))
    {
      return {};
    }
    done += part;
    needsMore = this->Decide(request, samples, means, works);
    samples *= 2;
  }
  std::vector<SurfaceEstimate> estimates;
  estimates.reserve(works.size());
  for (const Work& work : works)
  {
    estimates.push_back(work.Estimate);
  }
  if (this->Limits.Share)
  {
    this->Limits.Share->Complete(estimates, 0);
  }
  return estimates;
}

bool DiffuseEstimator::TakeSamples(const Request& request, int end,
  const std::function<bool(double)>& goOn, std::vector<Work>& works, Means& means)
{
  CacheShare* share = this->Limits.Share;
  const auto count = static_cast<vtkIdType>(works.size());
  for (vtkIdType begin = 0; begin < count; begin += PointsAtOnce)
  {
    ParallelFor(begin, std::min(begin + PointsAtOnce, count), 1,
      [&](vtkIdType first, vtkIdType last)
      {
        for (vtkIdType index = first; index < last; ++index)
        {
          const bool isMine = !share || share->GetOwner(index) == share->GetRank();
          if (isMine && works[index].IsAnyOpen())
          {
            this->TakeSamples(
              request.Points[index], end, request.WantsIncident, works[index], means[index]);
          }
        }
      });
    if (!goOn(static_cast<double>(begin) / static_cast<double>(count)))
    {
      return false;
    }
  }
  if (share)
  {
    share->Complete(means, 0);
  }
  return true;
}

void DiffuseEstimator::TakeSamples(
  const SurfacePoint& point, int end, bool wantsIncident, Work& work, PointMeans& means)
{
  const Receiver receiver(this->World, point.Place);
  if (!receiver.Reflection.Has(Lobes::Diffuse))
  {
    return;
  }
  const std::uint64_t hash = MixBits(MixBits(point.Key, this->Limits.Seed), this->Limits.Depth);
  const int begin = end == this->Limits.FirstSamples / 2 ? 0 : end / 2;
  if (begin == 0 && this->FindHidden(receiver, hash, work.Estimate))
  {
    means.IsHidden = true;
    return;
  }
  const GlossyLobe* lobe =
    this->Limits.Lobes.empty() ? nullptr : &this->Limits.Lobes[point.Place.Mesh];
  const bool isSmooth = !this->World.GetMeshes()[point.Place.Mesh].Normals.empty();
  std::uint64_t rays = 0;
  for (std::uint32_t half = 0; half < 2; ++half)
  {
    Progress& progress = work.Halves[half];
    // The first half of the incident light is stored, and the second is its pilot.
    if (begin == 0 && wantsIncident && lobe && lobe->IsKnown())
    {
      progress.Fit = std::make_unique<IncidentFit>();
    }
    else if (!work.IsOpen[1])
    {
      progress.Fit.reset();
    }
    progress.Samples.Extend(end);
    const Range range{ receiver, MixBits(hash, half), begin, end };
    rays += this->Limits.Kind == Light::Sampled ? this->SampleLights(range, progress)
                                                : this->LookAround(range, progress);
    means.Halves[half] = progress.Samples.GetMean();
    if (begin == 0)
    {
      work.Estimate.Halves[half].Reach =
        progress.TakeReach(end, isSmooth ? NearShareOfSmooth : NearShare);
    }
    if (progress.Fit)
    {
      (half == 0 ? work.Estimate.Incident : work.Estimate.IncidentPilot) =
        progress.Fit->Solve(receiver.Local, lobe->GetSize());
    }
  }
  this->Rays.fetch_add(rays, std::memory_order_relaxed);
}

/// Sets whether a point is hidden in a closed body or a gap, and its reach. Such a point sees the
/// inside of the body, or the other side of the gap, along its normal and in most directions: in
/// the others, it sees further bodies that reach into that one, or far along the gap. Light in a
/// gap may be very different from that beside it, as between a lamp and the ceiling that it hangs
/// from, and must not spread there.
bool DiffuseEstimator::FindHidden(
  const Receiver& receiver, std::uint64_t hash, SurfaceEstimate& estimate)
{
  float nearest = std::numeric_limits<float>::infinity();
  const auto isEnclosed = [&](const glm::vec3& direction)
  {
    const Ray ray{ receiver.Surface.LeavePosition, receiver.Local.ToWorld(direction) };
    const Hit hit = this->World.Intersect(ray);
    nearest = hit.IsValid() ? std::min(nearest, hit.Distance) : nearest;
    return hit.IsValid() &&
      ((hit.Distance < this->Limits.Gap && !this->World.GetMeshes()[hit.Mesh].CanBePassed()) ||
        (this->Limits.IsInside && this->Limits.IsInside(ray, hit)));
  };
  // One ray rules out nearly all points that are not hidden.
  const bool mayBe = isEnclosed({ 0.0f, 0.0f, 1.0f });
  this->Rays.fetch_add(1, std::memory_order_relaxed);
  if (!mayBe)
  {
    return false;
  }
  const int all = this->Limits.FirstSamples / 2;
  int count = 0;
  for (int i = 0; i < all; i += RayPacket::Size)
  {
    GatherDirections::Packet local;
    this->Directions.Get(hash, i, local);
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      count += isEnclosed({ local.X[lane], local.Y[lane], local.Z[lane] }) ? 1 : 0;
    }
  }
  this->Rays.fetch_add(all, std::memory_order_relaxed);
  estimate.IsHidden = 2 * count > all;
  estimate.Halves[0].Reach = estimate.Halves[1].Reach = nearest;
  return estimate.IsHidden;
}

bool DiffuseEstimator::Decide(
  const Request& request, int samples, const Means& means, std::vector<Work>& works) const
{
  // Take the neighbours into account.
  std::vector<glm::vec3> pooled[2];
  for (int half = 0; half < 2; ++half)
  {
    std::vector<glm::vec3> variances;
    variances.reserve(works.size());
    for (std::size_t point = 0; point < works.size(); ++point)
    {
      Work& work = works[point];
      if (work.IsOpen[half])
      {
        work.Variances[half] = means[point].Halves[half].Variance * static_cast<float>(samples);
      }
      variances.push_back(work.Variances[half] / static_cast<float>(samples));
    }
    pooled[half] = PoolVariances(variances, request.Graph);
  }

  // Decide which points need more samples.
  const bool canGoOn = 4 * samples <= this->Limits.LastSamples;
  std::atomic<bool> goesOn{ false };
  ParallelFor(0, static_cast<vtkIdType>(works.size()), 0,
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType point = first; point < last; ++point)
      {
        Work& work = works[point];
        if (means[point].IsHidden)
        {
          work.Close();
        }
        for (int half = 0; half < 2; ++half)
        {
          if (work.IsOpen[half])
          {
            HalfEstimate& pilot = work.Estimate.Halves[half];
            pilot.Pilot = means[point].Halves[half].Mean;
            pilot.Variance = pooled[half][point];
            work.Estimate.Halves[1 - half].Value = means[point].Halves[1 - half].Mean;
            work.IsOpen[half] = canGoOn && !this->IsEnough(request.Points[point], pilot);
          }
        }
        if (work.IsAnyOpen())
        {
          goesOn = true;
        }
      }
    });
  return goesOn;
}

bool DiffuseEstimator::IsEnough(const SurfacePoint& point, const HalfEstimate& pilot) const
{
  // Both halves together have half of the variance.
  const glm::vec3 error = glm::sqrt(0.5f * pilot.Variance);
  // Several points within the area have less noise together.
  const float together = std::sqrt(this->Limits.NoiseArea / std::max(point.Area, 1e-30f));
  const glm::vec3 color = this->World.GetBaseColor(point.Place);
  return GetDisplayedError(this->Limits.Display, pilot.Pilot, error, color) <
    this->Limits.Noise * std::clamp(together, 1.0f, MaximumNoise);
}

std::uint64_t DiffuseEstimator::SampleLights(const Range& range, Progress& progress) const
{
  const Receiver& receiver = range.From;
  const glm::vec3 albedo = receiver.Reflection.GetDiffuse().GetAlbedo();
  const bool isLambertian = receiver.Surface.Material->IsLambertian();
  ScatterLanes points;
  StreamLanes streams;
  points.Surfaces.Scattering = isLambertian ? 0 : (1u << LaneCount) - 1;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    points.Surfaces.Set(lane, receiver.Surface);
    if (!isLambertian)
    {
      points.Scattering[lane].emplace(receiver.Reflection);
    }
    points.LitLobes[lane] = Lobes::Diffuse;
    streams.Hash[lane] = range.Hash;
  }
  std::uint64_t rays = 0;
  for (int i = range.Begin; i < range.End; i += LaneCount)
  {
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      points.Lit[lane] = -1;
      streams.Index[lane] = static_cast<std::uint32_t>(i + lane);
    }
    Vec3Lanes light;
    Clear(light);
    rays += this->Paths.GetLight().Sample(points, streams, 0, light);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      progress.Samples.Add(i + lane, light.Get(lane) / albedo);
    }
  }
  return rays;
}

/// Takes the light that is found in given directions. Light that is not known is found later, by
/// paths that are followed together.
class DiffuseEstimator::Gathering
{
public:
  Gathering(
    const DiffuseEstimator& estimator, const Range& range, PathBatch& batch, Progress& progress)
    : Paths(estimator.Paths)
    , Samples(range)
    , Batch(batch)
    , Results(progress)
  {
    this->Batch.Clear();
  }

  void Add(int index, const glm::vec3& direction, const glm::vec3& radiance)
  {
    if (this->Results.Fit)
    {
      this->Results.Fit->Add({ direction.x, direction.y }, radiance);
    }
    const DiffuseLobe& lobe = this->Samples.From.Reflection.GetDiffuse();
    this->Results.Samples.Add(index, lobe.GetTransmission(direction.z) * radiance);
  }

  void AddPath(int index, const glm::vec3& direction, const Ray& ray, const Hit& hit)
  {
    PathBatch::Start start;
    start.First = ray;
    start.Hash = this->Samples.Hash;
    start.Index = static_cast<std::uint32_t>(index);
    start.Pdf = direction.z * InversePi;
    start.Normal = this->Samples.From.Surface.GetReceiverNormal();
    this->Batch.Add(start, hit);
    this->Starts.push_back({ index, direction });
    if (this->Batch.GetSize() == PathBatch::Capacity)
    {
      this->Follow();
    }
  }

  void Follow()
  {
    this->Paths.Follow(this->Batch, this->Rays);
    for (std::size_t path = 0; path < this->Starts.size(); ++path)
    {
      const auto& [index, direction] = this->Starts[path];
      this->Add(index, direction, this->Batch.GetRadiance(static_cast<int>(path)));
    }
    this->Batch.Clear();
    this->Starts.clear();
  }

  std::uint64_t Rays = 0;

private:
  const PathIntegrator& Paths;
  const Range& Samples;
  PathBatch& Batch;
  Progress& Results;
  std::vector<std::pair<int, glm::vec3>> Starts; // of the batch: the sample and its direction
};

std::uint64_t DiffuseEstimator::LookAround(const Range& range, Progress& progress)
{
  const Receiver& receiver = range.From;
  const Frame& frame = receiver.Local;
  Gathering gathering(*this, range, this->Batches.Local(), progress);
  GatherDirections::Packet local;
  RayPacket packet;
  std::fill_n(packet.Active, RayPacket::Size, -1);
  std::fill_n(packet.Query.ray.org_x, RayPacket::Size, receiver.Surface.LeavePosition.x);
  std::fill_n(packet.Query.ray.org_y, RayPacket::Size, receiver.Surface.LeavePosition.y);
  std::fill_n(packet.Query.ray.org_z, RayPacket::Size, receiver.Surface.LeavePosition.z);
  for (int i = range.Begin; i < range.End; i += RayPacket::Size)
  {
    this->Directions.Get(range.Hash, i, local);
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
    gathering.Rays += RayPacket::Size;
    PacketRadiance light;
    alignas(64) int known[RayPacket::Size];
    this->Known.Get(packet, light, known);
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      const int index = i / GatherDirections::Length * GatherDirections::Length + local.Index[lane];
      const glm::vec3 direction(local.X[lane], local.Y[lane], local.Z[lane]);
      if (range.Begin == 0 && packet.IsHit(lane))
      {
        progress.Distances.push_back(packet.Query.ray.tfar[lane]);
      }
      if (known[lane])
      {
        gathering.Add(index, direction, { light.Red[lane], light.Green[lane], light.Blue[lane] });
      }
      else
      {
        gathering.AddPath(index, direction, packet.GetRay(lane), packet.GetHit(lane));
      }
    }
  }
  gathering.Follow();
  return gathering.Rays;
}
}
