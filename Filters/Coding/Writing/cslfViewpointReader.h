// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads viewpoints of a light field of byte or float colours and 16-bit depth through the pipeline,
 * in any order, and makes the groups of them that are coded.
 */
#ifndef cslfViewpointReader_h
#define cslfViewpointReader_h

#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfPhase.h"
#include "Resampling/cslfKeyViews.h"
#include "cslfDescription.h"
#include "cslfFileAssembler.h"
#include "cslfViewpointSamples.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkAlgorithmOutput;
class vtkInformation;

namespace cslf
{
/// The grid of viewpoints and texels for the whole extent of that pipeline information, if it is
/// that of a whole light field.
std::optional<Layout> FindGrid(vtkInformation* information);

class ViewpointReader
{
public:
  /// Reads from a connection whose whole extent is `grid`'s.
  ViewpointReader(vtkAlgorithmOutput* connection, const Layout& grid);

  /// From now on, fields and slices are those of the key views only. At first, all viewpoints are
  /// key views.
  void SetKeyViewStep(int step) { this->Keys = KeyViews(this->Grid.GetViewpoints(), step); }

  /// Reads the first viewpoint with the description. On failure returns false and gives the reason
  /// in a sentence.
  bool Begin(std::string& error);

  Description GetField() const { return this->Keys.Apply(this->Input.GetDescription()); }

  /// The CRC-32 of the first viewpoint, after Begin.
  std::uint32_t GetFirstChecksum() const;

  /// Reads frames, in any order, in as few slabs as possible. On failure returns false and gives
  /// the reason in one line.
  bool Read(const std::vector<FrameId>& frames, std::string& error);

  /// While Read waits for the input: the share of the slices that is there, if the input has made
  /// this share of what it was asked for.
  double GetShare(double ofInput) const;

  /// The frames read last, in the requested order.
  const std::vector<ViewpointSamples>& GetSlices() const { return this->Slices; }

  /// Whether a texel read so far has a float colour that a video cannot hold.
  bool HasClipped() const { return this->Clipped; }

private:
  bool ReadRange(FrameId first, int last, std::string& error);
  void Copy(int slice, const ViewpointSamples& target);

  FieldStream Input;
  Layout Grid;
  KeyViews Keys;
  bool Clipped = false;
  std::vector<ViewpointSamples> Slices; ///< last

  ///@{
  /// The numbers of slices that Read has, that it waits for, and that it shall get.
  std::size_t Done = 0;
  std::size_t Awaited = 0;
  std::size_t Wanted = 0;
  ///@}
};

/// Gives the viewpoints of groups as they are coded: read, and fitted to the geometry. Keeps those
/// of groups that are coded several times, as far as there is room.
class GroupSource
{
public:
  /// Keeps at most `kept` slices. All arguments must outlive this object.
  GroupSource(
    ViewpointReader& input, const FileAssembler& file, const GeometryPlan& plan, int kept);

  /// The slices of the tasks' groups, one group after the other. Those of trials are kept.
  /// `progress` gets numbers from 0 to 1 while viewpoints are fitted, and returns false to stop. On
  /// failure returns false and gives the reason in one line.
  bool Gather(const std::vector<CodingTask>& tasks, const Progress& progress,
    std::vector<ViewpointSamples>& slices, std::string& error);

  /// Forgets a group that will not be coded again.
  void Drop(int group);

private:
  ViewpointReader& Input;
  const FileAssembler& File;
  const GeometryPlan& Plan;
  int Room;                                          ///< how many more slices are kept
  std::map<int, std::vector<ViewpointSamples>> Kept; ///< by group
};
}

#endif
