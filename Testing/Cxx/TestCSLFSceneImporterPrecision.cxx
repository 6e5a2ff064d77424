// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Actors far from the origin: their points keep the precision that their own coordinates have, and
// terrain at UTM coordinates in metres gives the same light field as the same terrain at the
// origin.
#include "cslfTesting.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkDataSetMapper.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRectilinearGrid.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

namespace
{
constexpr double Easting = 5e5;
constexpr double Northing = 4e6;

// The precision of a double at such coordinates, with some rounding.
constexpr double Tolerance = 3e-9;

vtkSmartPointer<vtkPolyData> MakeSphere()
{
  vtkNew<vtkSphereSource> source; // of radius 0.5, in floats
  source->SetThetaResolution(64);
  source->SetPhiResolution(64);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkPolyData> ImportFirst(vtkRenderer* renderer)
{
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  importer->Update();
  auto* block = vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(0));
  CSLF_CHECK(block && block->GetNumberOfPoints() > 0);
  return block ? vtkSmartPointer<vtkPolyData>(block) : vtkSmartPointer<vtkPolyData>::New();
}

int CountDifferentY(vtkPolyData* data)
{
  std::set<double> values;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    values.insert(data->GetPoint(i)[1]);
  }
  return static_cast<int>(values.size());
}

/// Checks that points are those of another object, placed by a matrix.
void CheckPlaced(vtkPolyData* placed, vtkPolyData* source, vtkMatrix4x4* matrix)
{
  CSLF_CHECK(placed->GetNumberOfPoints() == source->GetNumberOfPoints());
  double largest = 0.0;
  for (vtkIdType i = 0; i < source->GetNumberOfPoints(); ++i)
  {
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    double found[3];
    source->GetPoint(i, point);
    matrix->MultiplyPoint(point, point);
    placed->GetPoint(i, found);
    for (int axis = 0; axis < 3; ++axis)
    {
      largest = std::max(largest, std::abs(found[axis] - point[axis]));
    }
  }
  CSLF_CHECK_NEAR(largest, 0.0, Tolerance);
}

void TestActors()
{
  const vtkSmartPointer<vtkPolyData> sphere = MakeSphere();
  const int before = CountDifferentY(sphere);
  vtkNew<vtkRenderer> renderer;
  auto actor = MakeActor(sphere);
  actor->SetPosition(Easting, Northing, 0.0);
  renderer->AddActor(actor);
  vtkSmartPointer<vtkPolyData> placed = ImportFirst(renderer);
  std::cout << "A float sphere of " << before << " values of y has " << CountDifferentY(placed)
            << " far away.\n";
  CSLF_CHECK(sphere->GetNumberOfPoints() == 3970 && CountDifferentY(placed) > 0.95 * before);
  CheckPlaced(placed, sphere, actor->GetMatrix());

  // A reflection, in a nested assembly whose matrices partly cancel each other.
  actor->SetPosition(-1e6, 0.25, 0.125);
  actor->SetScale(-1.0, 2.0, 1.0);
  renderer->RemoveActor(actor);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(actor);
  inner->SetPosition(1e6, Northing, 3.0);
  inner->RotateZ(30.0);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->SetPosition(Easting, 0.0, -1.0);
  renderer->AddActor(outer);
  vtkNew<vtkMatrix4x4> matrix;
  vtkMatrix4x4::Multiply4x4(outer->GetMatrix(), inner->GetMatrix(), matrix);
  vtkMatrix4x4::Multiply4x4(matrix, actor->GetMatrix(), matrix);
  placed = ImportFirst(renderer);
  CheckPlaced(placed, sphere, matrix);
  vtkDataArray* normals = placed->GetPointData()->GetNormals();
  CSLF_CHECK(normals != nullptr);
  for (vtkIdType i = 0; normals && i < normals->GetNumberOfTuples(); i += 97)
  {
    double normal[3];
    normals->GetTuple(i, normal);
    const double length =
      std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    CSLF_CHECK_NEAR(length, 1.0, 1e-5);
  }

  // Lines of its edges.
  actor->GetProperty()->SetRepresentationToWireframe();
  CSLF_CHECK(CountDifferentY(ImportFirst(renderer)) > 0.9 * CountDifferentY(placed));
}

void TestGlyphs()
{
  // Points of a float cloud, which the actor places far away.
  vtkNew<vtkGlyph3DMapper> mapper;
  const vtkSmartPointer<vtkPolyData> places = MakeSphere();
  mapper->SetInputData(places);
  vtkNew<vtkSphereSource> source;
  mapper->SetSourceConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(Easting, Northing, 0.0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const vtkSmartPointer<vtkPolyData> glyphs = ImportFirst(renderer);
  vtkDataArray* matrices = glyphs->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  CSLF_CHECK(matrices && matrices->GetNumberOfTuples() == places->GetNumberOfPoints());
  for (vtkIdType i = 0; matrices && i < matrices->GetNumberOfTuples(); ++i)
  {
    CSLF_CHECK_NEAR(matrices->GetComponent(i, 7), Northing + places->GetPoint(i)[1], Tolerance);
  }
}

/// The surface of data with implicit coordinates.
void TestGrids()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 5, 5);
  image->SetOrigin(Easting, Northing, 0.125);
  image->SetSpacing(0.01, 0.01, 0.01);
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(5, 5, 5);
  vtkNew<vtkDoubleArray> coordinates[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < 5; ++i)
    {
      coordinates[axis]->InsertNextValue(image->GetOrigin()[axis] + 0.01 * i);
    }
  }
  grid->SetXCoordinates(coordinates[0]);
  grid->SetYCoordinates(coordinates[1]);
  grid->SetZCoordinates(coordinates[2]);
  for (vtkDataSet* data : { static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(grid) })
  {
    vtkNew<vtkDataSetMapper> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    const vtkSmartPointer<vtkPolyData> surface = ImportFirst(renderer);
    CSLF_CHECK(CountDifferentY(surface) >= 5);
    double bounds[6];
    surface->GetBounds(bounds);
    CSLF_CHECK_NEAR(bounds[2], Northing, Tolerance);
    CSLF_CHECK_NEAR(bounds[3], Northing + 0.04, Tolerance);
    CSLF_CHECK_NEAR(bounds[5], 0.165, Tolerance);
  }
}

/// Hills, 100 metres wide, in double points about the origin. Their grid is not integral, because
/// floats would keep integers.
vtkSmartPointer<vtkPolyData> MakeTerrain()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->SetOrigin(-50.3, -50.3, 0.0);
  plane->SetPoint1(50.3, -50.3, 0.0);
  plane->SetPoint2(-50.3, 50.3, 0.0);
  plane->SetResolution(60, 60);
  plane->Update();
  auto terrain = vtkSmartPointer<vtkPolyData>::New();
  terrain->DeepCopy(plane->GetOutput());
  vtkDataArray* normals = terrain->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < terrain->GetNumberOfPoints(); ++i)
  {
    double point[3];
    terrain->GetPoint(i, point);
    const double x = 0.2 * point[0];
    const double y = 0.15 * point[1];
    point[2] = 6.0 * std::sin(x) * std::cos(y);
    terrain->GetPoints()->SetPoint(i, point);
    const double slope[2] = { 1.2 * std::cos(x) * std::cos(y), -0.9 * std::sin(x) * std::sin(y) };
    const double length = std::sqrt(slope[0] * slope[0] + slope[1] * slope[1] + 1.0);
    normals->SetTuple3(i, -slope[0] / length, -slope[1] / length, 1.0 / length);
  }
  return terrain;
}

/// A terrain of double points that was moved.
vtkSmartPointer<vtkPolyData> Move(vtkPolyData* data, double x, double y, bool toFloats = false)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(x, y, 0.0);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(data);
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(
    toFloats ? vtkAlgorithm::SINGLE_PRECISION : vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return filter->GetOutput();
}

void Prepare(vtkCSLFSampler* sampler)
{
  sampler->SetViewpoints(2);
  sampler->SetResolution(32);
  sampler->SetSamples(16);
}

/// The PSNR between the colours of two fields or pictures.
double Compare(vtkImageAlgorithm* first, vtkImageAlgorithm* second)
{
  first->Update();
  second->Update();
  vtkDataArray* a = first->GetOutput()->GetPointData()->GetScalars();
  vtkDataArray* b = second->GetOutput()->GetPointData()->GetScalars();
  CSLF_CHECK(a && b && a->GetNumberOfValues() == b->GetNumberOfValues());
  double sum = 0.0;
  double brightness = 0.0;
  for (vtkIdType i = 0; a && b && i < a->GetNumberOfValues(); ++i)
  {
    const int components = a->GetNumberOfComponents();
    const auto component = static_cast<int>(i % components);
    const double value = a->GetComponent(i / components, component);
    const double error = value - b->GetComponent(i / components, component);
    sum += error * error;
    brightness += value;
  }
  CSLF_CHECK(brightness > 20.0 * a->GetNumberOfValues());
  return sum > 0.0 ? 10.0 * std::log10(255.0 * 255.0 * a->GetNumberOfValues() / sum) : 99.0;
}

void CheckField(const char* name, vtkCSLFSampler* near, vtkCSLFSampler* far)
{
  Prepare(far);
  const double psnr = Compare(near, far);
  std::cout << name << ": PSNR of the field " << psnr << " dB\n";
  CSLF_CHECK(psnr >= 50.0);
}

void TestTerrain()
{
  const vtkSmartPointer<vtkPolyData> terrain = MakeTerrain();
  vtkNew<vtkCSLFSampler> near;
  near->SetInputData(terrain);
  Prepare(near);
  near->Update();

  vtkNew<vtkCSLFSampler> asDoubles;
  asDoubles->SetInputData(Move(terrain, Easting, Northing));
  CheckField("Double points", near, asDoubles);

  // Float points about the origin, and an actor that places them.
  vtkNew<vtkCSLFSampler> byRenderer[3];
  vtkNew<vtkRenderer> renderers[3];
  const vtkSmartPointer<vtkPolyData> floats = Move(terrain, 0.0, 0.0, true);
  auto here = MakeActor(floats);
  renderers[0]->AddActor(here);
  byRenderer[0]->SetRenderer(renderers[0]);
  Prepare(byRenderer[0]);
  byRenderer[0]->Update();
  auto placed = MakeActor(floats);
  placed->SetPosition(Easting, Northing, 0.0);
  renderers[1]->AddActor(placed);
  byRenderer[1]->SetRenderer(renderers[1]);
  CheckField("Actor with a position", byRenderer[0], byRenderer[1]);
  auto shifted = MakeActor(floats);
  vtkNew<vtkTransform> user;
  user->Translate(Easting, Northing, 0.0);
  user->RotateZ(0.0);
  shifted->SetUserTransform(user);
  renderers[2]->AddActor(shifted);
  byRenderer[2]->SetRenderer(renderers[2]);
  CheckField("Actor with a transform", byRenderer[0], byRenderer[2]);

  // A view of each.
  vtkNew<vtkCSLFViewTracer> views[2];
  for (int i = 0; i < 2; ++i)
  {
    const double x = i == 0 ? 0.0 : Easting;
    const double y = i == 0 ? 0.0 : Northing;
    vtkNew<vtkCamera> camera;
    camera->SetFocalPoint(x, y, 0.0);
    camera->SetPosition(x + 70.0, y - 80.0, 60.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetClippingRange(10.0, 300.0);
    views[i]->SetRenderer(renderers[i]);
    views[i]->SetCamera(camera);
    views[i]->SetSize(96, 64);
    views[i]->SetSamples(16);
  }
  const double psnr = Compare(views[0], views[1]);
  std::cout << "PSNR of the view " << psnr << " dB\n";
  CSLF_CHECK(psnr >= 50.0);
}
}

int TestCSLFSceneImporterPrecision(int, char*[])
{
  TestActors();
  TestGlyphs();
  TestGrids();
  TestTerrain();
  return cslf::testing::Result();
}
