// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decodes what is wanted of closed groups of pictures, all tracks of many groups side by side.
 */
#ifndef cslfGroupDecoder_h
#define cslfGroupDecoder_h

#include "Coding/cslfContainerReader.h"
#include "Coding/cslfFrameConverter.h"
#include "Coding/cslfTrackDecoder.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace cslf
{
/// What is wanted of a group, and where it goes.
struct GroupRequest
{
  int Group = 0;
  std::vector<Slice> Slices; ///< of each frame; those without colour are not wanted
};

/// All methods may be called by several threads at once.
class GroupDecoder
{
public:
  explicit GroupDecoder(std::unique_ptr<ContainerReader> container);

  const FileHeader& GetHeader() const { return this->Container->GetHeader(); }
  int GetNumberOfGroups() const { return static_cast<int>(this->GetHeader().Groups.size()); }

  /// The slices of a group's frames.
  std::vector<int> GetSlices(int group) const;

  /// Fills what is wanted of some groups, with as many threads as vtkSMPTools has. Tells of each
  /// group whether it is whole; of one that is damaged the wanted slices are cleared.
  std::vector<bool> Decode(const std::vector<GroupRequest>& requests);

  /// The same for one group, by the calling thread alone or with a thread for each track.
  bool DecodeAlone(const GroupRequest& request);
  bool DecodeTracks(const GroupRequest& request);

  /// Whether a group is whole, by its checksums.
  bool Check(int group);

  /// The bytes of all packets of each track. Reads the whole file.
  std::vector<std::int64_t> CountBytes();

  /// From now on nothing more is decoded: what is at work ends soon, as if damaged.
  void Stop() { this->IsStopped = true; }

private:
  /// A decoder of one track and what turns its frames into slices.
  struct Worker
  {
    std::unique_ptr<TrackDecoder> Decoder;
    FrameToSlice Converter;
  };
  using Workers = std::vector<std::unique_ptr<Worker>>;

  GroupPackets ReadPackets(int group);
  std::unique_ptr<Worker> Begin(
    std::size_t track, const GroupRequest& request, const GroupPackets& packets);
  void PutBack(Workers& workers);
  bool Join(const Workers& workers, const std::vector<const AVFrame*>& frames, int place,
    const Slice& slice) const;
  void Clear(const GroupRequest& request) const;

  std::unique_ptr<ContainerReader> Container;
  std::vector<int> GroupStarts;
  std::mutex ContainerMutex; ///< while packets are read
  std::mutex IdleMutex;
  std::vector<Workers> Idle; ///< of each track
  std::atomic<bool> IsStopped{ false };
};
}

#endif
