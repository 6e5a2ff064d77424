// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Numbers that are evenly spread, however many of them are taken.
 */
#ifndef cslfRobertsSequence_h
#define cslfRobertsSequence_h

#include <cmath>

namespace cslf
{
/// The sequence of M. Roberts, by the plastic number: for each index two independent numbers in
/// [0,1) (`axis` 0 or 1), such that those of any run of indices, and of every n-th, are evenly
/// spread, as points of the unit square, too.
inline double RobertsNumber(int index, int axis)
{
  constexpr double steps[2] = { 0.7548776662466927, 0.5698402909980532 };
  const double product = index * steps[axis];
  return product - std::floor(product);
}
}

#endif
