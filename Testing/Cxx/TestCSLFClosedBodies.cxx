// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which sides of triangles face the inside of a closed body.
#include "PathTracing/RadianceCache/cslfMeshEdges.h"
#include "cslfTesting.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace
{
/// Adds a cube. Its triangles share no vertices, as at edges with different normals.
void AddCube(cslf::Mesh& mesh, const glm::vec3& low, bool isInsideOut)
{
  const glm::uvec3 triangles[] = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 },
    { 0, 5, 4 }, { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  for (glm::uvec3 corners : triangles)
  {
    if (isInsideOut)
    {
      std::swap(corners.y, corners.z);
    }
    const auto first = static_cast<std::uint32_t>(mesh.Vertices.size());
    for (const std::uint32_t corner : { corners.x, corners.y, corners.z })
    {
      mesh.Vertices.push_back(low + glm::vec3(corner & 1u, (corner >> 1) & 1u, (corner >> 2) & 1u));
    }
    mesh.Triangles.emplace_back(first, first + 1, first + 2);
  }
}

void CheckSides(const cslf::Mesh& mesh, std::size_t begin, std::size_t end, int side)
{
  const std::vector<std::uint8_t> sides = cslf::FindInsides(mesh);
  CSLF_CHECK(sides.size() == mesh.Triangles.size());
  for (std::size_t triangle = begin; triangle < std::min(end, sides.size()); ++triangle)
  {
    CSLF_CHECK(sides[triangle] == side);
  }
}
}

int TestCSLFClosedBodies(int, char*[])
{
  cslf::Mesh mesh;
  CSLF_CHECK(cslf::FindInsides(mesh).empty());
  AddCube(mesh, glm::vec3(3.0f), false);
  CheckSides(mesh, 0, 12, 2);
  AddCube(mesh, glm::vec3(-9.0f), true);
  CheckSides(mesh, 0, 12, 2);
  CheckSides(mesh, 12, 24, 1);

  // A triangle without area closes nothing and opens nothing.
  mesh.Triangles.emplace_back(0, 0, 1);
  CheckSides(mesh, 0, 12, 2);
  CheckSides(mesh, 24, 25, 0);

  // A missing triangle opens a body, and leaves the other closed.
  mesh.Triangles.erase(mesh.Triangles.begin() + 3);
  CheckSides(mesh, 0, 11, 0);
  CheckSides(mesh, 11, 23, 1);

  // A flap on an edge of a body, and one triangle that is turned.
  cslf::Mesh flap;
  AddCube(flap, glm::vec3(0.0f), false);
  flap.Vertices.emplace_back(2.0f, 2.0f, 2.0f);
  flap.Triangles.emplace_back(0, 1, 36);
  CheckSides(flap, 0, 13, 0);
  cslf::Mesh turned;
  AddCube(turned, glm::vec3(0.0f), false);
  std::swap(turned.Triangles[5].x, turned.Triangles[5].y);
  CheckSides(turned, 0, 12, 0);
  return cslf::testing::Result();
}
