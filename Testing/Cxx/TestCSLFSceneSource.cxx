// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes by name: their sizes and bounds, that they are always the same, and their light.
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFSceneSource.h"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkTestErrorObserver.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

namespace
{
/// What is counted in a scene, and a digest of its points and instances.
struct Sizes
{
  double Triangles = 0.0;
  double Instances = 0.0;
  double Spheres = 0.0;
  double Tubes = 0.0;
  std::uint64_t Digest = 14695981039346656037u;
  bool IsFinite = true;
};

/// Adds the values of an array to a digest (FNV-1a).
void Digest(vtkDataArray* array, Sizes& sizes)
{
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      const double value = array->GetComponent(i, c);
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      sizes.Digest = (sizes.Digest ^ bits) * 1099511628211u;
      sizes.IsFinite = sizes.IsFinite && std::isfinite(value);
    }
  }
}

double CountTriangles(vtkCellArray* cells)
{
  return static_cast<double>(cells->GetNumberOfConnectivityIds() - 2 * cells->GetNumberOfCells());
}

Sizes Measure(const char* name)
{
  vtkNew<vtkCSLFSceneSource> source;
  source->SetSceneName(name);
  source->Update();
  Sizes sizes;
  auto leaf = vtk::TakeSmartPointer(source->GetOutput()->NewTreeIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    auto* data = vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject());
    CSLF_CHECK(data);
    sizes.Triangles += CountTriangles(data->GetPolys()) + CountTriangles(data->GetStrips());
    sizes.Spheres += static_cast<double>(data->GetVerts()->GetNumberOfConnectivityIds());
    sizes.Tubes += static_cast<double>(
      data->GetLines()->GetNumberOfConnectivityIds() - data->GetLines()->GetNumberOfCells());
    if (data->GetPoints())
    {
      Digest(data->GetPoints()->GetData(), sizes);
    }
    if (vtkDataArray* matrices = data->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix()))
    {
      sizes.Instances += static_cast<double>(matrices->GetNumberOfTuples());
      Digest(matrices, sizes);
    }
  }
  return sizes;
}

/// Expects about as much as the documentation says, and the same again.
void TestSizes(const char* name, double triangles, double instances = 0.0, double spheres = 0.0)
{
  CSLF_CHECK(vtkCSLFSceneSource::HasScene(name));
  const Sizes first = Measure(name);
  const Sizes second = Measure(name);
  std::cout << name << ": " << first.Triangles << " triangles, " << first.Instances
            << " instances, " << first.Spheres << " spheres, " << first.Tubes << " tubes\n";
  CSLF_CHECK_NEAR(first.Triangles, triangles, 0.05 * triangles);
  CSLF_CHECK(first.Instances == instances);
  CSLF_CHECK(first.Spheres == spheres);
  CSLF_CHECK((first.Tubes > 0.0) == (spheres > 0.0));
  CSLF_CHECK(first.IsFinite);
  CSLF_CHECK(first.Digest == second.Digest);
}

void TestList()
{
  const int count = vtkCSLFSceneSource::GetNumberOfScenes();
  CSLF_CHECK(count >= 9);
  for (int i = 0; i < count; ++i)
  {
    CSLF_CHECK(vtkCSLFSceneSource::HasScene(vtkCSLFSceneSource::GetSceneName(i)));
    CSLF_CHECK(std::string(vtkCSLFSceneSource::GetSceneDescription(i)).back() == '.');
  }
  for (int i : { -1, count })
  {
    CSLF_CHECK(!vtkCSLFSceneSource::GetSceneName(i));
    CSLF_CHECK(!vtkCSLFSceneSource::GetSceneDescription(i));
  }
  CSLF_CHECK(!vtkCSLFSceneSource::HasScene(nullptr));
  CSLF_CHECK(!vtkCSLFSceneSource::HasScene("teapot"));
}

void TestEnvironment(const char* name, int mode)
{
  vtkNew<vtkCSLFSceneSource> source;
  source->SetSceneName(name);
  vtkNew<vtkCSLFEnvironment> environment;
  environment->SetModeToImage();
  source->SetUpEnvironment(environment);
  CSLF_CHECK(environment->GetMode() == mode);
}

void TestUnknown()
{
  vtkNew<vtkCSLFSceneSource> source;
  source->SetSceneName("teapot");
  vtkNew<vtkTest::ErrorObserver> errors;
  source->AddObserver(vtkCommand::ErrorEvent, errors);
  source->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  source->Update();
  CSLF_CHECK(errors->GetErrorMessage().find("There is no scene teapot.") != std::string::npos);
  vtkNew<vtkRenderer> renderer;
  CSLF_CHECK(!source->AddToRenderer(renderer));
}

void TestRenderer()
{
  vtkNew<vtkCSLFSceneSource> source;
  vtkNew<vtkRenderer> renderer;
  CSLF_CHECK(!source->AddToRenderer(renderer)); // the Cornell box
  source->SetSceneName("isosurfaces");
  CSLF_CHECK(source->AddToRenderer(renderer));
  CSLF_CHECK(!source->AddToRenderer(nullptr));
  CSLF_CHECK(renderer->GetViewProps()->GetNumberOfItems() == 1);
}
}

int TestCSLFSceneSource(int, char*[])
{
  TestList();
  TestSizes("cornell-box", 40.0);
  TestSizes("isosurfaces", 137778.0);
  TestSizes("streamlines", 400000.0);
  TestSizes("glyphs", 30.0, 20000.0);
  if (vtkCSLFSceneSource::HasScene("molecule"))
  {
    TestSizes("molecule", 0.0, 0.0, 5000.0);
  }
  TestSizes("terrain", 318402.0);
  TestSizes("assembly", 50000.0);
  TestSizes("turbulence", 2000000.0);
  TestSizes("pipes", 27500.0);
  TestEnvironment("cornell-box", vtkCSLFEnvironment::NoEnvironment);
  TestEnvironment("terrain", vtkCSLFEnvironment::NoEnvironment);
  TestEnvironment("isosurfaces", vtkCSLFEnvironment::ConstantEnvironment);
  TestEnvironment("assembly", vtkCSLFEnvironment::GradientEnvironment);
  TestEnvironment("teapot", vtkCSLFEnvironment::ImageEnvironment);
  TestUnknown();
  TestRenderer();
  return cslf::testing::Result();
}
