// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Single viewpoints of a coded light field: decoded on request or earlier in the background, and
 * kept within a memory budget.
 */
#ifndef cslfViewpointStore_h
#define cslfViewpointStore_h

#include "cslfBackgroundSteps.h"
#include "cslfGroupDecoder.h"
#include "cslfViewpointSamples.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

namespace cslf
{
/// Keeps the most recently used viewpoints. Only one thread may use it at a time.
class ViewpointCache
{
public:
  /// The maximum number of kept viewpoints. Surplus ones are dropped at once.
  void SetCapacity(std::size_t capacity);
  std::size_t GetCapacity() const { return this->Capacity; }

  bool Has(FrameId frame) const { return this->Places.count(frame) != 0; }

  /// Nothing if it is not kept. A viewpoint that is found counts as used. A damaged one is empty.
  std::optional<ViewpointSamples> Find(FrameId frame);

  void Insert(FrameId frame, ViewpointSamples viewpoint);

private:
  struct Entry
  {
    FrameId Frame;
    ViewpointSamples Content;
  };

  void Shrink();

  std::size_t Capacity = 0;
  std::list<Entry> Entries; ///< the most recently used one comes first
  std::map<FrameId, std::list<Entry>::iterator> Places;
};

/// All methods may be called by several threads at once. Those that decode throw std::bad_alloc if
/// there is not enough memory; background work then leaves the viewpoints to later requests.
class ViewpointStore
{
public:
  /// The decoder must outlive the store, which stops it when it is destroyed.
  explicit ViewpointStore(GroupDecoder& decoder);
  ~ViewpointStore();

  /// The maximum size of kept viewpoints, in bytes.
  void SetSize(std::uint64_t bytes);

  /// The number of viewpoints in that size.
  std::size_t GetCapacity();

  /// The group that contains a viewpoint.
  int GetGroup(FrameId frame) const
  {
    return this->GroupOfFrame[this->Decoder.GetHeader().Field.GetIndex(frame)];
  }

  /// Whether a viewpoint is kept.
  bool Has(FrameId frame);

  /// A viewpoint that is kept, or nothing. It is empty if it is damaged.
  std::optional<ViewpointSamples> Find(FrameId frame);

  /// A viewpoint, kept or decoded now. It is empty if it is damaged.
  ViewpointSamples Get(FrameId frame);

  void Insert(FrameId frame, ViewpointSamples viewpoint);

  /// Decodes viewpoints in the background, in this order but group by group. This replaces earlier
  /// requests that have not begun. Those at the end that do not fit in the budget are left out.
  void Prefetch(const std::vector<FrameId>& frames);

  /// Waits until all requested viewpoints are decoded.
  void Wait();

  /// Waits for the requested ones of these slices of a time, and decodes them first. Calls `goesOn`
  /// regularly, and stops and returns false if that returns false.
  bool WaitFor(int time, int first, int last, const std::function<bool()>& goesOn);

private:
  /// Frames of one group.
  struct Job
  {
    int Group = 0;
    std::vector<FrameId> Frames;
  };

  class Progress;

  std::vector<Job> MakeJobs(const std::vector<FrameId>& frames);
  void FetchNext();
  std::vector<ViewpointSamples> Decode(const Job& job, bool alone);

  GroupDecoder& Decoder;
  std::vector<int> GroupOfFrame; ///< by the field's index
  std::uint64_t ViewpointBytes = 0;

  std::mutex Mutex; ///< of all later members except the steps
  std::condition_variable Changed;
  ViewpointCache Cache;
  std::deque<Job> Pending;
  std::set<FrameId> InProgress;
  BackgroundSteps Steps;
};
}

#endif
