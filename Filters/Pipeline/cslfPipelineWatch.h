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
#include <thread>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;

namespace cslf
{
/// The filters that feed a connection, which may be null, nearest first, each once.
std::vector<vtkSmartPointer<vtkAlgorithm>> FindProducers(vtkAlgorithmOutput* connection);

class PipelineWatch
{
public:
  /// Calls `act` from now on when a filter that feeds the connection reports progress. If it
  /// returns false, that filter is asked to stop. Only the calling thread calls it.
  PipelineWatch(vtkAlgorithmOutput* connection, std::function<bool()> act);
  ~PipelineWatch();
  PipelineWatch(const PipelineWatch&) = delete;
  PipelineWatch& operator=(const PipelineWatch&) = delete;

private:
  void Add(vtkAlgorithm* algorithm);

  std::function<bool()> Act;
  std::thread::id Thread = std::this_thread::get_id();
  std::map<vtkSmartPointer<vtkAlgorithm>, unsigned long> Observers;
};
}

#endif
