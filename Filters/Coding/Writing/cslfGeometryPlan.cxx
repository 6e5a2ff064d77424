// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryPlan.h"

#include "Coding/Frames/cslfFrameOrder.h"
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfParallelFor.h"

#include <vtkPolyData.h>

#include <zlib.h>

#include <algorithm>
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

std::vector<ViewpointSamples> Copy(
  const Description& field, const std::vector<ViewpointSamples>& samples)
{
  const std::size_t texels = field.Grid.GetStripTexels();
  const ViewpointSamples all = MakeSamples(field, static_cast<vtkIdType>(texels * samples.size()));
  std::vector<ViewpointSamples> copies;
  for (const ViewpointSamples& viewpoint : samples)
  {
    copies.push_back(all.At(static_cast<vtkIdType>(texels * copies.size())));
    viewpoint.CopyTo(copies.back(), texels);
  }
  return copies;
}
}

std::vector<int> GetFirstGroup(const Layout& grid, int groupLength)
{
  FrameOrder order = MakeFrameOrder(grid, groupLength);
  order.Slices.resize(order.Groups.front());
  return order.Slices;
}

GeometryPlan::GeometryPlan(
  const std::vector<unsigned char>& bytes, const Description& field, ComputedChannels computed)
{
  std::string ignored;
  const auto geometry =
    bytes.empty() || !computed.HasDepth ? nullptr : DecodeGeometry(bytes, field.Box, ignored);
  if (geometry)
  {
    // As readers get it, with positions that are rounded.
    this->Depths.emplace(geometry, field.Box, field.Grid);
    this->Computed = computed;
    this->Checksum =
      static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
  }
}

GeometryPlan GeometryPlan::Choose(const std::vector<unsigned char>& bytes, const Description& field,
  const std::vector<int>& slices, const std::vector<ViewpointSamples>& samples)
{
  const std::size_t texels = field.Grid.GetStripTexels();
  ComputedChannels computed;
  computed.HasDepth = field.FindChannel(KnownChannel::Depth) != nullptr;
  computed.HasCoverage = computed.HasDepth &&
    !std::all_of(samples.begin(), samples.end(),
      [texels](const ViewpointSamples& viewpoint) { return IsCovered(viewpoint, texels); });
  GeometryPlan plan(bytes, field, computed);
  if (!plan.Depths)
  {
    return plan;
  }
  const std::vector<ViewpointSamples> fitted = Copy(field, samples);
  const double loss = plan.Fit(slices, fitted).GetLoss();
  plan = loss <= MostLoss ? std::move(plan) : GeometryPlan();
  plan.Loss = loss;
  for (std::size_t k = 0; plan.Depths && k < samples.size(); ++k)
  {
    fitted[k].CopyTo(samples[k], texels);
  }
  return plan;
}

GeometryFit GeometryPlan::Fit(
  const std::vector<int>& slices, const std::vector<ViewpointSamples>& samples) const
{
  GeometryFit fit;
  std::mutex mutex;
  ParallelFor(0, this->Depths ? static_cast<vtkIdType>(slices.size()) : 0, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<unsigned short> depths;
      for (vtkIdType k = begin; k < end; ++k)
      {
        this->Depths->Draw(slices[k], depths);
        const GeometryFit one = FitToGeometry(
          this->Depths->GetGrid().GetResolution(), depths, this->Computed.HasCoverage, samples[k]);
        const std::lock_guard<std::mutex> lock(mutex);
        fit += one;
      }
    });
  return fit;
}
}
