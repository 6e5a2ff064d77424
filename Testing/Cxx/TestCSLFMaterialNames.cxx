// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays of simulations with the names of version 0.1's materials, and arrays of version 0.1
// itself.
#include "PathTracing/Scene/cslfOldNames.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "cslfTesting.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTestErrorObserver.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace
{
void AddNumbers(vtkDataObject* data, const char* name, const std::vector<double>& numbers)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(numbers.size()));
  array->InsertNextTuple(numbers.data());
  data->GetFieldData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> MakePlane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  return plane->GetOutput();
}

/// Quantities that a simulation may write.
void AddSimulation(vtkDataObject* data)
{
  AddNumbers(data, "Roughness", { 0.001 });
  AddNumbers(data, "Opacity", { 0.25 });
  AddNumbers(data, "Metallic", { 1.0 });
  AddNumbers(data, "Emission", { 100.0, 100.0, 100.0 });
  AddNumbers(data, "Transmission", { 0.5 });
  AddNumbers(data, "IndexOfRefraction", { 1.33 });
}

/// The arrays of version 0.1: the same, without the prefix.
void MakeOld(vtkFieldData* fields)
{
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    const std::string name = fields->GetArrayName(i);
    CSLF_CHECK(name.compare(0, 5, "CSLF:") == 0);
    fields->GetAbstractArray(i)->SetName(name.substr(5).c_str());
  }
}

bool Contains(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

cslf::BuiltScene Build(vtkDataObject* data)
{
  cslf::SceneOptions options;
  options.FindScalars = [](vtkPolyData*, bool&) -> vtkDataArray* { return nullptr; };
  return cslf::BuildScene({ data }, options);
}

/// A simulation's arrays change nothing visible, wherever materials are read from.
void TestSimulation()
{
  const std::string plain = Build(MakePlane()).Fingerprint;
  auto plane = MakePlane();
  AddSimulation(plane);
  const cslf::BuiltScene built = Build(plane);
  CSLF_CHECK(built.Fingerprint == plain);
  CSLF_CHECK(Contains(built.Warning, "Roughness"));
  CSLF_CHECK(Contains(built.Warning, "CSLF:Roughness"));
  vtkNew<vtkMultiBlockDataSet> root;
  root->SetBlock(0, MakePlane());
  AddSimulation(root);
  CSLF_CHECK(Build(root).Fingerprint == plain);

  // The same beside our own arrays, and then there is no warning.
  auto colored = MakePlane();
  vtkCSLFMaterial::SetBaseColor(colored, 0.1, 0.2, 0.3);
  const std::string blue = Build(colored).Fingerprint;
  CSLF_CHECK(blue != plain);
  AddSimulation(colored);
  const cslf::BuiltScene mixed = Build(colored);
  CSLF_CHECK(mixed.Fingerprint == blue);
  CSLF_CHECK(mixed.Warning.empty());
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(colored) == 1.0);

  // Arrays of another form are not materials.
  auto series = MakePlane();
  AddNumbers(series, "Roughness", { 1.0, 2.0 });
  AddNumbers(series, "Temperature", { 300.0 });
  CSLF_CHECK(Build(series).Warning.empty());
  CSLF_CHECK(Build(series).Fingerprint == plain);
}

/// A window's property takes precedence over a simulation's arrays.
void TestRenderer()
{
  auto plane = MakePlane();
  AddSimulation(plane);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(plane);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetRoughness(0.6);
  actor->GetProperty()->SetMetallic(1.0);
  actor->GetProperty()->SetOpacity(0.9);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  vtkNew<vtkTest::ErrorObserver> messages;
  importer->AddObserver(vtkCommand::WarningEvent, messages);
  importer->Update();
  vtkDataObject* block = importer->GetOutput()->GetBlock(0);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(block) == 0.6);
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(block) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(block) == 0.9);
  CSLF_CHECK(vtkCSLFMaterial::GetTransmission(block) == 0.0);
  CSLF_CHECK(Contains(messages->GetWarningMessage(), "CSLF:Opacity"));

  // Our own arrays take precedence over the property, also if version 0.1 wrote them.
  for (const bool isOld : { false, true })
  {
    auto glass = MakePlane();
    vtkCSLFMaterial::SetBaseColor(glass, 1.0, 1.0, 1.0);
    vtkCSLFMaterial::SetTransmission(glass, 1.0);
    if (isOld)
    {
      MakeOld(glass->GetFieldData());
    }
    mapper->SetInputData(glass);
    importer->Update();
    block = importer->GetOutput()->GetBlock(0);
    CSLF_CHECK(vtkCSLFMaterial::GetTransmission(block) == 1.0);
    CSLF_CHECK(vtkCSLFMaterial::GetRoughness(block) == 0.6);
  }
}

/// A scene with all existing arrays.
vtkSmartPointer<vtkMultiBlockDataSet> MakeScene(bool isOld)
{
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  auto plane = MakePlane();
  vtkNew<vtkProperty> property;
  property->SetInterpolationToPBR();
  vtkCSLFMaterial::SetFromProperty(plane, property);
  plane->GetFieldData()->RemoveArray(vtkCSLFMaterial::VisibleSidesName()); // not of version 0.1
  vtkCSLFMaterial::SetEmission(plane, 1.0, 2.0, 3.0);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::memset(image->GetScalarPointer(), 99, 12);
  for (int slot = 0; slot < 4; ++slot)
  {
    vtkCSLFMaterial::SetTexture(plane, slot, image);
  }
  vtkNew<vtkMatrix4x4> matrix;
  const double green[4] = { 0.0, 1.0, 0.0, 1.0 };
  vtkCSLFInstances::AddInstance(plane, matrix, green);
  vtkNew<vtkSphereSource> source;
  source->Update();
  vtkSmartPointer<vtkPolyData> spheres = source->GetOutput();
  vtkCSLFMaterial::SetBaseColor(spheres, 0.5, 0.5, 0.5);
  vtkCSLFMaterial::SetPointRadius(spheres, 0.125);
  spheres->SetVerts(spheres->GetPolys());
  spheres->SetPolys(nullptr);
  vtkNew<vtkFloatArray> radii;
  radii->SetName(isOld ? "PointRadius" : vtkCSLFMaterial::PointRadiusName());
  for (vtkIdType i = 0; i < spheres->GetNumberOfPoints(); ++i)
  {
    radii->InsertNextValue(0.01f * static_cast<float>(i + 1));
  }
  spheres->GetPointData()->AddArray(radii);
  const double up[3] = { 0.0, 0.0, 1.0 };
  const double right[3] = { 1.0, 0.0, 0.0 };
  vtkCSLFLight::AddDirectionalLight(scene, up, right);
  vtkCSLFLight::AddPointLight(scene, up, right);
  vtkCSLFLight::AddSpotLight(scene, up, right, up, 30.0, 1.0);
  vtkCSLFLight::SetEnvironment(scene, up, right, up);
  vtkCSLFLight::SetEnvironmentImage(scene, image, up, right);
  scene->SetBlock(0, plane);
  scene->SetBlock(1, spheres);
  if (isOld)
  {
    MakeOld(plane->GetFieldData());
    MakeOld(spheres->GetFieldData());
    MakeOld(scene->GetFieldData());
  }
  return scene;
}

/// A scene of version 0.1 does not change, and gives one warning.
void TestOldScene()
{
  const cslf::BuiltScene built = Build(MakeScene(false));
  CSLF_CHECK(built.World != nullptr);
  CSLF_CHECK(built.Warning.empty());
  const auto scene = MakeScene(true);
  const cslf::BuiltScene old = Build(scene);
  CSLF_CHECK(old.Fingerprint == built.Fingerprint);
  CSLF_CHECK(old.HasEnvironment);
  for (const char* name : { "BaseColor", "CSLF:PointLightPosition", "CSLF:SpotLightCone",
         "CSLF:InstanceMatrix", "CSLF:NormalTextureLayout", "CSLF:PointRadius", "next version" })
  {
    CSLF_CHECK(Contains(old.Warning, name));
  }
  // The user's data is not changed.
  CSLF_CHECK(scene->GetFieldData()->HasArray("PointLightPosition"));
  CSLF_CHECK(!scene->GetFieldData()->HasArray(vtkCSLFLight::PointLightPosition()));

  // Arrays without a sign of ours are not read: a light without an intensity, a lone emission.
  auto plane = MakePlane();
  const std::string plain = Build(plane).Fingerprint;
  AddNumbers(plane, "PointLightPosition", { 0.0, 0.0, 1.0 });
  AddNumbers(plane, "EnvironmentRadiance", { 1.0, 1.0, 1.0 });
  AddNumbers(plane, "BaseColor", { 1.0 });
  CSLF_CHECK(Build(plane).Fingerprint == plain);
}

/// Files keep the names.
void TestFile()
{
  auto plane = MakePlane();
  vtkCSLFMaterial::SetRoughness(plane, 0.3);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(plane);
  writer->Write();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());
  reader->Update();
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(reader->GetOutput()) == 0.3);
  CSLF_CHECK(vtkCSLFMaterial::TextureName(-1) == nullptr);
  CSLF_CHECK(vtkCSLFMaterial::TextureLayoutName(4) == nullptr);
}
}

int TestCSLFMaterialNames(int, char*[])
{
  TestSimulation();
  TestRenderer();
  TestOldScene();
  TestFile();
  return cslf::testing::Result();
}
