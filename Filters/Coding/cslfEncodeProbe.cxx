// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfEncodeProbe.h"

#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

namespace cslf
{
namespace
{
// What a container adds for each frame of a track, and at its beginning: measured.
constexpr double FrameBytes = 12.0;
constexpr double GroupBytes = 28.0;
constexpr double TrackBytes = 700.0;
constexpr double FixedBytes = 1400.0;
}

EncodeProbe::EncodeProbe(vtkAlgorithm* producer, EncodeSettings settings)
  : Producer(producer)
  , Settings(std::move(settings))
{
}

bool EncodeProbe::Begin(std::string& error)
{
  this->Producer->UpdateInformation();
  vtkInformation* information = this->Producer->GetOutputInformation(0);
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  if (extent[5] < extent[4])
  {
    error = "The sampler does not say what it makes.";
    return false;
  }
  this->Slices = extent[5] + 1;
  const int viewpoints = static_cast<int>(std::lround(std::sqrt(this->Slices / double(FaceCount))));
  const Layout grid(viewpoints, extent[3] + 1);
  error = FindFault(this->Settings, grid.GetResolution());
  if (!error.empty())
  {
    return false;
  }
  extent[5] = extent[4];
  if (!this->Producer->UpdateExtent(extent))
  {
    error = "The sampler failed.";
    return false;
  }
  this->Puller.emplace(information, grid);
  this->Writer.emplace("probe.mp4", this->Settings, grid);
  if (!this->Puller->Begin(error))
  {
    return false;
  }
  error = FindFault(this->Settings, this->Puller->GetField());
  if (!error.empty())
  {
    return false;
  }
  this->Writer->Begin(this->Puller->GetField(), 0);
  return true;
}

bool EncodeProbe::Make(const std::vector<int>& groups, GroupCosts& costs, std::string& error)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const std::clock_t begin = std::clock();
  if (!this->Puller->Pull(this->Writer->GetSlices(groups), error))
  {
    return false;
  }
  costs.RenderSeconds += std::chrono::duration<double>(Clock::now() - start).count();
  const std::clock_t middle = std::clock();
  costs.RenderThreadSeconds += static_cast<double>(middle - begin) / CLOCKS_PER_SEC;
  std::vector<GroupParts> parts;
  if (!this->Writer->EncodeGroups(
        groups, this->Puller->GetSlices(), [] {}, parts, error))
  {
    return false;
  }
  costs.CodingThreadSeconds += static_cast<double>(std::clock() - middle) / CLOCKS_PER_SEC;
  for (const GroupParts& group : parts)
  {
    double bytes = 0.0;
    for (const CodedGroup& part : group)
    {
      const bool isCoverage = &part == &group[1];
      this->IsCoveredFully = this->IsCoveredFully && (!isCoverage || part.CoveredFully);
      for (const CodedFrame& frame : part.Frames)
      {
        bytes += static_cast<double>(frame.Data.size());
      }
    }
    costs.Bytes.push_back(bytes);
  }
  return true;
}

double EncodeProbe::GetContainerBytes() const
{
  const double tracks =
    static_cast<double>(this->Writer->GetTrackCount()) - (this->IsCoveredFully ? 1.0 : 0.0);
  return FixedBytes +
    tracks * (TrackBytes + GroupBytes * this->GetGroupCount() + FrameBytes * this->Slices);
}
}
