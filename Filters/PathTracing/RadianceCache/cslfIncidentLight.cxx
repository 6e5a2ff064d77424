// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfIncidentLight.h"

#include "PathTracing/cslfFresnel.h"
#include "PathTracing/cslfGGX.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// Samples that tell of one part of the hemisphere.
constexpr std::size_t CellSize = 16;

// Zernike's polynomials of the unit disc, on which directions spread by the cosine lie evenly: the
// mean of the product of any two is 0, that of a square is 1. Noll, JOSA 66(3), 1976.
constexpr std::size_t Polynomials = 6;
const float Root3 = std::sqrt(3.0f);
const float Root6 = std::sqrt(6.0f);

std::array<float, Polynomials> EvaluateZernike(const glm::vec2& place)
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
  constexpr int side = 24;
  const GGX facets(material.Alpha);
  const glm::vec3 outgoing(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
  Row row;
  float total = 0.0f;
  for (int i = 0; i < side * side; ++i)
  {
    const glm::vec2 u((i / side + 0.5f) / side, (i % side + 0.5f) / side);
    const glm::vec3 incident = facets.Sample(outgoing, u);
    if (incident.z > 0.0f)
    {
      const float cosHalf = glm::dot(outgoing, glm::normalize(outgoing + incident));
      const float weight = DielectricFresnel(cosHalf, material.IndexOfRefraction) *
        facets.MaskingShadowing(outgoing, incident) / facets.Masking(outgoing);
      total += weight;
      row.X += weight * incident.x;
      row.Z += weight * incident.z;
      row.XX += weight * incident.x * incident.x;
      row.YY += weight * incident.y * incident.y;
      row.XZ += weight * incident.x * incident.z;
    }
  }
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

IncidentLight IncidentFit::Solve(const Frame& frame, float lobeSize) const
{
  IncidentLight light;
  if (this->Samples.empty())
  {
    return light;
  }
  // Project the samples to the polynomials.
  glm::vec3 factors[Polynomials] = {};
  for (const Sample& sample : this->Samples)
  {
    const auto values = EvaluateZernike(sample.Place);
    for (std::size_t k = 0; k < Polynomials; ++k)
    {
      factors[k] += values[k] * sample.Radiance;
    }
  }
  const auto count = static_cast<float>(this->Samples.size());
  for (glm::vec3& factor : factors)
  {
    factor /= count;
  }

  // What is left in each part of the hemisphere, and how much it varies within: lobes that are
  // smaller than such a part see that, too.
  glm::vec3 left(0.0f);
  glm::vec3 within(0.0f);
  const std::size_t cells = this->Samples.size() / CellSize;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    glm::vec3 sum(0.0f);
    glm::vec3 squares(0.0f);
    for (std::size_t i = cell * CellSize; i < (cell + 1) * CellSize; ++i)
    {
      const auto values = EvaluateZernike(this->Samples[i].Place);
      glm::vec3 residual = this->Samples[i].Radiance;
      for (std::size_t k = 0; k < Polynomials; ++k)
      {
        residual -= values[k] * factors[k];
      }
      sum += residual;
      squares += residual * residual;
    }
    const glm::vec3 mean = sum / float(CellSize);
    const glm::vec3 variance = glm::max(squares / float(CellSize) - mean * mean, glm::vec3(0.0f)) *
      (float(CellSize) / float(CellSize - 1));
    left += mean * mean - variance / float(CellSize);
    within += variance;
  }
  const float cellSize = static_cast<float>(CellSize) / count;
  const float seen = std::max(0.0f, 1.0f - lobeSize / cellSize);
  const glm::vec3 error2 = (glm::max(left, glm::vec3(0.0f)) + seen * within) /
    static_cast<float>(std::max<std::size_t>(cells, 1));
  light.Error = std::sqrt(Largest(error2));

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

IncidentLight Average(const std::vector<IncidentLight>& lights, const glm::vec3& normal)
{
  IncidentLight mean;
  mean.Normal = normal;
  float squares = 0.0f;
  for (const IncidentLight& light : lights)
  {
    for (std::size_t i = 0; i < DirectionMoments().size(); ++i)
    {
      mean.Terms[i] += light.Terms[i] / static_cast<float>(lights.size());
    }
    squares += light.Error * light.Error;
  }
  // How far they differ, in a few directions.
  const Frame frame(normal);
  constexpr int directions = 8;
  for (int k = 0; k < directions; ++k)
  {
    const float angle = 2.0f * Pi * static_cast<float>(k) / directions;
    const float radius = k % 2 == 0 ? 0.4f : 0.8f;
    const DirectionMoments products = GetProducts(frame.ToWorld(
      { radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0f - radius * radius) }));
    const glm::vec3 center = mean.Get(products);
    for (const IncidentLight& light : lights)
    {
      const float difference = Largest(glm::abs(light.Get(products) - center));
      squares += difference * difference / directions;
    }
  }
  mean.Error = std::sqrt(squares / static_cast<float>(lights.size()));
  return mean;
}
}
