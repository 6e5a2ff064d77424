// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays of simulations with the names of parameters of materials.
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "cslfTesting.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

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
  CSLF_CHECK(built.Warning.empty());
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
  importer->Update();
  vtkDataObject* block = importer->GetOutput()->GetBlock(0);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(block) == 0.6);
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(block) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(block) == 0.9);
  CSLF_CHECK(vtkCSLFMaterial::GetTransmission(block) == 0.0);

  // Our own arrays take precedence over the property.
  auto glass = MakePlane();
  vtkCSLFMaterial::SetBaseColor(glass, 1.0, 1.0, 1.0);
  vtkCSLFMaterial::SetTransmission(glass, 1.0);
  mapper->SetInputData(glass);
  importer->Update();
  block = importer->GetOutput()->GetBlock(0);
  CSLF_CHECK(vtkCSLFMaterial::GetTransmission(block) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(block) == 0.6);
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
  TestFile();
  return cslf::testing::Result();
}
