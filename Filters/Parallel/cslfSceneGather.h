// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A scene whose pieces lie on several ranks, brought together on each.
 */
#ifndef cslfSceneGather_h
#define cslfSceneGather_h

#include "vtkCSLFModule.h" // for export macro

#include "Parallel/cslfBroadcast.h"

#include <vtkCharArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace cslf
{
/// What the ranks will hold, in bytes.
struct GatherCost
{
  std::uint64_t Pieces = 0; ///< of all ranks together, which each rank gets
  std::uint64_t Node = 0;   ///< what all ranks on this rank's computer need for their scenes
  std::uint64_t Memory = 0; ///< of this rank's computer; 0 where it is not known

  /// A warning where the memory may not be enough, or nothing.
  std::string FindWarning() const;
};

/// All ranks make the same calls together. Where one rank fails, the call returns false on all of
/// them, and the error says which and why.
class VTKCSLF_EXPORT SceneGather
{
public:
  /// Messages have `partSize` bytes at most.
  explicit SceneGather(
    vtkMultiProcessController* controller, std::size_t partSize = LargestMessage);

  /// Prepares a rank's inputs for the others and tells how much all ranks have. If a rank has no
  /// inputs to give, `error` says why.
  bool Begin(const std::vector<vtkDataObject*>& inputs, std::string& error);

  const GatherCost& GetCost() const { return this->Cost; }

  /// Whether all ranks compute alike: see GetArithmetic.
  bool AreAlike() const { return this->Alike; }

  /// Brings the inputs of all ranks here.
  bool Finish(std::string& error);

  /// All ranks' inputs in the order of the ranks, and the rank that each comes from.
  const std::vector<vtkSmartPointer<vtkDataObject>>& GetObjects() const { return this->Objects; }
  const std::vector<int>& GetRanks() const { return this->Ranks; }

private:
  void FindCost();
  bool Unpack(char* bytes, std::uint64_t count, int rank);

  vtkMultiProcessController* Controller;
  std::size_t PartSize;
  vtkNew<vtkCharArray> Mine;
  std::vector<std::uint64_t> Sizes; // of what each rank sends
  GatherCost Cost;
  bool Alike = true;
  std::vector<vtkSmartPointer<vtkDataObject>> Objects;
  std::vector<int> Ranks;
};
}

#endif
