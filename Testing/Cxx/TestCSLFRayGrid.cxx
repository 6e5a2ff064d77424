// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rectangles of a grid's rays that cannot hit a box are detected, and no others.
#include "PathTracing/Rays/cslfRayGrid.h"
#include "cslfTesting.h"

#include <vtkBox.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>

#include <glm/geometric.hpp>

#include <iostream>

namespace
{
constexpr int Rectangles = 20000;
constexpr int Side = 9; // of the rays that try a rectangle

class Random
{
public:
  double Get(double low, double high)
  {
    this->Sequence->Next();
    return this->Sequence->GetRangeValue(low, high);
  }

  glm::dvec3 GetPoint(double size)
  {
    const double x = this->Get(-size, size);
    const double y = this->Get(-size, size);
    return { x, y, this->Get(-size, size) };
  }

private:
  vtkNew<vtkMinimalStandardRandomSequence> Sequence;
};

bool IsMet(const cslf::Box& box, const glm::dvec3& origin, const glm::dvec3& direction)
{
  const double bounds[6] = { box.Low.x, box.High.x, box.Low.y, box.High.y, box.Low.z, box.High.z };
  double parameter;
  double point[3];
  // The ray's end lies beyond all boxes.
  const glm::dvec3 way = 100.0 * glm::normalize(direction);
  return vtkBox::IntersectBox(bounds, &origin.x, &way.x, point, parameter) != 0;
}

bool IsMet(
  const cslf::RayGrid& grid, const glm::dvec2& low, const glm::dvec2& high, const cslf::Box& box)
{
  for (int j = 0; j < Side; ++j)
  {
    for (int i = 0; i < Side; ++i)
    {
      const glm::dvec2 place = low + (high - low) * (glm::dvec2(i, j) / (Side - 1.0));
      const glm::dvec3 direction =
        grid.Direction + place.x * grid.DirectionX + place.y * grid.DirectionY;
      if (IsMet(box, grid.Origin, direction))
      {
        return true;
      }
    }
  }
  return false;
}

void TestBoxes()
{
  Random random;
  int met = 0;
  int leftOut = 0;
  for (int k = 0; k < Rectangles; ++k)
  {
    cslf::RayGrid grid;
    grid.Origin = random.GetPoint(1.5);
    grid.DirectionX = random.GetPoint(0.02);
    grid.DirectionY = random.GetPoint(0.02);
    const glm::dvec3 corner = random.GetPoint(0.5);
    const cslf::Box box{ corner, corner + glm::abs(random.GetPoint(0.5)) };
    grid.Direction = 0.5 * (box.Low + box.High) - grid.Origin + random.GetPoint(0.5);
    const glm::dvec2 low(random.Get(-8.0, 8.0), random.Get(-8.0, 8.0));
    const glm::dvec2 high = low + 4.0;
    const bool isMet = IsMet(grid, low, high, box);
    const bool mayMeet = cslf::MayMeet(grid, low, high, box);
    CSLF_CHECK(mayMeet || !isMet);
    met += isMet ? 1 : 0;
    leftOut += mayMeet ? 0 : 1;
  }
  std::cout << "of " << Rectangles << " rectangles " << met << " meet the box, " << leftOut
            << " are left out\n";
  CSLF_CHECK(met > Rectangles / 20);
  // Near an edge of the pyramid, a box may be outside without being on the outer side of one plane.
  CSLF_CHECK(leftOut > 0.7 * (Rectangles - met));
}

void TestOthers()
{
  // The function does not detect rays that start at different points, like those of a parallel
  // camera.
  cslf::RayGrid grid;
  grid.Direction = { 0.0, 0.0, 1.0 };
  grid.OriginX = { 1.0, 0.0, 0.0 };
  const cslf::Box far{ glm::dvec3(5.0), glm::dvec3(6.0) };
  CSLF_CHECK(cslf::MayMeet(grid, { 0.0, 0.0 }, { 1.0, 1.0 }, far));
}
}

int TestCSLFRayGrid(int, char*[])
{
  TestBoxes();
  TestOthers();
  return cslf::testing::Result();
}
