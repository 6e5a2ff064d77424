// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfColorFit.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfParallelFor.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <atomic>
#include <cmath>
#include <iterator>
#include <numeric>
#include <thread>
#include <unordered_map>
#include <utility>

namespace cslf
{
namespace
{
/// The cosine of the largest angle between triangles that share the colour of a corner.
constexpr float CreaseCosine = 0.77f;

/// At an edge where many triangles meet, each is compared with fewer than this many others.
constexpr std::size_t MaximumMeetings = 8;

/// How near places on a map are, in columns, to become one.
constexpr float MaximumDistance = 0.01f;

/// The same for values of arrays, as shares of their ranges.
constexpr float MaximumArrayDistance = 5e-4f;

/// How little samples of arrays differ, as shares of ranges, to be the same but for rounding.
constexpr float SameShare = 1e-6f;

/// How little colours of corners at one place differ to become one.
constexpr float MaximumDifference = 2.0f / 255.0f;

/// The RMS error of the triangles around a point whose colour shows the surface well, in
/// tolerances: views that are interpolated between viewpoints are worse.
constexpr double ExactTolerances = 12.0;

/// The same for detail that is finer than the triangles, which viewpoints may show.
constexpr double ExactDetailTolerances = 3.0;

/// If no more of what is sampled has larger errors, there are no viewpoints for so little.
constexpr double MaximumRest = 0.005;

/// Differences of the corners of a triangle weigh this much beside its samples: of colours, and of
/// places on maps and values of arrays, which have no noise, where at least that share of the
/// triangle has samples.
constexpr float Smoothness = 1e-3f;
constexpr float ValueSmoothness = 1e-5f;
constexpr float SampledShare = 0.9f;

/// The solver's limits.
constexpr int MaximumIterations = 60;
constexpr double SolvedShare = 1e-8;

std::uint64_t EdgeOf(unsigned int a, unsigned int b)
{
  return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}
}

ColorFit::ColorFit(SurfaceMesh& mesh, const ColorFitSettings& settings)
  : Settings(settings)
  , Surface(mesh)
  , Samples(mesh.Triangles.size())
  , AreNew(mesh.Triangles.size(), 1)
{
}

std::vector<std::size_t> ColorFit::ListNew() const
{
  std::vector<std::size_t> triangles;
  for (std::size_t i = 0; i < this->AreNew.size(); ++i)
  {
    if (this->AreNew[i] != 0)
    {
      triangles.push_back(i);
    }
  }
  return triangles;
}

// Triangles that meet at an edge share its colours unless there is a crease or another region.
void ColorFit::JoinCorners()
{
  const std::vector<glm::uvec3>& triangles = this->Surface.Triangles;
  if (this->Settings.KeepsMesh)
  {
    this->Values = triangles;
    this->Places.resize(this->Surface.Points.size());
    std::iota(this->Places.begin(), this->Places.end(), 0U);
    return;
  }
  struct Use
  {
    std::uint64_t Edge;
    unsigned int Triangle;
  };
  std::vector<Use> uses;
  uses.reserve(3 * triangles.size());
  for (unsigned int i = 0; i < triangles.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      uses.push_back({ EdgeOf(triangles[i][k], triangles[i][(k + 1) % 3]), i });
    }
  }
  std::sort(uses.begin(), uses.end(),
    [](const Use& a, const Use& b)
    { return a.Edge != b.Edge ? a.Edge < b.Edge : a.Triangle < b.Triangle; });
  std::vector<unsigned int> next(uses.size());
  std::iota(next.begin(), next.end(), 0U);
  const auto find = [&](unsigned int corner)
  {
    for (; next[corner] != corner; corner = next[corner])
    {
      next[corner] = next[next[corner]];
    }
    return corner;
  };
  const auto cornerAt = [&](const Use& use, unsigned int point)
  {
    const glm::uvec3& corners = triangles[use.Triangle];
    return 3 * use.Triangle + (corners.x == point ? 0 : corners.y == point ? 1 : 2);
  };
  for (std::size_t first = 0; first < uses.size(); ++first)
  {
    const std::size_t end = std::min(first + MaximumMeetings, uses.size());
    for (std::size_t i = first + 1; i < end && uses[i].Edge == uses[first].Edge; ++i)
    {
      const TriangleSamples& one = this->Samples[uses[first].Triangle];
      const TriangleSamples& other = this->Samples[uses[i].Triangle];
      // Those without area or samples join nothing, lest they join what does not belong together.
      const bool isFlat = !this->Settings.HasCreases || (one.IsRound && other.IsRound) ||
        glm::dot(one.Normal, other.Normal) > CreaseCosine;
      if (isFlat && one.Region == other.Region && one.Area > 0.0f && other.Area > 0.0f)
      {
        for (const auto point : { static_cast<unsigned int>(uses[i].Edge),
               static_cast<unsigned int>(uses[i].Edge >> 32) })
        {
          const unsigned int from = find(cornerAt(uses[i], point));
          const unsigned int to = find(cornerAt(uses[first], point));
          next[std::max(from, to)] = std::min(from, to);
        }
      }
    }
  }
  this->Values.resize(triangles.size());
  this->Places.clear();
  std::vector<unsigned int> numbers(uses.size());
  for (unsigned int corner = 0; corner < next.size(); ++corner)
  {
    const unsigned int root = find(corner);
    if (root == corner)
    {
      numbers[corner] = static_cast<unsigned int>(this->Places.size());
      this->Places.push_back(triangles[corner / 3][static_cast<int>(corner % 3)]);
    }
    this->Values[corner / 3][static_cast<int>(corner % 3)] = numbers[root];
  }
}

float ColorFit::GetSmoothness(std::size_t triangle, int kind) const
{
  const bool isSure = kind >= PlaceKind &&
    this->GetSums(triangle, kind).Weight >= SampledShare * this->Samples[triangle].Area;
  return isSure ? ValueSmoothness : Smoothness;
}

// The matrix of least squares times a vector.
void ColorFit::Apply(
  int kind, const std::vector<glm::vec3>& values, std::vector<glm::vec3>& results) const
{
  std::fill(results.begin(), results.end(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < this->Values.size(); ++i)
  {
    const glm::uvec3& corners = this->Values[i];
    const glm::vec3 own[3] = { values[corners.x], values[corners.y], values[corners.z] };
    glm::vec3 products[3];
    this->GetSums(i, kind).Multiply(own, products);
    const float smoothness = this->GetSmoothness(i, kind) * this->Samples[i].Area;
    const glm::vec3 sum = own[0] + own[1] + own[2];
    for (int k = 0; k < 3; ++k)
    {
      results[corners[k]] += products[k] + smoothness * (3.0f * own[k] - sum);
    }
  }
}

// The method of conjugate gradients, preconditioned by the matrix's diagonal.
void ColorFit::SolveKind(int kind, const std::function<bool()>& goOn)
{
  const std::size_t count = this->Places.size();
  std::vector<glm::vec3> rest(count, glm::vec3(0.0f));
  std::vector<float> diagonal(count, 0.0f);
  std::vector<float> weights(count, 0.0f);
  std::vector<glm::vec3>& values = this->Colors[kind];
  for (std::size_t i = 0; i < this->Values.size(); ++i)
  {
    const SampleSums& sums = this->GetSums(i, kind);
    for (int k = 0; k < 3; ++k)
    {
      const unsigned int place = this->Values[i][k];
      rest[place] += sums.GetProduct(k);
      diagonal[place] +=
        sums.Squares[k] + 2.0f * this->GetSmoothness(i, kind) * this->Samples[i].Area;
      weights[place] += sums.GetShare(k);
    }
  }
  values.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = weights[i] > 0.0f ? rest[i] / weights[i] : glm::vec3(0.0f);
    diagonal[i] = diagonal[i] > 0.0f ? 1.0f / diagonal[i] : 0.0f;
  }
  std::vector<glm::vec3> product(count);
  this->Apply(kind, values, product);
  std::vector<glm::vec3> direction(count);
  glm::dvec3 length(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    rest[i] -= product[i];
    direction[i] = diagonal[i] * rest[i];
    length += glm::dvec3(rest[i] * direction[i]);
  }
  const glm::dvec3 enough = SolvedShare * length;
  for (int k = 0; k < MaximumIterations && goOn(); ++k)
  {
    this->Apply(kind, direction, product);
    glm::dvec3 curvature(0.0);
    for (std::size_t i = 0; i < count; ++i)
    {
      curvature += glm::dvec3(direction[i] * product[i]);
    }
    glm::vec3 step(0.0f);
    for (int c = 0; c < 3; ++c)
    {
      step[c] =
        curvature[c] > 0.0 && length[c] > enough[c] ? float(length[c] / curvature[c]) : 0.0f;
    }
    if (step == glm::vec3(0.0f))
    {
      break;
    }
    glm::dvec3 next(0.0);
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] += step * direction[i];
      rest[i] -= step * product[i];
      next += glm::dvec3(diagonal[i] * rest[i] * rest[i]);
    }
    glm::vec3 turn(0.0f);
    for (int c = 0; c < 3; ++c)
    {
      turn[c] = length[c] > 0.0 ? float(next[c] / length[c]) : 0.0f;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      direction[i] = diagonal[i] * rest[i] + turn * direction[i];
    }
    length = next;
  }
}

void ColorFit::Solve(const std::function<void(double)>& proceed)
{
  this->JoinCorners();
  const bool hasMaps = std::any_of(this->Samples.begin(), this->Samples.end(),
    [](const TriangleSamples& samples) { return samples.Map > 0; });
  const std::size_t arrays = this->Samples.empty() ? 0 : this->Samples.front().Arrays.size();
  const int kinds = hasMaps ? FirstArrayKind + static_cast<int>(arrays) : PlaceKind;
  this->Colors.assign(FirstArrayKind + arrays, {});
  // Only this thread may report, which it does while it computes.
  std::atomic<bool> isStopped{ false };
  const auto goOn = [&, caller = std::this_thread::get_id()]
  {
    try
    {
      if (std::this_thread::get_id() == caller)
      {
        proceed(1.0);
      }
    }
    catch (...)
    {
      isStopped = true;
      throw;
    }
    return !isStopped;
  };
  ParallelFor(0, kinds, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType kind = begin; kind < end; ++kind)
      {
        this->SolveKind(static_cast<int>(kind), goOn);
      }
    });
}

// Light on dark surfaces may err by more: displayed colours are about the products of both.
double ColorFit::FindError(std::size_t triangle, int side) const
{
  const glm::uvec3& corners = this->Values[triangle];
  const std::vector<glm::vec3>& colors = this->Colors[side];
  const glm::vec3 own[3] = { colors[corners.x], colors[corners.y], colors[corners.z] };
  const TriangleSamples& samples = this->Samples[triangle];
  return samples.BaseSquare * samples.Sides[side].GetError(own) / 3.0;
}

// The error of places, as one of colours that is as bad.
double ColorFit::FindPlaceError(std::size_t triangle) const
{
  const TriangleSamples& samples = this->Samples[triangle];
  if (samples.Map == 0)
  {
    return 0.0;
  }
  const glm::uvec3& corners = this->Values[triangle];
  const std::vector<glm::vec3>& places = this->Colors[PlaceKind];
  const glm::vec3 own[3] = { places[corners.x], places[corners.y], places[corners.z] };
  const double factor = this->Settings.Tolerance / samples.PlaceTolerance;
  return factor * factor * samples.Places.GetError(own);
}

// The same for values of arrays.
double ColorFit::FindArrayError(std::size_t triangle) const
{
  const TriangleSamples& samples = this->Samples[triangle];
  const glm::uvec3& corners = this->Values[triangle];
  double most = 0.0;
  for (std::size_t i = 0; i < samples.Arrays.size() && samples.Map > 0; ++i)
  {
    const std::vector<glm::vec3>& values = this->Colors[FirstArrayKind + i];
    const glm::vec3 own[3] = { values[corners.x], values[corners.y], values[corners.z] };
    most = std::max(most, samples.Arrays[i].GetError(own));
  }
  const double factor = most > 0.0 ? this->Settings.Tolerance / this->Settings.ArrayTolerance : 0.0;
  return factor * factor * most;
}

// Whether the colours of a triangle vary more than a number of tolerances, however they are lit.
bool ColorFit::HasDetail(std::size_t triangle, double tolerances) const
{
  const double tolerance = tolerances * this->Settings.DetailTolerance;
  return this->Samples[triangle].Detail / 3.0 >
    tolerance * tolerance * this->Samples[triangle].Area;
}

float ColorFit::FindLength(std::size_t triangle, int edge) const
{
  const glm::uvec3& corners = this->Surface.Triangles[triangle];
  return glm::distance(
    this->Surface.Points[corners[edge]], this->Surface.Points[corners[(edge + 1) % 3]]);
}

// Edges to be divided: those of the triangles with the largest errors, as long as there are not too
// many.
std::vector<std::uint64_t> ColorFit::ChooseEdges() const
{
  struct Candidate
  {
    double Error;
    std::size_t Triangle;
    bool IsForArrays; // they must not take the triangles that colours need
  };
  std::vector<Candidate> candidates;
  const double tolerance = this->Settings.Tolerance * this->Settings.Tolerance;
  for (std::size_t i = 0; i < this->Samples.size(); ++i)
  {
    double error = std::max(this->Samples[i].Detail / 3.0, this->FindPlaceError(i));
    for (const int side : { 0, 1 })
    {
      error = std::max(error, this->FindError(i, side));
    }
    if (error > tolerance * this->Samples[i].Area || this->HasDetail(i, 1.0))
    {
      candidates.push_back({ error, i, false });
    }
    const double arrayError = this->FindArrayError(i);
    if (arrayError > tolerance * this->Samples[i].Area)
    {
      candidates.push_back({ arrayError, i, true });
    }
  }
  std::sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b)
    {
      return a.IsForArrays != b.IsForArrays ? b.IsForArrays
        : a.Error != b.Error                ? a.Error > b.Error
                                            : a.Triangle < b.Triangle;
    });
  std::vector<std::uint64_t> edges;
  for (const Candidate& candidate : candidates)
  {
    const glm::uvec3& corners = this->Surface.Triangles[candidate.Triangle];
    float lengths[3];
    for (int k = 0; k < 3; ++k)
    {
      lengths[k] = this->FindLength(candidate.Triangle, k);
    }
    const int longest =
      static_cast<int>(std::max_element(std::begin(lengths), std::end(lengths)) - lengths);
    const float shortest =
      candidate.IsForArrays ? this->Settings.ShortestArrayEdge : this->Settings.ShortestEdge;
    if (lengths[longest] > shortest)
    {
      edges.push_back(EdgeOf(corners[longest], corners[(longest + 1) % 3]));
    }
  }
  this->LimitEdges(edges);
  return edges;
}

// Keeps the first edges that do not divide too many triangles, each once.
void ColorFit::LimitEdges(std::vector<std::uint64_t>& edges) const
{
  std::unordered_map<std::uint64_t, std::size_t> uses;
  for (const std::uint64_t edge : edges)
  {
    uses[edge] = 0;
  }
  for (const glm::uvec3& corners : this->Surface.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto found = uses.find(EdgeOf(corners[k], corners[(k + 1) % 3]));
      if (found != uses.end())
      {
        ++found->second;
      }
    }
  }
  std::size_t count = this->Surface.Triangles.size();
  std::size_t kept = 0;
  for (const std::uint64_t edge : edges)
  {
    // Of edges that occur again, the first has taken the uses.
    const std::size_t more = std::exchange(uses[edge], 0);
    if (more > 0 && count + more <= this->Settings.MaximumTriangles)
    {
      count += more;
      edges[kept++] = edge;
    }
  }
  edges.resize(kept);
}

// Moves the middles of edges onto the surface, unless these are edges of several bodies, or
// creases.
void ColorFit::ProjectMiddles(const std::unordered_map<std::uint64_t, unsigned int>& middles)
{
  if (!this->Settings.Project)
  {
    return;
  }
  struct Around
  {
    glm::vec3 Normal{ 0.0f };
    std::uint32_t Region = TriangleSamples::None;
    int Triangles = 0;
    bool IsSmooth = true;
  };
  std::unordered_map<unsigned int, Around> around;
  for (std::size_t i = 0; i < this->Surface.Triangles.size(); ++i)
  {
    const glm::uvec3& corners = this->Surface.Triangles[i];
    const TriangleSamples& samples = this->Samples[i];
    for (int k = 0; k < 3; ++k)
    {
      const auto found = middles.find(EdgeOf(corners[k], corners[(k + 1) % 3]));
      if (found != middles.end())
      {
        Around& own = around[found->second];
        own.IsSmooth = own.IsSmooth && samples.Region != TriangleSamples::None &&
          (own.Triangles == 0 ||
            (own.Region == samples.Region && glm::dot(own.Normal, samples.Normal) > CreaseCosine));
        own.Normal += samples.Normal;
        own.Region = samples.Region;
        ++own.Triangles;
      }
    }
  }
  for (const auto& [point, own] : around)
  {
    if (own.IsSmooth && own.Triangles == 2)
    {
      glm::vec3& place = this->Surface.Points[point];
      place = this->Settings.Project(place, glm::normalize(own.Normal), own.Region);
    }
  }
}

bool ColorFit::Refine()
{
  if (this->Settings.KeepsMesh)
  {
    return false;
  }
  std::unordered_map<std::uint64_t, unsigned int> middles;
  std::vector<glm::vec3>& points = this->Surface.Points;
  for (const std::uint64_t edge : this->ChooseEdges())
  {
    middles[edge] = static_cast<unsigned int>(points.size());
    const glm::vec3 from = points[static_cast<unsigned int>(edge)];
    points.push_back(0.5f * (from + points[static_cast<unsigned int>(edge >> 32)]));
  }
  if (middles.empty())
  {
    return false;
  }
  this->ProjectMiddles(middles);
  std::vector<glm::uvec3> triangles;
  std::vector<TriangleSamples> samples;
  std::vector<char> areNew;
  const auto add = [&](unsigned int a, unsigned int b, unsigned int c)
  {
    triangles.emplace_back(a, b, c);
    samples.emplace_back();
    areNew.push_back(1);
  };
  for (std::size_t i = 0; i < this->Surface.Triangles.size(); ++i)
  {
    glm::uvec3 corners = this->Surface.Triangles[i];
    const auto middleOf = [&](int k)
    {
      const auto found = middles.find(EdgeOf(corners[k], corners[(k + 1) % 3]));
      return found == middles.end() ? std::numeric_limits<unsigned int>::max() : found->second;
    };
    constexpr unsigned int none = std::numeric_limits<unsigned int>::max();
    const int count =
      int(middleOf(0) != none) + int(middleOf(1) != none) + int(middleOf(2) != none);
    // With one divided edge it is the first, with two the last is not divided.
    while ((count == 1 && middleOf(0) == none) || (count == 2 && middleOf(2) != none))
    {
      corners = { corners.y, corners.z, corners.x };
    }
    const unsigned int ab = middleOf(0);
    const unsigned int bc = middleOf(1);
    const unsigned int ca = middleOf(2);
    const auto& [a, b, c] = std::array<unsigned int, 3>{ corners.x, corners.y, corners.z };
    switch (count)
    {
      case 0:
        triangles.push_back(corners);
        samples.push_back(this->Samples[i]);
        areNew.push_back(0);
        break;
      case 1:
        add(a, ab, c);
        add(ab, b, c);
        break;
      case 2:
        add(ab, b, bc);
        if (glm::distance(points[a], points[bc]) < glm::distance(points[ab], points[c]))
        {
          add(a, ab, bc);
          add(a, bc, c);
        }
        else
        {
          add(a, ab, c);
          add(ab, bc, c);
        }
        break;
      default:
        add(a, ab, ca);
        add(ab, b, bc);
        add(ca, bc, c);
        add(ab, bc, ca);
        break;
    }
  }
  this->Surface.Triangles = std::move(triangles);
  this->Samples = std::move(samples);
  this->AreNew = std::move(areNew);
  return true;
}

// The values that show all triangles around them well.
std::array<std::vector<char>, 2> ColorFit::FindExact() const
{
  const double most = std::pow(ExactTolerances * this->Settings.Tolerance, 2.0);
  const auto errs = [&](std::size_t triangle, int side)
  {
    return this->FindError(triangle, side) > most * this->Samples[triangle].Area ||
      this->FindPlaceError(triangle) > most * this->Samples[triangle].Area ||
      this->HasDetail(triangle, ExactDetailTolerances);
  };
  double known = 0.0;
  double unknown = 0.0;
  double rest = 0.0;
  for (const int side : { 0, 1 })
  {
    for (std::size_t i = 0; i < this->Values.size(); ++i)
    {
      const double weight = this->Samples[i].Sides[side].Weight;
      if (this->Samples[i].AreComplete[side])
      {
        known += weight;
        rest += errs(i, side) ? weight : 0.0;
      }
      else
      {
        unknown += this->Samples[i].Area;
      }
    }
  }
  const bool areAllExact = unknown + rest <= MaximumRest * (known + unknown);
  std::array<std::vector<char>, 2> areExact;
  for (const int side : { 0, 1 })
  {
    areExact[side].assign(this->Places.size(), known > rest ? 1 : 0);
    for (std::size_t i = 0; i < this->Values.size() && !areAllExact; ++i)
    {
      const bool isExact = this->Samples[i].AreComplete[side] && !errs(i, side);
      for (int k = 0; k < 3; ++k)
      {
        areExact[side][this->Values[i][k]] &= isExact;
      }
    }
  }
  return areExact;
}

// What is brighter than white is so in all triangles around a value.
std::array<std::vector<unsigned char>, 2> ColorFit::FindExactCodes() const
{
  const std::array<std::vector<char>, 2> areExact = this->FindExact();
  std::array<std::vector<unsigned char>, 2> codes;
  for (const int side : { 0, 1 })
  {
    std::vector<float> brightness(this->Places.size(), 0.0f);
    for (std::size_t i = 0; i < this->Values.size(); ++i)
    {
      const float found = this->Samples[i].Brightness[side];
      for (int k = 0; this->Samples[i].Sides[side].Weight > 0.0f && k < 3; ++k)
      {
        float& least = brightness[this->Values[i][k]];
        least = least == 0.0f ? found : std::min(least, found);
      }
    }
    for (std::size_t value = 0; value < brightness.size(); ++value)
    {
      codes[side].push_back(areExact[side][value] ? ToExactCode(brightness[value]) : 0);
    }
  }
  return codes;
}

// The map of each value, whose triangles all belong to one region.
std::vector<std::uint8_t> ColorFit::FindMaps() const
{
  std::vector<std::uint8_t> maps(this->Places.size(), 0);
  for (std::size_t i = 0; i < this->Values.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      std::uint8_t& map = maps[this->Values[i][k]];
      map = std::max(map, this->Samples[i].Map);
    }
  }
  return maps;
}

// Where all samples around a value of an array are the same, so is it: least squares are only
// nearly that, but numbers may stand for things.
void ColorFit::PinArrays()
{
  for (std::size_t kind = FirstArrayKind; kind < this->Colors.size(); ++kind)
  {
    std::vector<glm::vec3>& values = this->Colors[kind];
    std::vector<glm::vec3> least(values.size(), glm::vec3(2.0f)); // shares end at 1
    std::vector<glm::vec3> most(values.size(), glm::vec3(-1.0f));
    for (std::size_t i = 0; i < this->Values.size() && !values.empty(); ++i)
    {
      const SampleSums& sums = this->GetSums(i, static_cast<int>(kind));
      const glm::vec3 spread =
        glm::max(glm::max(glm::abs(sums.Products[0]), glm::abs(sums.Products[1])),
          glm::abs(sums.Products[2]));
      for (int c = 0; sums.Weight > 0.0f && c < 3; ++c)
      {
        const bool isSame = spread[c] <= SameShare * sums.Weight;
        for (int k = 0; k < 3; ++k)
        {
          float& first = least[this->Values[i][k]][c];
          float& last = most[this->Values[i][k]][c];
          first = std::min(first, isSame ? sums.Origin[c] : -1.0f);
          last = std::max(last, isSame ? sums.Origin[c] : 2.0f);
        }
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        const bool isSame = std::abs(most[i][c] - least[i][c]) <= SameShare;
        values[i][c] = isSame ? least[i][c] : values[i][c];
      }
    }
  }
}

SideColors ColorFit::Finish(FittedValues& values)
{
  this->PinArrays();
  const std::size_t count = this->Places.size();
  std::array<std::vector<char>, 2> areKnown;
  const std::array<std::vector<unsigned char>, 2> exact = this->FindExactCodes();
  for (const int side : { 0, 1 })
  {
    areKnown[side].assign(count, 0);
    for (std::size_t i = 0; i < this->Values.size(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        areKnown[side][this->Values[i][k]] |= this->Samples[i].Sides[side].Weight > 0.0f;
      }
    }
  }
  const std::vector<std::uint8_t> maps = this->FindMaps();
  const std::vector<glm::vec3>& own = this->Colors[PlaceKind];
  const bool hasMaps = !own.empty();
  float mostLight = 0.0f;
  for (const TriangleSamples& samples : this->Samples)
  {
    mostLight = std::max(mostLight, samples.MaximumLight);
  }
  const auto haveSameArrays = [&](unsigned int a, unsigned int b)
  {
    return std::all_of(this->Colors.begin() + FirstArrayKind, this->Colors.end(),
      [&](const std::vector<glm::vec3>& array)
      { return array.empty() || glm::distance(array[a], array[b]) <= MaximumArrayDistance; });
  };
  const auto areAlike = [&](unsigned int a, unsigned int b)
  {
    if (maps[a] != maps[b] ||
      (maps[a] > 0 && (glm::distance(own[a], own[b]) > MaximumDistance || !haveSameArrays(a, b))))
    {
      return false;
    }
    for (const int side : { 0, 1 })
    {
      const glm::vec3 difference = glm::abs(this->Colors[side][a] - this->Colors[side][b]);
      if (areKnown[side][a] != areKnown[side][b] || exact[side][a] != exact[side][b] ||
        (areKnown[side][a] &&
          std::max({ difference.x, difference.y, difference.z }) > MaximumDifference))
      {
        return false;
      }
    }
    return true;
  };
  // Values at one point, in their order.
  std::vector<unsigned int> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
    [&](unsigned int a, unsigned int b) { return this->Places[a] < this->Places[b]; });
  std::vector<unsigned int> numbers(count);
  std::vector<unsigned int> kept;
  SurfaceMesh lit;
  SideColors result;
  values.Arrays.resize(hasMaps ? this->Colors.size() - FirstArrayKind : 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const unsigned int value = order[i];
    const unsigned int place = this->Places[value];
    if (i == 0 || place != this->Places[order[i - 1]])
    {
      kept.clear();
    }
    const auto same = std::find_if(
      kept.begin(), kept.end(), [&](unsigned int other) { return areAlike(value, other); });
    if (same != kept.end())
    {
      numbers[value] = numbers[*same];
      continue;
    }
    kept.push_back(value);
    numbers[value] = static_cast<unsigned int>(lit.Points.size());
    lit.Points.push_back(this->Surface.Points[place]);
    for (const int side : { 0, 1 })
    {
      const glm::vec3 color = glm::max(this->Colors[side][value], glm::vec3(0.0f));
      // Points with hardly any samples may have got any light.
      const bool isClamped = this->Settings.ClampsColors || maps[value] > 0;
      const glm::vec3 most(maps[value] > 0 ? mostLight : 1.0f);
      result.Sides[side].push_back(areKnown[side][value]
          ? glm::vec4(isClamped ? glm::min(color, most) : color, 1.0f)
          : glm::vec4(0.0f));
      result.Exact[side].push_back(exact[side][value]);
    }
    if (hasMaps)
    {
      result.Mapped.Numbers.push_back(maps[value]);
      values.Places.emplace_back(own[value]);
    }
    for (std::size_t array = 0; array < values.Arrays.size(); ++array)
    {
      values.Arrays[array].push_back(this->Colors[FirstArrayKind + array][value]);
    }
  }
  for (const glm::uvec3& corners : this->Values)
  {
    lit.Triangles.emplace_back(numbers[corners.x], numbers[corners.y], numbers[corners.z]);
  }
  this->Surface = std::move(lit);
  return result;
}
}
