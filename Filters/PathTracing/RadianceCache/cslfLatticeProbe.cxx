// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLatticeProbe.h"
#include "Pipeline/cslfParallelFor.h"

#include "RandomNumbers/cslfSampleStream.h"
#include "cslfSeconds.h"

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <vector>

namespace cslf
{
namespace
{
using Clock = std::chrono::steady_clock;

// The number of neighbours that are built together.
constexpr std::size_t RunLength = 32;

// The share of all bricks that is built first. Each further step doubles it.
constexpr double FirstShare = 1.0 / 256;

// The fewest bricks of a step, so that all threads have work.
constexpr std::size_t MinimumBricks = 512;

// A pass is built completely if this takes at most this many times the time of the probe. For all
// others, this share of the expected time is enough.
constexpr double MaximumTimes = 2.5;
constexpr double EnoughShare = 0.025;

// The number of bricks whose points are counted. More batches would give the same result.
constexpr std::size_t MaximumCounted = std::size_t(1) << 19;
constexpr std::size_t CountedRun = std::size_t(1) << 14;

// The number of nearest points for an estimate.
constexpr int Neighbours = 6;

constexpr std::uint32_t ChoiceSeed = 20210;

/// The place of bricks in the order of building, in [0,1). A run of neighbours has the same place.
double GetTurn(std::size_t brick, std::size_t run)
{
  return static_cast<double>(MixBits(brick / run, ChoiceSeed) >> 11) / 9007199254740992.0;
}

/// Interpolates estimates from points in space on surfaces of similar orientation.
class ScatteredEstimates : public SurfaceEstimator
{
public:
  explicit ScatteredEstimates(const Scene& scene)
    : World(scene)
  {
  }

  void Add(const Hit& place, const SurfaceEstimate& estimate)
  {
    const SurfaceHit surface = this->World.GetSurface(place);
    this->Places->InsertNextPoint(
      surface.LeavePosition.x, surface.LeavePosition.y, surface.LeavePosition.z);
    this->Normals.push_back(surface.GeometricNormal);
    this->Estimates.push_back(estimate);
  }

  void Finish()
  {
    this->Data->SetPoints(this->Places);
    this->Locator->SetDataSet(this->Data);
    this->Locator->BuildLocator();
  }

  std::vector<SurfaceEstimate> Estimate(const Request& request) override
  {
    std::vector<SurfaceEstimate> estimates(request.Points.size());
    ParallelFor(0, static_cast<vtkIdType>(estimates.size()), 0,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType point = begin; point < end; ++point)
        {
          estimates[point] = this->Get(request.Points[point].Place);
        }
      });
    return estimates;
  }

private:
  /// The value is interpolated; the incident light is that of the point with the largest weight.
  SurfaceEstimate Get(const Hit& place) const
  {
    const SurfaceHit surface = this->World.GetSurface(place);
    const double point[3] = { surface.LeavePosition.x, surface.LeavePosition.y,
      surface.LeavePosition.z };
    vtkNew<vtkIdList> nearest;
    this->Locator->FindClosestNPoints(Neighbours, point, nearest);
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    double most = 0.0;
    const SurfaceEstimate* first = nullptr;
    for (const vtkIdType id : *nearest)
    {
      double other[3];
      this->Places->GetPoint(id, other);
      const glm::dvec3 way(other[0] - point[0], other[1] - point[1], other[2] - point[2]);
      const double facing = std::max(glm::dot(this->Normals[id], surface.GeometricNormal), 1e-3f);
      const double weight = facing * facing / (glm::dot(way, way) + 1e-12);
      sum += weight * glm::dvec3(this->Estimates[id].GetValue());
      weights += weight;
      if (weight > most)
      {
        most = weight;
        first = &this->Estimates[id];
      }
    }
    SurfaceEstimate result(weights > 0.0 ? glm::vec3(sum / weights) : glm::vec3(0.0f));
    if (first)
    {
      result.Incident = first->Incident;
      result.IncidentPilot = first->IncidentPilot;
    }
    return result;
  }

  const Scene& World;
  vtkNew<vtkPoints> Places;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkStaticPointLocator> Locator;
  std::vector<glm::vec3> Normals;
  std::vector<SurfaceEstimate> Estimates;
};

/// The points at which the whole begins.
struct FirstCounts
{
  double Bricks = 0.0;
  double Points = 0.0;
};

FirstCounts CountAll(LatticeBuilder& builder, const LatticeBuilder::Progress& goOn)
{
  const double share =
    std::min(1.0, static_cast<double>(MaximumCounted) / builder.GetNumberOfBricks());
  std::size_t all = 0;
  std::size_t counted = 0;
  std::size_t points = 0;
  const bool isCounted = builder.CountFirstPoints(
    [&](std::size_t brick)
    {
      const bool isChosen = GetTurn(brick, CountedRun) < share;
      ++all;
      counted += isChosen ? 1 : 0;
      return isChosen;
    },
    points, goOn);
  if (!isCounted)
  {
    return {};
  }
  const auto bricks = static_cast<double>(all);
  return { bricks, counted > 0 ? static_cast<double>(points) * bricks / counted : points };
}
}

double ProbeLattice(
  const Scene& scene, LatticeBuilder& builder, double seconds, const LatticeBuilder::Progress& goOn)
{
  // It is not known how many steps there will be.
  const auto goesOn = [&goOn](double) { return goOn(0.0); };
  const FirstCounts all = CountAll(builder, goesOn);
  if (all.Bricks == 0.0)
  {
    return 0.0;
  }
  ScatteredEstimates estimates(scene);
  double expected = 0.0;
  double elapsed = 0.0;
  double done = 0.0;
  std::size_t built = 0;
  const double least = static_cast<double>(MinimumBricks) / all.Bricks;
  for (double share = std::max(FirstShare, least); done < 1.0; share *= 2.0)
  {
    const auto start = Clock::now();
    const bool isBuiltWhole = builder.BuildPart(
      [&](std::size_t brick)
      {
        const double turn = GetTurn(brick, RunLength);
        const bool isBuilt = turn >= done && turn < share;
        built += isBuilt ? 1 : 0;
        return isBuilt;
      },
      [&estimates](const Hit& place, const SurfaceEstimate& estimate)
      { estimates.Add(place, estimate); },
      goesOn);
    if (!isBuiltWhole)
    {
      return expected;
    }
    elapsed += SecondsSince(start);
    done = std::min(share, 1.0);
    // The whole has fewer points than the sum of its parts, because bricks share points.
    const double parts = static_cast<double>(built) / all.Bricks;
    const auto first = static_cast<double>(builder.GetNumberOfFirstEstimates());
    const double further = builder.GetNumberOfEstimates() - first;
    const double points = builder.GetNumberOfEstimates();
    expected =
      points > 0.0 ? elapsed / points * (all.Points + further / std::max(parts, 1e-9)) : 0.0;
    if (built > 0 && expected > MaximumTimes * seconds &&
      elapsed > std::min(seconds, EnoughShare * expected))
    {
      break;
    }
  }
  if (done < 1.0)
  {
    estimates.Finish();
    builder.FillPart(
      [done](std::size_t brick) { return GetTurn(brick, RunLength) >= done; }, estimates, goesOn);
  }
  return expected;
}
}
