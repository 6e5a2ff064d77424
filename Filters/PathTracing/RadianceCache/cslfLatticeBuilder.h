// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Finds out how fine a lattice must be, and what values it holds.
 */
#ifndef cslfLatticeBuilder_h
#define cslfLatticeBuilder_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/cslfDisplayCurve.h"
#include "PathTracing/cslfScene.h"
#include "cslfCacheShare.h"
#include "cslfIncidentLight.h"
#include "cslfLatticeLayout.h"
#include "cslfOpenSides.h"
#include "cslfSurfaceLattice.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace cslf
{
/// What is known of a point of the surface.
struct SurfaceEstimate
{
  glm::vec3 Value{ 0.0f };

  /// How far away nearly all that it sees is, in scene space: at distances larger than this, the
  /// value may change although the estimates around do not.
  float Reach = 0.0f;

  /// The light that arrives, if it was asked for.
  IncidentLight Incident;

  /// The standard error, in the units of `LatticeSettings::Display`.
  float Noise = 0.0f;
};

/// An estimate between two others.
inline SurfaceEstimate Interpolate(
  const SurfaceEstimate& before, const SurfaceEstimate& after, float weight)
{
  SurfaceEstimate result = weight < 0.5f ? before : after;
  result.Value = glm::mix(before.Value, after.Value, weight);
  result.Reach = std::min(before.Reach, after.Reach);
  result.Noise = glm::mix(before.Noise, after.Noise, weight);
  return result;
}

struct LatticeSettings
{
  /// Points are added where interpolation errs by more than this, in the units of `Display`.
  float Tolerance = 0.004f;

  /// Whether points are added only where something bright would bleed over its edges.
  bool OnlyBright = false;

  /// The level that every brick has at least, where its triangle's size allows, so that details are
  /// not missed: 0 is their corners, 16 spacings apart; each further level halves that.
  int FirstLevel = 0;

  /// Flat triangles and charts of at most this many spacings have one value, as a binary logarithm.
  int SmallLevels = 0;

  double Exposure = 1.0;

  /// What a viewer sees of a value on a surface of the given base colour.
  DisplayCurve Display;

  /// The ranks that estimate the points together; null for this one alone.
  CacheShare* Share = nullptr;
};

class VTKCSLF_EXPORT LatticeBuilder
{
public:
  /// Estimates the value at a point of the surface: called from several threads at once. The key
  /// tells points apart; it depends on the scene only.
  using Estimator = std::function<SurfaceEstimate(const Hit& place, std::uint64_t key)>;

  /// Whether a brick that is no part of another is built, by its index.
  using Choice = std::function<bool(std::size_t brick)>;

  /// Values stay 0 on sides that are not open.
  LatticeBuilder(const Scene& scene, const OpenSides& sides, const LatticeLayout& layout,
    LatticeSettings settings, Estimator estimate);
  ~LatticeBuilder();

  /// Builds the lattice. `goOn` is told the progress, in [0,1]; false where it returned false.
  bool Build(const std::function<bool(double)>& goOn);

  /// Builds a part of it: may be called for several disjoint ones. `tell`, which may be empty, is
  /// told all points.
  void BuildPart(const Choice& choice,
    const std::function<void(const Hit& place, const SurfaceEstimate& estimate)>& tell);

  /// Gives the bricks of a part values at their corners, whose estimates nobody doubts.
  void FillPart(const Choice& choice, const Estimator& estimate);

  /// The number of points that building a part begins with.
  std::size_t CountFirstPoints(const Choice& choice);

  SurfaceLattice& GetLattice() { return this->Lattice; }
  IncidentField& GetIncident() { return this->Incident; }
  std::size_t GetNumberOfEstimates() const { return this->Estimates; }
  /// Those of them that no other asked for.
  std::size_t GetNumberOfFirstEstimates() const { return this->FirstEstimates; }

private:
  struct Patch;
  struct Point;

  bool AddAll(const std::function<bool(double)>& goOn, const std::function<void()>& useBatch);
  void AddTriangle(std::uint32_t mesh, std::uint32_t triangle);
  void AddChart(std::size_t index);
  void AddChartCell(Patch& patch, std::size_t index, int column, int row);
  void BuildBatch();
  void ClearBatch();
  void RequestAll(Patch& patch);
  std::uint32_t Request(const Patch& patch, int i, int j);
  std::uint32_t RequestOnTriangle(const Patch& patch, int column, int row);
  std::uint32_t RequestOnChart(const Patch& patch, int column, int row);
  std::uint32_t RequestMean(const Patch& patch, const glm::ivec2& low, const glm::ivec2& high,
    float weight, std::uint64_t key);
  std::uint32_t AddPoint(const Patch& patch, const TrianglePoint& place, std::uint64_t key);
  void EvaluateRequests();
  void ExchangeEstimates();
  void Refine();
  float GetDistance(const Patch& patch) const;
  bool NeedsMore(const Patch& patch) const;
  bool VariesWithin(const Patch& patch) const;
  bool IsCoarse(float distance) const;
  bool IsBright(const glm::vec3& error, float distance) const;
  bool IsMissed(const Patch& patch, int i, int j, int sideI, int sideJ) const;
  void Split(std::size_t index);
  bool IsEmpty(const Patch& patch) const;
  void Store(const Patch& patch);
  void StoreIncident(const Patch& patch);

  const Scene& World;
  const OpenSides& Sides;
  const LatticeLayout& Layout;
  LatticeSettings Settings;
  Estimator Estimate;
  SurfaceLattice Lattice;
  IncidentField Incident;
  std::size_t Estimates = 0;
  std::size_t FirstEstimates = 0;
  Choice IsChosen; // empty for all bricks
  std::function<void(const Hit&, const SurfaceEstimate&)> Tell;

  // The batch of triangles at work.
  std::vector<Patch> Patches;
  std::vector<Point> Points;
  std::size_t Evaluated = 0;                              // of the points
  std::size_t Means = 0;                                  // those of the points not estimated
  std::unordered_map<std::uint64_t, std::uint32_t> Index; // of points, by their keys
};
}

#endif
