// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Calls a function whenever an upstream filter reports progress.
 */
#ifndef cslfPipelineWatch_h
#define cslfPipelineWatch_h

#include <vtkSmartPointer.h>

#include <functional>
#include <map>
#include <set>
#include <thread>
#include <vector>

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
