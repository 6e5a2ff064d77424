// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A sequence whose first numbers are evenly spread, however many are used.
 */
#ifndef cslfRobertsSequence_h
#define cslfRobertsSequence_h

#include <cmath>

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
}

#endif
