// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares depths of the field with VTK's picture of the same surfaces: in perspective and
// parallel, for both eyes of a stereo pair, rotated, stretched and mirrored, cut by the clipping
// range; large pictures drawn in tiles; and what a camera inside the cube sees.
#include "cslfTestView.h"
#include "cslfTesting.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkTestErrorObserver.h>
#include <vtkWindowToImageFilter.h>

#include <functional>
#include <iostream>
#include <string>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

constexpr double Tolerance = 0.06;

struct Scene
{
  View Drawn;
  vtkSmartPointer<vtkCSLFMapper> Mapper = cslf::testing::MakeTestMapper();
  vtkSmartPointer<vtkActor> Field = Drawn.Add(Mapper);
  vtkSmartPointer<vtkActor> Surfaces = Drawn.Add(cslf::testing::MakeSurfaceMapper());

  Picture Render(vtkActor* shown)
  {
    this->Field->SetVisibility(shown == this->Field);
    this->Surfaces->SetVisibility(shown == this->Surfaces);
    return this->Drawn.Render();
  }
};

void TestDepth(const char* what, const std::function<void(Scene&)>& arrange)
{
  Scene scene;
  scene.Mapper->SetPixelSamples(1); // like the surfaces
  arrange(scene);
  const Picture field = scene.Render(scene.Field);
  const Picture surfaces = scene.Render(scene.Surfaces);
  const double same =
    cslf::testing::CompareDepths(field, surfaces, scene.Drawn.GetCamera(), Tolerance);
  std::cout << what << ": " << 100.0 * same << " % of " << surfaces.CountDrawn()
            << " pixels agree\n";
  CSLF_CHECK(surfaces.CountDrawn() > 1000);
  // Partly covered pixels have no depth.
  CSLF_CHECK(field.CountDrawn() > 0.9 * surfaces.CountDrawn());
  CSLF_CHECK(same > 0.98);
}

void TestStereo(const char* what, void (vtkRenderWindow::*type)())
{
  TestDepth(what,
    [type](Scene& scene)
    {
      scene.Drawn.GetCamera()->SetEyeAngle(8.0);
      (scene.Drawn.Window->*type)();
      scene.Drawn.Window->StereoRenderOn();
    });
}

void Move(vtkActor* actor)
{
  actor->SetPosition(0.2, -0.1, 0.3);
  actor->RotateX(25.0);
  actor->RotateY(-30.0);
}

void TestTiles()
{
  View small(64);
  small.Add(cslf::testing::MakeTestMapper());
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(small.Window);
  grabber->SetScale(3);
  grabber->ReadFrontBufferOff();
  grabber->Update();
  View large(192);
  large.Add(cslf::testing::MakeTestMapper());
  const Picture whole = large.Render();
  Picture tiled = whole;
  vtkDataArray* pixels = grabber->GetOutput()->GetPointData()->GetScalars();
  CSLF_CHECK(pixels->GetNumberOfValues() == static_cast<vtkIdType>(whole.Colors.size()));
  for (std::size_t i = 0; i < tiled.Colors.size(); ++i)
  {
    const auto component = static_cast<int>(i % 3);
    tiled.Colors[i] = static_cast<unsigned char>(pixels->GetComponent(i / 3, component));
  }
  std::cout << "tiles: " << cslf::testing::ComparePictures(tiled, whole) << " dB\n";
  CSLF_CHECK(cslf::testing::ComparePictures(tiled, whole) > 45.0);
}

// In front of the sphere. The line of sight from outside the cube is free up to this point.
void TestInside()
{
  Scene scene;
  vtkNew<vtkTest::ErrorObserver> warnings;
  scene.Mapper->AddObserver(vtkCommand::WarningEvent, warnings);
  vtkCamera* camera = scene.Drawn.GetCamera();
  camera->SetPosition(0.1, 0.1, 0.9);
  camera->SetFocalPoint(0.2, 0.15, 0.1);
  camera->SetClippingRange(0.01, 4.0);
  const Picture field = scene.Render(scene.Field);
  const Picture surfaces = scene.Render(scene.Surfaces);
  const double same = cslf::testing::CompareDepths(field, surfaces, camera, Tolerance);
  std::cout << "inside: " << 100.0 * same << " % agree\n";
  CSLF_CHECK(same > 0.97);
  CSLF_CHECK(
    warnings->GetWarningMessage().find("inside the light field's cube") != std::string::npos);
  // Reported once.
  warnings->Clear();
  scene.Render(scene.Field);
  CSLF_CHECK(!warnings->GetWarning());

  // Between sphere and wall, with the sphere behind the eye: nothing of the sphere is drawn.
  camera->SetPosition(0.25, 0.15, -0.45);
  camera->SetFocalPoint(0.25, 0.15, -1.0);
  const Picture hidden = scene.Render(scene.Field);
  const std::size_t middle = hidden.Depths.size() / 2 + hidden.Width / 2;
  CSLF_CHECK(hidden.Depths[middle] == 1.0);
}

// The near plane cuts the sphere open. The far plane is in front of the wall and the cube's far
// faces.
void TestClippingRange()
{
  Scene scene;
  scene.Drawn.GetCamera()->SetPosition(0.25, 0.15, 5.0);
  scene.Drawn.GetCamera()->SetFocalPoint(0.25, 0.15, 0.0);
  const double radius = 0.45;
  scene.Drawn.GetCamera()->SetClippingRange(5.0 - 0.1 - 0.8 * radius, 5.3);
  const Picture field = scene.Render(scene.Field);
  const std::size_t middle = field.Depths.size() / 2 + field.Width / 2;
  CSLF_CHECK(field.Depths[middle] == 1.0);
  const int ring = field.CountDrawn();
  scene.Drawn.GetCamera()->SetClippingRange(1.0, 5.3);
  const Picture whole = scene.Render(scene.Field);
  const double area = static_cast<double>(ring) / whole.CountDrawn();
  std::cout << "near plane leaves " << area << " of the sphere\n";
  // All but the cap, seen from far: 1 - (1 - 0.8^2), less what the field covers in part.
  CSLF_CHECK(area > 0.5 && area < 0.66);
}
}

int TestCSLFMapperCamera(int, char*[])
{
  TestDepth("perspective", [](Scene&) {});
  TestDepth("parallel",
    [](Scene& scene)
    {
      scene.Drawn.GetCamera()->ParallelProjectionOn();
      scene.Drawn.GetCamera()->SetParallelScale(1.5);
    });
  TestStereo("left eye", &vtkRenderWindow::SetStereoTypeToLeft);
  TestStereo("right eye", &vtkRenderWindow::SetStereoTypeToRight);
  TestDepth("transformed",
    [](Scene& scene)
    {
      for (vtkActor* actor : { scene.Field.Get(), scene.Surfaces.Get() })
      {
        Move(actor);
        actor->SetScale(1.2, 0.7, 1.0);
      }
    });
  TestDepth("mirrored",
    [](Scene& scene)
    {
      for (vtkActor* actor : { scene.Field.Get(), scene.Surfaces.Get() })
      {
        Move(actor);
        actor->SetScale(-1.0, 1.0, 1.0);
      }
    });
  TestDepth("off axis", [](Scene& scene) { scene.Drawn.GetCamera()->SetWindowCenter(0.3, -0.2); });
  TestTiles();
  TestInside();
  TestClippingRange();
  return cslf::testing::Result();
}
