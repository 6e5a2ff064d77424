// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSampleNoise.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cstddef>

namespace cslf
{
namespace
{
// The weights of the neighbours' mean error and of that of all, relative to a point's own.
constexpr double ShareOfNeighbours = 0.07;
constexpr double ShareOfAll = 0.03;
}

std::vector<glm::vec3> PoolVariances(
  const std::vector<glm::vec3>& variances, const PointGraph& graph)
{
  std::vector<glm::dvec3> errors;
  errors.reserve(variances.size());
  glm::dvec3 all(0.0);
  for (const glm::vec3& variance : variances)
  {
    errors.push_back(glm::sqrt(glm::dvec3(variance)));
    all += errors.back() / double(variances.size());
  }
  std::vector<glm::vec3> pooled;
  pooled.reserve(variances.size());
  for (std::size_t point = 0; point < variances.size(); ++point)
  {
    glm::dvec3 near = errors[point];
    for (const std::uint32_t* other = graph.Begin(point); other != graph.End(point); ++other)
    {
      near += errors[*other];
    }
    near /= 1.0 + static_cast<double>(graph.GetNumberOfNeighbours(point));
    const glm::dvec3 error = (1.0 - ShareOfNeighbours - ShareOfAll) * errors[point] +
      ShareOfNeighbours * near + ShareOfAll * all;
    pooled.emplace_back(error * error);
  }
  return pooled;
}

float GetDisplayedError(const DisplayCurve& display, const glm::vec3& value, const glm::vec3& error,
  const glm::vec3& baseColor)
{
  const glm::vec3 seen = display(value, baseColor);
  const glm::vec3 upwards = display(value + error, baseColor) - seen;
  const glm::vec3 downwards = seen - display(value - error, baseColor);
  const glm::vec3 larger = glm::max(upwards, downwards);
  return std::max({ larger.x, larger.y, larger.z });
}
}
