// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The checks that the tests share. A failed check is printed and counted; a test returns
 * `cslf::testing::Result()`.
 */
#ifndef cslfTesting_h
#define cslfTesting_h

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace cslf
{
namespace testing
{
inline int& Failures()
{
  static int failures = 0;
  return failures;
}

inline int Result()
{
  return Failures() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

inline void Check(bool passed, const char* condition, const char* file, int line)
{
  if (!passed)
  {
    std::cerr << file << ":" << line << ": failed: " << condition << "\n";
    ++Failures();
  }
}

inline void CheckNear(
  double actual, double expected, double tolerance, const char* what, const char* file, int line)
{
  if (!(std::abs(actual - expected) <= tolerance))
  {
    std::cerr << file << ":" << line << ": " << what << " is " << actual << ", expected "
              << expected << " within " << tolerance << "\n";
    ++Failures();
  }
}
}
}

#define CSLF_CHECK(condition) ::cslf::testing::Check((condition), #condition, __FILE__, __LINE__)
#define CSLF_CHECK_NEAR(actual, expected, tolerance)                                               \
  ::cslf::testing::CheckNear((actual), (expected), (tolerance), #actual, __FILE__, __LINE__)

#endif
