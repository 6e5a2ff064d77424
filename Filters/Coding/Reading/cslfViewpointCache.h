// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A cache of decoded viewpoints.
 */
#ifndef cslfViewpointCache_h
#define cslfViewpointCache_h

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <list>
#include <memory>
#include <unordered_map>

namespace cslf
{
/// The arrays of one decoded slice. They are shared and must not be changed.
struct DecodedViewpoint
{
  bool IsMissing = true; ///< damaged: the arrays, if any, are meaningless
  vtkSmartPointer<vtkDataArray> Color;
  vtkSmartPointer<vtkDataArray> Depth; ///< null where the field has none
};

using DecodedViewpointPointer = std::shared_ptr<const DecodedViewpoint>;

/// Keeps the most recently used viewpoints, by slice. Only one thread may use it at a time.
class ViewpointCache
{
public:
  /// The maximum number of kept viewpoints. Surplus ones are dropped at once.
  void SetCapacity(std::size_t capacity);
  std::size_t GetCapacity() const { return this->Capacity; }

  bool Has(int slice) const { return this->Places.count(slice) != 0; }

  /// Null if it is not kept. A viewpoint that is found counts as used.
  DecodedViewpointPointer Find(int slice);

  void Insert(int slice, DecodedViewpointPointer viewpoint);

private:
  struct Entry
  {
    int Slice = 0;
    DecodedViewpointPointer Content;
  };

  void Shrink();

  std::size_t Capacity = 0;
  std::list<Entry> Entries; ///< the most recently used one comes first
  std::unordered_map<int, std::list<Entry>::iterator> Places;
};
}

#endif
