// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Decides where LatticeBuilder adds points.
#include "cslfLatticeBuilder.h"

#include "cslfLatticePatch.h"
#include "cslfSampleNoise.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// The largest width of the interpolation between white and black, in spacings. It is half as large
// for twice the brightness, and so on.
constexpr double BrightEdge = 2.0;

// Points at most this far apart, in spacings, are close enough: half of that would be closer than
// requested.
constexpr float CoarseSpacings = 1.5f;

// The number of standard errors by which a difference must exceed the known error to be no noise.
constexpr float SureErrors = 3.0f;

float Largest(const glm::vec3& difference)
{
  const glm::vec3 size = glm::abs(difference);
  return std::max({ size.x, size.y, size.z });
}
}

float LatticeBuilder::GetDistance(const Patch& patch) const
{
  return patch.RootEdge / static_cast<float>(1 << (patch.RootSize - patch.Size + patch.Level));
}

bool LatticeBuilder::NeedsMore(const Patch& patch) const
{
  if (patch.Level == 0)
  {
    return this->VariesWithin(patch);
  }
  // The points that the last level added lie in the middle of edges of the level before.
  const int splits = 1 << patch.Level;
  for (int j = 0; j <= splits; ++j)
  {
    for (int i = 0; i <= splits - j; ++i)
    {
      const bool isMissed = i % 2 == 1 ? this->IsMissed(patch, i, j, 1, j % 2 == 1 ? -1 : 0)
                                       : j % 2 == 1 && this->IsMissed(patch, i, j, 0, 1);
      if (isMissed)
      {
        return true;
      }
    }
  }
  return false;
}

const HalfEstimate& LatticeBuilder::GetPilot(const Patch& patch, std::uint32_t point) const
{
  return this->Points[point].Estimate.Halves[patch.Half];
}

bool LatticeBuilder::IsMissed(const Patch& patch, int i, int j, int sideI, int sideJ) const
{
  const std::uint32_t point = patch.GetPoint(i, j);
  const HalfEstimate& here = this->GetPilot(patch, point);
  const HalfEstimate& before = this->GetPilot(patch, patch.GetPoint(i - sideI, j - sideJ));
  const HalfEstimate& after = this->GetPilot(patch, patch.GetPoint(i + sideI, j + sideJ));
  const glm::vec3 interpolated = 0.5f * (before.Pilot + after.Pilot);
  const glm::vec3 variance = here.Variance + 0.25f * (before.Variance + after.Variance);
  // Areas brighter than white light other places, even if they are narrow.
  const float distance = this->GetDistance(patch);
  if (this->IsBright(here.Pilot - interpolated, variance, distance))
  {
    return true;
  }
  if (!this->IsCoarse(distance))
  {
    return false;
  }
  const glm::vec3 color = this->World.GetBaseColor(this->Points[point].Place);
  const glm::vec3 seen = this->Settings.Display(interpolated, color);
  const float error = Largest(this->Settings.Display(here.Pilot, color) - seen);
  if (error <= this->Settings.Tolerance)
  {
    return false;
  }
  const float noise = GetDisplayedError(
    this->Settings.Display, interpolated, SureErrors * glm::sqrt(variance), color);
  return error > this->Settings.Tolerance + noise;
}

bool LatticeBuilder::VariesWithin(const Patch& patch) const
{
  const HalfEstimate& first = this->GetPilot(patch, patch.Points[0]);
  const glm::vec3 color = this->World.GetBaseColor(this->Points[patch.Points[0]].Place);
  const glm::vec3 seen = this->Settings.Display(first.Pilot, color);
  const float size = this->GetDistance(patch);
  const bool isCoarse = this->IsCoarse(size);
  return std::any_of(patch.Points.begin(), patch.Points.end(),
    [&](std::uint32_t index)
    {
      const HalfEstimate& pilot = this->GetPilot(patch, index);
      const bool varies = pilot.Reach < size ||
        Largest(this->Settings.Display(pilot.Pilot, color) - seen) > this->Settings.Tolerance;
      return (isCoarse && varies) ||
        this->IsBright(pilot.Pilot - first.Pilot, pilot.Variance + first.Variance, size);
    });
}

bool LatticeBuilder::IsCoarse(float distance) const
{
  return distance > CoarseSpacings * this->Layout.GetSpacing() && !this->Settings.OnlyBright;
}

bool LatticeBuilder::IsBright(
  const glm::vec3& error, const glm::vec3& variance, float distance) const
{
  const glm::vec3 sure = glm::abs(error) - SureErrors * glm::sqrt(variance);
  const double radiance = this->Settings.Exposure * std::max({ sure.x, sure.y, sure.z, 0.0f });
  return radiance * distance > BrightEdge * this->Layout.GetSpacing();
}
}
