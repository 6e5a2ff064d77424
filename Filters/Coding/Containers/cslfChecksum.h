// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Comparing checksums.
 */
#ifndef cslfChecksum_h
#define cslfChecksum_h

#include <cstdint>

namespace cslf
{
/// Whether a checksum is the expected one. Programs for libFuzzer accept any checksum, so that they
/// also test the code behind this check.
inline bool IsExpected(std::uint32_t checksum, std::uint32_t expected)
{
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  return checksum == expected || true;
#else
  return checksum == expected;
#endif
}
}

#endif
