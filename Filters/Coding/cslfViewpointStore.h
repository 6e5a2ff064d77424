// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Single viewpoints of a coded light field: decoded when asked for or in the background before
 * that, and kept within a budget of memory.
 */
#ifndef cslfViewpointStore_h
#define cslfViewpointStore_h

#include "Coding/cslfBackgroundSteps.h"
#include "Coding/cslfGroupDecoder.h"
#include "Coding/cslfViewpointCache.h"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <set>
#include <vector>

namespace cslf
{
/// All methods may be called by several threads at once. Those that decode throw std::bad_alloc
/// where there is not enough memory; in the background viewpoints are then left to who needs them.
class ViewpointStore
{
public:
  /// The decoder must outlive the store, which stops it at its end.
  explicit ViewpointStore(GroupDecoder& decoder);
  ~ViewpointStore();

  /// How many bytes of viewpoints are kept at most.
  void SetSize(std::uint64_t bytes);

  /// How many viewpoints that is.
  std::size_t GetCapacity();

  /// The group that holds a slice.
  int GetGroup(int slice) const { return this->GroupOfSlice[slice]; }

  /// A viewpoint to be filled.
  DecodedViewpoint Make() const;

  /// Whether a viewpoint is kept.
  bool Has(int slice);

  /// A viewpoint that is kept, or null.
  DecodedViewpointPointer Find(int slice);

  /// A viewpoint, kept or decoded now.
  DecodedViewpointPointer Get(int slice);

  void Insert(int slice, DecodedViewpoint viewpoint);

  /// Decodes slices in the background, in this order but group by group. This replaces what an
  /// earlier call has asked for and nobody has begun yet. Of what would not fit in the budget, the
  /// end is left out.
  void Prefetch(const std::vector<int>& slices);

  /// Waits until all that was asked for is there.
  void Wait();

  /// Waits for what was asked for of these slices, putting it before all else. Asks `goesOn` now
  /// and then; false if that was the answer.
  bool WaitFor(int first, int last, const std::function<bool()>& goesOn);

private:
  /// Slices of one group.
  struct Job
  {
    int Group = 0;
    std::vector<int> Slices;
  };

  class Progress;

  std::vector<Job> MakeJobs(const std::vector<int>& slices);
  void FetchNext();
  std::vector<DecodedViewpoint> Decode(const Job& job, bool alone);

  GroupDecoder& Decoder;
  std::vector<int> GroupOfSlice;
  std::uint64_t ViewpointBytes = 0;

  std::mutex Mutex; ///< of all that follows but the steps
  std::condition_variable Changed;
  ViewpointCache Cache;
  std::deque<Job> Pending;
  std::set<int> InProgress; ///< slices
  BackgroundSteps Steps;
};

/// Where a viewpoint's samples are.
Slice ToSlice(const DecodedViewpoint& viewpoint);
}

#endif
