// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads viewpoints of a light field of byte or float colours and 16-bit depth through the pipeline,
 * in any order.
 */
#ifndef cslfViewpointReader_h
#define cslfViewpointReader_h

#include "Pipeline/cslfFieldStream.h"
#include "Resampling/cslfKeyViews.h"
#include "cslfDescription.h"
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
/// Viewpoints of groups that are coded several times.
class GroupCache
{
public:
  /// Keeps at most this many slices.
  explicit GroupCache(int slices)
    : Room(slices)
  {
  }

  /// Keeps a group's slices if there is room.
  void Keep(int group, std::vector<ViewpointSamples> slices)
  {
    const int count = static_cast<int>(slices.size());
    if (count <= this->Room && this->Groups.count(group) == 0)
    {
      this->Room -= count;
      this->Groups[group] = std::move(slices);
    }
  }

  /// The slices of a group, or null.
  const std::vector<ViewpointSamples>* Find(int group) const
  {
    const auto found = this->Groups.find(group);
    return found == this->Groups.end() ? nullptr : &found->second;
  }

  void Drop(int group)
  {
    const auto found = this->Groups.find(group);
    if (found != this->Groups.end())
    {
      this->Room += static_cast<int>(found->second.size());
      this->Groups.erase(found);
    }
  }

private:
  int Room;
  std::map<int, std::vector<ViewpointSamples>> Groups;
};

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
}

#endif
