// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceLattice.h"

namespace cslf
{
SurfaceLattice::SurfaceLattice(const std::vector<std::uint8_t>& splits)
{
  this->Triangles.reserve(splits.size());
  std::size_t bricks = 0;
  for (std::uint8_t split : splits)
  {
    this->Triangles.push_back({ static_cast<std::uint32_t>(bricks), split });
    bricks += std::size_t(2) << (2 * split);
  }
  this->NumberOfRoots = bricks;
  this->Bricks.resize(bricks);
  this->Values.emplace_back(0.0f);
}

SurfaceLattice SurfaceLattice::MakeEmpty() const
{
  SurfaceLattice empty;
  empty.Triangles = this->Triangles;
  empty.NumberOfRoots = this->NumberOfRoots;
  empty.Bricks.resize(this->NumberOfRoots);
  empty.Values.emplace_back(0.0f);
  return empty;
}

void SurfaceLattice::SetBrick(
  std::size_t index, std::uint32_t level, const std::vector<glm::vec3>& values)
{
  this->Bricks[index] = { static_cast<std::uint32_t>(this->Values.size()), level };
  this->Values.insert(this->Values.end(), values.begin(), values.end());
}

std::size_t SurfaceLattice::SplitBrick(std::size_t index)
{
  const std::size_t first = this->Bricks.size();
  this->Bricks[index] = { static_cast<std::uint32_t>(first), Split };
  this->Bricks.resize(first + 4);
  return first;
}
}
