// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfParallel.h"

#include "cslfMessages.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>
#include <vtkMultiProcessStream.h>

#ifdef CSLF_HAS_MPI
#include <vtkMPIController.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <vector>

namespace cslf::tool
{
namespace
{
struct State
{
  bool IsShared = false;
  bool HasBegun = false; ///< the shared work
  bool IsBroken = false; ///< it was left in the middle
};

State& GetState()
{
  static State state;
  return state;
}

vtkMultiProcessController* GetController()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

/// Whether no process has an error.
bool Agree(bool hasSucceeded)
{
  const int mine = hasSucceeded ? 1 : 0;
  int all = mine;
  GetController()->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  return all == 1;
}

#ifdef CSLF_HAS_MPI
/// Whether a launcher of Open MPI, PMIx, MPICH or Intel MPI started the process.
bool IsUnderMPI()
{
  const char* const marks[] = { "OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE" };
  return std::any_of(
    std::begin(marks), std::end(marks), [](const char* mark) { return std::getenv(mark); });
}
#endif
}

ParallelRun::ParallelRun(int* argc, char*** argv)
{
#ifdef CSLF_HAS_MPI
  if (IsUnderMPI())
  {
    this->Controller = vtkSmartPointer<vtkMPIController>::New();
    this->Controller->Initialize(argc, argv, 0);
    vtkMultiProcessController::SetGlobalController(this->Controller);
  }
#else
  static_cast<void>(argc);
  static_cast<void>(argv);
#endif
}

ParallelRun::~ParallelRun()
{
  if (this->Controller)
  {
    vtkMultiProcessController::SetGlobalController(nullptr);
    this->Controller->Finalize();
  }
}

bool IsFirstRank()
{
  vtkMultiProcessController* controller = GetController();
  return !controller || controller->GetLocalProcessId() == 0;
}

void SetShared(bool isShared)
{
  GetState().IsShared = isShared && GetController();
}

bool IsShared()
{
  return GetState().IsShared;
}

int CountProcesses()
{
  return IsShared() ? GetController()->GetNumberOfProcesses() : 1;
}

int ShareNumber(int number)
{
  if (IsShared())
  {
    GetController()->Broadcast(&number, 1, 0);
  }
  return number;
}

bool TakesPart()
{
  return IsFirstRank() || IsShared();
}

SharedWork::SharedWork()
{
  State& state = GetState();
  if (state.IsShared && !state.HasBegun)
  {
    state.HasBegun = true;
    if (!Agree(true))
    {
      throw Failure("");
    }
  }
}

SharedWork::~SharedWork()
{
  GetState().IsBroken = std::uncaught_exceptions() > 0;
}

Ending EndTogether(const std::string& error)
{
  const State& state = GetState();
  if (!state.IsShared)
  {
    return { !error.empty(), error };
  }
  if (state.IsBroken)
  {
    // The others wait for this process somewhere in the middle: terminate them all.
    PrintError(error);
    std::_Exit(EXIT_FAILURE);
  }
  Ending ending;
  if (!state.HasBegun)
  {
    Agree(false);
  }
  vtkMultiProcessStream mine;
  mine << error;
  std::vector<vtkMultiProcessStream> all;
  GetController()->Gather(mine, all, 0);
  for (vtkMultiProcessStream& stream : all)
  {
    std::string text;
    stream >> text;
    ending.Error = ending.Error.empty() ? text : ending.Error;
  }
  ending.HasFailed = !Agree(error.empty() && ending.Error.empty());
  return ending;
}
}
