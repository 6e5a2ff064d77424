// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLatticeSum.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
class LatticeSum
{
public:
  LatticeSum(const SurfaceLattice& a, const SurfaceLattice& b, const LayoutProgress& progress)
    : A(a)
    , B(b)
    , Sum(a.MakeEmpty())
  {
    for (std::size_t root = 0; root < this->Sum.GetNumberOfRoots(); ++root)
    {
      progress.Step();
      this->Root = root;
      this->Add(root, a.GetBrick(root), b.GetBrick(root), {});
    }
  }

  SurfaceLattice& Get() { return this->Sum; }

private:
  using Brick = SurfaceLattice::Brick;

  /// Converts barycentric coordinates of a brick to those of its root.
  struct Place
  {
    glm::vec2 Corner{ 0.0f };
    float Scale = 1.0f;

    Place GetPart(int cell) const
    {
      const float half = 0.5f * this->Scale;
      const glm::vec2 corner(
        cell == 1 || cell == 2 ? half : 0.0f, cell == 1 || cell == 3 ? half : 0.0f);
      return { this->Corner + corner, cell == 1 ? -half : half };
    }
  };

  static bool IsLattice(const Brick& brick)
  {
    return brick.Level != SurfaceLattice::Constant && brick.Level != SurfaceLattice::Split;
  }

  void Add(std::size_t index, const Brick& a, const Brick& b, const Place& place)
  {
    const bool isSplitA = a.Level == SurfaceLattice::Split;
    const bool isSplitB = b.Level == SurfaceLattice::Split;
    if (!isSplitA && !isSplitB)
    {
      this->SetValues(index, a, b, place);
      return;
    }
    const std::size_t first = this->Sum.SplitBrick(index);
    for (int cell = 0; cell < 4; ++cell)
    {
      this->Add(first + cell, isSplitA ? this->A.GetBrick(a.First + cell) : a,
        isSplitB ? this->B.GetBrick(b.First + cell) : b, place.GetPart(cell));
    }
  }

  void SetValues(std::size_t index, const Brick& a, const Brick& b, const Place& place)
  {
    std::uint32_t level = SurfaceLattice::Constant;
    if (IsLattice(a) || IsLattice(b))
    {
      level = std::max(IsLattice(a) ? a.Level : 0, IsLattice(b) ? b.Level : 0);
    }
    const int splits = level == SurfaceLattice::Constant ? 0 : 1 << level;
    std::vector<glm::vec3> values;
    for (int j = 0; j <= splits; ++j)
    {
      for (int i = 0; i <= splits - j; ++i)
      {
        const glm::vec2 local = glm::vec2(i, j) / static_cast<float>(std::max(splits, 1));
        const glm::vec2 point = place.Corner + place.Scale * local;
        values.push_back(this->A.GetInBrick(this->A.GetBrick(this->Root), point.x, point.y) +
          this->B.GetInBrick(this->B.GetBrick(this->Root), point.x, point.y));
      }
    }
    this->Sum.SetBrick(index, level, values);
  }

  const SurfaceLattice& A;
  const SurfaceLattice& B;
  SurfaceLattice Sum;
  std::size_t Root = 0;
};
}

SurfaceLattice AddLattices(
  const SurfaceLattice& a, const SurfaceLattice& b, const LayoutProgress& progress)
{
  return std::move(LatticeSum(a, b, progress).Get());
}
}
