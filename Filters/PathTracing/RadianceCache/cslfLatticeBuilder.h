// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Determines the resolution of a lattice and its values.
 */
#ifndef cslfLatticeBuilder_h
#define cslfLatticeBuilder_h

#include "PathTracing/Scene/cslfScene.h"
#include "Quality/cslfDisplayCurve.h"
#include "cslfIncidentLight.h"
#include "cslfLatticeLayout.h"
#include "cslfOpenSides.h"
#include "cslfSurfaceEstimate.h"
#include "cslfSurfaceLattice.h"
#include "vtkCSLFModule.h" // for export macro

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace cslf
{
struct LatticeSettings
{
  /// The error of interpolation above which points are added, in the units of `Display`.
  float Tolerance = 0.004f;

  /// Whether points are added only where something bright would bleed over its edges.
  bool OnlyBright = false;

  /// The minimum level of every brick, if its triangle's size allows, so that details are not
  /// missed: level 0 has its corners, 16 spacings apart; each further level halves that.
  int FirstLevel = 0;

  /// Flat triangles and charts of at most this many spacings have one value, as a binary logarithm.
  int SmallLevels = 0;

  /// Corners of bricks that are smaller than this, in spacings, share one point with those whose
  /// normals are alike in the same cube of this edge. 0 lets none.
  float ClusterSize = 0.0f;

  double Exposure = 1.0;

  /// The displayed value on a surface of the given base colour.
  DisplayCurve Display;
};

/**
 * Builds a lattice twice, once for each half of the points' samples: one half decides where it is
 * refined, the other provides its values. The lattice is the mean of both.
 */
class VTKCSLF_EXPORT LatticeBuilder
{
public:
  /// Gets the progress, in [0,1]. The work ends if it returns false.
  using Progress = std::function<bool(double)>;

  /// Whether to build a brick that is not part of another, by its index.
  using Choice = std::function<bool(std::size_t brick)>;

  /// Values stay 0 on sides that are not open.
  LatticeBuilder(const Scene& scene, const OpenSides& sides, const LatticeLayout& layout,
    LatticeSettings settings, SurfaceEstimator& estimator);
  ~LatticeBuilder();

  /// Builds the lattice. `goOn` gets the progress, in [0,1]. Returns false if `goOn` did.
  bool Build(const Progress& goOn);

  /// Builds a part of it, like Build. May be called for several disjoint parts. `onEstimate`, which
  /// may be empty, gets all points.
  bool BuildPart(const Choice& choice,
    const std::function<void(const Hit& place, const SurfaceEstimate& estimate)>& onEstimate,
    const Progress& goOn);

  /// Gives the bricks of a part values at their corners, without checking their accuracy.
  bool FillPart(const Choice& choice, SurfaceEstimator& estimator, const Progress& goOn);

  /// Counts the points at which building a part begins.
  bool CountFirstPoints(const Choice& choice, std::size_t& count, const Progress& goOn);

  /// The key of a point on a side of a triangle or a chart, by which it is found in a batch and
  /// gets its random numbers. It differs from those of points at vertices and on edges that
  /// triangles share. `domain` is the triangle's number, or that of all triangles plus the chart's,
  /// and the column and the row count the finest points. `isMean` is for points that are
  /// interpolated.
  static std::uint64_t MakeKey(std::size_t domain, bool back, int column, int row, bool isMean);

  /// The lattice. Call it once, at the end.
  SurfaceLattice TakeLattice(const LayoutProgress& progress = LayoutProgress());
  std::size_t GetNumberOfBricks() const { return this->Lattices[0].GetNumberOfRoots(); }
  IncidentField& GetIncident() { return this->Incident; }
  std::size_t GetNumberOfEstimates() const { return this->Estimates; }
  /// Those that were not requested before.
  std::size_t GetNumberOfFirstEstimates() const { return this->FirstEstimates; }

private:
  struct Patch;
  struct Point;
  struct Bend;

  bool AddAll(const std::function<bool(double begin, double end)>& useBatch);
  void AddTriangle(std::uint32_t mesh, std::uint32_t triangle);
  void AddChart(std::size_t index);
  void AddPatch(Patch patch);
  void AddChartCell(Patch& patch, std::size_t index, int column, int row);
  bool BuildBatch(const Progress& goOn);
  void ClearBatch();
  void RequestAll(Patch& patch);
  std::uint32_t Request(const Patch& patch, int i, int j);
  std::uint32_t RequestOnTriangle(const Patch& patch, int column, int row);
  std::uint64_t FindSharedKey(const Patch& patch, int column, int row) const;
  std::uint64_t FindClusterKey(const Patch& patch, const TrianglePoint& place) const;
  bool IsClustered(const Patch& patch) const;
  std::uint32_t RequestOnChart(const Patch& patch, int column, int row);
  std::uint32_t RequestMean(const Patch& patch, const glm::ivec2& low, const glm::ivec2& high,
    float weight, std::uint64_t key);
  std::uint32_t AddPoint(const Patch& patch, const TrianglePoint& place, std::uint64_t key);
  bool EvaluateRequests(bool isFirst, const Progress& goOn);
  void LightHidden();
  void AddGraph(
    const std::vector<std::uint32_t>& numbers, SurfaceEstimator::Request& request) const;
  glm::vec3 GetPosition(const Point& point) const;
  void Refine();
  float GetDistance(const Patch& patch) const;
  bool NeedsMore(const Patch& patch) const;
  std::size_t CountHidden(const Patch& patch) const;
  bool MeetsBody(const Patch& patch) const;
  bool VariesWithin(const Patch& patch) const;
  bool BendsWithin(const Patch& patch) const;
  bool FindBend(int half, std::uint32_t from, std::uint32_t to, Bend& bend) const;
  bool IsCoarse(float distance) const;
  bool IsBright(const glm::vec3& error, const glm::vec3& variance, float distance) const;
  const HalfEstimate& GetPilot(const Patch& patch, std::uint32_t point) const;
  bool IsMissed(const Patch& patch, int i, int j, int sideI, int sideJ) const;
  bool UseOtherPoints(Patch& patch);
  void Split(std::size_t index);
  bool IsEmpty(const Patch& patch) const;
  void Store(const Patch& patch);
  void StoreIncident(const Patch& patch);

  const Scene& World;
  const OpenSides& Sides;
  const LatticeLayout& Layout;
  LatticeSettings Settings;
  SurfaceEstimator* Estimator;
  SurfaceLattice Lattices[2]; // of half of the values each
  IncidentField Incident;
  std::size_t Estimates = 0;
  std::size_t FirstEstimates = 0;
  Choice IsChosen; // empty for all bricks
  std::function<void(const Hit&, const SurfaceEstimate&)> OnEstimate;

  // The current batch of triangles.
  std::vector<Patch> Patches;
  std::vector<Point> Points;
  std::size_t Evaluated = 0;                              // of the points
  std::size_t Means = 0;                                  // those of the points not estimated
  std::unordered_map<std::uint64_t, std::uint32_t> Index; // of points, by their keys

  // The estimated points with which the batch began, and which of them are next to each other.
  PointGraph FirstGraph;
  std::vector<std::uint32_t> FirstPoints;  // of the graph's points
  std::vector<std::uint32_t> FirstNumbers; // of the points in the graph
};

// How often the spacing is halved at the edges of very bright areas, whose errors affect all
// surfaces that they light.
constexpr int ExtraLevels = 5;

/// A point of the surface at which light is estimated or interpolated.
struct LatticeBuilder::Point
{
  Hit Place;
  std::uint64_t Key = 0;
  SurfaceEstimate Estimate;

  // If it lies between two other points that are close enough together, it is interpolated.
  bool IsMean = false;
  std::uint32_t Before = 0;
  std::uint32_t After = 0;
  float Weight = 0.0f; // of the point after it
};

/// How much the light between two points differs from a straight line.
struct LatticeBuilder::Bend
{
  glm::vec3 Middle{ 0.0f }; // half way, added to the mean of both
  glm::vec3 Variance{ 0.0f };
};

/// A brick that is being computed, and the points of its lattice, row by row.
struct LatticeBuilder::Patch
{
  int Half = 0; // which of the two lattices it belongs to, and whose values decide
  std::size_t Brick = 0;
  std::size_t Domain = 0; // its triangle's number, or that of all triangles plus its chart's
  std::uint32_t Mesh = 0;
  std::uint32_t Triangle = 0;          // if it belongs to a triangle
  const SurfaceChart* Chart = nullptr; // if it belongs to a chart
  float RootEdge = 0.0f;               // the longest edge of the brick that contains it
  float RootArea = 0.0f;               // and that brick's area
  int RootSize = 0;                    // of that brick, as below
  bool Back = false;
  bool Flipped = false;
  int Column = 0; // of its first corner among the finest points of the triangle or chart
  int Row = 0;
  int Size = 0; // of its edges, in finest points, as a binary logarithm
  int Level = 0;
  bool IsConstant = false;
  bool IsSmooth = false; // whether it is a whole triangle that shares points with its neighbours
  bool HasOwnVertices = false; // whether its corners do not share the points of vertices nearby,
                               // because those are all hidden
  bool MayShare = true;        // whether its points may be those of a cluster
  bool IsOpen = true;
  std::vector<std::uint32_t> Points;

  float GetArea() const
  {
    return this->RootArea / static_cast<float>(1 << 2 * (this->RootSize - this->Size));
  }

  std::uint32_t GetPoint(int i, int j) const
  {
    return this->Points[PointIndex(i, j, 1 << this->Level)];
  }
};
}

#endif
