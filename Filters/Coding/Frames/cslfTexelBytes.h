// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The four bytes of a texel as one number, so that a texel fits in a vector's lane. The shift of
 * each byte depends on the machine's byte order.
 */
#ifndef cslfTexelBytes_h
#define cslfTexelBytes_h

#include <vtkEndian.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cslf
{
struct TexelBytes
{
#ifdef VTK_WORDS_BIGENDIAN
  static constexpr int Red = 24;
  static constexpr int Green = 16;
  static constexpr int Blue = 8;
  static constexpr int Coverage = 0;
#else
  static constexpr int Red = 0;
  static constexpr int Green = 8;
  static constexpr int Blue = 16;
  static constexpr int Coverage = 24;
#endif
};

inline std::uint32_t ReadTexel(const unsigned char* colors, int k)
{
  std::uint32_t texel;
  std::memcpy(&texel, colors + 4 * static_cast<std::ptrdiff_t>(k), sizeof(texel));
  return texel;
}

inline void WriteTexel(std::uint32_t texel, unsigned char* colors, int k)
{
  std::memcpy(colors + 4 * static_cast<std::ptrdiff_t>(k), &texel, sizeof(texel));
}
}

#endif
