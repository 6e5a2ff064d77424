// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLatticeBuilder.h"

#include "cslfLatticeSum.h"

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// The finest lattice of one brick. Finer bricks are split.
constexpr int LeafLevel = 2;

// The number of bricks processed together: they share points, and keep all threads busy, with
// bounded memory.
constexpr std::size_t BatchBricks = std::size_t(1) << 18;

// The number of an interpolated point.
constexpr std::uint32_t NotEstimated = 0xffffffffu;
}

LatticeBuilder::LatticeBuilder(const Scene& scene, const OpenSides& sides,
  const LatticeLayout& layout, LatticeSettings settings, SurfaceEstimator& estimator)
  : World(scene)
  , Sides(sides)
  , Layout(layout)
  , Settings(settings)
  , Estimator(&estimator)
  , Lattices{ layout.MakeLattice(), layout.MakeLattice() }
{
}

LatticeBuilder::~LatticeBuilder() = default;

bool LatticeBuilder::Build(const Progress& goOn)
{
  const bool done = this->AddAll(
    [this, &goOn](double begin, double end)
    {
      return goOn(begin) &&
        this->BuildBatch([&](double part) { return goOn(begin + (end - begin) * part); });
    });
  return done && goOn(1.0);
}

bool LatticeBuilder::AddAll(const std::function<bool(double begin, double end)>& useBatch)
{
  const std::vector<Mesh>& meshes = this->World.GetMeshes();
  const std::size_t charts = this->Layout.GetCharts().size();
  const auto all = static_cast<double>(this->Lattices[0].GetNumberOfTriangles() + charts);
  std::size_t used = 0;
  std::size_t added = 0;
  const auto useFullBatch = [&]
  {
    ++added;
    if (this->Patches.size() < BatchBricks)
    {
      return true;
    }
    const bool goesOn = useBatch(used / all, added / all);
    used = added;
    return goesOn;
  };
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
  {
    // Surfaces that reflect nothing keep the value of an empty brick, which is 0.
    const bool isBuilt = meshes[mesh].CanHoldLattice() && !meshes[mesh].IsBlack();
    const std::size_t triangles = isBuilt ? meshes[mesh].Triangles.size() : 0;
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle)
    {
      this->AddTriangle(mesh, triangle);
      if (!useFullBatch())
      {
        return false;
      }
    }
  }
  for (std::size_t chart = 0; chart < charts; ++chart)
  {
    if (!meshes[this->Layout.GetCharts()[chart].GetMesh()].IsBlack())
    {
      this->AddChart(chart);
    }
    if (!useFullBatch())
    {
      return false;
    }
  }
  return useBatch(used / all, 1.0);
}

void LatticeBuilder::AddTriangle(std::uint32_t mesh, std::uint32_t triangle)
{
  const std::size_t index = this->World.GetTriangleIndex(mesh, triangle);
  if (this->Layout.IsOnChart(index))
  {
    return;
  }
  const int splits = this->Lattices[0].GetSplits(index);
  const int depth = this->Layout.GetDepth(index);
  const int levels = std::min(depth, LatticeLayout::BrickLevels);
  const Mesh& surface = this->World.GetMeshes()[mesh];
  Patch patch;
  patch.Domain = index;
  patch.Mesh = mesh;
  patch.Triangle = triangle;
  patch.RootEdge = surface.GetLongestEdge(triangle) / static_cast<float>(splits);
  patch.RootArea = surface.GetArea(triangle) / static_cast<float>(splits * splits);
  patch.RootSize = levels + ExtraLevels;
  patch.Size = patch.RootSize;
  patch.Level = std::min({ levels, this->Settings.FirstLevel, LeafLevel });
  patch.IsConstant = depth <= this->Settings.SmallLevels && surface.Normals.empty();
  patch.IsSmooth = splits == 1 && patch.Level == 0 && !surface.Normals.empty();
  for (const bool back : { false, true })
  {
    patch.Back = back;
    for (int j = 0; j < splits && this->Sides.Has(index, back); ++j)
    {
      for (int i = 0; i < 2 * (splits - j) - 1; ++i)
      {
        patch.Flipped = i % 2 == 1;
        patch.Column = (i + 1) / 2 << patch.Size;
        patch.Row = (patch.Flipped ? j + 1 : j) << patch.Size;
        patch.Brick =
          this->Lattices[0].GetBrickIndex(index, back, CellIndex(i / 2, j, patch.Flipped, splits));
        if (!this->IsChosen || this->IsChosen(patch.Brick))
        {
          this->AddPatch(patch);
        }
      }
    }
  }
}

void LatticeBuilder::AddChart(std::size_t index)
{
  const SurfaceChart& chart = this->Layout.GetCharts()[index];
  const int levels = this->Layout.GetCellDepth(chart);
  Patch patch;
  patch.Domain = this->Lattices[0].GetNumberOfTriangles() + index;
  patch.Mesh = chart.GetMesh();
  patch.Chart = &chart;
  patch.RootEdge = std::max(chart.GetCellSize().x, chart.GetCellSize().y);
  patch.RootArea = 0.5f * chart.GetCellSize().x * chart.GetCellSize().y;
  patch.RootSize = levels + ExtraLevels;
  patch.Size = patch.RootSize;
  patch.Level = std::min({ levels, this->Settings.FirstLevel, LeafLevel });
  patch.IsConstant = levels == 0 && chart.GetBricksOfSide() == 2;
  for (const bool back : { false, true })
  {
    patch.Back = back;
    for (int row = 0; row < chart.GetRows(); ++row)
    {
      for (int column = 0; column < chart.GetColumns(); ++column)
      {
        this->AddChartCell(patch, index, column, row);
      }
    }
  }
}

void LatticeBuilder::AddChartCell(Patch& patch, std::size_t index, int column, int row)
{
  for (const bool flipped : { false, true })
  {
    patch.Flipped = flipped;
    patch.Column = (flipped ? column + 1 : column) << patch.Size;
    patch.Row = (flipped ? row + 1 : row) << patch.Size;
    const int cell = 2 * (row * patch.Chart->GetColumns() + column) + (flipped ? 1 : 0);
    patch.Brick = this->Lattices[0].GetChartBrickIndex(index, patch.Back, cell);
    if (!this->IsEmpty(patch) && (!this->IsChosen || this->IsChosen(patch.Brick)))
    {
      this->AddPatch(patch);
    }
  }
}

void LatticeBuilder::AddPatch(Patch patch)
{
  for (const int half : { 0, 1 })
  {
    patch.Half = half;
    this->Patches.push_back(patch);
  }
}

bool LatticeBuilder::BuildPart(const Choice& choice,
  const std::function<void(const Hit& place, const SurfaceEstimate& estimate)>& onEstimate,
  const Progress& goOn)
{
  this->IsChosen = choice;
  this->OnEstimate = onEstimate;
  const bool done = this->Build(goOn);
  this->IsChosen = nullptr;
  this->OnEstimate = nullptr;
  return done;
}

bool LatticeBuilder::FillPart(
  const Choice& choice, SurfaceEstimator& estimator, const Progress& goOn)
{
  LatticeSettings settings = this->Settings;
  settings.Tolerance = std::numeric_limits<float>::infinity();
  settings.FirstLevel = 0;
  settings.Exposure = 0.0;
  SurfaceEstimator* filling = &estimator;
  std::swap(settings, this->Settings);
  std::swap(filling, this->Estimator);
  const bool done = this->BuildPart(choice, nullptr, goOn);
  std::swap(filling, this->Estimator);
  std::swap(settings, this->Settings);
  return done;
}

bool LatticeBuilder::CountFirstPoints(
  const Choice& choice, std::size_t& count, const Progress& goOn)
{
  count = 0;
  this->IsChosen = choice;
  const bool done = this->AddAll(
    [&](double begin, double)
    {
      for (Patch& patch : this->Patches)
      {
        this->RequestAll(patch);
      }
      count += this->Points.size() - this->Means;
      this->ClearBatch();
      return goOn(begin);
    });
  this->IsChosen = nullptr;
  return done;
}

bool LatticeBuilder::BuildBatch(const Progress& goOn)
{
  bool isFirst = true;
  double done = 0.0;
  while (std::any_of(
    this->Patches.begin(), this->Patches.end(), [](const Patch& patch) { return patch.IsOpen; }))
  {
    for (Patch& patch : this->Patches)
    {
      if (patch.IsOpen)
      {
        this->RequestAll(patch);
      }
    }
    this->FirstEstimates += isFirst ? this->Points.size() - this->Means : 0;
    if (!goOn(done))
    {
      this->ClearBatch();
      return false;
    }
    // It is not known how many rounds there will be. Each counts as half of what remains.
    const double part = 0.5 * (1.0 - done);
    if (!this->EvaluateRequests(
          isFirst, [&](double evaluated) { return goOn(done + part * evaluated); }))
    {
      this->ClearBatch();
      return false;
    }
    done += part;
    if (!goOn(done))
    {
      this->ClearBatch();
      return false;
    }
    for (std::size_t i = 0; isFirst && i < this->Patches.size(); ++i)
    {
      if (this->Patches[i].Half == 0)
      {
        this->StoreIncident(this->Patches[i]);
      }
    }
    isFirst = false;
    this->Refine();
  }
  if (!goOn(done))
  {
    this->ClearBatch();
    return false;
  }
  for (const Patch& patch : this->Patches)
  {
    this->Store(patch);
  }
  for (const Point& point : this->Points)
  {
    if (this->OnEstimate && !point.IsMean && !point.Estimate.IsHidden)
    {
      this->OnEstimate(point.Place, point.Estimate);
    }
  }
  this->Estimates += this->Points.size() - this->Means;
  this->ClearBatch();
  return true;
}

void LatticeBuilder::ClearBatch()
{
  this->Patches.clear();
  this->Points.clear();
  this->Index.clear();
  this->FirstGraph = PointGraph();
  this->FirstPoints.clear();
  this->FirstNumbers.clear();
  this->Evaluated = 0;
  this->Means = 0;
}

void LatticeBuilder::Refine()
{
  const std::size_t count = this->Patches.size();
  for (std::size_t index = 0; index < count; ++index)
  {
    Patch& patch = this->Patches[index];
    if (patch.IsOpen && this->CountHidden(patch) == patch.Points.size() &&
      this->UseOtherPoints(patch))
    {
      continue;
    }
    patch.IsOpen =
      patch.IsOpen && !patch.IsConstant && patch.Level < patch.Size && this->NeedsMore(patch);
    if (patch.IsOpen && patch.Level < LeafLevel)
    {
      ++patch.Level;
    }
    else if (patch.IsOpen)
    {
      this->Split(index);
    }
  }
}

/// Gives a brick whose points are all hidden others, which may be outside. False if there are none.
bool LatticeBuilder::UseOtherPoints(Patch& patch)
{
  if (this->IsClustered(patch))
  {
    patch.MayShare = false;
    return true;
  }
  if (patch.IsConstant)
  {
    if (!patch.Chart)
    {
      // The first corner has this point's key.
      this->Index.erase(this->Points[patch.Points[0]].Key);
    }
    patch.IsConstant = false;
    return true;
  }
  if (patch.IsSmooth && patch.Level == 0 && patch.Size == patch.RootSize && !patch.HasOwnVertices)
  {
    patch.HasOwnVertices = true;
    return true;
  }
  return false;
}

void LatticeBuilder::Split(std::size_t index)
{
  const Patch parent = this->Patches[index];
  const std::size_t first = this->Lattices[parent.Half].SplitBrick(parent.Brick);
  const int half = (parent.Flipped ? -1 : 1) * (1 << (parent.Size - 1));
  bool hasReplaced = false;
  // The cells in order: two on the first row with the flipped one between them, one on the second.
  for (int cell = 0; cell < 4; ++cell)
  {
    Patch child = parent;
    child.Brick = first + cell;
    child.Size = parent.Size - 1;
    child.Flipped = parent.Flipped != (cell == 1);
    child.Column += cell == 1 || cell == 2 ? half : 0;
    child.Row += cell == 1 || cell == 3 ? half : 0;
    child.Points.clear();
    if (parent.Chart && this->IsEmpty(child) && (hasReplaced || cell < 3))
    {
      // There is no triangle.
      const HalfEstimate& value = this->Points[parent.Points[0]].Estimate.Halves[1 - parent.Half];
      this->Lattices[parent.Half].SetBrick(
        child.Brick, SurfaceLattice::Constant, { 0.5f * value.Value });
    }
    else if (!hasReplaced)
    {
      this->Patches[index] = child;
      hasReplaced = true;
    }
    else
    {
      this->Patches.push_back(child);
    }
  }
}

bool LatticeBuilder::IsEmpty(const Patch& patch) const
{
  const float scale = 1.0f / static_cast<float>(1 << patch.RootSize);
  const float size = (patch.Flipped ? -scale : scale) * static_cast<float>(1 << patch.Size);
  const glm::vec2 corner = scale * glm::vec2(patch.Column, patch.Row);
  const glm::vec2 corners[3] = { corner, corner + glm::vec2(size, 0.0f),
    corner + glm::vec2(0.0f, size) };
  return !patch.Chart->Overlaps(patch.Back, corners);
}

bool LatticeBuilder::EvaluateRequests(bool isFirst, const Progress& goOn)
{
  SurfaceEstimator::Request request;
  request.WantsIncident = isFirst;
  request.GoOn = goOn;
  std::vector<std::uint32_t> numbers; // of new points in the request
  for (std::size_t index = this->Evaluated; index < this->Points.size(); ++index)
  {
    const Point& point = this->Points[index];
    numbers.push_back(
      point.IsMean ? NotEstimated : static_cast<std::uint32_t>(request.Points.size()));
    if (!point.IsMean)
    {
      request.Points.push_back({ point.Place, point.Key });
    }
  }
  this->AddGraph(numbers, request);
  const std::vector<SurfaceEstimate> estimates = this->Estimator->Estimate(request);
  if (estimates.size() < request.Points.size())
  {
    return false;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (numbers[i] != NotEstimated)
    {
      this->Points[this->Evaluated + i].Estimate = estimates[numbers[i]];
    }
  }
  for (std::size_t index = this->Evaluated; index < this->Points.size(); ++index)
  {
    Point& point = this->Points[index];
    if (point.IsMean)
    {
      point.Estimate = Interpolate(
        this->Points[point.Before].Estimate, this->Points[point.After].Estimate, point.Weight);
    }
  }
  this->Evaluated = this->Points.size();
  this->LightHidden();
  if (isFirst)
  {
    this->FirstGraph = std::move(request.Graph);
    for (std::uint32_t index = 0; index < numbers.size(); ++index)
    {
      if (numbers[index] != NotEstimated)
      {
        this->FirstPoints.push_back(index);
      }
    }
    this->FirstNumbers = std::move(numbers);
  }
  return true;
}

/// Gives points inside closed bodies the mean light of their neighbours outside, because between
/// them it is interpolated.
void LatticeBuilder::LightHidden()
{
  if (std::none_of(this->Points.begin(), this->Points.end(),
        [](const Point& point) { return point.Estimate.IsHidden; }))
  {
    return;
  }
  struct Mean
  {
    SurfaceEstimate Light;
    float Counts[2] = {}; // of the neighbours in bricks of each half
  };
  std::unordered_map<std::uint32_t, Mean> means;
  const auto add = [&](int half, std::uint32_t to, std::uint32_t from)
  {
    const SurfaceEstimate& estimate = this->Points[from].Estimate;
    if (this->Points[to].Estimate.IsHidden && !estimate.IsHidden)
    {
      Mean& mean = means[to];
      const float weight = 1.0f / ++mean.Counts[half];
      HalfEstimate& pilot = mean.Light.Halves[half];
      HalfEstimate& other = mean.Light.Halves[1 - half];
      pilot.Pilot = glm::mix(pilot.Pilot, estimate.Halves[half].Pilot, weight);
      pilot.Variance = glm::mix(pilot.Variance, estimate.Halves[half].Variance, weight);
      other.Value = glm::mix(other.Value, estimate.Halves[1 - half].Value, weight);
    }
  };
  for (const Patch& patch : this->Patches)
  {
    const int splits = patch.IsConstant ? 0 : 1 << patch.Level;
    for (int j = 0; j < splits; ++j)
    {
      for (int i = 0; i < splits - j; ++i)
      {
        const std::uint32_t corners[] = { patch.GetPoint(i, j), patch.GetPoint(i + 1, j),
          patch.GetPoint(i, j + 1) };
        for (int corner = 0; corner < 3; ++corner)
        {
          add(patch.Half, corners[corner], corners[(corner + 1) % 3]);
          add(patch.Half, corners[(corner + 1) % 3], corners[corner]);
        }
      }
    }
  }
  for (const auto& [point, mean] : means)
  {
    for (int half = 0; half < 2; ++half)
    {
      // A half's bricks decide by its pilot, and store the values of the other half.
      if (mean.Counts[half] > 0.0f)
      {
        SurfaceEstimate& estimate = this->Points[point].Estimate;
        estimate.Halves[half].Pilot = mean.Light.Halves[half].Pilot;
        estimate.Halves[half].Variance = mean.Light.Halves[half].Variance;
        estimate.Halves[1 - half].Value = mean.Light.Halves[1 - half].Value;
      }
    }
  }
}

/// Adds the areas of the new points, and which of them are next to each other.
void LatticeBuilder::AddGraph(
  const std::vector<std::uint32_t>& numbers, SurfaceEstimator::Request& request) const
{
  std::vector<PointGraph::Edge> edges;
  std::vector<float> areas[2];
  for (std::vector<float>& areasOfHalf : areas)
  {
    areasOfHalf.resize(request.Points.size(), 0.0f);
  }
  const auto getNumber = [&](std::uint32_t point)
  { return point >= this->Evaluated ? numbers[point - this->Evaluated] : NotEstimated; };
  for (const Patch& patch : this->Patches)
  {
    const int splits = patch.IsOpen && !patch.IsConstant ? 1 << patch.Level : 0;
    const float area = patch.GetArea() / static_cast<float>(patch.Points.size());
    for (const std::uint32_t point : patch.Points)
    {
      if (getNumber(point) != NotEstimated)
      {
        areas[patch.Half][getNumber(point)] += area;
      }
    }
    for (int j = 0; j < splits; ++j)
    {
      for (int i = 0; i < splits - j; ++i)
      {
        const std::uint32_t corners[] = { getNumber(patch.GetPoint(i, j)),
          getNumber(patch.GetPoint(i + 1, j)), getNumber(patch.GetPoint(i, j + 1)) };
        for (int corner = 0; corner < 3; ++corner)
        {
          const std::uint32_t other = corners[(corner + 1) % 3];
          if (corners[corner] != NotEstimated && other != NotEstimated && corners[corner] != other)
          {
            edges.emplace_back(corners[corner], other);
          }
        }
      }
    }
  }
  for (std::size_t point = 0; point < request.Points.size(); ++point)
  {
    request.Points[point].Area = std::max(areas[0][point], areas[1][point]);
  }
  request.Graph = PointGraph(request.Points.size(), edges);
}

void LatticeBuilder::StoreIncident(const Patch& patch)
{
  std::vector<IncidentLight> lights;
  std::vector<IncidentLight> pilots;
  for (std::uint32_t index : patch.Points)
  {
    const SurfaceEstimate& estimate = this->Points[index].Estimate;
    if (estimate.IsHidden)
    {
      continue;
    }
    if (!estimate.Incident.IsKnown())
    {
      return;
    }
    lights.push_back(estimate.Incident);
    pilots.push_back(estimate.IncidentPilot);
  }
  if (lights.empty())
  {
    return;
  }
  constexpr float third = 1.0f / 3.0f;
  TrianglePoint middle{ patch.Triangle, third, third };
  if (patch.Chart)
  {
    const float size = patch.Flipped ? -third : third;
    const auto cell = static_cast<float>(1 << patch.RootSize);
    middle =
      patch.Chart->Find(patch.Back, glm::vec2(patch.Column, patch.Row) / cell + glm::vec2(size));
  }
  Hit center = this->Points[patch.Points[0]].Place;
  center.Triangle = middle.Triangle;
  center.U = middle.U;
  center.V = middle.V;
  this->Incident.Resize(this->Lattices[0].GetNumberOfRoots());
  this->Incident.Set(
    patch.Brick, Average(lights, pilots, this->World.GetSurface(center).ShadingNormal));
}

void LatticeBuilder::Store(const Patch& patch)
{
  std::vector<glm::vec3> values;
  for (std::uint32_t index : patch.Points)
  {
    values.push_back(0.5f * this->Points[index].Estimate.Halves[1 - patch.Half].Value);
  }
  const bool varies = std::any_of(values.begin(), values.end(),
    [&values](const glm::vec3& value) { return value != values.front(); });
  values.resize(varies ? values.size() : 1);
  this->Lattices[patch.Half].SetBrick(patch.Brick,
    varies ? static_cast<std::uint32_t>(patch.Level) : SurfaceLattice::Constant, values);
}

SurfaceLattice LatticeBuilder::TakeLattice(const LayoutProgress& progress)
{
  SurfaceLattice sum = AddLattices(this->Lattices[0], this->Lattices[1], progress);
  for (SurfaceLattice& lattice : this->Lattices)
  {
    lattice = SurfaceLattice();
  }
  return sum;
}
}
