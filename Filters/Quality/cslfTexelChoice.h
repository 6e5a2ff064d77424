// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Chooses texels that represent all texels of a field.
 */
#ifndef cslfTexelChoice_h
#define cslfTexelChoice_h

#include "RandomNumbers/cslfSampleStream.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cslf
{
/// The sequence of M. Roberts with the plastic number: for each index two independent numbers in
/// [0,1) (`axis` 0 or 1). The numbers of any range of indices, or of every n-th index, are evenly
/// spread, also as points of the unit square.
inline double RobertsNumber(int index, int axis)
{
  constexpr double steps[2] = { 0.7548776662466927, 0.5698402909980532 };
  const double product = index * steps[axis];
  return product - std::floor(product);
}

/// A choice of `count` of the texels 0 to `total` - 1: one at random from each of `count` ranges of
/// equal length, up to one texel. So the texels ascend without duplicates, and can be visited in
/// order without a list.
class TexelChoice
{
public:
  /// A count above the total means the total; then each texel is chosen.
  TexelChoice(std::uint64_t total, std::uint64_t count, std::uint32_t seed)
    : Total(total)
    , Count(std::min(total, count))
    , Seed(seed)
  {
  }

  std::uint64_t GetCount() const { return this->Count; }

  /// The texel of that index, which must be below the count.
  std::uint64_t operator[](std::uint64_t index) const
  {
    const std::uint64_t length = this->Total / this->Count;
    const std::uint64_t longer =
      this->Total % this->Count; // the number of ranges with one texel more
    const std::uint64_t first = index * length + std::min(index, longer);
    return first + MixBits(MixBits(this->Seed, 0), index) % (length + (index < longer ? 1 : 0));
  }

private:
  std::uint64_t Total;
  std::uint64_t Count;
  std::uint32_t Seed;
};
}

#endif
