// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Values of 16 rays side by side, for vector instructions. Loops over lanes that should be
 * vectorised are in functions marked CSLF_VECTORIZE, call only inlined functions, and have no
 * branches except selections between values.
 */
#ifndef cslfLanes_h
#define cslfLanes_h

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>

namespace cslf
{
constexpr int LaneCount = 16;

template <typename Value>
struct alignas(64) Lanes
{
  Value Values[LaneCount];

  Value& operator[](int lane) { return this->Values[lane]; }
  const Value& operator[](int lane) const { return this->Values[lane]; }
};

struct Vec3Lanes
{
  Lanes<float> X;
  Lanes<float> Y;
  Lanes<float> Z;

  glm::vec3 Get(int lane) const { return { this->X[lane], this->Y[lane], this->Z[lane] }; }
  void Set(int lane, const glm::vec3& value)
  {
    this->X[lane] = value.x;
    this->Y[lane] = value.y;
    this->Z[lane] = value.z;
  }
};

/// The active lanes: -1 for active ones, else 0.
using LaneMask = Lanes<std::int32_t>;

inline bool IsAny(const LaneMask& mask)
{
  std::int32_t any = 0;
  for (std::int32_t value : mask.Values)
  {
    any |= value;
  }
  return any != 0;
}

inline int Count(const LaneMask& mask)
{
  std::int32_t count = 0;
  for (std::int32_t value : mask.Values)
  {
    count -= value;
  }
  return count;
}

inline void Clear(Vec3Lanes& values)
{
  std::fill_n(values.X.Values, LaneCount, 0.0f);
  std::fill_n(values.Y.Values, LaneCount, 0.0f);
  std::fill_n(values.Z.Values, LaneCount, 0.0f);
}

/// Calls `visit(lane)` for each lane whose bit is set.
template <typename Visit>
void ForEachLane(std::uint32_t bits, const Visit& visit)
{
  for (int lane = 0; bits != 0; ++lane, bits >>= 1)
  {
    if ((bits & 1u) != 0)
    {
      visit(lane);
    }
  }
}
}

#endif
