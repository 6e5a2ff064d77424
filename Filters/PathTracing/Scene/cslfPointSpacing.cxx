// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPointSpacing.h"

#include "Pipeline/cslfParallelFor.h"
#include "Pipeline/cslfTriangleList.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <random>

namespace cslf
{
namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

// The number of points whose neighbours are searched among all points. A search tree would find
// those of all points, but takes longer to build, and some get slow where points are concentrated.
constexpr vtkIdType MinimumSamples = 50;
constexpr vtkIdType MaximumSamples = 200;
constexpr vtkIdType MaximumDistances = 200000000;

constexpr vtkIdType ChunkSize = 512;

/// Squares of the distances to the nearest points, in ascending order.
using Nearest = std::array<double, 4>;

void Insert(Nearest& nearest, double square)
{
  if (square < nearest.back() && square > 0.0)
  {
    nearest.back() = square;
    for (std::size_t i = nearest.size() - 1; i > 0 && nearest[i] < nearest[i - 1]; --i)
    {
      std::swap(nearest[i], nearest[i - 1]);
    }
  }
}

/// One point, at random, of each of some equally large parts of a cloud.
std::vector<glm::dvec3> ChooseSamples(const std::vector<const SceneBlock*>& cloud, vtkIdType count)
{
  const vtkIdType samples =
    std::min(count, std::clamp(MaximumDistances / count, MinimumSamples, MaximumSamples));
  std::mt19937_64 random(1);
  std::vector<glm::dvec3> places;
  std::size_t block = 0;
  vtkIdType first = 0; // of the block
  for (vtkIdType i = 0; i < samples; ++i)
  {
    const vtkIdType begin = i * count / samples;
    const vtkIdType size = (i + 1) * count / samples - begin;
    const auto point = begin + static_cast<vtkIdType>(random() % static_cast<std::uint64_t>(size));
    while (point - first >= static_cast<vtkIdType>(cloud[block]->Round.size()))
    {
      first += static_cast<vtkIdType>(cloud[block++]->Round.size());
    }
    places.push_back(GetPoint(cloud[block]->Data, cloud[block]->Round[point - first].Points[0]));
  }
  return places;
}

/// The points of a block, in columns.
struct Chunk
{
  std::array<double, ChunkSize> Coordinates[3];
  vtkIdType Count;

  Chunk(const SceneBlock& block, vtkIdType begin, vtkIdType end)
    : Count(end - begin)
  {
    for (vtkIdType i = 0; i < this->Count; ++i)
    {
      const glm::dvec3 place = GetPoint(block.Data, block.Round[begin + i].Points[0]);
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Coordinates[axis][i] = place[axis];
      }
    }
  }

  void AddTo(Nearest& nearest, const glm::dvec3& from) const
  {
    std::array<double, ChunkSize> squares;
    for (vtkIdType i = 0; i < this->Count; ++i)
    {
      const double x = this->Coordinates[0][i] - from.x;
      const double y = this->Coordinates[1][i] - from.y;
      const double z = this->Coordinates[2][i] - from.z;
      squares[i] = x * x + y * y + z * z;
    }
    for (vtkIdType i = 0; i < this->Count; ++i)
    {
      Insert(nearest, squares[i]);
    }
  }
};

/// Adds the points of a block to those nearest to the samples.
void AddBlock(
  const SceneBlock& block, const std::vector<glm::dvec3>& samples, std::vector<Nearest>& nearest)
{
  const auto count = static_cast<vtkIdType>(block.Round.size());
  std::mutex mutex;
  ParallelFor(0, (count + ChunkSize - 1) / ChunkSize, 64,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<Nearest> found(samples.size(), { Infinity, Infinity, Infinity, Infinity });
      for (vtkIdType i = begin; i < end; ++i)
      {
        const Chunk chunk(block, i * ChunkSize, std::min((i + 1) * ChunkSize, count));
        for (std::size_t sample = 0; sample < samples.size(); ++sample)
        {
          chunk.AddTo(found[sample], samples[sample]);
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      for (std::size_t sample = 0; sample < samples.size(); ++sample)
      {
        for (double square : found[sample])
        {
          Insert(nearest[sample], square);
        }
      }
    });
}
}

double FindPointSpacing(const std::vector<const SceneBlock*>& cloud)
{
  vtkIdType count = 0;
  for (const SceneBlock* block : cloud)
  {
    count += static_cast<vtkIdType>(block->Round.size());
  }
  if (count == 0)
  {
    return 0.0;
  }
  const std::vector<glm::dvec3> samples = ChooseSamples(cloud, count);
  std::vector<Nearest> nearest(samples.size(), { Infinity, Infinity, Infinity, Infinity });
  for (const SceneBlock* block : cloud)
  {
    AddBlock(*block, samples, nearest);
  }
  std::vector<double> squares;
  for (const Nearest& of : nearest)
  {
    const auto last = std::find(of.begin(), of.end(), Infinity);
    if (last != of.begin())
    {
      squares.push_back(*(last - 1));
    }
  }
  if (squares.empty())
  {
    return 0.0;
  }
  const auto middle = squares.begin() + squares.size() / 2;
  std::nth_element(squares.begin(), middle, squares.end());
  return std::sqrt(*middle);
}
}
