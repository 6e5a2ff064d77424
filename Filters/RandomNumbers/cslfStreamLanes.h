// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The random numbers of 16 paths, side by side.
 */
#ifndef cslfStreamLanes_h
#define cslfStreamLanes_h

#include "SIMD/cslfLanes.h"
#include "cslfSampleStream.h"

namespace cslf
{
struct StreamLanes
{
  Lanes<std::uint64_t> Hash;  ///< of the path's texel
  Lanes<std::uint32_t> Index; ///< of the texel's samples

  /// The numbers of each path's vertex, like SampleStream::Get2D. Vertices are numbered from 0.
  void Get2D(std::uint32_t vertex, Dimension dimension, Lanes<float>& x, Lanes<float>& y) const;

  /// Only the first number, like SampleStream::Get1D.
  void Get1D(std::uint32_t vertex, Dimension dimension, Lanes<float>& x) const;
};
}

#endif
