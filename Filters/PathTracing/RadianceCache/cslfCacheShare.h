// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Several ranks that compute the points of one cache together. All perform the same steps. Each
 * estimates a part of the points, and all get all estimates.
 */
#ifndef cslfCacheShare_h
#define cslfCacheShare_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace cslf
{
class CacheShare
{
public:
  virtual ~CacheShare() = default;

  virtual int GetRank() const = 0;
  virtual int GetCount() const = 0;

  /// Whether all ranks agree. All ranks call it together.
  virtual bool Agree(bool isFor) = 0;

  /// Sums all ranks' numbers. All ranks call it together.
  virtual std::uint64_t Sum(std::uint64_t mine) = 0;

  /// The rank that estimates a point: few neighbours share a rank, so that the ranks have equal
  /// work.
  int GetOwner(std::size_t point) const
  {
    return static_cast<int>(point / PointsPerShare % static_cast<std::size_t>(this->GetCount()));
  }

  /// Completes the values of points from number `first` on, of which each rank has computed its
  /// own. All ranks call it together.
  template <typename Value>
  void Complete(std::vector<Value>& values, std::size_t first)
  {
    static_assert(std::is_trivially_copyable<Value>::value, "it is sent as bytes");
    for (std::size_t begin = 0; begin < values.size(); begin += MaximumAtOnce)
    {
      this->ShareRange(values, first, begin, std::min(begin + MaximumAtOnce, values.size()));
    }
  }

private:
  static constexpr std::size_t PointsPerShare = 4;
  static constexpr std::size_t MaximumAtOnce = std::size_t(1)
    << 20; // because MPI counts bytes in int

  template <typename Value>
  void ShareRange(std::vector<Value>& values, std::size_t first, std::size_t begin, std::size_t end)
  {
    const int count = this->GetCount();
    std::vector<std::size_t> sizes(count, 0);
    std::vector<Value> mine;
    for (std::size_t index = begin; index < end; ++index)
    {
      const int owner = this->GetOwner(first + index);
      sizes[owner] += sizeof(Value);
      if (owner == this->GetRank())
      {
        mine.push_back(values[index]);
      }
    }
    std::vector<Value> all(end - begin);
    this->Gather(mine.data(), sizes, all.data());
    std::vector<std::size_t> places(count, 0);
    for (int rank = 1; rank < count; ++rank)
    {
      places[rank] = places[rank - 1] + sizes[rank - 1] / sizeof(Value);
    }
    for (std::size_t index = begin; index < end; ++index)
    {
      values[index] = all[places[this->GetOwner(first + index)]++];
    }
  }

  /// Gathers bytes on all ranks, in the order of the ranks. `sizes` are those of all ranks.
  virtual void Gather(const void* mine, const std::vector<std::size_t>& sizes, void* all) = 0;
};
}

#endif
