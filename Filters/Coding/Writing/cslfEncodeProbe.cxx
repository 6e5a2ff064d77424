// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEncodeProbe.h"

#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfFieldArrays.h"

#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkPolyData.h>

#include <chrono>
#include <ctime>
#include <utility>

namespace cslf
{
namespace
{
/// Probes are short.
bool GoOn(double)
{
  return true;
}
}

EncodeProbe::EncodeProbe(vtkAlgorithm* producer, EncodeSettings settings, vtkPolyData* geometry,
  std::optional<ComputedChannels> computed)
  : Producer(producer)
  , Settings(std::move(settings))
  , Geometry(geometry)
  , Computed(computed)
{
}

bool EncodeProbe::Begin(std::string& error)
{
  this->Producer->UpdateInformation();
  vtkInformation* information = this->Producer->GetOutputInformation(0);
  const auto grid = FindGrid(information);
  if (!grid)
  {
    error = "The sampler gives no information about its output.";
    return false;
  }
  error = FindError(this->Settings, grid->GetResolution());
  error =
    error.empty() ? KeyViews::FindError(grid->GetViewpoints(), this->Settings.KeyViewStep) : error;
  if (!error.empty())
  {
    return false;
  }
  this->Input.emplace(this->Producer->GetOutputPort(0), *grid);
  this->Input->SetKeyViewStep(this->Settings.KeyViewStep);
  this->Writer.emplace("probe.mp4", this->Settings);
  if (!this->Input->Begin(error))
  {
    return false;
  }
  error = FindError(this->Settings, this->Input->GetField());
  if (!error.empty())
  {
    return false;
  }
  return this->BeginWriting(error);
}

bool EncodeProbe::BeginWriting(std::string& error)
{
  const Description field = this->Input->GetField();
  std::string fault;
  const FilePart part{ GeometryPartType, GeometryPartName,
    this->Geometry ? EncodeGeometry(this->Geometry, field.Box, field.Grid.GetResolution(), fault)
                   : std::vector<unsigned char>() };
  if (!part.Bytes.empty() && FindError({}, part).empty())
  {
    this->Writer->SetParts({ part });
    if (this->Computed)
    {
      this->Plan = GeometryPlan(part.Bytes, field, *this->Computed);
    }
    else if (this->Settings.ComputesDepth())
    {
      const std::vector<FrameId> frames = GetTriedViewpoints(field.Grid);
      if (!this->Input->Read(frames, error))
      {
        return false;
      }
      this->Plan = GeometryPlan::Choose(part.Bytes, field, frames, this->Input->GetSlices(), GoOn);
    }
  }
  this->Writer->Begin(field, 0, this->Plan);
  return true;
}

bool EncodeProbe::Make(const std::vector<int>& groups, GroupCosts& costs, std::string& error)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const std::clock_t begin = std::clock();
  if (!this->Input->Read(this->Writer->GetFrames(groups), error))
  {
    return false;
  }
  const std::clock_t middle = std::clock();
  std::vector<ViewpointSamples> fitted;
  if (this->Plan.TellsAll())
  {
    // The encoder will ask for none.
    fitted = MakeBlankSamples(this->Input->GetField(), this->Input->GetSlices().size());
  }
  else
  {
    costs.RenderSeconds += std::chrono::duration<double>(Clock::now() - start).count();
    costs.RenderThreadSeconds += static_cast<double>(middle - begin) / CLOCKS_PER_SEC;
    // The samples themselves are asked for afterwards.
    fitted = this->GetComputed().HasDepth
      ? CopySamples(this->Input->GetField(), this->Input->GetSlices())
      : this->Input->GetSlices();
    GeometryFit ignored;
    this->Plan.Fit(this->Writer->GetFrames(groups), fitted, GoOn, ignored);
  }
  std::vector<CodingTask> tasks;
  tasks.reserve(groups.size());
  for (int group : groups)
  {
    tasks.push_back({ group, true, { this->Settings.CRF } });
  }
  std::vector<GroupTracks> coded;
  if (!this->Writer->GetCoder().Encode(tasks, fitted, GoOn, coded, error))
  {
    return false;
  }
  costs.CodingThreadSeconds += static_cast<double>(std::clock() - middle) / CLOCKS_PER_SEC;
  for (const GroupTracks& group : coded)
  {
    const GroupCost cost = this->Writer->GetCost(group);
    this->IsCoveredFully = this->IsCoveredFully && cost.CoveredFully;
    costs.Bytes.push_back(cost.Bytes + cost.CoverageBytes);
  }
  return true;
}

double EncodeProbe::GetContainerBytes() const
{
  return this->Writer->GetContainerBytes(!this->IsCoveredFully);
}
}
