// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Slices, tiles, nodes and texels.
#include "cslfLayout.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <set>

namespace
{
void TestIndices(const cslf::Layout& layout)
{
  CSLF_CHECK(layout.IsValid());
  const int side = layout.GetViewpoints();
  std::set<int> slices;
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    for (int j = 0; j < side; ++j)
    {
      for (int i = 0; i < side; ++i)
      {
        const int slice = layout.SliceOf({ face, i, j });
        CSLF_CHECK(slice == (face * side + j) * side + i);
        const cslf::Viewpoint viewpoint = layout.ViewpointOf(slice);
        CSLF_CHECK(viewpoint.Face == face && viewpoint.I == i && viewpoint.J == j);
        slices.insert(slice);
      }
    }
  }
  CSLF_CHECK(static_cast<int>(slices.size()) == layout.GetSlices());
  CSLF_CHECK(*slices.begin() == 0 && *slices.rbegin() == layout.GetSlices() - 1);

  int extent[6];
  layout.GetWholeExtent(extent);
  CSLF_CHECK(extent[1] + 1 == 5 * layout.GetResolution());
  CSLF_CHECK(extent[3] + 1 == layout.GetResolution());
  CSLF_CHECK(extent[5] + 1 == 6 * side * side);
}

void TestTiles()
{
  for (int entry = 0; entry < cslf::FaceCount; ++entry)
  {
    int expected = 0;
    for (int exit = 0; exit < cslf::FaceCount; ++exit)
    {
      if (exit != entry)
      {
        CSLF_CHECK(cslf::TileOf(entry, exit) == expected);
        CSLF_CHECK(cslf::ExitFaceOf(entry, expected) == exit);
        ++expected;
      }
    }
  }
}

void TestNodes(const cslf::Layout& layout)
{
  const int side = layout.GetViewpoints();
  CSLF_CHECK(layout.NodeCoordinate(0) == -1.0);
  CSLF_CHECK(layout.NodeCoordinate(side - 1) == 1.0);
  for (double coordinate = -1.0; coordinate <= 1.0; coordinate += 0.01)
  {
    const cslf::NodeBracket bracket = layout.FindNodes(coordinate);
    CSLF_CHECK(bracket.Lower >= 0 && bracket.Upper == bracket.Lower + 1 && bracket.Upper < side);
    const double lower = layout.NodeCoordinate(bracket.Lower);
    const double upper = layout.NodeCoordinate(bracket.Upper);
    CSLF_CHECK_NEAR(lower + bracket.Weight * (upper - lower), coordinate, 1e-12);
    CSLF_CHECK(bracket.Weight > -1e-12 && bracket.Weight < 1.0 + 1e-12);
  }
  CSLF_CHECK(layout.FindNodes(-5.0).Weight == 0.0);
  CSLF_CHECK(layout.FindNodes(5.0).Weight == 1.0);
}

void TestTexels(const cslf::Layout& layout)
{
  const int resolution = layout.GetResolution();
  double sum = 0.0;
  for (int p = 0; p < resolution; ++p)
  {
    sum += layout.TexelCoordinate(p);
  }
  CSLF_CHECK_NEAR(sum, 0.0, 1e-9);
  CSLF_CHECK_NEAR(layout.TexelCoordinate(0), -1.0 + 1.0 / resolution, 1e-12);
}

void TestSharedViewpoints(const cslf::Layout& layout)
{
  // The grids of neighbouring faces meet on the edges.
  const int side = layout.GetViewpoints();
  const auto find = [&](int notOnFace, const glm::dvec3& position)
  {
    for (int slice = 0; slice < layout.GetSlices(); ++slice)
    {
      const cslf::Viewpoint viewpoint = layout.ViewpointOf(slice);
      if (viewpoint.Face != notOnFace &&
        glm::distance(layout.ViewpointPosition(viewpoint), position) < 1e-12)
      {
        return true;
      }
    }
    return false;
  };
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    for (int k = 0; k < side; ++k)
    {
      for (const cslf::Viewpoint& edge :
        { cslf::Viewpoint{ face, k, 0 }, cslf::Viewpoint{ face, k, side - 1 },
          cslf::Viewpoint{ face, 0, k }, cslf::Viewpoint{ face, side - 1, k } })
      {
        CSLF_CHECK(find(face, layout.ViewpointPosition(edge)));
      }
    }
  }
}

void TestInvalid()
{
  CSLF_CHECK(!cslf::Layout(1, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(0, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(-3, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(4, 0).IsValid());
  CSLF_CHECK(!cslf::Layout(100000, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(9, { 0, 4 }, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(9, { 1, 8 }, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(9, { 0, 4, 4, 8 }, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(9, {}, 16).IsValid());
  CSLF_CHECK(!cslf::Layout(10, { 0, 3, 4, 9 }, 16).IsValid());
}
}

int TestCSLFLayout(int, char*[])
{
  TestTiles();
  for (const cslf::Layout& layout : { cslf::Layout(2, 16), cslf::Layout(5, 7), cslf::Layout(8, 100),
         cslf::Layout(9, { 0, 4, 8 }, 3), cslf::Layout(10, { 0, 3, 6, 9 }, 4),
         cslf::Layout(10, { 0, 4, 5, 9 }, 4) })
  {
    TestIndices(layout);
    TestNodes(layout);
    TestTexels(layout);
    TestSharedViewpoints(layout);
  }
  TestInvalid();
  return cslf::testing::Result();
}
