// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryPlan.h"

#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfParallelFor.h"

#include <vtkPolyData.h>

#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string>

namespace cslf
{
namespace
{
/// Whether a viewpoint is covered everywhere, as where the environment is shown.
bool IsCovered(const ViewpointSamples& samples, std::size_t texels)
{
  const ColorTexels colors(samples);
  for (std::size_t texel = 0; texel < texels; ++texel)
  {
    if (colors.GetCoverage(texel) != 255)
    {
      return false;
    }
  }
  return true;
}

/// Whether a field has nothing but what geometry can tell: colour and depth of one layer.
bool HasOnlyTold(const Description& field)
{
  return std::none_of(ChannelIds.begin(), ChannelIds.end(),
    [&field](ChannelId id)
    {
      return field.FindChannel(id) && id != ChannelId(KnownChannel::Color) &&
        id != ChannelId(KnownChannel::Depth);
    });
}
}

std::vector<FrameId> GetTriedViewpoints(const Layout& grid)
{
  std::vector<FrameId> frames;
  const int middle = grid.GetViewpoints() / 2;
  for (int face = 0; face < FaceCount; ++face)
  {
    frames.push_back(grid.SliceOf({ face, middle, middle }));
  }
  return frames;
}

GeometryPlan::GeometryPlan(
  const std::vector<unsigned char>& bytes, const Description& field, ComputedChannels computed)
{
  std::string ignored;
  const auto geometry =
    bytes.empty() || !computed.HasDepth ? nullptr : DecodeGeometry(bytes, field.Box, ignored);
  // What a geometry of the opaque surfaces lacks is only in the depth.
  if (geometry && !IsOpaqueGeometry(geometry) &&
    static_cast<std::size_t>(geometry->GetNumberOfPolys()) <= GeometryTexels::MaximumTriangles)
  {
    // As readers get it, with positions that are rounded.
    this->Texels.emplace(geometry, field.Box, field.Grid);
    this->Computed = computed;
    this->Computed.HasColor = computed.HasColor && this->Texels->HasColors() &&
      field.FindChannel(KnownChannel::Color)->Type == VTK_UNSIGNED_CHAR;
    this->Computed.IsAll = computed.IsAll && this->Computed.HasColor && HasOnlyTold(field);
    this->Checksum =
      static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
  }
}

GeometryPlan GeometryPlan::Choose(const std::vector<unsigned char>& bytes, const Description& field,
  const std::vector<FrameId>& frames, const std::vector<ViewpointSamples>& samples,
  const Progress& progress)
{
  const std::size_t texels = field.Grid.GetStripTexels();
  ComputedChannels computed;
  computed.HasDepth = field.FindChannel(KnownChannel::Depth) != nullptr;
  computed.HasCoverage = computed.HasDepth &&
    !std::all_of(samples.begin(), samples.end(),
      [texels](const ViewpointSamples& viewpoint) { return IsCovered(viewpoint, texels); });
  computed.HasColor = computed.HasDepth;
  GeometryPlan plan(bytes, field, computed);
  if (!plan.Texels)
  {
    return plan;
  }
  GeometryFit fit;
  const bool isDone = plan.Fit(frames, samples, progress, fit);
  // Where colours change within a texel, its centre says little.
  const double mostError = plan.MayTellAll() ? MaximumExactColorError : MaximumColorError;
  plan.Computed.HasColor =
    plan.Computed.HasColor && fit.Colored > 0 && fit.GetColorError() <= mostError;
  plan.Computed.IsAll = plan.Computed.HasColor && plan.MayTellAll() && HasOnlyTold(field);
  // What is thinner than a texel has no texels that show it, though the geometry has it.
  const double most = plan.TellsAll() ? MaximumUsefulLoss : MaximumLoss;
  plan = isDone && fit.Texels > 0 && fit.GetLoss() <= most ? std::move(plan) : GeometryPlan();
  plan.Tried = fit;
  return plan;
}

bool GeometryPlan::Fit(const std::vector<FrameId>& frames,
  const std::vector<ViewpointSamples>& samples, const Progress& progress, GeometryFit& fit) const
{
  std::mutex mutex;
  return ParallelFor(0, this->Texels ? static_cast<vtkIdType>(frames.size()) : 0, progress,
    [&](vtkIdType begin, vtkIdType end)
    {
      const std::atomic<bool> isStopped{ false };
      const Layout& grid = this->Texels->GetGrid();
      DrawnTexels drawn(grid.GetStripTexels(), this->Computed.HasColor);
      for (vtkIdType k = begin; k < end; ++k)
      {
        this->Texels->Draw(frames[k].Slice, drawn, isStopped);
        const GeometryFit one =
          FitToGeometry(grid.GetResolution(), drawn, this->Computed.HasCoverage, samples[k]);
        const std::lock_guard<std::mutex> lock(mutex);
        fit += one;
      }
    });
}
}
