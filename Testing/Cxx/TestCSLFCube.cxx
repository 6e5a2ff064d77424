// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cube's geometry: faces, rays to (u,v,s,t) and back, world to cube space.
#include "cslfCube.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <limits>
#include <random>

namespace
{
void TestOrientationTable()
{
  // OpenGL 4.6, table 8.19: face, then the direction whose in-face coordinates are (sc, tc).
  struct Row
  {
    int Face;
    glm::dvec3 Direction;
    glm::dvec2 Coordinates;
  };
  const Row rows[] = {
    { 0, { 1, 0.25, 0.5 }, { -0.5, -0.25 } },
    { 1, { -1, 0.25, 0.5 }, { 0.5, -0.25 } },
    { 2, { 0.25, 1, 0.5 }, { 0.25, 0.5 } },
    { 3, { 0.25, -1, 0.5 }, { 0.25, -0.5 } },
    { 4, { 0.25, 0.5, 1 }, { 0.25, -0.5 } },
    { 5, { 0.25, 0.5, -1 }, { -0.25, -0.5 } },
  };
  for (const Row& row : rows)
  {
    const cslf::CubePoint point = cslf::DirectionToFace(3.0 * row.Direction);
    CSLF_CHECK(point.Face == row.Face);
    CSLF_CHECK(glm::distance(point.Coordinates, row.Coordinates) < 1e-12);
    CSLF_CHECK(glm::distance(cslf::FaceToCube(row.Face, row.Coordinates), row.Direction) < 1e-12);
  }
}

void TestRoundTrips()
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> inFace(-0.999, 0.999);
  std::uniform_real_distribution<double> distance(-3.0, 3.0);
  int pairs = 0;
  for (int entry = 0; entry < cslf::FaceCount; ++entry)
  {
    for (int exit = 0; exit < cslf::FaceCount; ++exit)
    {
      if (entry == exit)
      {
        continue;
      }
      ++pairs;
      for (int i = 0; i < 200; ++i)
      {
        const glm::dvec2 uv(inFace(random), inFace(random));
        const glm::dvec2 st(inFace(random), inFace(random));
        const glm::dvec3 from = cslf::FaceToCube(entry, uv);
        const glm::dvec3 direction = cslf::FaceToCube(exit, st) - from;
        const double start = distance(random);
        const auto ray = cslf::RayToCoordinates(from + start * direction, direction);
        CSLF_CHECK(ray.has_value());
        CSLF_CHECK(ray && ray->Entry.Face == entry && ray->Exit.Face == exit);
        CSLF_CHECK(ray && glm::distance(ray->Entry.Coordinates, uv) < 1e-9);
        CSLF_CHECK(ray && glm::distance(ray->Exit.Coordinates, st) < 1e-9);
        CSLF_CHECK_NEAR(ray->EntryDistance, -start, 1e-9);
        CSLF_CHECK_NEAR(ray->ExitDistance, 1.0 - start, 1e-9);
      }
    }
  }
  CSLF_CHECK(pairs == 30);
}

void TestEdgesAndCorners()
{
  // Neighbouring faces agree on every point of the edges and corners they share.
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    for (double along : { -1.0, -0.5, 0.0, 0.75, 1.0 })
    {
      for (const glm::dvec2& edge : { glm::dvec2(along, -1.0), glm::dvec2(along, 1.0),
             glm::dvec2(-1.0, along), glm::dvec2(1.0, along) })
      {
        const glm::dvec3 point = cslf::FaceToCube(face, edge);
        int shared = 0;
        for (int other = 0; other < cslf::FaceCount; ++other)
        {
          if (point[cslf::FaceAxis(other)] == cslf::FaceSign(other))
          {
            ++shared;
            CSLF_CHECK(cslf::FaceToCube(other, cslf::CubeToFace(other, point)) == point);
          }
        }
        CSLF_CHECK(shared == (std::abs(along) == 1.0 ? 3 : 2));
      }
    }
  }

  // The main diagonals leave opposite to their entry, through the corners.
  for (double x : { -1.0, 1.0 })
  {
    for (double y : { -1.0, 1.0 })
    {
      const glm::dvec3 corner(x, y, 1.0);
      const auto ray = cslf::RayToCoordinates(3.0 * corner, -corner);
      CSLF_CHECK(ray.has_value());
      CSLF_CHECK(ray && cslf::FaceToCube(ray->Entry.Face, ray->Entry.Coordinates) == corner);
      CSLF_CHECK(ray && cslf::FaceToCube(ray->Exit.Face, ray->Exit.Coordinates) == -corner);
      CSLF_CHECK(ray && ray->Entry.Face != ray->Exit.Face);
    }
  }
}

void TestMisses()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CSLF_CHECK(!cslf::RayToCoordinates({ 0, 0, 3 }, { 0, 3, -1 }));
  CSLF_CHECK(!cslf::RayToCoordinates({ 0, 2, 0 }, { 1, 0, 0 }));
  CSLF_CHECK(!cslf::RayToCoordinates({ 0, 0, 0 }, { 0, 0, 0 }));
  CSLF_CHECK(!cslf::RayToCoordinates({ nan, 0, 0 }, { 1, 0, 0 }));
  CSLF_CHECK(!cslf::RayToCoordinates({ 0, 0, 0 }, { 1, nan, 0 }));
  // Touching an edge from outside is a miss.
  CSLF_CHECK(!cslf::RayToCoordinates({ 2, 0, 0 }, { -1, 1, 0 }));
}

void TestWorld()
{
  const double bounds[6] = { 1, 3, -2, 2, 0, 1 };
  const cslf::Cube cube = cslf::Cube::FromBounds(bounds, 0.05);
  CSLF_CHECK(glm::distance(cube.Center, glm::dvec3(2, 0, 0.5)) < 1e-12);
  CSLF_CHECK(glm::distance(cube.Edges, glm::dvec3(4.4)) < 1e-12);
  CSLF_CHECK(cube.Contains(bounds));
  CSLF_CHECK(!cslf::Cube::FromBounds(bounds, 0.0).Contains(bounds));

  const cslf::Cube box{ { 1, 2, 3 }, { 2, 4, 8 } };
  const glm::dvec3 point(1.5, 3.0, -1.0);
  CSLF_CHECK(glm::distance(box.PointToCube(point), glm::dvec3(0.5, 0.5, -1.0)) < 1e-12);
  CSLF_CHECK(glm::distance(box.PointToWorld(box.PointToCube(point)), point) < 1e-12);
  CSLF_CHECK(glm::distance(box.VectorToWorld(box.VectorToCube(point)), point) < 1e-12);
  double boxBounds[6];
  box.GetBounds(boxBounds);
  CSLF_CHECK(boxBounds[0] == 0 && boxBounds[1] == 2 && boxBounds[4] == -1 && boxBounds[5] == 7);
}
}

int TestCSLFCube(int, char*[])
{
  TestOrientationTable();
  TestRoundTrips();
  TestEdgesAndCorners();
  TestMisses();
  TestWorld();
  return cslf::testing::Result();
}
