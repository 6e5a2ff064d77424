// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Thousands of thin bars keep their number, their length and their thickness when most of their
// triangles are removed. A large ball beside them stays round.
#include "Geometry/cslfReduction.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr int Bars = 2000;
constexpr int Sides = 12;
constexpr int Rings = 60; // of the ball
constexpr double Pi = 3.14159265358979;
const float Thickness = 0.001F; // radius of a bar
const float Length = 0.02F;

void AddBar(const glm::vec3& place, float length, cslf::SurfaceMesh& mesh)
{
  const auto first = static_cast<unsigned int>(mesh.Points.size());
  for (int i = 0; i < 2 * Sides; ++i)
  {
    const double angle = 2.0 * Pi * (i % Sides) / Sides;
    mesh.Points.push_back(place +
      glm::vec3(i < Sides ? 0.0F : length, Thickness * static_cast<float>(std::cos(angle)),
        Thickness * static_cast<float>(std::sin(angle))));
  }
  for (unsigned int i = 0; i < Sides; ++i)
  {
    const unsigned int next = (i + 1) % Sides;
    mesh.Triangles.emplace_back(first + i, first + next, first + Sides + next);
    mesh.Triangles.emplace_back(first + i, first + Sides + next, first + Sides + i);
    if (i > 0 && next > 0)
    {
      mesh.Triangles.emplace_back(first, first + next, first + i);
      mesh.Triangles.emplace_back(first + Sides, first + Sides + i, first + Sides + next);
    }
  }
}

void AddBall(const glm::vec3& center, cslf::SurfaceMesh& mesh)
{
  const auto first = static_cast<unsigned int>(mesh.Points.size());
  for (int ring = 0; ring <= Rings; ++ring)
  {
    for (int side = 0; side < 2 * Rings; ++side)
    {
      const double latitude = Pi * ring / Rings;
      const double angle = Pi * side / Rings;
      mesh.Points.push_back(center +
        0.3F *
          glm::vec3(std::sin(latitude) * std::cos(angle), std::sin(latitude) * std::sin(angle),
            std::cos(latitude)));
      if (ring > 0)
      {
        const unsigned int next = (side + 1) % (2 * Rings);
        const unsigned int row = first + 2 * Rings * ring;
        const unsigned int before = row - 2 * Rings;
        mesh.Triangles.emplace_back(before + side, row + side, row + next);
        mesh.Triangles.emplace_back(before + side, row + next, before + next);
      }
    }
  }
}

/// The area of the triangles around each bar, and the extent of their points.
struct Extents
{
  double Areas[Bars]{};
  glm::vec3 Low[Bars];
  glm::vec3 High[Bars];
  double WorstOfBall = 0.0; ///< distance from the ball
};

glm::vec3 PlaceOf(int bar)
{
  return { 0.0F, 0.02F * static_cast<float>(bar % 50), 0.02F * static_cast<float>(bar / 50) };
}

Extents Measure(const cslf::SurfaceMesh& mesh)
{
  Extents extents;
  std::fill_n(extents.Low, Bars, glm::vec3(std::numeric_limits<float>::max()));
  std::fill_n(extents.High, Bars, glm::vec3(std::numeric_limits<float>::lowest()));
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    const glm::vec3& point = mesh.Points[corners.x];
    if (point.x < -0.5F)
    {
      for (int i = 0; i < 3; ++i)
      {
        const double away = glm::distance(mesh.Points[corners[i]], glm::vec3(-1.0F, 0.0F, 0.0F));
        extents.WorstOfBall = std::max(extents.WorstOfBall, std::abs(away - 0.3));
      }
      continue;
    }
    const int bar = static_cast<int>(std::floor(point.y / 0.02F + 0.5F)) +
      50 * static_cast<int>(std::floor(point.z / 0.02F + 0.5F));
    extents.Areas[bar] +=
      0.5 * glm::length(glm::cross(mesh.Points[corners.y] - point, mesh.Points[corners.z] - point));
    for (int i = 0; i < 3; ++i)
    {
      extents.Low[bar] = glm::min(extents.Low[bar], mesh.Points[corners[i]]);
      extents.High[bar] = glm::max(extents.High[bar], mesh.Points[corners[i]]);
    }
  }
  return extents;
}
}

int TestCSLFGeometryReduction(int, char*[])
{
  cslf::SurfaceMesh mesh;
  for (int bar = 0; bar < Bars; ++bar)
  {
    AddBar(PlaceOf(bar), Length, mesh);
  }
  AddBall({ -1.0F, 0.0F, 0.0F }, mesh);
  cslf::Weld(mesh);
  const Extents before = Measure(mesh);
  const std::size_t most = mesh.Triangles.size() / 4;
  cslf::SurfaceMesh reduced = mesh;
  cslf::Reduce(reduced, most, true);
  CSLF_CHECK(reduced.Triangles.size() <= most && reduced.Triangles.size() > 9 * most / 10);
  const Extents after = Measure(reduced);
  double least = 1.0;
  double worst = 0.0;
  for (int bar = 0; bar < Bars; ++bar)
  {
    least = std::min(least, after.Areas[bar] / before.Areas[bar]);
    const glm::vec3 size = after.High[bar] - after.Low[bar];
    worst = std::max(worst, std::abs(size.x / Length - 1.0));
    worst = std::max(worst, std::max(size.y, size.z) / (2.0 * Thickness) - 1.8);
  }
  std::cout << "smallest share of an area " << least << ", largest error of an extent " << worst
            << ", of the ball " << after.WorstOfBall << "\n";
  CSLF_CHECK(least > 0.8);
  CSLF_CHECK(worst < 0.15);
  CSLF_CHECK(after.WorstOfBall < 0.01);

  // A bar of 400 times its thickness.
  cslf::SurfaceMesh wire;
  AddBar(glm::vec3(0.0F), 400.0F * Thickness, wire);
  cslf::Weld(wire);
  cslf::Reduce(wire, wire.Triangles.size() / 2, true);
  float thickest = 0.0F;
  for (const glm::vec3& point : wire.Points)
  {
    thickest = std::max(thickest, glm::length(glm::vec2(point.y, point.z)));
  }
  std::cout << "radius of a wire " << thickest / Thickness << "\n";
  CSLF_CHECK(thickest > 0.9F * Thickness && thickest < 1.8F * Thickness);

  // There is nothing to reduce, or nothing at all.
  cslf::SurfaceMesh few = reduced;
  cslf::Reduce(few, most, true);
  CSLF_CHECK(few.Triangles == reduced.Triangles && few.Points == reduced.Points);
  cslf::SurfaceMesh none;
  cslf::Reduce(none, 10, true);
  CSLF_CHECK(none.Triangles.empty());

  // More parts than triangles are allowed.
  cslf::Reduce(mesh, 1000, true);
  CSLF_CHECK(mesh.Triangles.size() <= 1000 && !mesh.Triangles.empty());
  return cslf::testing::Result();
}
