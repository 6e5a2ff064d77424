// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Continues known numbers smoothly where they are unknown, by means over larger and larger squares
 * (push-pull), so that the unknown ones cost few bits.
 */
#ifndef cslfPushPull_h
#define cslfPushPull_h

#include <cstddef>
#include <vector>

namespace cslf
{
/// A square of numbers, some of which are known.
struct Patch
{
  explicit Patch(int size)
    : Size(size)
    , Values(static_cast<std::size_t>(size) * size, 0.0F)
    , Weights(this->Values)
  {
  }

  std::size_t IndexOf(int x, int y) const { return static_cast<std::size_t>(y) * this->Size + x; }

  int Size;
  std::vector<float> Values;
  std::vector<float> Weights; ///< 1 where the number is known, else 0
};

/// Sets unknown numbers to the means of known ones around them. Without known ones, they become 0.
void Fill(Patch& patch);
}

#endif
