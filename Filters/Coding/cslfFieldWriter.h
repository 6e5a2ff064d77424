// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Codes a light field group by group into parts, and joins them to one file.
 */
#ifndef cslfFieldWriter_h
#define cslfFieldWriter_h

#include "Coding/cslfCodingTask.h"
#include "Coding/cslfFileHeader.h"
#include "Coding/cslfFrameOrder.h"
#include "Coding/cslfPartStore.h"
#include "Coding/cslfRateControl.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cslf
{
/// What a user may choose.
struct EncodeSettings
{
  std::string Preset;
  std::string PixelFormat; ///< FFmpeg's name, or "auto"
  double CRF = 0.0;
  double CoverageCRF = 0.0;
  double DepthCRF = 0.0;
  int GroupLength = MaximumGroupLength;
  bool Lossless = false;
  RateTarget Target{}; ///< in place of CRF, unless its kind is Factor
  int KeyViewStep = 1; ///< see KeyViews; 0 for what reaches NovelViewPSNR, see ChooseKeyViews
  double NovelViewPSNR = 0.0;
  std::string Codec = "hevc";
};

/// What keeps a file of that name from being written, in one line; empty where nothing does.
/// Touches no file.
std::string FindFault(const std::string& fileName);

/// What keeps frames of that resolution from being coded with these settings, likewise.
std::string FindFault(const EncodeSettings& settings, int resolution);

/// What keeps a field from being coded, in one line; empty where nothing does.
std::string FindFault(const Description& field);

/// What keeps it from being coded with these settings, which have passed the checks above,
/// likewise.
std::string FindFault(const EncodeSettings& settings, const Description& field);

/// A group's part of each track.
using GroupParts = std::vector<CodedGroup>;

/// First Begin. Then EncodeGroups for every group, on any machine. Where the file is written:
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

  std::size_t GetTrackCount() const { return this->Encodings.size(); }

  /// What rate control has to know. The writer must outlive it.
  RateField GetRateField() const;

  /// What the container adds once, about.
  double GetContainerBytes(bool hasCoverage) const;

  /// A text that tells all that the parts depend on.
  const std::string& GetManifest() const { return this->Manifest; }

  /// Makes the folder of parts, or takes over what a killed run left, before anything is known of
  /// the field. On failure returns false and says why.
  bool ReserveParts(bool restart, std::string& error)
  {
    return this->Parts.Reserve(restart, error);
  }

  /// Where in that folder something that helps to go on may be kept.
  std::string GetCacheName() const { return this->Parts.GetCacheName(); }

  /// Opens the folder of parts, and finds what a killed run left there under the same manifest, if
  /// `restart` is set. A warning tells what is discarded.
  bool OpenParts(bool restart, std::string& warning, std::string& error);

  /// The groups that are not stored yet, in coding order.
  const std::vector<int>& GetMissingGroups() const { return this->Missing; }
  bool IsMissing(int group) const;

  /// Does some tasks side by side. `slices` are those of the tasks' groups, one group after the
  /// other; `parts` has those of the first task, for each of its factors, then those of the next.
  /// `idle` is called now and then on the calling thread.
  bool EncodeGroups(const std::vector<CodingTask>& tasks, const std::vector<ConstSlice>& slices,
    const std::function<void()>& idle, std::vector<GroupParts>& parts, std::string& error) const;

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
  ///@}

  /// Joins all groups to the file. `progress` gets numbers from 0 to 1 and returns false to stop.
  bool Finish(const std::function<bool(double)>& progress, std::string& error);

private:
  struct Encoding
  {
    Track Kind;
    EncodeOptions Options;
    std::vector<std::uint8_t> ParameterSets;
    bool CoveredFully = true;
  };

  void MakeEncodings(const Description& field);
  std::string MakeManifest(std::uint32_t sample) const;
  EncodeOptions GetOptions(const Encoding& encoding, double factor) const;
  bool IsMeasured(const CodingTask& task) const;
  bool MeasureErrors(const std::vector<CodingTask>& tasks, const std::vector<ConstSlice>& slices,
    std::vector<GroupParts>& parts, std::string& error) const;
  bool FindGroup(int group);
  bool Note(std::size_t track, int group, const CodedGroup& part, std::string& error);
  void DropFullCoverage();

  std::string FileName;
  PartStore Parts;
  EncodeSettings Settings;
  FileHeader Header;
  std::vector<Encoding> Encodings; ///< one for each of the header's tracks
  std::string Manifest;
  std::vector<int> Missing;
  std::vector<GroupCost> Costs; ///< of each group that is stored
};
}

#endif
