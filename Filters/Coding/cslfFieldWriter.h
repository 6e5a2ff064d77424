// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Codes a light field group by group into parts, and joins them to one file.
 */
#ifndef cslfFieldWriter_h
#define cslfFieldWriter_h

#include "Coding/cslfFileHeader.h"
#include "Coding/cslfFrameOrder.h"
#include "Coding/cslfPartStore.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cslf
{
/// What a user may choose.
struct EncodeSettings
{
  std::string Preset;
  std::string PixelFormat;
  double CRF = 0.0;
  double CoverageCRF = 0.0;
  double DepthCRF = 0.0;
  int GroupLength = MaximumGroupLength;
  bool Lossless = false;
};

/// What keeps a file of that name from being written with these settings for frames of that
/// resolution, in one line; empty where nothing does. Touches no file.
std::string FindFault(const std::string& fileName, const EncodeSettings& settings, int resolution);

/// What keeps a field from being coded, in one line; empty where nothing does.
std::string FindFault(const Description& field);

class FieldWriter
{
public:
  /// For a field of `grid`'s numbers of viewpoints and texels.
  FieldWriter(const std::string& fileName, const EncodeSettings& settings, const Layout& grid);

  /// The lengths of the groups in coding order.
  const std::vector<int>& GetGroups() const { return this->Header.Groups; }

  /// The slices of some groups in coding order.
  std::vector<int> GetSlices(int firstGroup, int count) const;

  /// Makes the folder of parts. `field` has passed FindFault.
  bool Begin(const Description& field, std::string& error);

  /// Codes some groups, whose slices come in coding order, side by side.
  bool WriteGroups(
    int firstGroup, int count, const std::vector<ConstSlice>& slices, std::string& error);

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

  void MakeEncodings(bool hasDepth);
  bool Note(std::size_t track, int group, const CodedGroup& part, std::string& error);
  void DropFullCoverage();

  PartStore Parts;
  EncodeSettings Settings;
  FileHeader Header;
  std::vector<Encoding> Encodings; ///< one for each of the header's tracks
};
}

#endif
