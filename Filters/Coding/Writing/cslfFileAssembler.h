// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Keeps the coded groups of a light field in a folder, and joins them to one file.
 */
#ifndef cslfFileAssembler_h
#define cslfFileAssembler_h

#include "Coding/Containers/cslfFileHeader.h"
#include "Coding/Frames/cslfFrameOrder.h"
#include "cslfGeometryPlan.h"
#include "cslfGroupCoder.h"
#include "cslfGroupStore.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// Call Begin first. Then the coder codes every group, on any rank. On the rank that writes the
/// file, call OpenFolder, StoreGroup for each group that is missing, and Finish.
class FileAssembler
{
public:
  FileAssembler(const std::string& fileName, const EncodeSettings& settings);

  /// The number of groups, after Begin.
  int GetGroupCount() const { return this->Header.GetCodedGroups(); }

  /// The number of frames of a group.
  int CountFrames(int group) const { return this->Header.Groups[group]; }

  /// The frames of some groups in coding order.
  std::vector<FrameId> GetFrames(const std::vector<int>& groups) const;

  /// Fixes order and tracks. `field` has passed FindError; `checksum` stands for the field's
  /// samples. Groups are made to fit to the plan before they are coded.
  void Begin(const Description& field, std::uint32_t checksum, const GeometryPlan& plan);

  /// Before Begin: what measures a finished file of that name, whose certificate is then added to
  /// the file. Returns nothing if there is none. It reports progress by itself.
  using Certifier = std::function<std::optional<Certificate>(const std::string& fileName)>;
  static constexpr double MeasuredShare = 0.9; ///< the progress of Finish afterwards
  void SetCertifier(const Certifier& certifier) { this->Certify = certifier; }

  /// What the file contains besides the field.
  void SetParts(const std::vector<FilePart>& parts) { this->Header.Parts = parts; }

  /// The coder of the groups, after Begin.
  const GroupCoder& GetCoder() const { return *this->Coder; }

  /// The data for rate control. The writer must outlive it.
  RateField GetRateField() const;

  /// About how much the container adds once.
  double GetContainerBytes(bool hasCoverage) const;

  /// A text of all that the coded groups depend on.
  const std::string& GetManifest() const { return this->Manifest; }

  /// Makes the folder of groups, or takes over that of a killed run, before anything is known of
  /// the field. On failure returns false and gives the reason.
  bool ReserveFolder(bool restart, std::string& error)
  {
    return this->Store.Reserve(restart, error);
  }

  /// The path in that folder where data for a restart may be kept.
  PersistentFile GetCacheFile() const { return this->Store.GetCacheFile(); }

  /// Opens the folder of groups. If `restart` is set, finds those that a killed run left there
  /// under the same manifest. A warning says what is discarded.
  bool OpenFolder(bool restart, std::string& warning, std::string& error);

  /// The groups that are not stored yet, in coding order.
  const std::vector<int>& GetMissingGroups() const { return this->Header.Missing; }
  bool IsMissing(int group) const;

  /// The number of stored groups: 0 before OpenFolder, and on ranks that do not write the file.
  int CountStored() const;

  /// The cost of a group's tracks.
  GroupCost GetCost(const GroupTracks& tracks) const;

  /// Stores a missing group.
  bool StoreGroup(int group, const GroupTracks& tracks, std::string& error);

  /// The cost of a stored group.
  const GroupCost& GetStoredCost(int group) const { return this->Costs[group]; }

  ///@{
  /// The results of rate control's trials, kept beside the groups of the same manifest. Empty if
  /// there are none.
  std::string ReadTrials() const { return this->Store.ReadTrials(); }
  bool WriteTrials(const std::string& text, std::string& error) const
  {
    return this->Store.WriteTrials(text, error);
  }
  void DropTrials() const { this->Store.DropTrials(); }
  ///@}

  /// Whether the disk has enough space for the rest, judged by the target size of the file or by
  /// the stored groups. Half of an estimate by these is enough. If not, says how much is missing.
  bool HasRoom(std::string& error) const;

  /// Whether there is something to preview: the coarsest grid is stored, but not all groups.
  bool CanPreview() const;

  /// Joins the stored groups to a file in the folder of groups, which replaces an earlier one. If
  /// this fails, for example because the disk has no space besides what is needed, there is none,
  /// and `error` gives the reason.
  bool WritePreview(std::string& error);

  /// Joins all groups to the file, which replaces an earlier one only if `replaces` is set.
  /// `progress` gets numbers from 0 to 1 and returns false to stop. A warning says what was left
  /// beside the file.
  bool Finish(bool replaces, const std::function<bool(double)>& progress, std::string& warning,
    std::string& error);

  /// After Begin, also on ranks that do not write the file: the end of the message of a run that
  /// ends before the file is complete, with that many groups stored.
  std::string DescribeKept(int stored) const;

private:
  /// What is known about a track from its groups.
  struct TrackState
  {
    std::vector<std::uint8_t> ParameterSets;
    bool CoveredFully = true;
  };

  /// What an earlier run left of a group. A run that is killed while it writes or removes a group
  /// leaves some of its tracks.
  enum class Found
  {
    Whole,
    Missing,
    Damaged
  };

  std::string MakeManifest(std::uint32_t checksum, const GeometryPlan& plan) const;
  std::vector<std::uint8_t> Carry(const std::vector<std::uint8_t>& packet) const;
  bool AddCertificate(const std::function<bool(double)>& progress, std::string& error);
  bool Join(
    const std::string& fileName, const std::function<bool(double)>& progress, std::string& error);
  double GetStoredBytes() const;
  double GetWantedBytes() const;
  double GetMissingBytes() const;
  Found FindGroup(int group);
  bool RecordGroup(std::size_t track, int group, const CodedGroup& coded, std::string& error);
  void DropFullCoverage();

  std::string FileName;
  GroupStore Store;
  EncodeSettings Settings;
  Certifier Certify; ///< may be empty
  FileHeader Header;
  std::optional<GroupCoder> Coder;
  std::vector<TrackState> States; ///< one for each of the header's tracks
  int Delay = 0; ///< the maximum number of frames by which decoding runs ahead of presentation
  std::string Manifest;
  bool HasFolder = false;
  std::vector<GroupCost> Costs; ///< of each group that is stored
};
}

#endif
