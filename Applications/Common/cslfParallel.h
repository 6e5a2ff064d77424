// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The tool under mpirun. Commands that write video share their work; all others are done by the
 * first process alone. Without mpirun, or without MPI, there is one process, and nothing here does
 * anything.
 */
#ifndef cslfParallel_h
#define cslfParallel_h

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiProcessController;

namespace cslf
{
namespace tool
{
/// MPI from beginning to end, if mpirun started the process.
class ParallelRun
{
public:
  ParallelRun(int* argc, char*** argv);
  ~ParallelRun();
  ParallelRun(const ParallelRun&) = delete;
  ParallelRun& operator=(const ParallelRun&) = delete;

private:
  vtkSmartPointer<vtkMultiProcessController> Controller; // VTK keeps no reference of its own
};

/// Whether this is the first process: the one that reads results and prints.
bool IsFirstRank();

/// How many processes do the chosen command together.
int CountProcesses();

/// The first process's number, on all that do the chosen command together.
int ShareNumber(int number);

/// Says that the chosen command is done by all processes together, if it is.
void SetShared(bool isShared);

/// Whether the chosen command is done by several processes together.
bool IsShared();

/// Whether this process has a part in the chosen command.
bool TakesPart();

/// All processes together begin what they do together, and end it. Throws a Failure where one of
/// them has failed already.
class SharedWork
{
public:
  SharedWork();
  ~SharedWork();
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;
};

/// How a command ended, for all processes.
struct Ending
{
  bool HasFailed = false;
  std::string Error; ///< to be printed by this process, or empty
};

/// Brings the processes' endings together: every one calls this at the end of a command, with its
/// error. The first process prints the error of the first that failed.
Ending Conclude(const std::string& error);
}
}

#endif
