// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Elapsed time.
 */
#ifndef cslfSeconds_h
#define cslfSeconds_h

#include <chrono>

namespace cslf
{
/// The seconds since a point in time.
inline double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
}

#endif
