// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLightTree.h"

#include "SIMD/cslfVectorize.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cslf
{
namespace
{
// The bins of an axis, between which lights can be split.
constexpr int BinCount = 16;

// The most lights that may share a leaf, and the largest cost of a useful split, relative to that
// of a leaf.
constexpr std::size_t MaximumInLeaf = 4;
constexpr double MinimumSplitGain = 0.8;

// The least squared distance that counts, in scene space.
constexpr float MinimumDistance2 = 1e-12f;

// How far below the horizon rounding may move a light that lies on it, in scene space.
constexpr float HorizonSlack = 1e-6f;

// The smallest cosine that is used for a surface's light.
constexpr float MinimumCosine = 1e-4f;

// The smallest power of a light, relative to that of all.
constexpr double MinimumPower = 1e-30;

/// The measure of a group that its split should minimise.
double GetCost(const LightBounds& bounds)
{
  if (bounds.IsEmpty())
  {
    return 0.0;
  }
  // Unlike the area, the diagonal also separates lights that lie on a line.
  const glm::vec3 diagonal = bounds.Upper - bounds.Lower;
  return bounds.Power * MeasureDirections(bounds) * glm::dot(diagonal, diagonal);
}

/// The bins of one axis.
struct Binning
{
  int Axis;
  float Lower;
  float Scale;

  int GetBin(const LightBounds& bounds) const
  {
    const float place = (bounds.GetCenter()[this->Axis] - this->Lower) * this->Scale;
    return std::clamp(static_cast<int>(place), 0, BinCount - 1);
  }
};

/// The cost of the best split of bins, and the first bin of its second part.
double FindBestSplit(const std::array<LightBounds, BinCount>& bins, int& split)
{
  std::array<double, BinCount> upper{};
  LightBounds sum;
  for (int i = BinCount - 1; i > 0; --i)
  {
    sum = Join(sum, bins[i]);
    upper[i] = sum.IsEmpty() ? std::numeric_limits<double>::infinity() : GetCost(sum);
  }
  double best = std::numeric_limits<double>::infinity();
  sum = LightBounds();
  for (int i = 1; i < BinCount; ++i)
  {
    sum = Join(sum, bins[i - 1]);
    const double cost = sum.IsEmpty() ? best : GetCost(sum) + upper[i];
    if (cost < best)
    {
      best = cost;
      split = i;
    }
  }
  return best;
}
}

LightTree::LightTree(const std::vector<LightBounds>& lights)
  : Lights(lights.size())
  , Leaves(lights.size())
{
  std::vector<Item> items;
  items.reserve(lights.size());
  for (const LightBounds& light : lights)
  {
    items.push_back({ light, static_cast<std::uint32_t>(items.size()) });
    this->TotalPower += light.Power;
  }
  if (!items.empty())
  {
    this->Nodes.emplace_back();
    this->Nodes[0].Parent = 0;
    this->Nodes[0].ParentPart = 0;
    this->Build(items, MakeRange(items, 0, items.size()), 0);
  }
}

LightTree::Range LightTree::MakeRange(
  const std::vector<Item>& items, std::size_t begin, std::size_t end)
{
  Range range{ begin, end, {} };
  for (std::size_t i = begin; i < end; ++i)
  {
    range.Bounds = Join(range.Bounds, items[i].Bounds);
  }
  return range;
}

void LightTree::Build(std::vector<Item>& items, const Range& range, std::uint32_t node)
{
  const std::vector<Range> parts = Divide(items, range);
  this->Nodes[node].PartCount = static_cast<int>(parts.size());
  for (int part = 0; part < Width; ++part)
  {
    const bool isUsed = part < this->Nodes[node].PartCount;
    this->Nodes[node].Set(part, isUsed ? parts[part].Bounds : LightBounds(), this->TotalPower);
    if (isUsed && !parts[part].CanSplit)
    {
      this->MakeLeaf(items, parts[part], node, part);
    }
    else if (isUsed)
    {
      const auto next = static_cast<std::uint32_t>(this->Nodes.size());
      this->Nodes[node].Next[part] = next;
      this->Nodes[node].Count[part] = 0;
      this->Nodes.emplace_back();
      this->Nodes[next].Parent = node;
      this->Nodes[next].ParentPart = part;
      this->Build(items, parts[part], next);
    }
  }
}

void LightTree::MakeLeaf(
  const std::vector<Item>& items, const Range& range, std::uint32_t node, int part)
{
  this->Nodes[node].Next[part] = static_cast<std::uint32_t>(range.Begin);
  this->Nodes[node].Count[part] = static_cast<std::uint32_t>(range.End - range.Begin);
  for (std::size_t i = range.Begin; i < range.End; ++i)
  {
    const auto share =
      static_cast<float>(std::max(items[i].Bounds.Power / range.Bounds.Power, MinimumPower));
    this->Lights[i] = { items[i].Light, share };
    this->Leaves[items[i].Light] = { Width * node + static_cast<std::uint32_t>(part), share };
  }
}

/// Splits a range, then the costliest of its parts, until there are as many as a group can have.
std::vector<LightTree::Range> LightTree::Divide(std::vector<Item>& items, const Range& range)
{
  std::vector<Range> parts{ range };
  while (parts.size() < Width)
  {
    auto largest = parts.end();
    for (auto part = parts.begin(); part != parts.end(); ++part)
    {
      const bool isLarger =
        largest == parts.end() || GetCost(part->Bounds) > GetCost(largest->Bounds);
      largest = part->CanSplit && isLarger ? part : largest;
    }
    if (largest == parts.end())
    {
      break;
    }
    const Range whole = *largest;
    const std::size_t middle = Split(items, whole);
    if (middle == whole.End)
    {
      largest->CanSplit = false;
      continue;
    }
    *largest = MakeRange(items, whole.Begin, middle);
    parts.insert(largest + 1, MakeRange(items, middle, whole.End));
  }
  for (Range& part : parts)
  {
    part.CanSplit = part.CanSplit && Split(items, part) != part.End;
  }
  return parts;
}

/// Sorts lights into two parts, and returns where the second begins. Returns the end if it is best
/// not to split them.
std::size_t LightTree::Split(std::vector<Item>& items, const Range& range)
{
  const std::size_t begin = range.Begin;
  const std::size_t end = range.End;
  if (end - begin == 1)
  {
    return end;
  }
  glm::vec3 lower(std::numeric_limits<float>::max());
  glm::vec3 upper(std::numeric_limits<float>::lowest());
  for (std::size_t i = begin; i < end; ++i)
  {
    lower = glm::min(lower, items[i].Bounds.GetCenter());
    upper = glm::max(upper, items[i].Bounds.GetCenter());
  }
  const glm::vec3 extent = upper - lower;
  const float longest = std::max({ extent.x, extent.y, extent.z });
  double best = std::numeric_limits<double>::infinity();
  Binning bestBins{ 0, 0.0f, 0.0f };
  int bestSplit = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Binning binning{ axis, lower[axis], static_cast<float>(BinCount) / extent[axis] };
    if (!std::isfinite(binning.Scale))
    {
      continue;
    }
    std::array<LightBounds, BinCount> bins;
    for (std::size_t i = begin; i < end; ++i)
    {
      LightBounds& bin = bins[binning.GetBin(items[i].Bounds)];
      bin = Join(bin, items[i].Bounds);
    }
    // Splits across a short side would leave elongated groups.
    int split = 0;
    const double cost = double(longest / extent[axis]) * FindBestSplit(bins, split);
    if (cost < best)
    {
      best = cost;
      bestBins = binning;
      bestSplit = split;
    }
  }
  if (end - begin <= MaximumInLeaf && best >= MinimumSplitGain * GetCost(range.Bounds))
  {
    return end;
  }
  const auto first = items.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = items.begin() + static_cast<std::ptrdiff_t>(end);
  const auto middle = bestSplit == 0
    ? first
    : std::stable_partition(
        first, last, [&](const Item& item) { return bestBins.GetBin(item.Bounds) < bestSplit; });
  // Lights at the same place are split in their order.
  return middle == first || middle == last ? begin + (end - begin) / 2
                                           : static_cast<std::size_t>(middle - items.begin());
}

void LightTree::Vec3Parts::Set(int part, const glm::vec3& value)
{
  this->X[part] = value.x;
  this->Y[part] = value.y;
  this->Z[part] = value.z;
}

void LightTree::Node::Set(int part, const LightBounds& bounds, double totalPower)
{
  const bool isEmpty = bounds.IsEmpty();
  const glm::vec3 half = 0.5f * (bounds.Upper - bounds.Lower);
  const bool isCone = bounds.Kind != LightBounds::Kinds::AllAround;
  this->Center.Set(part, isEmpty ? glm::vec3(0.0f) : bounds.GetCenter());
  this->HalfSize.Set(part, isEmpty ? glm::vec3(0.0f) : half);
  this->Radius[part] = isEmpty ? 0.0f : glm::length(half);
  this->Power[part] =
    isEmpty ? 0.0f : static_cast<float>(std::max(bounds.Power / totalPower, MinimumPower));
  this->Axis.Set(part, bounds.Axis);
  this->CosCone[part] = isCone ? static_cast<float>(std::cos(bounds.Angle)) : -2.0f;
  this->SinCone[part] = isCone ? static_cast<float>(std::sin(bounds.Angle)) : 0.0f;
  const bool isSurface = bounds.Kind == LightBounds::Kinds::Surfaces;
  this->TwoSided[part] = isSurface ? 1.0f : 0.0f;
  this->Beyond[part] = isSurface ? 1.0f : 0.0f;
  this->HasCones = this->HasCones || isCone;
  this->Next[part] = 0;
  this->Count[part] = 0;
}

double LightTree::Node::FindImportances(
  const LightReceiver& receiver, Parts<float>& importances) const
{
  const glm::vec3 position = receiver.Position;
  const glm::vec3 normal = receiver.Normal;
  const glm::vec3 sides = glm::abs(normal);
  const float least = normal != glm::vec3(0.0f) ? 0.0f : 1.0f; // without a horizon
  CSLF_LANE_LOOP
  for (int i = 0; i < Width; ++i)
  {
    const float x = this->Center.X[i] - position.x;
    const float y = this->Center.Y[i] - position.y;
    const float z = this->Center.Z[i] - position.z;
    const float radius2 = this->Radius[i] * this->Radius[i];
    const float distance2 = std::max(std::max(x * x + y * y + z * z, radius2), MinimumDistance2);
    // How far above the receiver's horizon the lights reach.
    const float height = x * normal.x + y * normal.y + z * normal.z +
      this->HalfSize.X[i] * sides.x + this->HalfSize.Y[i] * sides.y +
      this->HalfSize.Z[i] * sides.z + HorizonSlack;
    const float above = std::max(height, 0.0f) / std::sqrt(distance2);
    const float horizon = std::max(std::min(above, 1.0f), least);
    importances[i] = this->Power[i] / distance2 * horizon;
  }
  if (this->HasCones)
  {
    this->ThinByCones(position, importances);
  }
  return double(importances[0]) + importances[1] + importances[2] + importances[3];
}

/// Multiplies importances by the largest share of their light that lights send towards a point.
void LightTree::Node::ThinByCones(const glm::vec3& position, Parts<float>& importances) const
{
  CSLF_LANE_LOOP
  for (int i = 0; i < Width; ++i)
  {
    const float x = position.x - this->Center.X[i];
    const float y = position.y - this->Center.Y[i];
    const float z = position.z - this->Center.Z[i];
    const float distance2 = x * x + y * y + z * z;
    const float radius = this->Radius[i];
    const float inverse = 1.0f / std::sqrt(std::max(distance2, MinimumDistance2));
    // How far the point is beyond the edge of the cone, as seen from the centre ...
    const float towards =
      (x * this->Axis.X[i] + y * this->Axis.Y[i] + z * this->Axis.Z[i]) * inverse;
    const float either = this->TwoSided[i] != 0.0f ? std::abs(towards) : towards;
    const float cosine = std::min(either, 1.0f);
    const float sine = std::sqrt(std::max(1.0f - cosine * cosine, 0.0f));
    const float cosBeyond = cosine * this->CosCone[i] + sine * this->SinCone[i];
    const float sinBeyond = sine * this->CosCone[i] - cosine * this->SinCone[i];
    // ... and from the place in the bounding sphere where this is smallest.
    const float sinSphere = std::min(radius * inverse, 1.0f);
    const float cosSphere = std::sqrt(1.0f - sinSphere * sinSphere);
    const float outside =
      this->Beyond[i] * std::max(cosBeyond * cosSphere + sinBeyond * sinSphere, MinimumCosine);
    const float beyond = cosine >= this->CosCone[i] ? 1.0f : outside;
    const float far = cosBeyond >= cosSphere ? 1.0f : beyond;
    importances[i] *= distance2 <= radius * radius ? 1.0f : far;
  }
}

LightTree::Choice LightTree::Sample(const LightReceiver& receiver, double u) const
{
  Choice choice;
  double probability = 1.0;
  const Node* node = this->Nodes.data();
  int part = 0;
  for (;;)
  {
    part = 0;
    if (node->PartCount > 1)
    {
      Parts<float> importances;
      const double sum = node->FindImportances(receiver, importances);
      if (!(sum > 0.0))
      {
        return choice;
      }
      u *= sum;
      int last = 0; // with a probability above 0
      for (; part < node->PartCount && u >= importances[part]; ++part)
      {
        u -= importances[part];
        last = importances[part] > 0.0f ? part : last;
      }
      if (part == node->PartCount)
      {
        part = last;
        u = importances[part];
      }
      u = std::min(u / importances[part], 1.0);
      probability *= importances[part] / sum;
    }
    if (node->Count[part] > 0)
    {
      break;
    }
    node = &this->Nodes[node->Next[part]];
  }
  const Entry* light = &this->Lights[node->Next[part]];
  const Entry* last = light + node->Count[part] - 1;
  for (; light != last && u >= light->Share; ++light)
  {
    u -= light->Share;
  }
  choice.Light = light->Index;
  choice.Probability = probability * light->Share;
  choice.Remainder = std::min(u / light->Share, 1.0);
  return choice;
}

double LightTree::GetProbability(const LightReceiver& receiver, std::uint32_t light) const
{
  double probability = this->Leaves[light].Share;
  auto part = static_cast<int>(this->Leaves[light].Index % Width);
  const Node* node = &this->Nodes[this->Leaves[light].Index / Width];
  for (;;)
  {
    if (node->PartCount > 1)
    {
      Parts<float> importances;
      const double sum = node->FindImportances(receiver, importances);
      if (!(importances[part] > 0.0f))
      {
        return 0.0;
      }
      probability *= importances[part] / sum;
    }
    if (node == this->Nodes.data())
    {
      return probability;
    }
    part = node->ParentPart;
    node = &this->Nodes[node->Parent];
  }
}
}
