// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decodes the wanted frames of closed groups of pictures, all tracks of many groups in parallel.
 */
#ifndef cslfGroupDecoder_h
#define cslfGroupDecoder_h

#include "Coding/Containers/cslfContainerReader.h"
#include "Coding/Frames/cslfFrameConverter.h"
#include "Coding/Geometry/cslfGeometryTexels.h"
#include "Coding/Groups/cslfTrackDecoder.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace cslf
{
/// The wanted slices of a group, and their destination.
struct GroupRequest
{
  int Group = 0;
  std::vector<ViewpointSamples> Slices; ///< of each frame; empty ones are not wanted
};

/// All methods may be called by several threads at once. Those that decode or read throw
/// std::bad_alloc if there is not enough memory.
class GroupDecoder
{
public:
  /// The depths are those of the file's geometry, null unless its header asks for them.
  GroupDecoder(std::unique_ptr<ContainerReader> container, std::unique_ptr<GeometryTexels> texels);

  const FileHeader& GetHeader() const { return this->Container->GetHeader(); }
  int GetNumberOfGroups() const { return static_cast<int>(this->GetHeader().Groups.size()); }

  /// The frames of a group.
  std::vector<FrameId> GetFrames(int group) const;

  /// Whether a group is undamaged, by its checksums. Reads the group unless this is known already.
  bool Check(int group);

  /// Reads a group's packets. Null if the group is missing or damaged.
  /// Called before memory is allocated for what a file claims to contain.
  std::unique_ptr<const GroupPackets> Load(int group);

  /// Decodes the wanted slices of some groups, with as many threads as vtkSMPTools has. Returns for
  /// each group whether it is undamaged, and clears the wanted slices of damaged ones.
  std::vector<bool> Decode(const std::vector<GroupRequest>& requests);

  /// The same for one loaded group, with the calling thread alone or with a thread for each track.
  bool DecodeAlone(const GroupRequest& request, const GroupPackets& packets);
  bool DecodeTracks(const GroupRequest& request, const GroupPackets& packets);

  /// The size of all packets of each track, in bytes. Reads the whole file.
  std::vector<std::int64_t> CountBytes();

  /// Whether somebody has written to the file since it was opened.
  bool HasFileChanged() const { return this->Container->HasChanged(); }

  /// Stops decoding: work in progress ends soon, as if damaged, and no more is begun.
  void Stop() { this->IsStopped = true; }

private:
  /// A decoder of one track, and the converter of its frames to slices.
  struct Worker
  {
    std::unique_ptr<TrackDecoder> Decoder;
    FrameToSlice Converter;
  };
  using Workers = std::vector<std::unique_ptr<Worker>>;

  /// What is known of a group.
  enum class Condition
  {
    Unknown,
    Missing, ///< from an unfinished file
    Whole,
    Damaged
  };

  Condition GetCondition(int group);
  void SetCondition(int group, bool isWhole);
  bool LoadAndDecode(const GroupRequest& request, bool alone);

  /// Whether the geometry tells all, so that no frame is decoded.
  bool IsAllComputed() const { return this->GetHeader().Computed.IsAll; }
  bool ComputeAll(const GroupRequest& request);
  bool Finish(const GroupRequest& request, bool isGood, Workers& workers);
  std::unique_ptr<Worker> Begin(
    std::size_t track, const GroupRequest& request, const GroupPackets& packets);
  void PutBack(Workers& workers);
  bool Join(const Workers& workers, const std::vector<const AVFrame*>& frames, int place,
    const ViewpointSamples& slice) const;
  bool Compute(const GroupRequest& request, int place) const;
  void Clear(const GroupRequest& request) const;

  std::unique_ptr<ContainerReader> Container;
  std::unique_ptr<const GeometryTexels> Texels;
  std::vector<int> GroupStarts;
  std::mutex ContainerMutex; ///< while packets are read
  std::mutex IdleMutex;
  std::vector<Workers> Idle; ///< of each track
  std::mutex ConditionMutex;
  std::vector<Condition> Conditions; ///< of each group
  std::atomic<bool> IsStopped{ false };
};
}

#endif
