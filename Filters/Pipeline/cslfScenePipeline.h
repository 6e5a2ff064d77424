// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The executive of filters that gather a scene from all ranks. Where the input of one rank fails,
 * the pipeline does not execute the filter there, and the other ranks would wait forever. This
 * executive informs them.
 */
#ifndef cslfScenePipeline_h
#define cslfScenePipeline_h

#include <vtkCompositeDataPipeline.h>

#include <functional>

namespace cslf
{
class ScenePipeline : public vtkCompositeDataPipeline
{
public:
  static ScenePipeline* New();
  vtkTypeMacro(ScenePipeline, vtkCompositeDataPipeline);

  /// Whether the filter gathers a scene when it executes, and the collective call that it makes if
  /// its input has failed.
  std::function<bool()> MustGather;
  std::function<void()> GatherAsFailed;

  /// Notes that the filter has made its collective call, or does not need it.
  void SetGathered() { this->HasGathered = true; }

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int UpdateInformation() override;
  vtkTypeBool Update(int port, vtkInformationVector* requests) override;
  using vtkCompositeDataPipeline::Update;

protected:
  ScenePipeline() = default;
  ~ScenePipeline() override = default;

private:
  ScenePipeline(const ScenePipeline&) = delete;
  void operator=(const ScenePipeline&) = delete;

  bool Gathers() const;
  void EndUpdate(bool isDone);

  bool HasGathered = false;
  bool IsBroken = false; ///< an earlier pass of this update has failed
};
}

#endif
