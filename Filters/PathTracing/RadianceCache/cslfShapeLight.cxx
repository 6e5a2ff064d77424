// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShapeLight.h"
#include "Pipeline/cslfParallelFor.h"

#include "PathTracing/Materials/cslfBSDF.h"
#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Paths/cslfPathBatch.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfShapePoints.h"

#include <vtkMath.h>
#include <vtkSMPThreadLocal.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace cslf
{
namespace
{
// The weight of the assumption that light is constant in a cell, in samples.
constexpr double Stiffness = 2.0;

// Where shapes reach into each other, light falls steeply into gaps that views hardly see. A sample
// has this weight if a ray from its point, in another direction than the path's, ends within the
// shape's width, so that fits err least where most is seen.
constexpr float GapWeight = 0.03f;

// The fewest samples of a cell.
constexpr int MinimumSamples = 16;

// The samples after which the work may be stopped: about a second's.
constexpr std::uint64_t SamplesAtOnce = std::uint64_t(1) << 20;

/// What a sample finds.
struct Sample
{
  std::uint32_t Cell = ShapeLayout::None;
  ShapeFit::Terms Terms{};
  glm::vec3 Light{ 0.0f };
  float Weight = 1.0f; ///< for the fit
};

/// The samples of one batch of paths, which one rank takes.
struct Samples
{
  Sample All[PathBatch::Capacity];
};

/// The sums from which a cell's fit is computed.
struct Moments
{
  double Products[ShapeFit::Count][ShapeFit::Count] = {};
  double Light[3][ShapeFit::Count] = {};
  int Count = 0;

  void Add(const Sample& sample)
  {
    ++this->Count;
    for (int i = 0; i < ShapeFit::Count; ++i)
    {
      const double weighted = sample.Weight * sample.Terms[i];
      for (int j = 0; j <= i; ++j)
      {
        this->Products[i][j] += weighted * sample.Terms[j];
      }
      for (int channel = 0; channel < 3; ++channel)
      {
        this->Light[channel][i] += weighted * sample.Light[channel];
      }
    }
  }

  ShapeFit Solve() const
  {
    ShapeFit fit;
    if (this->Count < MinimumSamples)
    {
      return fit;
    }
    double matrix[ShapeFit::Count][ShapeFit::Count];
    double* rows[ShapeFit::Count];
    for (int i = 0; i < ShapeFit::Count; ++i)
    {
      rows[i] = matrix[i];
      for (int j = 0; j < ShapeFit::Count; ++j)
      {
        matrix[i][j] = this->Products[std::max(i, j)][std::min(i, j)];
      }
      matrix[i][i] += i > 0 ? Stiffness * this->Products[0][0] / this->Count : 0.0;
    }
    int order[ShapeFit::Count];
    double scratch[ShapeFit::Count];
    if (vtkMath::LUFactorLinearSystem(rows, order, ShapeFit::Count, scratch) == 0)
    {
      return fit;
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      double solution[ShapeFit::Count];
      std::copy_n(this->Light[channel], ShapeFit::Count, solution);
      vtkMath::LUSolveLinearSystem(rows, order, solution, ShapeFit::Count);
      for (int i = 0; i < ShapeFit::Count; ++i)
      {
        fit.Factors[i][channel] = static_cast<float>(solution[i]);
      }
    }
    fit.IsKnown = 1;
    return fit;
  }
};

/// The numbers of [0,1) of one of a unit's samples: of its point and its direction. They are an
/// additive recurrence, because light depends on all of them together: its means over a smooth
/// function of several variables converge faster than those of pairs. Roberts, "The Unreasonable
/// Effectiveness of Quasirandom Sequences", 2018; the steps are powers of the root of x^6 = x + 1.
class SampleNumbers
{
public:
  static constexpr int Count = 5;

  SampleNumbers(std::uint64_t hash, std::uint32_t index)
  {
    constexpr double root = 1.1347241384015194;
    double step = 1.0;
    for (int i = 0; i < Count; ++i)
    {
      step /= root;
      const double start = static_cast<double>(MixBits(hash, i) >> 11) * 0x1p-53;
      const double number = start + step * index;
      this->Values[i] = std::min(static_cast<float>(number - std::floor(number)), BelowOne);
    }
  }

  float operator[](int i) const { return this->Values[i]; }

private:
  float Values[Count];
};

/// Takes samples of cells.
class Sampler
{
public:
  Sampler(const Scene& scene, const PathIntegrator& paths, const ShapeLayout& layout,
    const ShapeLight::Settings& settings)
    : World(scene)
    , Paths(paths)
    , Layout(layout)
    , Points(scene, layout)
    , Settings(settings)
    , Seed(MixBits(settings.Seed, settings.Samples))
    , Batches(PathBatch(1, true))
  {
  }

  /// Takes samples `begin` to `end` of those of all units, which end at these numbers.
  void Take(const std::vector<std::uint64_t>& ends, std::uint64_t begin, std::uint64_t end,
    Samples& samples)
  {
    PathBatch& batch = this->Batches.Local();
    batch.Clear();
    std::vector<Start> starts;
    std::size_t unit = std::upper_bound(ends.begin(), ends.end(), begin) - ends.begin();
    for (std::uint64_t number = begin; number < end; ++number)
    {
      while (number >= ends[unit])
      {
        ++unit;
      }
      const std::uint64_t before = unit > 0 ? ends[unit - 1] : 0;
      this->Add(unit, static_cast<std::uint32_t>(number - before), samples.All[number - begin],
        batch, starts);
    }
    std::uint64_t rays = 0;
    this->Paths.Follow(batch, rays);
    this->Rays += rays + starts.size();
    for (std::size_t path = 0; path < starts.size(); ++path)
    {
      const Start& start = starts[path];
      const Hit seen = batch.GetSeen(static_cast<int>(path));
      if (this->IsOutside(start.First, seen))
      {
        start.Result->Light = start.Transmission * batch.GetRadiance(static_cast<int>(path));
      }
      else
      {
        start.Result->Cell = ShapeLayout::None;
      }
    }
  }

  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  struct Start
  {
    Sample* Result;
    Ray First;
    glm::vec3 Transmission;
  };

  void Add(std::size_t unit, std::uint32_t number, Sample& sample, PathBatch& batch,
    std::vector<Start>& starts) const
  {
    sample.Cell = ShapeLayout::None;
    const std::uint64_t hash = MixBits(this->Seed, unit);
    const SampleNumbers numbers(hash, number);
    ShapePoints::Point point;
    if (!this->Points.Get(unit, numbers[0], { numbers[1], numbers[2] }, point))
    {
      return;
    }
    const SurfaceHit surface = this->World.GetSurface(point.View, point.Seen);
    const ShapeLayout::Place place = this->Layout.Find(point.Seen, surface);
    if (place.Cell == ShapeLayout::None)
    {
      return;
    }
    const Frame frame(surface.ShadingNormal);
    MaterialPoint white = surface.GetMaterialPoint();
    white.BaseColor = glm::vec3(1.0f);
    const BSDF reflection(
      *surface.Material, white, frame.ToLocal(surface.GeometricNormal), surface.Inside);
    if (!reflection.Has(Lobes::Diffuse))
    {
      return;
    }
    const glm::vec3 direction = SampleCosineHemisphere({ numbers[3], numbers[4] });
    PathBatch::Start start;
    start.First = { surface.LeavePosition, frame.ToWorld(direction) };
    start.Hash = hash;
    start.Index = number;
    start.Pdf = CosineHemispherePdf(direction);
    start.Normal = surface.GetReceiverNormal();
    sample.Weight = this->GetWeight(unit, surface, frame, MixBits(hash + 1, number));
    sample.Cell = place.Cell;
    sample.Terms = ShapeFit::MakeTerms(surface.ShadingNormal, place.Offset);
    starts.push_back(
      { &sample, start.First, glm::vec3(reflection.GetDiffuse().GetTransmission(direction.z)) });
    batch.Add(start);
  }

  /// How much a point of a unit's counts.
  float GetWeight(
    std::size_t unit, const SurfaceHit& surface, const Frame& frame, std::uint64_t bits) const
  {
    constexpr float step = 0x1p-24f;
    const glm::vec2 numbers(
      step * static_cast<float>(bits & 0xffffff), step * static_cast<float>(bits >> 40));
    const Ray ray{ surface.LeavePosition, frame.ToWorld(SampleCosineHemisphere(numbers)) };
    const ShapeLayout::Unit& box = this->Layout.GetUnits()[unit];
    const glm::vec3 size = box.Edges * glm::vec3(box.Cells);
    const Hit hit = this->World.Intersect(ray);
    const bool isInGap = hit.IsValid() && hit.Distance < std::min({ size.x, size.y, size.z });
    return isInGap ? GapWeight : 1.0f;
  }

  /// Whether a ray does not start within another body, where no light is seen from outside.
  bool IsOutside(const Ray& ray, const Hit& seen) const
  {
    return !seen.IsValid() || !this->Settings.IsInside || !this->Settings.IsInside(ray, seen);
  }

  const Scene& World;
  const PathIntegrator& Paths;
  const ShapeLayout& Layout;
  ShapePoints Points;
  const ShapeLight::Settings& Settings;
  std::uint64_t Seed;
  vtkSMPThreadLocal<PathBatch> Batches;
  std::atomic<std::uint64_t> Rays{ 0 };
};

/// The samples of a unit: more if it has many cells.
std::uint64_t CountSamples(const ShapeLayout::Unit& unit, int samplesOfCell)
{
  return unit.CountFilled() * static_cast<std::uint64_t>(samplesOfCell);
}

/// The number at which the samples of each unit end. Some units have none if `most` is above 0 and
/// all would have more.
std::vector<std::uint64_t> CountSamples(
  const std::vector<ShapeLayout::Unit>& units, int samplesOfCell, std::uint64_t most, double& share)
{
  std::uint64_t all = 0;
  for (const ShapeLayout::Unit& unit : units)
  {
    all += CountSamples(unit, samplesOfCell);
  }
  const std::uint64_t step = most > 0 ? all / most + 1 : 1;
  std::vector<std::uint64_t> ends;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < units.size(); ++i)
  {
    const std::uint64_t samples = CountSamples(units[i], samplesOfCell);
    count += i % step != 0 ? 0 : most > 0 ? std::min(samples, most) : samples;
    ends.push_back(count);
  }
  share = all > 0 ? static_cast<double>(count) / static_cast<double>(all) : 1.0;
  return ends;
}

/// Adds up samples of units, and makes the fits of those that are complete.
class Fitting
{
public:
  Fitting(const ShapeLayout& layout, const std::vector<std::uint64_t>& ends)
    : Units(layout.GetUnits())
    , Ends(ends)
    , Fits(layout.GetNumberOfCells())
  {
  }

  /// Adds the samples from number `begin` on, in order.
  void Add(const std::vector<Samples>& samples, std::uint64_t begin, std::uint64_t end)
  {
    const auto first = std::upper_bound(this->Ends.begin(), this->Ends.end(), begin);
    const auto last = std::lower_bound(first, this->Ends.end(), end);
    std::vector<Moments> rest;
    ParallelFor(first - this->Ends.begin(),
      last - this->Ends.begin() + (last == this->Ends.end() ? 0 : 1), 0,
      [&](vtkIdType from, vtkIdType to)
      {
        std::vector<Moments> moments;
        for (vtkIdType unit = from; unit < to; ++unit)
        {
          const std::uint64_t start = unit > 0 ? this->Ends[unit - 1] : 0;
          moments.assign(this->Units[unit].GetNumberOfCells(), Moments());
          if (start < begin)
          {
            moments = this->Rest;
          }
          this->Sum(unit, samples, begin, std::max(start, begin), end, moments);
          if (this->Ends[unit] > end)
          {
            rest = moments;
            continue;
          }
          for (std::size_t cell = 0; cell < moments.size(); ++cell)
          {
            this->Fits[this->Units[unit].First + cell] = moments[cell].Solve();
          }
        }
      });
    this->Rest = std::move(rest);
  }

  std::vector<ShapeFit> TakeFits() { return std::move(this->Fits); }

private:
  void Sum(std::size_t unit, const std::vector<Samples>& samples, std::uint64_t begin,
    std::uint64_t from, std::uint64_t end, std::vector<Moments>& moments) const
  {
    constexpr std::uint64_t size = PathBatch::Capacity;
    for (std::uint64_t number = from; number < std::min(end, this->Ends[unit]); ++number)
    {
      const Sample& sample = samples[(number - begin) / size].All[(number - begin) % size];
      if (sample.Cell != ShapeLayout::None)
      {
        moments[sample.Cell - this->Units[unit].First].Add(sample);
      }
    }
  }

  const std::vector<ShapeLayout::Unit>& Units;
  const std::vector<std::uint64_t>& Ends;
  std::vector<ShapeFit> Fits;
  std::vector<Moments> Rest; // of the unit that is not complete
};
}

bool ShapeLight::Estimate(const Scene& scene, const PathIntegrator& paths, const Settings& settings,
  const std::function<bool(double)>& goOn)
{
  double part = 1.0;
  const std::vector<std::uint64_t> ends =
    CountSamples(this->Layout.GetUnits(), settings.Samples, settings.MaximumPaths, part);
  const std::uint64_t count = ends.empty() ? 0 : ends.back();
  Sampler sampler(scene, paths, this->Layout, settings);
  Fitting fitting(this->Layout, ends);
  CacheShare* share = settings.Share;
  constexpr std::uint64_t size = PathBatch::Capacity;
  for (std::uint64_t first = 0; first < count; first += SamplesAtOnce)
  {
    if (!goOn(static_cast<double>(first) / static_cast<double>(count)))
    {
      return false;
    }
    const std::uint64_t last = std::min(first + SamplesAtOnce, count);
    std::vector<Samples> samples((last - first + size - 1) / size);
    ParallelFor(0, static_cast<vtkIdType>(samples.size()), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          if (!share || share->GetOwner(i) == share->GetRank())
          {
            const std::uint64_t start = first + i * size;
            sampler.Take(ends, start, std::min(start + size, last), samples[i]);
          }
        }
      });
    if (share)
    {
      share->Complete(samples, 0);
    }
    fitting.Add(samples, first, last);
  }
  if (!goOn(1.0))
  {
    return false;
  }
  this->Fits = fitting.TakeFits();
  this->Share = part;
  this->Rays += sampler.GetNumberOfRays();
  return true;
}
}
