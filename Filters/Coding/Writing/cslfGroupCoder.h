// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Codes groups of a field, all their tracks, in parallel.
 */
#ifndef cslfGroupCoder_h
#define cslfGroupCoder_h

#include "Coding/Groups/cslfGroupEncoder.h"
#include "Pipeline/cslfPhase.h"
#include "cslfEncodeSettings.h"

#include <functional>
#include <string>
#include <vector>

namespace cslf
{
class GroupCoder
{
public:
  /// Field and settings have passed FindError; `groups` has the number of frames of each group.
  /// `computed` are the tracks that files do not need, because readers compute their contents.
  GroupCoder(const EncodeSettings& settings, const Description& field, std::vector<int> groups,
    std::vector<TrackRole> computed);

  /// The tracks: colour, coverage, and those of further channels, without those that are computed.
  std::vector<Track> GetTracks() const;

  /// Does some tasks in parallel. `slices` are those of the tasks' groups, one group after the
  /// other; `coded` gets those of the first task, for each of its factors, then those of the
  /// next. `progress` is called regularly on the calling thread. On failure returns false and gives
  /// the reason.
  bool Encode(const std::vector<CodingTask>& tasks, const std::vector<ViewpointSamples>& slices,
    const Progress& progress, std::vector<GroupTracks>& coded, std::string& error) const;

private:
  struct Encoding
  {
    Track Kind;
    EncodeOptions Options;
  };

  /// A group that is coded with one factor.
  struct Coding
  {
    std::vector<ViewpointSamples> Frames;
    double Factor;
    bool IsMeasured;
    GroupTracks* Tracks;
  };

  void AddTracks(ChannelId id, const ChannelForm& form, const EncoderChoice& choice);
  std::vector<Coding> Split(const std::vector<CodingTask>& tasks,
    const std::vector<ViewpointSamples>& slices, std::vector<GroupTracks>& coded) const;
  EncodeOptions GetOptions(const Encoding& encoding, double factor) const;
  bool IsMeasured(const CodingTask& task) const;
  void EncodeTrack(std::size_t track, const Coding& coding, const std::function<bool()>& proceed,
    std::string& error) const;
  void MeasureError(const Coding& coding, std::string& error) const;

  EncodeSettings Settings;
  int Resolution;
  bool IsRadiance;
  std::vector<int> Groups;
  std::vector<TrackRole> Computed;
  std::vector<Encoding> Encodings;
};
}

#endif
