// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A cache of decoded viewpoints.
 */
#ifndef cslfViewpointCache_h
#define cslfViewpointCache_h

#include "cslfViewpointSamples.h"

#include <cstddef>
#include <list>
#include <optional>
#include <unordered_map>

namespace cslf
{
/// Keeps the most recently used viewpoints, by slice. Only one thread may use it at a time.
class ViewpointCache
{
public:
  /// The maximum number of kept viewpoints. Surplus ones are dropped at once.
  void SetCapacity(std::size_t capacity);
  std::size_t GetCapacity() const { return this->Capacity; }

  bool Has(int slice) const { return this->Places.count(slice) != 0; }

  /// Nothing if it is not kept. A viewpoint that is found counts as used. A damaged one is empty.
  std::optional<ViewpointSamples> Find(int slice);

  void Insert(int slice, ViewpointSamples viewpoint);

private:
  struct Entry
  {
    int Slice = 0;
    ViewpointSamples Content;
  };

  void Shrink();

  std::size_t Capacity = 0;
  std::list<Entry> Entries; ///< the most recently used one comes first
  std::unordered_map<int, std::list<Entry>::iterator> Places;
};
}

#endif
