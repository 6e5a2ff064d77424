// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfIncidentLight.h"

#include "PathTracing/Materials/cslfGGX.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// The number of samples for one part of the hemisphere.
constexpr int CellSize = 16;

// Zernike polynomials of the unit disc, on which cosine-distributed directions are uniform: the
// mean of the product of any two is 0, that of a square is 1. Noll, JOSA 66(3), 1976.
const float Root3 = std::sqrt(3.0f);
const float Root6 = std::sqrt(6.0f);

std::array<float, 6> EvaluateZernike(const glm::vec2& place)
{
  const float x2 = place.x * place.x;
  const float y2 = place.y * place.y;
  return { 1.0f, 2.0f * place.x, 2.0f * place.y, 2.0f * Root6 * place.x * place.y,
    Root6 * (x2 - y2), Root3 * (2.0f * (x2 + y2) - 1.0f) };
}

/// The moments of one direction.
DirectionMoments GetProducts(const glm::vec3& d)
{
  return { 1.0f, d.x, d.y, d.z, d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z };
}

/// Adds a factor of (a . d)(b . d), of a direction d.
void AddProduct(
  IncidentLight& light, const glm::vec3& a, const glm::vec3& b, const glm::vec3& factor)
{
  light.Terms[4] += a.x * b.x * factor;
  light.Terms[5] += a.y * b.y * factor;
  light.Terms[6] += a.z * b.z * factor;
  light.Terms[7] += (a.x * b.y + a.y * b.x) * factor;
  light.Terms[8] += (a.x * b.z + a.z * b.x) * factor;
  light.Terms[9] += (a.y * b.z + a.z * b.y) * factor;
}

float Largest(const glm::vec3& value)
{
  return std::max({ value.x, value.y, value.z });
}
}

GlossyLobe::GlossyLobe(const SurfaceMaterial& material)
{
  for (int i = 0; i <= Steps; ++i)
  {
    this->Rows.push_back(MakeRow(material, std::max(1e-3f, static_cast<float>(i) / Steps)));
  }
  const Row& upright = this->Rows.back();
  this->Size = upright.XX + upright.YY;
}

GlossyLobe::Row GlossyLobe::MakeRow(const SurfaceMaterial& material, float cosine)
{
  Row row;
  float total = 0.0f;
  VisitReflections(material.IndexOfRefraction, GGX(material.Alpha), cosine,
    [&](const glm::vec3& incident, float weight)
    {
      total += weight;
      row.X += weight * incident.x;
      row.Z += weight * incident.z;
      row.XX += weight * incident.x * incident.x;
      row.YY += weight * incident.y * incident.y;
      row.XZ += weight * incident.x * incident.z;
    });
  if (total > 0.0f)
  {
    return { row.X / total, row.Z / total, row.XX / total, row.YY / total, row.XZ / total };
  }
  return row;
}

DirectionMoments GlossyLobe::GetMoments(const glm::vec3& normal, const glm::vec3& outgoing) const
{
  const float cosine = glm::dot(normal, outgoing);
  const float position = std::clamp(cosine, 0.0f, 1.0f) * Steps;
  const int lower = std::min(static_cast<int>(position), Steps - 1);
  const float part = position - static_cast<float>(lower);
  const Row& a = this->Rows[lower];
  const Row& b = this->Rows[lower + 1];
  const auto mix = [part](float x, float y) { return x + part * (y - x); };
  const float mX = mix(a.X, b.X);
  const float mZ = mix(a.Z, b.Z);
  const float mXX = mix(a.XX, b.XX);
  const float mYY = mix(a.YY, b.YY);
  const float mXZ = mix(a.XZ, b.XZ);

  const glm::vec3 along = outgoing - cosine * normal;
  const float length = glm::length(along);
  const glm::vec3 x = length > 1e-6f ? along / length : Frame(normal).X;
  const glm::vec3 y = glm::cross(normal, x);
  const float mZZ = 1.0f - mXX - mYY;
  const glm::vec3 mean = mX * x + mZ * normal;
  const auto product = [&](int i, int j)
  {
    return mXX * x[i] * x[j] + mYY * y[i] * y[j] + mZZ * normal[i] * normal[j] +
      mXZ * (x[i] * normal[j] + normal[i] * x[j]);
  };
  return { 1.0f, mean.x, mean.y, mean.z, product(0, 0), product(1, 1), product(2, 2), product(0, 1),
    product(0, 2), product(1, 2) };
}

void IncidentFit::Moments::Add(const float z[Polynomials], const glm::vec3& l)
{
  int product = 0;
  for (int k = 0; k < Polynomials; ++k)
  {
    this->LZ[k] += glm::dvec3(z[k] * l);
    for (int j = 0; j <= k; ++j)
    {
      this->ZZ[product++] += z[j] * z[k];
    }
  }
  this->LL += glm::dvec3(l * l);
}

glm::dvec3 IncidentFit::Moments::GetSquares(const glm::dvec3 factors[Polynomials]) const
{
  glm::dvec3 squares = this->LL;
  int product = 0;
  for (int k = 0; k < Polynomials; ++k)
  {
    squares -= 2.0 * factors[k] * this->LZ[k];
    for (int j = 0; j <= k; ++j)
    {
      squares += (j < k ? 2.0 : 1.0) * this->ZZ[product++] * factors[j] * factors[k];
    }
  }
  return glm::max(squares, 0.0);
}

void IncidentFit::Add(const glm::vec2& place, const glm::vec3& radiance)
{
  const auto values = EvaluateZernike(place);
  this->Samples.Add(values.data(), radiance);
  for (int k = 0; k < Polynomials; ++k)
  {
    this->Sums[k] += glm::dvec3(values[k] * radiance);
    this->CellZ[k] += values[k] / float(CellSize);
  }
  this->CellL += radiance / float(CellSize);
  if (++this->Count % CellSize == 0)
  {
    this->Cells.Add(this->CellZ, this->CellL);
    std::fill_n(this->CellZ, Polynomials, 0.0f);
    this->CellL = glm::vec3(0.0f);
  }
}

float IncidentFit::GetError(const glm::dvec3 factors[Polynomials], float lobeSize) const
{
  // The residual in each part of the hemisphere, and its variation within the part, which affects
  // smaller lobes.
  const int cells = std::max(this->Count / CellSize, 1);
  const glm::dvec3 means = this->Cells.GetSquares(factors);
  const glm::dvec3 squares = this->Samples.GetSquares(factors) / double(CellSize);
  const glm::dvec3 within = glm::max(squares - means, 0.0) * (CellSize / (CellSize - 1.0));
  const glm::dvec3 left = glm::max(means - within / double(CellSize), 0.0);
  const double seen = std::max(0.0, 1.0 - lobeSize * cells);
  return std::sqrt(Largest((left + seen * within) / double(cells)));
}

IncidentLight IncidentFit::Solve(const Frame& frame, float lobeSize) const
{
  IncidentLight light;
  if (this->Count == 0)
  {
    return light;
  }
  glm::dvec3 exact[Polynomials];
  glm::vec3 factors[Polynomials];
  for (int k = 0; k < Polynomials; ++k)
  {
    exact[k] = this->Sums[k] / double(this->Count);
    factors[k] = exact[k];
  }
  light.Mean = factors[0];
  light.Error = this->GetError(exact, lobeSize);

  // Expand the polynomials.
  light.Normal = frame.Z;
  light.Terms[0] = factors[0] - Root3 * factors[5];
  for (int axis = 0; axis < 3; ++axis)
  {
    light.Terms[1 + axis] = 2.0f * (frame.X[axis] * factors[1] + frame.Y[axis] * factors[2]);
  }
  AddProduct(light, frame.X, frame.Y, 2.0f * Root6 * factors[3]);
  AddProduct(light, frame.X, frame.X, Root6 * factors[4] + 2.0f * Root3 * factors[5]);
  AddProduct(light, frame.Y, frame.Y, 2.0f * Root3 * factors[5] - Root6 * factors[4]);
  return light;
}

IncidentLight Average(const std::vector<IncidentLight>& lights,
  const std::vector<IncidentLight>& pilots, const glm::vec3& normal)
{
  IncidentLight mean;
  IncidentLight pilot;
  mean.Normal = normal;
  const float weight = 1.0f / static_cast<float>(lights.size());
  float squares = 0.0f;
  for (std::size_t light = 0; light < lights.size(); ++light)
  {
    for (std::size_t i = 0; i < DirectionMoments().size(); ++i)
    {
      mean.Terms[i] += weight * lights[light].Terms[i];
      pilot.Terms[i] += weight * pilots[light].Terms[i];
    }
    mean.Mean += weight * pilots[light].Mean;
    squares += pilots[light].Error * pilots[light].Error;
  }
  // Compare them in a few directions.
  const Frame frame(normal);
  constexpr int directions = 8;
  for (int k = 0; k < directions; ++k)
  {
    const float angle = 2.0f * Pi * static_cast<float>(k) / directions;
    const float radius = k % 2 == 0 ? 0.4f : 0.8f;
    const DirectionMoments products = GetProducts(frame.ToWorld(
      { radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0f - radius * radius) }));
    const glm::vec3 center = pilot.Get(products);
    for (const IncidentLight& light : pilots)
    {
      const float difference = Largest(glm::abs(light.Get(products) - center));
      squares += difference * difference / directions;
    }
  }
  mean.Error = std::sqrt(weight * squares);
  return mean;
}
}
