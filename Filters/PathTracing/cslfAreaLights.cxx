// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfAreaLights.h"

#include "cslfMesh.h"
#include "cslfSampling.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace cslf
{
AreaLights::AreaLights(std::vector<EmissiveTriangle> triangles)
  : Triangles(std::move(triangles))
{
  std::vector<double> weights;
  weights.reserve(this->Triangles.size());
  for (const EmissiveTriangle& triangle : this->Triangles)
  {
    const float area = 0.5f * glm::length(glm::cross(triangle.EdgeU, triangle.EdgeV));
    weights.push_back(double(area) * triangle.Importance);
  }
  this->Choice = Distribution1D(weights);
}

LightSample AreaLights::Sample(const glm::vec3& from, const glm::vec2& u) const
{
  // Choose the triangle, then the point with what is left of the random number.
  const DiscreteSample choice = this->Choice.Sample(u.x);
  const EmissiveTriangle& triangle = this->Triangles[choice.Index];
  const glm::vec2 point = SampleTriangle({ choice.Remainder, u.y });

  LightSample sample;
  const glm::vec3 path =
    triangle.Corner + point.x * triangle.EdgeU + point.y * triangle.EdgeV - from;
  const float distance = glm::length(path);
  if (distance > 0.0f)
  {
    const glm::vec3 normal = glm::normalize(glm::cross(triangle.EdgeU, triangle.EdgeV));
    sample.Distance = distance;
    sample.Direction = path / distance;
    const TrianglePoint place{ triangle.Triangle, point.x, point.y, triangle.Instance };
    sample.Radiance = triangle.Source->GetOpacity(place) * triangle.Source->GetEmission(place);
    sample.Pdf =
      this->Pdf(triangle.Importance, distance, std::abs(glm::dot(normal, sample.Direction)));
  }
  return sample;
}

float AreaLights::Pdf(float importance, float distance, float cosine) const
{
  if (importance == 0.0f)
  {
    return 0.0f;
  }
  // Per area, a triangle's choice and its area cancel.
  const auto perArea = static_cast<float>(importance / this->Choice.GetTotal());
  return cosine > 0.0f ? perArea * distance * distance / cosine : 0.0f;
}
}
