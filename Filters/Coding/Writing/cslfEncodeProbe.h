// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Codes single groups of a field without writing a file, to measure their cost.
 */
#ifndef cslfEncodeProbe_h
#define cslfEncodeProbe_h

#include "cslfFileAssembler.h"
#include "cslfViewpointReader.h"

#include <vtkSmartPointer.h>

#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkPolyData;

namespace cslf
{
/// The cost of some groups.
struct GroupCosts
{
  double RenderSeconds = 0.0;       ///< of the input's work
  double RenderThreadSeconds = 0.0; ///< of all threads together
  double CodingThreadSeconds = 0.0; ///< likewise
  std::vector<double> Bytes;        ///< of each group, including its share of the container

  void operator+=(const GroupCosts& other)
  {
    this->RenderSeconds += other.RenderSeconds;
    this->RenderThreadSeconds += other.RenderThreadSeconds;
    this->CodingThreadSeconds += other.CodingThreadSeconds;
    this->Bytes.insert(this->Bytes.end(), other.Bytes.begin(), other.Bytes.end());
  }
};

class EncodeProbe
{
public:
  /// The producer's output port 0 is the field. The geometry, which may be null, is in the file. If
  /// it is not told what is computed from it, the probe tries.
  EncodeProbe(vtkAlgorithm* producer, EncodeSettings settings, vtkPolyData* geometry = nullptr,
    std::optional<ComputedChannels> computed = std::nullopt);

  /// Asks for the field's description, with its first viewpoint. On failure returns false and gives
  /// the reason in a sentence.
  bool Begin(std::string& error);

  /// What the groups of a run would depend on.
  const std::string& GetManifest() const { return this->Writer->GetManifest(); }

  /// What readers would compute, after Begin.
  const ComputedChannels& GetComputed() const { return this->Plan.GetComputed(); }

  /// Whether they would compute all if the colours of the viewpoints were the final ones.
  bool MayTellAll() const { return this->Plan.MayTellAll(); }

  int GetGroupCount() const { return this->Writer->GetGroupCount(); }

  /// Makes and codes some groups. On failure returns false and gives the reason.
  bool Make(const std::vector<int>& groups, GroupCosts& costs, std::string& error);

  /// The viewpoints of the groups that were made last.
  std::vector<ViewpointSamples> GetSlices() const { return this->Input->GetSlices(); }

  /// The approximate size of what a file contains beside the groups.
  double GetContainerBytes() const;

private:
  bool BeginWriting(std::string& error);

  vtkAlgorithm* Producer;
  EncodeSettings Settings;
  vtkSmartPointer<vtkPolyData> Geometry;
  std::optional<ComputedChannels> Computed;
  GeometryPlan Plan;
  std::optional<ViewpointReader> Input;
  std::optional<FileAssembler> Writer;
  bool IsCoveredFully = true; // by all groups made so far
};
}

#endif
