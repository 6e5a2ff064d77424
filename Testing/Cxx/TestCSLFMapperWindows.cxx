// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Graphics resources: one mapper in two windows with separate textures; windows that are finalised
// and used again or destroyed; actors that are removed or get another mapper. Windows that show
// nothing of the field any more have no incomplete picture.
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <vtkHardwareSelector.h>
#include <vtkSelection.h>

#include <functional>
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

/// A window whose picture is not complete: when streaming, the first never is.
struct Incomplete
{
  vtkSmartPointer<vtkCSLFMapper> Mapper = cslf::testing::MakeTestMapper();
  std::unique_ptr<View> Shown = std::make_unique<View>();
  vtkSmartPointer<vtkActor> Actor = Shown->Add(Mapper);

  Incomplete()
  {
    this->Mapper->StreamingOn();
    CSLF_CHECK(this->Mapper->IsComplete());
    this->Shown->Render();
    CSLF_CHECK(!this->Mapper->IsComplete());
  }
};

/// Whether nothing is incomplete after `change`.
bool IsCompleteAfter(const std::function<void(Incomplete&)>& change)
{
  Incomplete incomplete;
  change(incomplete);
  return incomplete.Mapper->IsComplete();
}

void TestCompleteness()
{
  CSLF_CHECK(IsCompleteAfter([](Incomplete& test) { test.Shown.reset(); }));
  CSLF_CHECK(IsCompleteAfter([](Incomplete& test) { test.Shown->Window->Finalize(); }));
  CSLF_CHECK(IsCompleteAfter(
    [](Incomplete& test) { test.Shown->Window->RemoveRenderer(test.Shown->Renderer); }));
  CSLF_CHECK(
    IsCompleteAfter([](Incomplete& test) { test.Shown->Renderer->RemoveActor(test.Actor); }));
  CSLF_CHECK(IsCompleteAfter(
    [](Incomplete& test) { test.Mapper->ReleaseGraphicsResources(test.Shown->Window); }));
  // The actor no longer has the mapper when its window is destroyed.
  CSLF_CHECK(IsCompleteAfter(
    [](Incomplete& test)
    {
      test.Actor->SetMapper(cslf::testing::MakeSurfaceMapper());
      CSLF_CHECK(!test.Mapper->IsComplete());
      test.Shown.reset();
      CSLF_CHECK(test.Mapper->GetTextureBytes() == 0);
    }));
  // The next frame does not contain the field.
  CSLF_CHECK(IsCompleteAfter(
    [](Incomplete& test)
    {
      test.Actor->SetMapper(cslf::testing::MakeSurfaceMapper());
      test.Shown->Render();
    }));
  CSLF_CHECK(IsCompleteAfter(
    [](Incomplete& test)
    {
      test.Actor->VisibilityOff();
      CSLF_CHECK(!test.Mapper->IsComplete());
      test.Shown->Render();
    }));
  CSLF_CHECK(IsCompleteAfter(
    [](Incomplete& test)
    {
      test.Shown->Renderer->DrawOff();
      test.Shown->Render();
    }));
  // Of two windows, one is complete.
  CSLF_CHECK(IsCompleteAfter(
    [](Incomplete& test)
    {
      test.Mapper->StreamingOff();
      View other;
      other.Add(test.Mapper);
      other.Render();
      CSLF_CHECK(!test.Mapper->IsComplete());
      test.Shown.reset();
      CSLF_CHECK(test.Mapper->IsComplete());
      other.Render();
    }));
  // Neither another size nor a selection that skips the actor completes a picture.
  CSLF_CHECK(!IsCompleteAfter([](Incomplete& test) { test.Shown->Window->SetSize(90, 60); }));
  CSLF_CHECK(!IsCompleteAfter(
    [](Incomplete& test)
    {
      test.Actor->PickableOff();
      vtkNew<vtkHardwareSelector> selector;
      selector->SetRenderer(test.Shown->Renderer);
      selector->SetArea(1, 1, 3, 3);
      vtkSmartPointer<vtkSelection>::Take(selector->Select());
    }));
}
}

int TestCSLFMapperWindows(int, char*[])
{
  TestTwoWindows();
  TestReleases();
  TestCompleteness();
  return cslf::testing::Result();
}
