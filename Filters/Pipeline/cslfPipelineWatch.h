// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Something to do while the filters above one's own are at work: whenever one of them reports
 * progress.
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
/// The filters that feed a connection, which may be null: its own first, each once.
std::vector<vtkSmartPointer<vtkAlgorithm>> FindProducers(vtkAlgorithmOutput* connection);

class PipelineWatch
{
public:
  /// From now on calls `act` at the progress of everything that feeds the connection. The filter
  /// at work is asked to stop when it returns false. Only the calling thread acts.
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
