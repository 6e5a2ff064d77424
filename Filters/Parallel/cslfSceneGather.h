// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Gathers a scene from several ranks on each of them.
 */
#ifndef cslfSceneGather_h
#define cslfSceneGather_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfRanks.h"

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
/// The memory that the ranks will need, in bytes.
struct GatherCost
{
  std::uint64_t Pieces = 0; ///< of all ranks together, received by each rank
  std::uint64_t Node = 0;   ///< what the scenes of all ranks on this rank's computer need
  std::uint64_t Memory = 0; ///< of this rank's computer; 0 if unknown

  /// A warning if there may not be enough memory, or nothing.
  std::string FindWarning() const;
};

/// All ranks make the same calls together. If one rank fails, the call returns false on all, and
/// the error gives that rank and its reason.
class VTKCSLF_EXPORT SceneGather
{
public:
  /// `arithmetic` identifies how this rank computes. Messages have `partSize` bytes at most.
  SceneGather(vtkMultiProcessController* controller, const std::string& arithmetic,
    std::size_t partSize = MaximumMessage);

  /// Prepares a rank's inputs for the others and determines the size of all ranks' inputs. If a
  /// rank cannot give its inputs, `error` gives the reason.
  bool Begin(const std::vector<vtkDataObject*>& inputs, std::string& error);

  const GatherCost& GetCost() const { return this->Cost; }

  /// Whether all ranks have the same arithmetic.
  bool AreAlike() const { return this->Alike; }

  /// Gathers the inputs of all ranks.
  bool Finish(std::string& error);

  /// All ranks' inputs in the order of the ranks, and the rank that each comes from.
  const std::vector<vtkSmartPointer<vtkDataObject>>& GetObjects() const { return this->Objects; }
  const std::vector<int>& GetRanks() const { return this->Ranks; }

private:
  void FindCost();
  bool Unpack(char* bytes, std::uint64_t count, int rank);

  vtkMultiProcessController* Controller;
  std::string Arithmetic;
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
