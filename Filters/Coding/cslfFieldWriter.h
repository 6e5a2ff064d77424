// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Keeps the coded groups of a light field as parts, and joins them to one file.
 */
#ifndef cslfFieldWriter_h
#define cslfFieldWriter_h

#include "Coding/cslfFileHeader.h"
#include "Coding/cslfFrameOrder.h"
#include "Coding/cslfGroupCoder.h"
#include "Coding/cslfPartStore.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// First Begin. Then every group is coded by the coder, on any machine. Where the file is written:
/// OpenParts, StoreGroup for each group that it did not find, Finish.
class FieldWriter
{
public:
  FieldWriter(const std::string& fileName, const EncodeSettings& settings);

  /// How many groups there are, after Begin.
  int GetGroupCount() const { return static_cast<int>(this->Header.Groups.size()); }

  /// How many frames a group has.
  int GetFrames(int group) const { return this->Header.Groups[group]; }

  /// The slices of some groups in coding order.
  std::vector<int> GetSlices(const std::vector<int>& groups) const;

  /// Fixes order and tracks. `field` has passed FindFault; `sample` stands for the field's samples.
  void Begin(const Description& field, std::uint32_t sample);

  /// What the file shall carry besides the field.
  void SetParts(const std::vector<FilePart>& parts) { this->Header.Parts = parts; }

  std::size_t GetTrackCount() const { return this->States.size(); }

  /// What codes the groups, after Begin.
  const GroupCoder& GetCoder() const { return *this->Coder; }

  /// What rate control has to know. The writer must outlive it.
  RateField GetRateField() const;

  /// What the container adds once, about.
  double GetContainerBytes(bool hasCoverage) const;

  /// A text that tells all that the parts depend on.
  const std::string& GetManifest() const { return this->Manifest; }

  ///@{
  /// A group's parts as bytes for messages, of the same manifest on both sides.
  std::vector<std::uint8_t> Pack(const CodedGroup& part) const;
  bool Unpack(std::vector<std::uint8_t> bytes, CodedGroup& part) const;
  ///@}

  /// Makes the folder of parts, or takes over what a killed run left, before anything is known of
  /// the field. On failure returns false and says why.
  bool ReserveParts(bool restart, std::string& error)
  {
    return this->Parts.Reserve(restart, error);
  }

  /// Where in that folder something that helps to go on may be kept.
  KeptFile GetCacheFile() const { return this->Parts.GetCacheFile(); }

  /// Opens the folder of parts, and finds what a killed run left there under the same manifest, if
  /// `restart` is set. A warning tells what is discarded.
  bool OpenParts(bool restart, std::string& warning, std::string& error);

  /// The groups that are not stored yet, in coding order.
  const std::vector<int>& GetMissingGroups() const { return this->Missing; }
  bool IsMissing(int group) const;

  /// How many groups are stored: none before OpenParts, and where the file is not written.
  int CountStored() const;

  /// What a group's parts cost.
  GroupCost GetCost(const GroupParts& parts) const;

  /// Keeps a group that was missing.
  bool StoreGroup(int group, const GroupParts& parts, std::string& error);

  /// What a group that is stored costs.
  const GroupCost& GetStoredCost(int group) const { return this->Costs[group]; }

  ///@{
  /// What rate control found by trials, kept beside the parts of the same manifest; empty if there
  /// is nothing.
  std::string ReadTrials() const { return this->Parts.ReadTrials(); }
  bool WriteTrials(const std::string& text, std::string& error) const
  {
    return this->Parts.WriteTrials(text, error);
  }
  void DropTrials() const { this->Parts.DropTrials(); }
  ///@}

  /// Whether the disk has room for what is still to be written, as far as that is known: by the
  /// size that the file shall have, or by the groups that are stored. Of what is only guessed by
  /// these, half is enough. Otherwise says what is missing.
  bool HasRoom(std::string& error) const;

  /// Joins all groups to the file. `progress` gets numbers from 0 to 1 and returns false to stop. A
  /// warning tells what was left beside the file.
  bool Finish(
    const std::function<bool(double)>& progress, std::string& warning, std::string& error);

  /// After Begin, also where the file is not written: the end of a message on a run that ends
  /// before the file is whole, with so many groups stored.
  std::string DescribeKept(int stored) const;

private:
  /// What is known of a track from its groups.
  struct TrackState
  {
    std::vector<std::uint8_t> ParameterSets;
    bool CoveredFully = true;
  };

  /// What an earlier run left of a group. A run that is killed while it writes a group's parts, or
  /// clears them away in the end, leaves some of them.
  enum class Found
  {
    Whole,
    Missing,
    Damaged
  };

  std::string MakeManifest(std::uint32_t sample) const;
  bool Join(const std::function<bool(double)>& progress, std::string& error);
  double GetStoredBytes() const;
  double GetWantedBytes() const;
  Found FindGroup(int group);
  bool Note(std::size_t track, int group, const CodedGroup& part, std::string& error);
  void DropFullCoverage();

  std::string FileName;
  PartStore Parts;
  EncodeSettings Settings;
  FileHeader Header;
  std::optional<GroupCoder> Coder;
  std::vector<TrackState> States; ///< one for each of the header's tracks
  int Delay = 0; ///< by how many frames decoding runs ahead of presentation, at most
  std::string Manifest;
  std::uint32_t ManifestNumber = 0;
  bool HasParts = false;
  std::vector<int> Missing;
  std::vector<GroupCost> Costs; ///< of each group that is stored
};
}

#endif
