// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The phases of an algorithm's long work. A user sees the name of the present one as the
 * algorithm's GetProgressText(), and the share of the whole Update() or Write() as GetProgress().
 * PipelineWatch calls a function whenever an upstream filter reports progress.
 */
#ifndef cslfPhase_h
#define cslfPhase_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkSmartPointer.h>

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

class vtkAlgorithm;

namespace cslf
{
/// Gets the share of the work that is done, from 0 to 1, on the thread that has begun the work. If
/// it returns false, the work ends soon.
using Progress = std::function<bool(double)>;

/// The progress of a part of the work, from `first` to `last` of the whole.
VTKCSLF_EXPORT Progress Within(const Progress& progress, double first, double last);

/// What work of many steps throws if it shall end. Whoever begins the work catches it.
struct Aborted
{
};

/// The progress of such work: it throws where `progress` returns false.
VTKCSLF_EXPORT Progress OrAbort(const Progress& progress);

/// While it exists, the algorithm is in this phase. There may be phases within a phase, one after
/// the other.
class VTKCSLF_EXPORT Phase
{
public:
  /// The phase lasts from the algorithm's present progress to `last`, a share of the phase around
  /// it or, if there is none, of the whole. An empty name stands for the name of the phase around
  /// it. The algorithm's progress must be its own, not that of an earlier Update().
  Phase(vtkAlgorithm* algorithm, const std::string& name, double last = 1.0);
  ~Phase();
  Phase(const Phase&) = delete;
  Phase& operator=(const Phase&) = delete;

  /// Reports the share of the phase that is done. Progress never runs backwards: if the share was
  /// larger before, that counts. Returns false if the algorithm was asked to stop.
  bool Report(double share);

  /// The largest share reported.
  double GetShare() const { return this->Share; }

  /// Reports while a filter is at work for the algorithm. If that is in a phase, its name is shown.
  bool ReportFor(vtkAlgorithm* filter, double share);

private:
  bool Report(const char* name, double share);

  vtkAlgorithm* Algorithm;
  std::string Name;
  std::optional<std::string> NameAround;
  double Shift;
  double Scale;
  double Share = 0.0;
};
}

class vtkAlgorithm;
class vtkAlgorithmOutput;

namespace cslf
{
///@{
/// The filters that feed a connection, which may be null, or all inputs of a filter: nearest first,
/// each once.
std::vector<vtkSmartPointer<vtkAlgorithm>> FindProducers(vtkAlgorithmOutput* connection);
std::vector<vtkSmartPointer<vtkAlgorithm>> FindInputs(vtkAlgorithm* filter);
///@}

class PipelineWatch
{
public:
  /// Calls `act` from now on with each of these filters when it reports progress. If it returns
  /// false, that filter is asked to stop. Only the calling thread calls it.
  PipelineWatch(const std::vector<vtkSmartPointer<vtkAlgorithm>>& filters,
    std::function<bool(vtkAlgorithm*)> act);

  /// The same for all filters that feed a connection.
  PipelineWatch(vtkAlgorithmOutput* connection, std::function<bool(vtkAlgorithm*)> act);
  ~PipelineWatch();
  PipelineWatch(const PipelineWatch&) = delete;
  PipelineWatch& operator=(const PipelineWatch&) = delete;

private:
  void Add(vtkAlgorithm* algorithm);

  std::function<bool(vtkAlgorithm*)> Act;
  std::thread::id Thread = std::this_thread::get_id();
  std::map<vtkSmartPointer<vtkAlgorithm>, unsigned long> Observers;
  std::set<vtkAlgorithm*> Stopped;
};
}

#endif
