// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Slats hide most of a chequered wall from every viewpoint. With the geometry, pictures are nearly
// those of the scene, and far better than with depth, also if some boxes are translucent; depths
// are exact, clipping planes cut the slats, and an eye between slats and wall sees the wall.
#include "cslfCodecTesting.h"
#include "cslfColor.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFRateControl.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropPicker.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWorldPointPicker.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
constexpr int Size = 160;
constexpr int Slats = 9;
constexpr int Fields = 6; // of the wall, along each side

void AddBox(vtkMultiBlockDataSet* scene, const double (&bounds)[6], const double (&color)[3],
  double opacity = 1.0)
{
  vtkNew<vtkCubeSource> source;
  source->SetBounds(bounds);
  source->Update();
  vtkPolyData* box = source->GetOutput();
  vtkCSLFMaterial::SetBaseColor(box, 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(box, color[0], color[1], color[2]);
  vtkCSLFMaterial::SetOpacity(box, opacity);
  scene->SetBlock(scene->GetNumberOfBlocks(), box);
}

vtkNew<vtkMultiBlockDataSet> MakeScene()
{
  vtkNew<vtkMultiBlockDataSet> scene;
  const double step = 1.8 / Fields;
  for (int i = 0; i < Fields * Fields; ++i)
  {
    const double x = -0.9 + step * (i % Fields);
    const double y = -0.9 + step * (i / Fields);
    const bool isOdd = (i % Fields + i / Fields) % 2 == 1;
    AddBox(scene, { x, x + step, y, y + step, -0.9, -0.85 },
      { isOdd ? 0.9 : 0.1, 0.15 * (i % Fields), 0.15 * (i / Fields) });
  }
  for (int i = 0; i < Slats; ++i)
  {
    const double y = -0.9 + 1.8 * i / Slats;
    AddBox(scene, { -0.9, 0.9, y, y + 0.9 / Slats, 0.3, 0.35 }, { 0.8, 0.8, 0.1 * i });
  }
  return scene;
}

cslf::testing::Picture Trace(vtkMultiBlockDataSet* scene, vtkCamera* camera)
{
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputDataObject(scene);
  tracer->GetEnvironment()->SetModeToNone();
  tracer->SetCamera(camera);
  tracer->SetSize(Size, Size);
  tracer->SetSamples(64);
  tracer->SetMaximumDepth(0);
  tracer->Update();
  auto* colors =
    vtkUnsignedCharArray::SafeDownCast(tracer->GetOutput()->GetPointData()->GetScalars());
  cslf::testing::Picture picture;
  picture.Width = Size;
  for (vtkIdType pixel = 0; pixel < colors->GetNumberOfTuples(); ++pixel)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      picture.Colors.push_back(colors->GetTypedComponent(pixel, channel));
    }
  }
  return picture;
}

cslf::testing::Picture DrawSurfaces(vtkMultiBlockDataSet* scene, vtkCamera* camera)
{
  cslf::testing::View view(Size);
  vtkNew<vtkAppendPolyData> all;
  for (unsigned int block = 0; block < scene->GetNumberOfBlocks(); ++block)
  {
    all->AddInputData(vtkPolyData::SafeDownCast(scene->GetBlock(block)));
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(all->GetOutputPort());
  view.Add(mapper);
  view.GetCamera()->DeepCopy(camera);
  return view.Render();
}

/// The mean of red in the middle of a picture.
double GetRed(const cslf::testing::Picture& picture)
{
  double sum = 0.0;
  for (int y = Size / 2 - 4; y < Size / 2 + 4; ++y)
  {
    for (int x = Size / 2 - 4; x < Size / 2 + 4; ++x)
    {
      sum += picture.Colors[3 * (y * Size + x)] / 64.0;
    }
  }
  return sum;
}

/// The point that a picker finds under a place of the scene, and that place, must be the same.
template <class Picker>
void CheckPick(cslf::testing::View& view, const double (&place)[3])
{
  view.Renderer->SetWorldPoint(place[0], place[1], place[2], 1.0);
  view.Renderer->WorldToDisplay();
  const double* pixel = view.Renderer->GetDisplayPoint();
  vtkNew<Picker> picker;
  picker->Pick(std::floor(pixel[0]), std::floor(pixel[1]), 0.0, view.Renderer);
  const double* found = picker->GetPickPosition();
  // Beside each other by less than a pixel, and exactly on the surface.
  CSLF_CHECK_NEAR(found[0], place[0], 0.015);
  CSLF_CHECK_NEAR(found[1], place[1], 0.015);
  CSLF_CHECK_NEAR(found[2], place[2], 0.0005);
}

/// On a slat, and on the wall between slats.
void CheckPicks(cslf::testing::View& view)
{
  for (const double z : { 0.35, -0.85 })
  {
    const double place[3] = { 0.1, z > 0.0 ? -0.05 : 0.05, z };
    CheckPick<vtkWorldPointPicker>(view, place);
    CheckPick<vtkPropPicker>(view, place);
  }
}

void SetUp(vtkCSLFSampler* sampler, vtkMultiBlockDataSet* scene, int samples)
{
  sampler->SetInputDataObject(scene);
  sampler->AutomaticCubeOff();
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(5);
  sampler->SetResolution(96);
  sampler->SetSamples(samples);
  sampler->SetMaximumDepth(0);
}

/// Translucent boxes beside and in front of the others are looked up by depth, the others by the
/// geometry, also in a coded file.
void TestTranslucent(const std::string& folder)
{
  const auto scene = MakeScene();
  AddBox(scene, { -0.8, -0.6, -0.4, -0.2, 0.6, 0.62 }, { 0.1, 0.6, 0.2 }, 0.7);
  AddBox(scene, { 0.92, 0.98, -0.6, 0.4, -0.2, 0.2 }, { 0.2, 0.2, 0.9 }, 0.4);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, scene, 8);
  vtkNew<vtkTest::ErrorObserver> observer;
  sampler->AddObserver(vtkCommand::WarningEvent, observer);
  sampler->Update();
  // Two boxes of twelve triangles each.
  CSLF_CHECK(observer->GetWarningMessage().find("without 24 of") != std::string::npos);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(0, sampler->GetOutputPort(0));
  encoder->SetInputConnection(1, sampler->GetOutputPort(1));
  const std::string fileName = folder + "/translucent.mp4";
  encoder->SetFileName(fileName.c_str());
  encoder->GetRateControl()->SetCRF(16.0);
  encoder->SetPreset("ultrafast");
  encoder->RestartOff();
  CSLF_CHECK(encoder->Write() == 1 && !encoder->GetActualDepthFromGeometry());
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());

  vtkNew<vtkCSLFMapper> mapper;
  cslf::testing::View view(Size);
  view.Add(mapper);
  view.GetCamera()->SetPosition(1.2, 0.9, 4.0);
  const auto truth = Trace(scene, view.GetCamera());
  mapper->SetInputConnection(0, sampler->GetOutputPort(0));
  mapper->SetInputConnection(1, sampler->GetOutputPort(1));
  double bounds[6];
  mapper->GetBounds(bounds);
  CSLF_CHECK(bounds[5] == 1.0); // the geometry lacks some boxes
  for (vtkAlgorithm* source :
    { static_cast<vtkAlgorithm*>(sampler), static_cast<vtkAlgorithm*>(decoder) })
  {
    mapper->SetInputConnection(0, source->GetOutputPort(0));
    mapper->SetInputConnection(1, source->GetOutputPort(1));
    mapper->SetLookupToGeometry();
    const double psnr = cslf::testing::ComparePictures(view.Render(), truth);
    mapper->SetLookupToDepth();
    const double other = cslf::testing::ComparePictures(view.Render(), truth);
    std::cout << "translucent, " << source->GetClassName() << ": geometry " << psnr << " dB, depth "
              << other << " dB\n";
    CSLF_CHECK(psnr > other + 1.0);
  }
}
}

int TestCSLFMapperGeometry(int argc, char* argv[])
{
  TestTranslucent(cslf::testing::MakeFolder(argc, argv, "MapperGeometry"));
  const auto scene = MakeScene();
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, scene, 4);

  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(0, sampler->GetOutputPort(0));
  mapper->SetInputConnection(1, sampler->GetOutputPort(1));
  CSLF_CHECK(mapper->GetLookup() == vtkCSLFMapper::GEOMETRY);
  cslf::testing::View view(Size);
  const auto actor = view.Add(mapper);
  vtkCamera* camera = view.GetCamera();
  double lowest = 99.0;
  for (const double height : { -2.0, 0.9, 2.5 })
  {
    camera->SetPosition(1.2, height, 4.0);
    const auto truth = Trace(scene, camera);
    mapper->SetLookupToGeometry();
    const auto picture = view.Render();
    const double psnr = cslf::testing::ComparePictures(picture, truth);
    mapper->SetPixelSamples(1);
    const auto surfaces = DrawSurfaces(scene, camera);
    CSLF_CHECK(cslf::testing::CompareDepths(surfaces, view.Render(), camera, 0.001) > 0.97);
    mapper->SetPixelSamples(2);
    mapper->SetLookupToDepth();
    const double other = cslf::testing::ComparePictures(view.Render(), truth);
    std::cout << "height " << height << ": geometry " << psnr << " dB, depth " << other << " dB\n";
    CSLF_CHECK(psnr > other + 1.0);
    lowest = std::min(lowest, psnr);
  }
  CSLF_CHECK(lowest > 29.0);
  double bounds[6];
  mapper->GetBounds(bounds);
  CSLF_CHECK(bounds[0] == -1.0 && bounds[5] == 1.0); // the cube
  mapper->SetLookupToGeometry();
  // Those of what is drawn.
  mapper->GetBounds(bounds);
  CSLF_CHECK_NEAR(bounds[0], -0.9, 0.01);
  CSLF_CHECK_NEAR(bounds[1], 0.9, 0.01);
  CSLF_CHECK_NEAR(bounds[4], -0.9, 0.01);
  CSLF_CHECK_NEAR(bounds[5], 0.35, 0.01);

  // Pickers find the surfaces where they are.
  camera->SetPosition(0.1, 0.0, 4.0);
  camera->SetFocalPoint(0.1, 0.0, 0.0);
  view.Render();
  CheckPicks(view);

  // What a plane cuts away does not hide the rest.
  camera->SetPosition(0.0, -0.05, 4.0);
  camera->SetFocalPoint(-0.15, -0.05, -0.85);
  const double slat = GetRed(view.Render());
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.0, 0.0, 0.0);
  plane->SetNormal(0.0, 0.0, -1.0);
  // Many planes, of which one cuts.
  for (int i = 0; i < 10; ++i)
  {
    vtkNew<vtkPlane> far;
    far->SetOrigin(0.0, 0.0, 10.0 + i);
    far->SetNormal(0.0, 0.0, -1.0);
    mapper->AddClippingPlane(far);
  }
  mapper->AddClippingPlane(plane);
  const double wall = GetRed(view.Render());
  mapper->RemoveAllClippingPlanes();
  CSLF_CHECK(slat > 220.0 && wall < 120.0);

  // Neither does what lies behind the eye.
  camera->SetPosition(0.0, -0.05, 0.2);
  camera->SetClippingRange(0.01, 5.0);
  CSLF_CHECK_NEAR(GetRed(view.Render()), 255.0 * cslf::LinearToSRGB(0.1), 1.5);

  // Without geometry, the lookup is that by depth.
  camera->SetPosition(1.2, 0.9, 4.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(1.0, 12.0);
  mapper->SetLookupToDepth();
  const auto byDepth = view.Render();
  mapper->SetLookupToGeometry();
  CSLF_CHECK(cslf::testing::ComparePictures(view.Render(), byDepth) < 40.0);
  // The same if most of it is lost.
  vtkNew<vtkPolyData> poor;
  poor->DeepCopy(sampler->GetGeometry());
  poor->GetFieldData()->GetArray("GeometryLoss")->SetComponent(0, 0, 0.3);
  mapper->SetInputDataObject(1, poor);
  CSLF_CHECK(cslf::testing::ComparePictures(view.Render(), byDepth) > 98.0);
  mapper->GetBounds(bounds);
  CSLF_CHECK(bounds[5] == 1.0);
  mapper->RemoveInputConnection(1, 0);
  CSLF_CHECK(cslf::testing::ComparePictures(view.Render(), byDepth) > 98.0);
  return cslf::testing::Result();
}
