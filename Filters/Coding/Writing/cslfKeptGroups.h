// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Viewpoints that will be needed again, kept if memory allows.
 */
#ifndef cslfKeptGroups_h
#define cslfKeptGroups_h

#include "Coding/Frames/cslfFrameConverter.h"

#include <map>
#include <memory>
#include <vector>

namespace cslf
{
class KeptGroups
{
public:
  /// Keeps at most this many slices.
  explicit KeptGroups(int slices)
    : Room(slices)
  {
  }

  /// Keeps a group's slices, whose samples live as long as `hold`, if there is room.
  void Keep(int group, std::vector<ConstSlice> slices, std::shared_ptr<const void> hold)
  {
    const int count = static_cast<int>(slices.size());
    if (count <= this->Room && this->Groups.count(group) == 0)
    {
      this->Room -= count;
      this->Groups[group] = { std::move(slices), std::move(hold) };
    }
  }

  /// The slices of a group, or null.
  const std::vector<ConstSlice>* Find(int group) const
  {
    const auto found = this->Groups.find(group);
    return found == this->Groups.end() ? nullptr : &found->second.Slices;
  }

  void Drop(int group)
  {
    const auto found = this->Groups.find(group);
    if (found != this->Groups.end())
    {
      this->Room += static_cast<int>(found->second.Slices.size());
      this->Groups.erase(found);
    }
  }

private:
  struct Group
  {
    std::vector<ConstSlice> Slices;
    std::shared_ptr<const void> Hold;
  };

  int Room;
  std::map<int, Group> Groups;
};
}

#endif
