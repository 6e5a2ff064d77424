// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRoundView.h"

#include "PathTracing/Materials/cslfLobe.h"
#include "RandomNumbers/cslfSampling.h"

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// The smallest share of a round end, and of everything for the side, that counts as visible:
// estimates are exact only far away, and everything visible needs a probability above 0.
constexpr float MinimumPart = 0.05f;

// Steps of Newton's method that bring a ray's hit to the surface, and the cosine to the normal that
// they need: Embree's hits on tubes of 100 radii or more in length are slightly off the surface.
constexpr int NewtonSteps = 2;
constexpr float MinimumNewtonCosine = 0.05f;
}

SphereView::SphereView(const glm::vec3& from, const glm::vec3& center, float radius)
  : Path(center - from)
  , Radius(radius)
  , Distance(glm::length(this->Path))
{
  if (this->Distance > radius)
  {
    const float sine = radius / this->Distance;
    const float sine2 = sine * sine;
    this->CapHeight = sine2 / (1.0f + std::sqrt(std::max(0.0f, 1.0f - sine2)));
  }
}

float SphereView::GetSolidAngle() const
{
  return 2.0f * Pi * this->CapHeight;
}

float SphereView::GetPdf() const
{
  return this->CapHeight > 0.0f ? 1.0f / this->GetSolidAngle() : 0.0f;
}

RoundSample SphereView::Sample(const glm::vec2& u) const
{
  RoundSample sample;
  if (!(this->CapHeight > 0.0f))
  {
    return sample;
  }
  const float height = u.x * this->CapHeight;
  const float sine2 = height * (2.0f - height);
  const float sine = std::sqrt(sine2);
  glm::vec3 local(0.0f, 0.0f, 1.0f - height);
  SinCosOfTurn(u.y, local.y, local.x);
  local.x *= sine;
  local.y *= sine;
  sample.Direction = Frame(this->Path / this->Distance).ToWorld(local);
  const float offAxis = this->Distance * sine;
  const float depth = std::sqrt(std::max(0.0f, this->Radius * this->Radius - offAxis * offAxis));
  sample.Distance = this->Distance * local.z - depth;
  sample.Pdf = sample.Distance > 0.0f ? this->GetPdf() : 0.0f;
  return sample;
}

TubeView::TubeView(const glm::vec3& from, const Tube& tube)
  : From(from)
  , Shape(tube)
  , Ends{ SphereView(from, tube.GetCenter(0.0f), tube.GetRadius(0.0f)),
    SphereView(from, tube.GetCenter(1.0f), tube.GetRadius(1.0f)) }
{
  if (tube.IsSphere())
  {
    this->Shares[0] = 1.0f;
    return;
  }
  if (tube.Contains(from))
  {
    return;
  }
  this->LookAtSide();
  for (int end = 0; end < 2; ++end)
  {
    this->Shares[end] = tube.Joints[end] ? 0.0f : this->EstimateEnd(end);
  }
  this->Shares[2] = this->EstimateSide();
  const float sum = this->Shares[0] + this->Shares[1] + this->Shares[2];
  for (float& share : this->Shares)
  {
    share = sum > 0.0f ? share / sum : 0.0f;
  }
}

void TubeView::LookAtSide()
{
  const Tube& tube = this->Shape;
  const glm::vec3 path = this->From - tube.Start;
  const float height = glm::dot(path, tube.Axis);
  const glm::vec3 across = path - height * tube.Axis;
  this->AxisDistance = glm::length(across);
  this->Towards = this->AxisDistance > 0.0f ? across / this->AxisDistance : Frame(tube.Axis).X;
  this->CosSlant = std::sqrt(1.0f - tube.Slope * tube.Slope);

  // The point sees an azimuth if it is above the tangent plane there.
  const float reach = this->CosSlant * this->AxisDistance;
  const float least = tube.Radius + tube.Slope * height;
  this->LineHeight = reach - least;
  if (!(this->LineHeight > 0.0f))
  {
    return;
  }
  this->Azimuth = reach > -least ? std::acos(std::clamp(least / reach, -1.0f, 1.0f)) : Pi;
  const glm::vec3 normal = this->CosSlant * this->Towards - tube.Slope * tube.Axis;
  const glm::vec3 line = this->CosSlant * tube.Axis + tube.Slope * this->Towards;
  const float length = this->CosSlant * tube.Length;
  this->LinePlace = glm::dot(path - tube.Radius * normal, line);
  this->LineAngle = std::atan2(length * this->LineHeight,
    this->LineHeight * this->LineHeight - this->LinePlace * (length - this->LinePlace));
}

/// The approximate solid angle of an end's part of its sphere.
float TubeView::EstimateEnd(int end) const
{
  const Tube& tube = this->Shape;
  const glm::vec3 path = this->From - tube.GetCenter(static_cast<float>(end));
  const float outwards = end == 0 ? -1.0f : 1.0f;
  const float cosine = glm::dot(path, tube.Axis) / glm::length(path);
  const float part = 0.5f * (1.0f + outwards * (cosine + tube.Slope));
  return std::clamp(part, MinimumPart, 1.0f) * this->Ends[end].GetSolidAngle();
}

/// The approximate solid angle of the side, exact for an infinite cylinder.
float TubeView::EstimateSide() const
{
  const float length = this->CosSlant * this->Shape.Length;
  if (!(this->Azimuth > 0.0f) || !(this->LineAngle > 0.0f))
  {
    return 0.0f;
  }
  const float nearest = std::clamp(this->LinePlace / length, 0.0f, 1.0f);
  const float radius = this->CosSlant * this->Shape.GetRadius(nearest);
  const float width =
    2.0f * std::asin(std::clamp(radius / std::max(this->AxisDistance, 1e-30f), 0.0f, 1.0f));
  const auto sine = [this](float place)
  { return place / std::sqrt(place * place + this->LineHeight * this->LineHeight); };
  const float extent = sine(length - this->LinePlace) - sine(-this->LinePlace);
  return std::max(width * extent, MinimumPart * (this->Shares[0] + this->Shares[1]));
}

RoundSample TubeView::Sample(const glm::vec2& u) const
{
  float x = u.x;
  for (int part = 0; part < 3; ++part)
  {
    const float share = this->Shares[part];
    if (x < share)
    {
      const glm::vec2 rest(std::min(x / share, BelowOne), u.y);
      return part < 2 ? this->SampleEnd(part, rest) : this->SampleSide(rest);
    }
    x -= share;
  }
  return {}; // within the tube, or lost to rounding
}

RoundSample TubeView::SampleEnd(int end, const glm::vec2& u) const
{
  RoundSample sample = this->Ends[end].Sample(u);
  const glm::vec3 point = this->From + sample.Distance * sample.Direction;
  const Tube& tube = this->Shape;
  sample.Along = tube.IsSphere() ? tube.OnlyEnd : static_cast<float>(end);
  if (!tube.IsSphere())
  {
    const float along = glm::dot(point - tube.GetCenter(static_cast<float>(end)), tube.Axis) /
        tube.GetRadius(static_cast<float>(end)) +
      tube.Slope;
    sample.Pdf = (end == 0 ? along <= 0.0f : along >= 0.0f) ? sample.Pdf : 0.0f;
  }
  sample.Pdf *= this->Shares[end];
  return sample;
}

RoundSample TubeView::SampleSide(const glm::vec2& u) const
{
  const Tube& tube = this->Shape;
  const float angle = u.x * this->LineAngle;
  const float sine = std::sin(angle);
  const float length = this->CosSlant * tube.Length;
  const float place = sine *
    (this->LinePlace * this->LinePlace + this->LineHeight * this->LineHeight) /
    (this->LineHeight * std::cos(angle) + this->LinePlace * sine);
  RoundSample sample;
  sample.Along = std::clamp(place / length, 0.0f, 1.0f);
  const float azimuth = this->Azimuth * (2.0f * u.y - 1.0f);
  const glm::vec3 across = glm::cross(tube.Axis, this->Towards);
  const glm::vec3 normal =
    this->CosSlant * (std::cos(azimuth) * this->Towards + std::sin(azimuth) * across) -
    tube.Slope * tube.Axis;
  const glm::vec3 path =
    tube.GetCenter(sample.Along) + tube.GetRadius(sample.Along) * normal - this->From;
  sample.Distance = glm::length(path);
  sample.Direction = path / sample.Distance;
  sample.Pdf = this->GetSidePdf(sample.Along, normal, path);
  return sample;
}

float TubeView::GetSidePdf(float along, const glm::vec3& normal, const glm::vec3& path) const
{
  const float area = -glm::dot(normal, path); // of a unit of surface, times the distance
  if (!(area > 0.0f) || !(this->LineAngle > 0.0f) || !(this->Azimuth > 0.0f))
  {
    return 0.0f;
  }
  const float length = this->CosSlant * this->Shape.Length;
  const float place = along * length - this->LinePlace;
  const float perLength =
    this->LineHeight / (this->LineAngle * (this->LineHeight * this->LineHeight + place * place));
  const float circle = this->CosSlant * this->Shape.GetRadius(along);
  const float distance2 = glm::dot(path, path);
  return this->Shares[2] * perLength / (2.0f * this->Azimuth * circle) * distance2 *
    std::sqrt(distance2) / area;
}

float TubeView::GetPdf(const glm::vec3& direction, float distance) const
{
  const Tube& tube = this->Shape;
  glm::vec3 path = distance * direction;
  for (int step = 0;; ++step)
  {
    const glm::vec3 point = this->From + path;
    const float along = tube.FindAlong(point);
    if (tube.IsSphere() || tube.IsOnEnd(along))
    {
      const int end = !tube.IsSphere() && along >= 1.0f ? 1 : 0;
      return this->Shares[end] * this->Ends[end].GetPdf();
    }
    const glm::vec3 fromAxis = point - tube.GetCenter(along);
    const float length = glm::length(fromAxis);
    const glm::vec3 normal = fromAxis / length;
    const float cosine = -glm::dot(normal, direction);
    if (step == NewtonSteps || cosine < MinimumNewtonCosine)
    {
      return this->GetSidePdf(along, normal, path);
    }
    path += (length - tube.GetRadius(along)) / cosine * direction;
  }
}
}
