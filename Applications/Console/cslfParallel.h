// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The tool under mpirun. Commands that write video share their work; only the first process runs
 * all others. Without mpirun, or without MPI, there is one process, and these functions do nothing.
 */
#ifndef cslfParallel_h
#define cslfParallel_h

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiProcessController;

namespace cslf::tool
{
/// MPI from initialisation to finalisation, if mpirun started the process.
class ParallelRun
{
public:
  ParallelRun(int* argc, char*** argv);
  ~ParallelRun();
  ParallelRun(const ParallelRun&) = delete;
  ParallelRun& operator=(const ParallelRun&) = delete;

private:
  vtkSmartPointer<vtkMultiProcessController> Controller; // VTK does not keep a reference
};

/// Whether this is the first process: the one that reads results and prints.
bool IsFirstRank();

/// The number of processes that run the chosen command together.
int CountProcesses();

/// The first process's number, on all processes that run the chosen command together.
int ShareNumber(int number);

/// Declares that all processes run the chosen command together, if they do.
void SetShared(bool isShared);

/// Whether several processes run the chosen command together.
bool IsShared();

/// Whether this process takes part in the chosen command.
bool TakesPart();

/// All processes call these together to begin and end their shared work. Throws a Failure if one of
/// them has failed already.
class SharedWork
{
public:
  SharedWork();
  ~SharedWork();
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;
};

/// The result of a command, for all processes.
struct Ending
{
  bool HasFailed = false;
  std::string Error; ///< to be printed by this process, or empty
};

/// Gathers the results of all processes. Each calls this at the end of a command, with its error.
/// The first process prints the error of the first that failed.
Ending EndTogether(const std::string& error);
}

#endif
