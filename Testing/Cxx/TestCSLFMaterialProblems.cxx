// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Material arrays of a wrong type, size or place, and values out of range, are named in a warning.
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "cslfTesting.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTestErrorObserver.h>

#include <limits>
#include <string>
#include <vector>

namespace
{
vtkSmartPointer<vtkPolyData> MakePlane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  return plane->GetOutput();
}

void Add(
  vtkFieldData* fields, const char* name, const std::vector<double>& numbers, vtkIdType tuples = 1)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(numbers.size()));
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    array->InsertNextTuple(numbers.data());
  }
  fields->AddArray(array);
}

/// The tracer's warning.
std::string GetWarning(vtkDataObject* data)
{
  cslf::SceneOptions options;
  options.FindScalars = [](vtkPolyData*, bool&) { return nullptr; };
  return cslf::BuildScene({ data }, options).Warning;
}

bool Contains(const std::string& text, const std::string& part)
{
  const bool contains = text.find(part) != std::string::npos;
  if (!contains)
  {
    std::cerr << "\"" << text << "\" has no \"" << part << "\"\n";
  }
  return contains;
}

void TestUnused()
{
  auto plane = MakePlane();
  CSLF_CHECK(GetWarning(plane).empty());
  Add(plane->GetFieldData(), vtkCSLFMaterial::RoughnessName(), { 0.1, 0.2, 0.3 });
  vtkNew<vtkStringArray> text;
  text->SetName(vtkCSLFMaterial::BaseColorName());
  text->InsertNextValue("red");
  plane->GetFieldData()->AddArray(text);
  Add(plane->GetFieldData(), vtkCSLFMaterial::OpacityName(), { 0.5 }, 0);
  Add(plane->GetPointData(), vtkCSLFMaterial::EmissionName(), { 1.0 }, 4);
  Add(plane->GetPointData(), vtkCSLFMaterial::MetallicName(), { 1.0 }, 4);
  Add(plane->GetCellData(), vtkCSLFMaterial::EmissionName(), { 1.0, 2.0 }, 1);
  Add(plane->GetFieldData(), vtkCSLFMaterial::TextureName(vtkCSLFMaterial::BaseColorTexture),
    { 1.0, 1.0, 1.0 });
  const std::string warning = GetWarning(plane);
  CSLF_CHECK(Contains(warning, "CSLF:Roughness of 3 components (1 expected)"));
  CSLF_CHECK(Contains(warning, "CSLF:BaseColor of type vtkStringArray (numbers expected)"));
  CSLF_CHECK(Contains(warning, "CSLF:Opacity without tuples (1 expected)"));
  CSLF_CHECK(Contains(warning, "CSLF:Emission of points of 1 component (3 expected)"));
  CSLF_CHECK(Contains(warning, "CSLF:Metallic of points (expected in the field data)"));
  CSLF_CHECK(Contains(warning, "CSLF:Emission of cells of 2 components (3 expected)"));
  CSLF_CHECK(Contains(warning, "CSLF:BaseColorTexture (expected: unsigned chars"));

  // Those of the root of composite data, once for all blocks.
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, MakePlane());
  scene->SetBlock(1, MakePlane());
  Add(scene->GetFieldData(), vtkCSLFMaterial::BaseColorName(), { 0.5 });
  const std::string ofRoot = GetWarning(scene);
  CSLF_CHECK(Contains(ofRoot, "CSLF:BaseColor of 1 component (3 expected)"));
  CSLF_CHECK(ofRoot.find("BaseColor") == ofRoot.rfind("BaseColor"));
}

void TestOutOfRange()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto plane = MakePlane();
  Add(plane->GetFieldData(), vtkCSLFMaterial::RoughnessName(), { -0.5 });
  Add(plane->GetFieldData(), vtkCSLFMaterial::BaseColorName(), { 0.5, 2.0, nan });
  Add(plane->GetFieldData(), vtkCSLFMaterial::OpacityName(), { 1.0 });
  Add(plane->GetPointData(), vtkCSLFMaterial::EmissionName(), { 1.0, -1.0, nan }, 4);
  const std::string warning = GetWarning(plane);
  CSLF_CHECK(Contains(warning, "CSLF:Roughness of -0.5 is replaced by 0"));
  CSLF_CHECK(Contains(warning, "CSLF:BaseColor of 2 is replaced by 1"));
  CSLF_CHECK(Contains(warning, "CSLF:BaseColor of nan is replaced by 0.8"));
  CSLF_CHECK(
    Contains(warning, "8 value(s) of CSLF:Emission of points that are below 0 or not finite"));
  CSLF_CHECK(warning.find("Opacity") == std::string::npos);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(plane) == 0.0);
  double color[3];
  vtkCSLFMaterial::GetBaseColor(plane, color);
  CSLF_CHECK(color[0] == 0.5 && color[1] == 1.0 && color[2] == 0.8);

  // It is traced nevertheless.
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 0.0, 0.5);
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->AddObserver(vtkCommand::WarningEvent, observer);
  tracer->SetInputData(plane);
  tracer->SetCamera(camera);
  tracer->SetSize(4, 4);
  tracer->SetColorTypeToFloat();
  tracer->Update();
  CSLF_CHECK(observer->GetWarning());
  CSLF_CHECK(Contains(observer->GetWarningMessage(), "CSLF:Roughness of -0.5"));
  double range[2];
  tracer->GetOutput()->GetPointData()->GetScalars()->GetRange(range, -1);
  CSLF_CHECK(range[0] >= 0.0 && range[1] < 10.0);
}

void TestImported()
{
  auto plane = MakePlane();
  Add(plane->GetFieldData(), vtkCSLFMaterial::RoughnessName(), { 0.1, 0.2 });
  Add(plane->GetFieldData(), vtkCSLFMaterial::MetallicName(), { 0.5 });
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(plane);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->AddObserver(vtkCommand::WarningEvent, observer);
  importer->SetRenderer(renderer);
  importer->Update();
  CSLF_CHECK(
    Contains(observer->GetWarningMessage(), "CSLF:Roughness of 2 components (1 expected)"));
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(importer->GetOutput()->GetBlock(0)) == 0.5);
}
}

int TestCSLFMaterialProblems(int, char*[])
{
  TestUnused();
  TestOutOfRange();
  TestImported();
  return cslf::testing::Result();
}
