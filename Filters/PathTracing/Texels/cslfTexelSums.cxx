// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelSums.h"

#include "SIMD/cslfVectorize.h"

#include <algorithm>
#include <limits>

namespace cslf
{
namespace
{
/// Marks hits that are nearer to their texels' centres than all before.
CSLF_VECTORIZE void FindNearest(const PacketHits& hits, float* offsets, int* nearest)
{
  alignas(64) float squares[TexelSums::Size]; // the largest values if nothing is hit
  CSLF_LANE_LOOP
  for (int lane = 0; lane < TexelSums::Size; ++lane)
  {
    const float offsetX = hits.Places.X[lane] - 0.5f;
    const float offsetY = hits.Places.Y[lane] - 0.5f;
    const int isHit = static_cast<int>(hits.Rays.Query.hit.geomID[lane]) == -1 ? 0 : -1;
    const float square = offsetX * offsetX + offsetY * offsetY;
    squares[lane] = isHit ? square : std::numeric_limits<float>::max();
  }
  for (int first = 0; first < TexelSums::Size; first += hits.Group.Size)
  {
    CSLF_LANE_LOOP
    for (int i = 0; i < hits.Group.Size; ++i)
    {
      float& offset = offsets[hits.Group.First + i];
      nearest[first + i] = squares[first + i] < offset ? -1 : 0;
      offset = squares[first + i] < offset ? squares[first + i] : offset;
    }
  }
}

CSLF_VECTORIZE void AddCovered(float* sums, const TexelGroup& group, const int* covered)
{
  alignas(64) float counts[TexelSums::Size];
  for (int lane = 0; lane < TexelSums::Size; ++lane)
  {
    counts[lane] = static_cast<float>(-covered[lane]);
  }
  ChannelSum::AddTo(sums, group, counts);
}

CSLF_VECTORIZE void AddSquare(
  float* sums, const TexelGroup& group, const float* values, const int* own)
{
  alignas(64) float squares[TexelSums::Size];
  for (int lane = 0; lane < TexelSums::Size; ++lane)
  {
    squares[lane] = own[lane] ? values[lane] * values[lane] : 0.0f;
  }
  ChannelSum::AddTo(sums, group, squares);
}

template <typename... Sums>
std::vector<KnownChannel> ListChannelsOf(const std::tuple<Sums...>*)
{
  return { Sums::Id... };
}
}

std::vector<KnownChannel> TexelSums::ListChannels()
{
  return ListChannelsOf(static_cast<const ChannelList*>(nullptr));
}

TexelSums::TexelSums(const ViewpointSamples& output)
  : Output(&output)
{
  std::fill_n(this->NearestOffset, TexelSums::Size, std::numeric_limits<float>::max());
}

template <typename Self, typename Function>
void TexelSums::ForEach(Self& self, Function function)
{
  std::apply([&](auto&... sums)
    { ((self.Output->GetArray(sums.Id) ? function(sums) : void()), ...); },
    self.Channels);
}

bool TexelSums::NeedsNearest() const
{
  bool needs = false;
  ForEach(*this, [&needs](const auto& sum) { needs |= sum.NeedsNearest; });
  return needs;
}

void TexelSums::KeepNearest(const PacketHits& hits)
{
  alignas(64) int nearest[TexelSums::Size];
  FindNearest(hits, this->NearestOffset, nearest);
  ForEach(*this, [&](auto& sum) { sum.KeepNearest(hits, nearest); });
}

CSLF_VECTORIZE void TexelSums::Add(const PacketSamples& samples)
{
  AddCovered(this->Covered, samples.First.Group, samples.Covered);
  ForEach(*this, [&samples](auto& sum) { sum.Add(samples); });
}

void TexelSums::AddPath(int texel, const PathBatch& batch, int path, bool isOwn)
{
  const glm::vec3& radiance = batch.GetRadiance(path);
  if (isOwn)
  {
    this->Squares.Red[texel] += radiance.x * radiance.x;
    this->Squares.Green[texel] += radiance.y * radiance.y;
    this->Squares.Blue[texel] += radiance.z * radiance.z;
    ++this->Paths[texel];
  }
  const float coverage = batch.GetCoverage(path);
  this->Covered[texel] += coverage;
  this->Partial[texel] += coverage * (1.0f - coverage);
  ForEach(*this, [&](auto& sum) { sum.AddPath(texel, batch, path, isOwn); });
}

void TexelSums::AddSquares(const PacketSamples& samples)
{
  const TexelGroup& group = samples.First.Group;
  AddSquare(this->Squares.Red, group, samples.Radiance.Red, samples.Own);
  AddSquare(this->Squares.Green, group, samples.Radiance.Green, samples.Own);
  AddSquare(this->Squares.Blue, group, samples.Radiance.Blue, samples.Own);
}

ColorSamples TexelSums::GetColorSamples(int texel) const
{
  const auto& color = std::get<ColorSum>(this->Channels);
  const int others = color.GetOtherCount(texel);
  const PacketRadiance& sum = color.GetOwn();
  return { others == 0 ? this->Samples : static_cast<int>(this->Covered[texel]) - others,
    { sum.Red[texel], sum.Green[texel], sum.Blue[texel] },
    { this->Squares.Red[texel], this->Squares.Green[texel], this->Squares.Blue[texel] } };
}

CSLF_VECTORIZE void TexelSums::Take(const int texels[TexelSums::Size])
{
  alignas(64) int taking[TexelSums::Size];
  for (int texel = 0; texel < TexelSums::Size; ++texel)
  {
    taking[texel] = this->TakenSamples[texel] == 0 ? texels[texel] : 0;
    this->TakenSamples[texel] = taking[texel] ? this->Samples : this->TakenSamples[texel];
    this->TakenCovered[texel] = taking[texel] ? this->Covered[texel] : this->TakenCovered[texel];
    this->TakenCount -= taking[texel];
  }
  ForEach(*this, [&taking](auto& sum) { sum.Take(taking); });
}

void TexelSums::TakeAll()
{
  int all[TexelSums::Size];
  std::fill_n(all, TexelSums::Size, -1);
  this->Take(all);
}

void TexelSums::Write(double exposure, const int inside[TexelSums::Size],
  const std::int64_t indices[TexelSums::Size]) const
{
  WrittenTexels texels;
  texels.Exposure = exposure;
  for (int texel = 0; texel < TexelSums::Size; ++texel)
  {
    if (inside[texel])
    {
      texels.Texels[texels.Count++] = { texel, indices[texel], this->TakenSamples[texel],
        this->TakenCovered[texel] };
    }
  }
  ForEach(*this, [&](const auto& sum) { sum.Write(texels, *this->Output); });
}
}
