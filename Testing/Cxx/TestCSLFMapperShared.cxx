// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// One mapper in several actors, renderers, assemblies and props with levels of detail: the same
// pictures as with a mapper for each.
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <vtkAssembly.h>
#include <vtkHardwareSelector.h>
#include <vtkInformation.h>
#include <vtkLODProp3D.h>
#include <vtkMatrix4x4.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

#include <functional>
#include <iostream>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

/// Returns the mapper of an actor by its number.
using Mappers = std::function<vtkMapper*(int)>;

/// Actor number `index` at one of two places, turned by half a turn at the second: the camera sees
/// other faces of the cube there.
void Place(vtkProp3D* prop, int index)
{
  prop->SetScale(0.5);
  prop->RotateY(180.0 * index);
  prop->SetPosition(index == 0 ? -0.7 : 0.7, 0.0, 0.0);
}

/// In dB. The start of the search along a ray depends on the viewpoints that were loaded, for other
/// actors, too, so single pixels at silhouettes differ.
constexpr double Same = 45.0;

/// Checks some frames of a scene with one mapper against those with a mapper for each actor.
void Compare(
  const char* what, const std::function<void(View&, const Mappers&)>& build,
  const std::function<void(View&, int)>& prepare = [](View&, int) {}, int frames = 3)
{
  const vtkSmartPointer<vtkCSLFMapper> shared = cslf::testing::MakeTestMapper();
  const vtkSmartPointer<vtkCSLFMapper> own[] = { cslf::testing::MakeTestMapper(),
    cslf::testing::MakeTestMapper() };
  View first;
  View second;
  build(first, [&](int) { return shared; });
  build(second, [&](int index) { return own[index]; });
  for (int frame = 0; frame < frames; ++frame)
  {
    prepare(first, frame);
    prepare(second, frame);
    const Picture picture = first.Render();
    const Picture expected = second.Render();
    const double psnr = cslf::testing::ComparePictures(picture, expected);
    std::cout << what << ", frame " << frame << ": " << psnr << " dB of " << picture.CountDrawn()
              << " pixels\n";
    CSLF_CHECK(psnr > Same);
    CSLF_CHECK(picture.CountDrawn() > 500);
    CSLF_CHECK(std::abs(picture.CountDrawn() - expected.CountDrawn()) <= 2);
    CSLF_CHECK(shared->IsComplete());
  }
}

void AddTwoActors(View& view, const Mappers& mappers)
{
  for (int index = 0; index < 2; ++index)
  {
    Place(view.Add(mappers(index)), index);
  }
}

// Still, with a moving camera, with a moving actor, and with actors that come and go.
void TestActors()
{
  Compare(
    "two actors", AddTwoActors,
    [](View& view, int frame)
    {
      view.GetCamera()->Azimuth(frame == 2 ? 25.0 : 0.0);
      auto* actors = view.Renderer->GetActors();
      auto* first = vtkActor::SafeDownCast(actors->GetItemAsObject(0));
      auto* second = vtkActor::SafeDownCast(actors->GetItemAsObject(1));
      second->RotateY(frame == 3 || frame == 4 ? 25.0 : 0.0);
      first->SetVisibility(frame != 5);
      second->SetVisibility(frame != 6);
    },
    8);
}

void TestRenderers()
{
  Compare("two renderers",
    [](View& view, const Mappers& mappers)
    {
      view.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
      view.Add(mappers(0));
      vtkNew<vtkRenderer> other;
      other->SetViewport(0.5, 0.0, 1.0, 1.0);
      view.Window->AddRenderer(other);
      vtkNew<vtkActor> actor;
      actor->SetMapper(mappers(1));
      other->AddActor(actor);
      other->GetActiveCamera()->SetPosition(-2.0, 0.5, -5.0);
      other->GetActiveCamera()->SetClippingRange(1.0, 12.0);
    });
  Compare("stereo", AddTwoActors,
    [](View& view, int)
    {
      view.GetCamera()->SetEyeAngle(6.0);
      view.Window->SetStereoTypeToSplitViewportHorizontal();
      view.Window->StereoRenderOn();
    });
  Compare("two cameras in turn", AddTwoActors,
    [](View& view, int frame)
    {
      static vtkNew<vtkCamera> cameras[2];
      vtkCamera* camera = cameras[frame % 2];
      camera->SetPosition(frame % 2 ? -1.5 : 1.5, 0.5, frame % 2 ? -5.0 : 5.0);
      camera->SetClippingRange(1.0, 12.0);
      view.Renderer->SetActiveCamera(camera);
    });
}

vtkSmartPointer<vtkAssembly> MakePart(vtkMapper* mapper)
{
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  auto part = vtkSmartPointer<vtkAssembly>::New();
  part->AddPart(actor);
  return part;
}

// An actor at two places, if it has the only mapper.
void AddTwoAssemblies(View& view, const Mappers& mappers)
{
  const auto first = MakePart(mappers(0));
  const auto second = mappers(0) == mappers(1) ? first : MakePart(mappers(1));
  for (int index = 0; index < 2; ++index)
  {
    vtkNew<vtkAssembly> whole;
    whole->AddPart(index == 0 ? first : second);
    Place(whole, index);
    view.Renderer->AddActor(whole);
  }
}

void TestAssemblies()
{
  Compare("a part of two assemblies", AddTwoAssemblies,
    [](View& view, int frame) { view.GetCamera()->Azimuth(frame == 1 ? 20.0 : 0.0); });
  Compare("levels of detail",
    [](View& view, const Mappers& mappers)
    {
      for (int index = 0; index < 2; ++index)
      {
        vtkNew<vtkLODProp3D> levels;
        levels->AddLOD(mappers(index), 0.0);
        Place(levels, index);
        view.Renderer->AddViewProp(levels);
      }
    });
}

// A selection finds the right actor, and is no frame of its own.
void TestSelection()
{
  View view(128);
  const auto mapper = cslf::testing::MakeTestMapper();
  vtkSmartPointer<vtkActor> actors[2];
  for (int index = 0; index < 2; ++index)
  {
    actors[index] = view.Add(mapper);
    Place(actors[index], index);
  }
  view.GetCamera()->SetPosition(0.0, 0.0, 6.0);
  view.Render();
  const Picture picture = view.Render();
  for (int index = 0; index < 2; ++index)
  {
    const unsigned int x = index == 0 ? 41 : 86;
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(view.Renderer);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
    selector->SetArea(x, 64, x + 1, 65);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    CSLF_CHECK(selection->GetNumberOfNodes() == 1);
    CSLF_CHECK(selection->GetNumberOfNodes() == 1 &&
      selection->GetNode(0)->GetProperties()->Get(vtkSelectionNode::PROP()) == actors[index]);
    CSLF_CHECK(mapper->IsComplete());
  }
  CSLF_CHECK(cslf::testing::ComparePictures(view.Render(), picture) > 90.0);
}
}

int TestCSLFMapperShared(int, char*[])
{
  TestActors();
  TestRenderers();
  TestAssemblies();
  TestSelection();
  return cslf::testing::Result();
}
