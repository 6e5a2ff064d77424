// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Finds out how fine a lattice must be, and what values it holds.
 */
#ifndef cslfLatticeBuilder_h
#define cslfLatticeBuilder_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/cslfScene.h"
#include "cslfSurfaceLattice.h"

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

  /// How far away what it sees is, in scene space: at distances larger than this, the value may
  /// change although the estimates around do not.
  float Reach = 0.0f;
};

struct LatticeSettings
{
  /// The levels from a brick's corners to points at the smallest distance.
  static constexpr int BrickLevels = 4;

  /// The smallest distance of points, in scene space. Where the whole scene at this distance would
  /// be more than MaximumPoints points, the distance grows.
  float Spacing = 0.01f;

  /// The level that every brick has at least, where its triangle's size allows: details smaller
  /// than that fineness may be missed.
  int FirstLevel = 0;

  /// The level that no brick goes beyond; 0 for corners only.
  int LastLevel = BrickLevels;

  /// Points are added where interpolation errs by more than this, in the units of `Display`.
  float Tolerance = 0.004f;

  /// What a viewer sees of a value on a surface of the given base colour.
  std::function<glm::vec3(const glm::vec3& value, const glm::vec3& baseColor)> Display;
};

class VTKCSLF_EXPORT LatticeBuilder
{
public:
  /// Estimates the value at a point of the surface: called from several threads at once. The key
  /// tells points apart; it depends on the scene only.
  using Estimator = std::function<SurfaceEstimate(const Hit& place, std::uint64_t key)>;

  LatticeBuilder(const Scene& scene, LatticeSettings settings, Estimator estimate);
  ~LatticeBuilder();

  /// Builds the lattice. `goOn` is told the progress, in [0,1]; false where it returned false.
  bool Build(const std::function<bool(double)>& goOn);

  SurfaceLattice& GetLattice() { return this->Lattice; }
  std::size_t GetNumberOfEstimates() const { return this->Estimates; }

private:
  struct Patch;
  struct Point;

  void ChooseSplits();
  bool IsSmall(std::uint32_t mesh, std::uint32_t triangle) const;
  void AddTriangle(std::uint32_t mesh, std::uint32_t triangle);
  void BuildBatch();
  std::uint32_t Request(const Patch& patch, int i, int j, int level);
  void RequestAll(Patch& patch);
  void EvaluateRequests();
  bool NeedsMore(const Patch& patch) const;
  bool VariesWithin(const Patch& patch) const;
  float InterpolationError(const Patch& patch, int i, int j, int sideI, int sideJ) const;
  void Store(const Patch& patch);

  const Scene& World;
  LatticeSettings Settings;
  Estimator Estimate;
  SurfaceLattice Lattice;
  std::vector<std::uint8_t> Depths; // of each triangle: the binary logarithm of its finest splits
  std::size_t Estimates = 0;

  // The batch of triangles at work.
  std::vector<Patch> Patches;
  std::vector<Point> Points;
  std::size_t Evaluated = 0;                              // of the points
  std::unordered_map<std::uint64_t, std::uint32_t> Index; // of points, by their keys
};
}

#endif
