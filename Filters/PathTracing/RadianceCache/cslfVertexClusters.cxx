// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfVertexClusters.h"

#include "RandomNumbers/cslfSampleStream.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <unordered_map>

namespace cslf
{
namespace
{
// The normals of a cluster differ by up to about this size in each component.
constexpr float NormalStep = 0.5f;
}

std::uint64_t HashCell(const glm::vec3& cell, std::uint64_t seed)
{
  for (int i = 0; i < 3; ++i)
  {
    seed = MixBits(seed, static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[i])));
  }
  return seed;
}

std::vector<std::uint32_t> FindVertexClusters(
  const Mesh& mesh, float edge, const LayoutProgress& progress)
{
  std::vector<std::uint32_t> clusters;
  std::unordered_map<std::uint64_t, std::uint32_t> firsts;
  for (std::uint32_t vertex = 0; vertex < mesh.Normals.size(); ++vertex)
  {
    progress.Step();
    const float length = glm::length(mesh.Normals[vertex]);
    if (!(length > 0.0f))
    {
      clusters.push_back(vertex);
      continue;
    }
    const glm::vec3 normal = glm::round(mesh.Normals[vertex] / (NormalStep * length));
    const std::uint64_t key =
      HashCell(normal, HashCell(glm::floor(mesh.Vertices[vertex] / edge), 0));
    clusters.push_back(firsts.emplace(key, vertex).first->second);
  }
  return clusters;
}
}
