// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The samples that a camera can use, those that are kept, and where they show that surfaces may be.
#include "Lookup/cslfSceneGrid.h"
#include "cslfResidency.h"
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "cslfViewFrustum.h"
#include "cslfViewpointLevels.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

using cslf::Residency;
using cslf::ViewFrustum;

namespace
{
const glm::dvec3 Minimum(-0.9, -0.9, -0.3);
const glm::dvec3 Maximum(0.9, 0.8, 0.4);

cslf::DisplayRows MakeRows(
  const glm::dvec3& eye, const glm::dvec3& target, double angle, bool isParallel = false)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(target.x, target.y, target.z);
  camera->SetViewUp(0.1, 1.0, 0.2);
  camera->SetViewAngle(angle);
  camera->SetParallelProjection(isParallel);
  camera->SetParallelScale(angle / 20.0);
  camera->SetClippingRange(0.01, 100.0);
  vtkMatrix4x4* matrix = camera->GetCompositeProjectionTransformMatrix(1.5, -1.0, 1.0);
  cslf::DisplayRows rows;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      rows[row][column] = matrix->GetElement(row, column);
    }
  }
  return rows;
}

ViewFrustum MakeFrustum(const glm::dvec3& eye, double angle = 40.0)
{
  return ViewFrustum(MakeRows(eye, glm::dvec3(0.0), angle), Minimum, Maximum);
}

void TestLevels()
{
  for (int viewpoints : { 2, 3, 8, 9, 16, 17, 40 })
  {
    const cslf::ViewpointLevels levels(viewpoints);
    const int finest = levels.GetCount() - 1;
    CSLF_CHECK(static_cast<int>(levels.GetNodes(finest).size()) == viewpoints);
    CSLF_CHECK(levels.GetNodes(0).size() <= 4);
    CSLF_CHECK(levels.LevelOf(0, viewpoints - 1) == 0);
    for (int level = 0; level <= finest; ++level)
    {
      const std::vector<int>& nodes = levels.GetNodes(level);
      CSLF_CHECK(nodes.front() == 0 && nodes.back() == viewpoints - 1);
      for (int node : nodes)
      {
        CSLF_CHECK(levels.LevelOf(node, 0) <= level);
      }
      for (int index = 0; index + 1 < viewpoints; ++index)
      {
        const int lower = levels.FindInterval(level, index);
        CSLF_CHECK(nodes[lower] <= index && index + 1 <= nodes[lower + 1]);
      }
    }
  }
}

// Random lines of sight that meet the scene's box must all pass where ViewFrustum says.
void TestLinesOfSight(const glm::dvec3& eye, double angle, bool isParallel)
{
  const glm::dvec3 target(0.3, -0.1, 0.2);
  const cslf::DisplayRows rows = MakeRows(eye, target, angle, isParallel);
  const ViewFrustum frustum(rows, Minimum, Maximum);
  CSLF_CHECK(!frustum.IsInside());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int drawn = 0;
  for (int k = 0; k < 3000; ++k)
  {
    const glm::dvec3 point =
      Minimum + (Maximum - Minimum) * glm::dvec3(uniform(random), uniform(random), uniform(random));
    glm::dvec4 display;
    for (int row = 0; row < 4; ++row)
    {
      display[row] = glm::dot(rows[row], glm::dvec4(point, 1.0));
    }
    if (std::max(std::abs(display.x), std::abs(display.y)) > display.w)
    {
      continue;
    }
    const glm::dvec3 direction =
      isParallel ? glm::dvec3(frustum.GetEye()) : point - glm::dvec3(frustum.GetEye());
    const auto ray = cslf::RayToCoordinates(point, direction);
    ++drawn;
    CSLF_CHECK(frustum.CanEnter(ray->Entry.Face));
    CSLF_CHECK(frustum.CanLeave(ray->Entry.Face, ray->Exit.Face));
    CSLF_CHECK(frustum.PassesThrough(
      ray->Entry.Face, ray->Entry.Coordinates - 0.01, ray->Entry.Coordinates + 0.01));
    CSLF_CHECK(frustum.PassesThrough(
      ray->Exit.Face, ray->Exit.Coordinates - 0.01, ray->Exit.Coordinates + 0.01));
  }
  CSLF_CHECK(drawn > 100);
  const auto gaze = cslf::RayToCoordinates(
    isParallel ? target : eye, isParallel ? glm::dvec3(frustum.GetEye()) : target - eye);
  CSLF_CHECK(glm::distance(frustum.GetGaze(),
               cslf::FaceToCube(gaze->Entry.Face, gaze->Entry.Coordinates)) < 1e-6);
}

void TestFrustum()
{
  TestLinesOfSight({ 4.0, 2.0, 3.0 }, 40.0, false);
  TestLinesOfSight({ 0.2, 0.3, 4.0 }, 40.0, false);
  TestLinesOfSight({ 2.0, 0.3, -4.0 }, 10.0, false);
  TestLinesOfSight({ 4.0, 2.0, 3.0 }, 30.0, true);
  // Seen from above, the scene needs few of the sides.
  const ViewFrustum above = MakeFrustum({ 0.0, 4.0, 0.1 });
  CSLF_CHECK(above.CanEnter(2) && !above.CanEnter(0) && !above.CanEnter(4));
  CSLF_CHECK(above.PassesThrough(2, glm::dvec2(-0.1), glm::dvec2(0.1)));
  CSLF_CHECK(!above.PassesThrough(2, { -0.1, 0.8 }, { 0.1, 0.9 }));
  CSLF_CHECK(MakeFrustum({ 0.5, 0.5, -0.5 }).IsInside());
}

// 1, 2 and 3 faces take 5, 2 x 4 and 3 x 3 blocks.
void TestBlocks()
{
  CSLF_CHECK(Residency::CountBlocks({ MakeFrustum({ 0.0, 0.1, 4.0 }) }) == 5);
  CSLF_CHECK(Residency::CountBlocks({ MakeFrustum({ 2.0, 0.1, 4.0 }) }) == 8);
  CSLF_CHECK(Residency::CountBlocks({ MakeFrustum({ 2.0, -3.0, 4.0 }) }) == 9);
  CSLF_CHECK(Residency::CountBlocks({ MakeFrustum({ 0.0, 0.0, 0.5 }) }) == 30);
  // Two cameras with the same view share them.
  CSLF_CHECK(Residency::CountBlocks(
               { MakeFrustum({ 2.0, -3.0, 4.0 }), MakeFrustum({ 2.1, -3.0, 4.0 }) }) == 9);
}

// The size of the table's largest cell, in nodes of the base grid. Nothing if a slot is absent.
std::optional<int> FindCoarsestCell(const Residency::Table& table, int baseNodes)
{
  double widest = 0.0;
  for (std::size_t cell = 0; cell < table.Cells.size(); cell += 8)
  {
    const float* corners = &table.Cells[cell];
    if (std::min(std::min(corners[0], corners[1]), std::min(corners[2], corners[3])) < 0.0F)
    {
      return {};
    }
    widest = std::max({ widest, double(corners[6] - corners[4]), double(corners[7] - corners[5]) });
  }
  return static_cast<int>(std::lround(0.5 * widest * (baseNodes - 1)));
}

void BringAll(Residency& residency, int mostLevel)
{
  for (const cslf::WantedTiles& wanted : residency.ListMissing())
  {
    if (wanted.Level <= mostLevel)
    {
      residency.SetPresent(wanted.Slice, wanted.Tiles);
    }
  }
}

// The cells become finer level by level. After the camera turns, samples needed by both views stay.
void TestRefinement()
{
  const cslf::Layout grid(9, 16);
  Residency residency(grid, Residency::MinimumBlocks, 81);
  residency.Aim({ MakeFrustum({ 2.0, 3.0, 4.0 }) });
  CSLF_CHECK(!FindCoarsestCell(residency.MakeTable(4), 9));
  const auto missing = residency.ListMissing();
  CSLF_CHECK(missing.size() > 27 && missing.size() <= 3 * 81);
  CSLF_CHECK(std::is_sorted(missing.begin(), missing.begin() + 28,
    [](const auto& a, const auto& b) { return a.Level < b.Level; }));
  BringAll(residency, 0);
  CSLF_CHECK(FindCoarsestCell(residency.MakeTable(4), 9) == 4);
  BringAll(residency, 1);
  CSLF_CHECK(FindCoarsestCell(residency.MakeTable(4), 9) == 2);
  // From here the scene does not let lines of sight pass near all edges.
  BringAll(residency, 2);
  CSLF_CHECK(residency.ListMissing().empty());
  CSLF_CHECK(residency.MakeTable(4).Cells[8 * (3 * 8 + 3) + 6] -
      residency.MakeTable(4).Cells[8 * (3 * 8 + 3) + 4] ==
    0.25F);

  residency.Aim({ MakeFrustum({ 2.0, 0.0, 4.0 }) });
  for (const cslf::WantedTiles& wanted : residency.ListMissing())
  {
    const cslf::Viewpoint viewpoint = grid.ViewpointOf(wanted.Slice);
    CSLF_CHECK(viewpoint.Face == 0 || viewpoint.Face == 4);
    const int above = cslf::TileOf(viewpoint.Face, 2);
    CSLF_CHECK((wanted.Tiles & (1 << above)) != 0);
  }
  BringAll(residency, 2);
  // Samples that are not needed any more made space for others. After turning back, the common
  // faces stay.
  residency.Aim({ MakeFrustum({ 2.0, 3.0, 4.0 }) });
  const auto back = residency.ListMissing();
  CSLF_CHECK(std::all_of(back.begin(), back.end(),
    [&](const auto& wanted) { return grid.ViewpointOf(wanted.Slice).Face == 2; }));
}

// Cameras that take turns do not take samples from each other if all fit: cameras at opposite
// corners, and two that look at different parts of one face.
void TestTurns()
{
  const auto look = [](double x) {
    return ViewFrustum(MakeRows({ x, 0.0, 4.0 }, { x, 0.0, 0.0 }, 8.0), Minimum, Maximum);
  };
  const ViewFrustum pairs[][2] = {
    { MakeFrustum({ 2.0, 3.0, 4.0 }), MakeFrustum({ -2.0, -3.0, -4.0 }) }, { look(-0.7), look(0.7) }
  };
  for (const auto& pair : pairs)
  {
    Residency residency(cslf::Layout(17, 16), 2 * Residency::MinimumBlocks, 17 * 17);
    for (int turn = 0; turn < 2; ++turn)
    {
      residency.Aim({ pair[turn] });
      CSLF_CHECK(!residency.ListMissing().empty());
      BringAll(residency, 4);
    }
    const auto table = residency.MakeTable(4).Cells;
    residency.Aim({ pair[0] });
    CSLF_CHECK(residency.ListMissing().empty());
    residency.Aim({ pair[1], pair[0], pair[1] });
    CSLF_CHECK(residency.ListMissing().empty());
    residency.Aim({ pair[1] });
    CSLF_CHECK(residency.ListMissing().empty());
    CSLF_CHECK(residency.MakeTable(4).Cells == table);
  }
}

// Too few slots for all: the coarser levels get them, then samples near the focal point.
void TestBudget()
{
  const cslf::Layout grid(17, 16);
  Residency residency(grid, Residency::MinimumBlocks, 100);
  residency.Aim({ MakeFrustum({ 0.5, 0.5, 4.0 }) });
  const auto missing = residency.ListMissing();
  CSLF_CHECK(missing.size() == 100);
  BringAll(residency, 4);
  const Residency::Table table = residency.MakeTable(4);
  const auto width = [&](int i, int j)
  {
    const float* cell = &table.Cells[8 * (16 * j + i)];
    return static_cast<int>(std::lround(8.0 * (cell[6] - cell[4])));
  };
  CSLF_CHECK(width(8, 7) == 1 || width(8, 7) == 2);
  CSLF_CHECK(*FindCoarsestCell(table, 17) <= 4);
  // Slots belong to the viewpoints, each only once.
  std::vector<int> uses(100, 0);
  for (const auto& wanted : missing)
  {
    ++uses[residency.GetSlot(wanted.Slice)];
  }
  CSLF_CHECK(std::all_of(uses.begin(), uses.end(), [](int use) { return use == 1; }));
  // Looking at another point of the same face frees only some of them.
  residency.Aim({ MakeFrustum({ 0.8, 0.5, 4.0 }) });
  CSLF_CHECK(residency.ListMissing().size() < 50);
}

// Cells around a damaged viewpoint use coarser ones; if these lack one, too, the rest is used.
void TestDamage()
{
  const cslf::Layout grid(9, 16);
  Residency residency(grid, Residency::MinimumBlocks, 81);
  residency.Aim({ MakeFrustum({ 0.0, 0.1, 4.0 }) });
  residency.SetDamaged(grid.SliceOf({ 4, 3, 3 }));
  residency.SetDamaged(grid.SliceOf({ 4, 4, 4 }));
  BringAll(residency, 2);
  CSLF_CHECK(residency.ListMissing().empty());
  const Residency::Table table = residency.MakeTable(4);
  const float* nearFirst = &table.Cells[8 * (8 * 2 + 2)];
  CSLF_CHECK(*std::min_element(nearFirst, nearFirst + 4) == Residency::Absent);
  CSLF_CHECK(*std::max_element(nearFirst, nearFirst + 4) >= 0.0F);
  const float* far = &table.Cells[8 * (8 * 2 + 5)];
  CSLF_CHECK(*std::min_element(far, far + 4) >= 0.0F && far[6] - far[4] == 0.25F);
}

// Depths that are no number, or beyond the exit face, mark the cells of such faces only.
void TestBadDepths()
{
  const auto image =
    cslf::testing::MakeTestField(cslf::Layout(2, 16), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_FLOAT);
  vtkDataArray* depths = image->GetPointData()->GetArray("Depth");
  const double bad[] = { std::nan(""), 1e300, -1e300, 2.0, -1.0 };
  for (vtkIdType i = 0; i < depths->GetNumberOfTuples(); ++i)
  {
    depths->SetTuple1(i, bad[i % 5]);
  }
  std::string error;
  const auto field = cslf::Description::ReadFrom(image, error);
  CSLF_CHECK(field.has_value());
  if (field)
  {
    cslf::SceneGrid grid(*field);
    grid.Add(0, cslf::ViewpointSamples(image));
    CSLF_CHECK(grid.Spread());
  }
}

// Each tile is examined once.
void TestSceneGrid()
{
  const auto image = cslf::testing::MakeTestField(
    cslf::Layout(2, 16), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  std::string error;
  const auto field = cslf::Description::ReadFrom(image, error);
  CSLF_CHECK(field.has_value());
  if (!field)
  {
    return;
  }
  cslf::SceneGrid grid(*field);
  const cslf::ViewpointSamples samples(image);
  grid.Add(0, samples, 1);
  CSLF_CHECK(grid.Spread());
  const auto rings = grid.GetRings();
  grid.Add(0, samples, 1);
  CSLF_CHECK(!grid.Spread());
  CSLF_CHECK(grid.GetRings() == rings);
  grid.Add(0, samples);
  CSLF_CHECK(grid.Spread());
  CSLF_CHECK(grid.GetRings() != rings);
}
}

int TestCSLFResidency(int, char*[])
{
  TestLevels();
  TestFrustum();
  TestBlocks();
  TestRefinement();
  TestTurns();
  TestBudget();
  TestDamage();
  TestSceneGrid();
  TestBadDepths();
  return cslf::testing::Result();
}
