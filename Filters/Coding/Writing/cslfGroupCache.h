// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Viewpoints that will be needed again, kept if memory allows.
 */
#ifndef cslfGroupCache_h
#define cslfGroupCache_h

#include "cslfViewpointSamples.h"

#include <map>
#include <utility>
#include <vector>

namespace cslf
{
class GroupCache
{
public:
  /// Keeps at most this many slices.
  explicit GroupCache(int slices)
    : Room(slices)
  {
  }

  /// Keeps a group's slices if there is room.
  void Keep(int group, std::vector<ViewpointSamples> slices)
  {
    const int count = static_cast<int>(slices.size());
    if (count <= this->Room && this->Groups.count(group) == 0)
    {
      this->Room -= count;
      this->Groups[group] = std::move(slices);
    }
  }

  /// The slices of a group, or null.
  const std::vector<ViewpointSamples>* Find(int group) const
  {
    const auto found = this->Groups.find(group);
    return found == this->Groups.end() ? nullptr : &found->second;
  }

  void Drop(int group)
  {
    const auto found = this->Groups.find(group);
    if (found != this->Groups.end())
    {
      this->Room += static_cast<int>(found->second.size());
      this->Groups.erase(found);
    }
  }

private:
  int Room;
  std::map<int, std::vector<ViewpointSamples>> Groups;
};
}

#endif
