// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Graphics resources: one mapper in two windows with separate textures; windows that are finalised
// and used again or destroyed; actors that are removed or get another mapper.
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <memory>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

// Except for the rounding of single values.
bool AreSame(const Picture& a, const Picture& b)
{
  return a.CountDrawn() == b.CountDrawn() && cslf::testing::ComparePictures(a, b) > 70.0;
}

void TestTwoWindows()
{
  const auto mapper = cslf::testing::MakeTestMapper();
  View first;
  first.Add(mapper);
  const Picture picture = first.Render();
  const vtkTypeInt64 bytes = mapper->GetTextureBytes();
  CSLF_CHECK(bytes > 0);
  {
    View second;
    second.Add(mapper);
    CSLF_CHECK(AreSame(second.Render(), picture));
    CSLF_CHECK(mapper->GetTextureBytes() == 2 * bytes);
    // Each keeps its own, in any order.
    CSLF_CHECK(AreSame(first.Render(), picture));
    CSLF_CHECK(AreSame(second.Render(), picture));
    CSLF_CHECK(mapper->GetTextureBytes() == 2 * bytes);
    mapper->SetLookupToBilinear();
    const Picture bilinear = second.Render();
    CSLF_CHECK(AreSame(first.Render(), bilinear));
    mapper->SetLookupToDepth();
  }
  CSLF_CHECK(mapper->GetTextureBytes() == bytes);
  CSLF_CHECK(AreSame(first.Render(), picture));
}

void TestReleases()
{
  const auto mapper = cslf::testing::MakeTestMapper();
  auto view = std::make_unique<View>();
  const auto actor = view->Add(mapper);
  const Picture picture = view->Render();
  const vtkTypeInt64 bytes = mapper->GetTextureBytes();

  view->Window->Finalize();
  CSLF_CHECK(mapper->GetTextureBytes() == 0);
  CSLF_CHECK(AreSame(view->Render(), picture));
  CSLF_CHECK(mapper->GetTextureBytes() == bytes);

  view->Renderer->RemoveActor(actor);
  CSLF_CHECK(mapper->GetTextureBytes() == 0);
  CSLF_CHECK(view->Render().GetMean() == 0.0);
  view->Renderer->AddActor(actor);
  CSLF_CHECK(AreSame(view->Render(), picture));

  // The old mapper is destroyed while the window stays.
  auto passing = cslf::testing::MakeTestMapper();
  actor->SetMapper(passing);
  CSLF_CHECK(AreSame(view->Render(), picture));
  actor->SetMapper(mapper);
  passing = nullptr;
  CSLF_CHECK(AreSame(view->Render(), picture));

  // A window is destroyed while the mapper stays.
  view.reset();
  CSLF_CHECK(mapper->GetTextureBytes() == 0);
  View other;
  other.Add(mapper);
  CSLF_CHECK(AreSame(other.Render(), picture));
}
}

int TestCSLFMapperWindows(int, char*[])
{
  TestTwoWindows();
  TestReleases();
  return cslf::testing::Result();
}
