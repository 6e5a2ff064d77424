// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Codes single groups of a field without writing a file, to find out what they cost.
 */
#ifndef cslfEncodeProbe_h
#define cslfEncodeProbe_h

#include "Coding/cslfFieldWriter.h"
#include "Pipeline/cslfSlicePuller.h"

#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;

namespace cslf
{
/// What some groups cost.
struct GroupCosts
{
  double RenderSeconds = 0.0;       ///< of the input's work
  double RenderThreadSeconds = 0.0; ///< of all threads together
  double CodingThreadSeconds = 0.0; ///< likewise
  std::vector<double> Bytes;        ///< of each group, with what it takes of the container

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
  /// The producer's output port 0 is the field.
  EncodeProbe(vtkAlgorithm* producer, EncodeSettings settings);

  /// Asks for the field's description, with its first viewpoint. On failure returns false and says
  /// why, in a sentence.
  bool Begin(std::string& error);

  /// What a run's parts would depend on.
  const std::string& GetManifest() const { return this->Writer->GetManifest(); }

  int GetGroupCount() const { return this->Writer->GetGroupCount(); }

  /// Makes and codes some groups. On failure returns false and says why.
  bool Make(const std::vector<int>& groups, GroupCosts& costs, std::string& error);

  /// The viewpoints of the groups that were made last.
  std::vector<ConstSlice> GetSlices() const { return this->Puller->GetSlices(); }

  /// What a file holds beside the groups, about.
  double GetContainerBytes() const;

private:
  vtkAlgorithm* Producer;
  EncodeSettings Settings;
  std::optional<SlicePuller> Puller;
  std::optional<FieldWriter> Writer;
  bool IsCoveredFully = true; // by all groups made so far
};
}

#endif
