// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A field that shows the environment: around a sphere, every lookup draws the white sky without
// gaps. A geometry with cells of missing points, or points outside of the cube, is not used.
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkTestErrorObserver.h>

#include <limits>
#include <string>

namespace
{
constexpr int Size = 96;

/// The share of pixels that are neither white as the sky nor red as the sphere.
double CountOthers(const cslf::testing::Picture& picture)
{
  int others = 0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const int red = picture.Colors[3 * pixel];
    const int green = picture.Colors[3 * pixel + 1];
    others += red < 200 || (green > 50 && green < 200) ? 1 : 0;
  }
  return static_cast<double>(others) / (Size * Size);
}

void CheckError(vtkPolyData* geometry, vtkCSLFSampler* sampler)
{
  vtkNew<vtkCSLFMapper> mapper;
  vtkNew<vtkTest::ErrorObserver> observer;
  mapper->AddObserver(vtkCommand::WarningEvent, observer);
  mapper->SetInputConnection(sampler->GetOutputPort());
  mapper->SetGeometryData(geometry);
  cslf::testing::View view(Size);
  view.Add(mapper);
  view.Render();
  CSLF_CHECK(observer->GetWarning());
  CSLF_CHECK(observer->GetWarningMessage().find("not used") != std::string::npos);
}
}

int TestCSLFMapperEnvironment(int, char*[])
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(0.6);
  source->SetThetaResolution(48);
  source->SetPhiResolution(48);
  source->Update();
  vtkPolyData* sphere = source->GetOutput();
  vtkCSLFMaterial::SetBaseColor(sphere, 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(sphere, 1.0, 0.0, 0.0);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputDataObject(sphere);
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToConstant();
  sampler->GetEnvironment()->ShowOn();
  sampler->SetViewpoints(5);
  sampler->SetResolution(48);
  sampler->SetSamples(4);
  sampler->SetMaximumDepth(0);
  sampler->Update();

  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(0, sampler->GetOutputPort(0));
  mapper->SetInputConnection(1, sampler->GetOutputPort(1));
  mapper->SetPixelSamples(1); // others mix colours at outlines
  cslf::testing::View view(Size);
  view.Add(mapper);
  vtkCamera* camera = view.GetCamera();
  // Sees three faces of the cube.
  camera->SetPosition(2.4, 1.9, 2.6);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewAngle(15.0); // inside of the cube's picture
  for (const int lookup :
    { vtkCSLFMapper::BILINEAR, vtkCSLFMapper::DEPTH, vtkCSLFMapper::GEOMETRY })
  {
    mapper->SetLookup(lookup);
    const double others = CountOthers(view.Render());
    std::cout << "lookup " << lookup << ": " << 100.0 * others << " % of pixels are others\n";
    CSLF_CHECK(others < (lookup == vtkCSLFMapper::BILINEAR ? 0.3 : 0.03));
  }

  vtkNew<vtkPolyData> missing;
  missing->DeepCopy(sampler->GetGeometry());
  missing->GetPolys()->InsertNextCell({ 0, 1, missing->GetNumberOfPoints() });
  CheckError(missing, sampler);
  vtkNew<vtkPolyData> outside;
  outside->DeepCopy(sampler->GetGeometry());
  outside->GetPoints()->SetPoint(0, 7.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  CheckError(outside, sampler);
  return cslf::testing::Result();
}
