// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which parts of a mesh are closed, and which side of them is outside.
#include "cslfClosedParts.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace
{
struct Mesh
{
  std::vector<glm::vec3> Points;
  std::vector<std::uint32_t> Corners;

  /// A tetrahedron around a place, of triangles that share no points.
  void AddTetrahedron(const glm::vec3& place, bool isInsideOut)
  {
    const glm::vec3 ends[4] = { { 1, 1, 1 }, { -1, -1, 1 }, { -1, 1, -1 }, { 1, -1, -1 } };
    const int faces[4][3] = { { 0, 1, 3 }, { 0, 2, 1 }, { 0, 3, 2 }, { 1, 2, 3 } };
    for (const auto& face : faces)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->Corners.push_back(static_cast<std::uint32_t>(this->Points.size()));
        this->Points.push_back(place + ends[face[isInsideOut ? 2 - k : k]]);
      }
    }
  }

  /// Whether a triangle is counterclockwise as seen from the other side of a place.
  bool IsOutside(std::size_t triangle, const glm::vec3& place) const
  {
    const glm::vec3 a = this->Points[this->Corners[3 * triangle]];
    const glm::vec3 b = this->Points[this->Corners[3 * triangle + 1]];
    const glm::vec3 c = this->Points[this->Corners[3 * triangle + 2]];
    return glm::dot(glm::cross(b - a, c - a), a - place) > 0.0f;
  }
};

// Two bodies, one of them inside out, behind one that lacks a side.
void CheckBodies()
{
  const glm::vec3 places[3] = { { 9, 0, 0 }, { 0, 0, 0 }, { 0, 9, 0 } };
  Mesh mesh;
  mesh.AddTetrahedron(places[0], false);
  mesh.Corners.resize(9);
  mesh.AddTetrahedron(places[1], false);
  mesh.AddTetrahedron(places[2], true);
  const cslf::ClosedParts parts = cslf::SortClosedParts(mesh.Points, mesh.Corners);
  CSLF_CHECK(parts.Corners == 24 && mesh.Corners.size() == 33);
  for (std::size_t triangle = 0; triangle < 8; ++triangle)
  {
    CSLF_CHECK(mesh.IsOutside(triangle, places[triangle < 4 ? 1 : 2]));
  }
  for (std::size_t point = 0; point < mesh.Points.size(); ++point)
  {
    CSLF_CHECK(parts.IsTurned[point] == (glm::distance(mesh.Points[point], places[2]) < 2.0f));
  }
}

// A body with one triangle turned over has no inside.
void CheckTurned()
{
  Mesh mesh;
  mesh.AddTetrahedron({ 0, 0, 0 }, false);
  std::swap(mesh.Corners[1], mesh.Corners[2]);
  CSLF_CHECK(cslf::SortClosedParts(mesh.Points, mesh.Corners).Corners == 0);
}
}

int TestCSLFClosedParts(int, char*[])
{
  CheckBodies();
  CheckTurned();
  return cslf::testing::Result();
}
