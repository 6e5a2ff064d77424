// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decoded viewpoints that are kept for a while.
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
/// The arrays of one decoded slice. They are shared, so nobody may change them.
struct DecodedViewpoint
{
  bool IsMissing = true; ///< damaged: then the arrays, if any, say nothing
  vtkSmartPointer<vtkDataArray> Color;
  vtkSmartPointer<vtkDataArray> Depth; ///< null where the field has none
};

using DecodedViewpointPointer = std::shared_ptr<const DecodedViewpoint>;

/// Keeps the viewpoints that were used last, by slice. Only one thread at a time may use it.
class ViewpointCache
{
public:
  /// How many viewpoints are kept at most; what is too many is dropped at once.
  void SetCapacity(std::size_t capacity);
  std::size_t GetCapacity() const { return this->Capacity; }

  bool Has(int slice) const { return this->Places.count(slice) != 0; }

  /// Null if it is not there. A viewpoint that is found counts as used.
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
  std::list<Entry> Entries; ///< the one used last comes first
  std::unordered_map<int, std::list<Entry>::iterator> Places;
};
}

#endif
