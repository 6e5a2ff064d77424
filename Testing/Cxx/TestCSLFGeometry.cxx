// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The geometry of a field: hidden surfaces are left out, spheres, tubes and instances are
// tessellated, the budget holds, positions and colours are right, also at large coordinates, and
// nothing is made that nobody asks for.
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{
vtkSmartPointer<vtkPolyData> MakeSphere(const glm::dvec3& center, double radius, int sides)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(center.x, center.y, center.z);
  source->SetRadius(radius);
  source->SetThetaResolution(sides);
  source->SetPhiResolution(sides);
  source->Update();
  return source->GetOutput();
}

/// White from outside, without reflections.
void SetUp(vtkCSLFSampler* sampler, vtkDataObject* scene)
{
  sampler->SetInputDataObject(scene);
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(5);
  sampler->SetResolution(64);
  sampler->SetSamples(1);
  sampler->SetMaximumDepth(0);
}

glm::dvec3 GetPoint(vtkPolyData* data, vtkIdType number)
{
  double point[3];
  data->GetPoint(number, point);
  return { point[0], point[1], point[2] };
}

double GetNumber(vtkPolyData* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  CSLF_CHECK(array && array->GetNumberOfValues() == 1);
  return array ? array->GetTuple1(0) : -1.0;
}

/// A sphere within a closed box is hidden.
void TestHidden()
{
  vtkNew<vtkCubeSource> box;
  box->SetBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(box->GetOutputPort());
  both->AddInputData(MakeSphere(glm::dvec3(0.0), 0.5, 32));
  both->Update();
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, both->GetOutput());
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  // The 12 triangles of the box are large, so they are divided.
  CSLF_CHECK(geometry->GetNumberOfPolys() >= 48 && geometry->GetNumberOfPolys() < 400);
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 point = glm::abs(GetPoint(geometry, i));
    CSLF_CHECK_NEAR(std::max({ point.x, point.y, point.z }), 1.0, 1e-6);
  }
  CSLF_CHECK(GetNumber(geometry, cslf::GeometryLossName) == 0.0);
}

/// A sphere, a tube and instances of a triangle, each with its emission, far from the origin.
void TestShapes()
{
  const glm::dvec3 origin(5.0e5, 4.0e6, 200.0);
  vtkNew<vtkMultiBlockDataSet> scene;

  vtkNew<vtkPoints> centers;
  centers->SetDataTypeToDouble();
  centers->InsertNextPoint(origin.x, origin.y, origin.z);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 0 });
  vtkNew<vtkPolyData> ball;
  ball->SetPoints(centers);
  ball->SetVerts(vertices);
  vtkCSLFMaterial::SetPointRadius(ball, 1.0);
  scene->SetBlock(0, ball);

  vtkNew<vtkPoints> ends;
  ends->SetDataTypeToDouble();
  ends->InsertNextPoint(origin.x + 3.0, origin.y, origin.z);
  ends->InsertNextPoint(origin.x + 3.0, origin.y + 2.0, origin.z);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  vtkNew<vtkPolyData> tube;
  tube->SetPoints(ends);
  tube->SetLines(lines);
  vtkCSLFMaterial::SetLineRadius(tube, 0.5);
  scene->SetBlock(1, tube);

  for (unsigned int block = 0; block < 2; ++block)
  {
    auto* data = vtkPolyData::SafeDownCast(scene->GetBlock(block));
    vtkCSLFMaterial::SetBaseColor(data, 0.0, 0.0, 0.0);
    vtkCSLFMaterial::SetEmission(data, block == 0 ? 1.0 : 0.0, block == 1 ? 1.0 : 0.0, 0.0);
  }
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, scene);
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  vtkDataArray* colors = geometry->GetPointData()->GetArray("Color");
  CSLF_CHECK(geometry->GetNumberOfPolys() > 100 && colors);
  // An edge of the cube is about 5 long, so a texel about 0.04.
  int ofBall = 0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 point = GetPoint(geometry, i) - origin;
    const bool isOfBall = point.x < 2.0;
    ofBall += isOfBall ? 1 : 0;
    const glm::dvec3 nearest =
      isOfBall ? glm::dvec3(0.0) : glm::dvec3(3.0, std::clamp(point.y, 0.0, 2.0), 0.0);
    CSLF_CHECK_NEAR(glm::distance(point, nearest), isOfBall ? 1.0 : 0.5, 0.01);
    CSLF_CHECK(colors->GetComponent(i, isOfBall ? 0 : 1) == 255.0);
    CSLF_CHECK(colors->GetComponent(i, isOfBall ? 1 : 0) == 0.0);
    CSLF_CHECK(colors->GetComponent(i, 3) == 255.0);
  }
  CSLF_CHECK(ofBall > 50 && ofBall < geometry->GetNumberOfPoints() - 50);
  CSLF_CHECK(GetNumber(geometry, cslf::GeometryErrorName) < 0.01);
  CSLF_CHECK(GetNumber(geometry, cslf::GeometryLossName) == 0.0);
}

void TestInstances()
{
  const auto part = MakeSphere(glm::dvec3(0.0), 0.5, 12);
  std::vector<double> columns;
  vtkNew<vtkMatrix4x4> matrix;
  vtkNew<vtkCSLFSampler> sampler;
  for (int i = 0; i < 3; ++i)
  {
    matrix->SetElement(0, 3, 2.0 * i);
    // The last one is mirrored.
    matrix->SetElement(1, 1, i == 2 ? -1.0 : 1.0);
    vtkCSLFInstances::AddInstance(part, matrix);
  }
  SetUp(sampler, part);
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  int counts[3] = { 0, 0, 0 };
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 point = GetPoint(geometry, i);
    const int instance = std::clamp(static_cast<int>(std::lround(0.5 * point.x)), 0, 2);
    ++counts[instance];
    CSLF_CHECK_NEAR(glm::distance(point, glm::dvec3(2.0 * instance, 0.0, 0.0)), 0.5, 1e-5);
  }
  CSLF_CHECK(counts[0] > 20 && counts[1] == counts[0] && counts[2] == counts[0]);
}

/// A detailed sphere, simplified to fewer and fewer triangles.
void TestBudget()
{
  const auto sphere = MakeSphere(glm::dvec3(0.0), 1.0, 200);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, sphere);
  double error = 0.0;
  for (const int triangles : { 200000, 500, 50 })
  {
    sampler->SetGeometryTriangles(triangles);
    sampler->Update(1);
    vtkPolyData* geometry = sampler->GetGeometry();
    CSLF_CHECK(geometry->GetNumberOfPolys() > 4 && geometry->GetNumberOfPolys() <= triangles);
    const double next = GetNumber(geometry, cslf::GeometryErrorName);
    CSLF_CHECK(next >= error);
    error = next;
  }
  sampler->SetGeometryTriangles(0);
  sampler->Update(1);
  CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPolys() == 0);
}

/// The geometry is made alone if only it is wanted, and with the whole field, but not with parts of
/// it. It is made once.
void TestDemand()
{
  const auto sphere = MakeSphere(glm::dvec3(0.0), 1.0, 20);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, sphere);
  sampler->Update(1);
  CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPolys() > 0);
  CSLF_CHECK(sampler->GetOutput()->GetNumberOfPoints() == 0);
  sampler->Update();
  CSLF_CHECK(sampler->GetOutput()->GetNumberOfPoints() > 0);
  CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPolys() > 0);
  const vtkMTimeType time = sampler->GetOutput()->GetMTime();
  sampler->Update(1);
  CSLF_CHECK(sampler->GetOutput()->GetMTime() == time);

  vtkNew<vtkCSLFSampler> other;
  SetUp(other, sphere);
  other->UpdateInformation();
  int part[6];
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(other->GetOutputInformation(0), part);
  part[5] = part[4];
  other->UpdateExtent(part);
  CSLF_CHECK(other->GetOutput()->GetNumberOfPoints() > 0);
  CSLF_CHECK(other->GetGeometry()->GetNumberOfPolys() == 0);
  other->UpdateWholeExtent();
  const vtkIdType count = other->GetGeometry()->GetNumberOfPolys();
  CSLF_CHECK(count == sampler->GetGeometry()->GetNumberOfPolys());
  const double seconds = other->GetGeometrySeconds();
  const vtkMTimeType otherTime = other->GetOutput()->GetMTime();
  other->Update(1);
  CSLF_CHECK(other->GetOutput()->GetMTime() == otherTime);
  CSLF_CHECK(other->GetGeometrySeconds() == seconds);

  // None remains none.
  other->SetGeometryTriangles(0);
  other->Update();
  CSLF_CHECK(other->GetOutput()->GetNumberOfPoints() > 0);
  CSLF_CHECK(other->GetGeometry()->GetNumberOfPolys() == 0);
}
}

/// A rod in a flat cube stays round, and a thin one is there, although it is thinner than a tenth
/// of a texel.
void TestThin()
{
  const auto makeRod = [](double length, double radius)
  {
    vtkNew<vtkCylinderSource> rod;
    rod->SetHeight(length);
    rod->SetRadius(radius);
    rod->SetResolution(24);
    rod->Update();
    return vtkSmartPointer<vtkPolyData>(rod->GetOutput());
  };
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, makeRod(300.0, 0.5));
  sampler->AutomaticCubeOff();
  sampler->SetCubeCenter(0.0, 0.0, 0.0);
  sampler->SetCubeEdges(2.0, 340.0, 2.0);
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  CSLF_CHECK(geometry->GetNumberOfPolys() >= 40);
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 point = GetPoint(geometry, i);
    CSLF_CHECK(std::abs(point.y) > 149.9 || std::hypot(point.x, point.z) > 0.49);
  }

  vtkNew<vtkCSLFSampler> other;
  SetUp(other, makeRod(2.0, 0.001));
  other->Update(1);
  CSLF_CHECK(other->GetGeometry()->GetNumberOfPolys() > 0);
  CSLF_CHECK(GetNumber(other->GetGeometry(), cslf::GeometryLossName) < 0.01);
}

/// Invisible surfaces cost the others nothing; and where nothing is seen, there is a warning.
void TestUnseen()
{
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, MakeSphere(glm::dvec3(0.0), 1.0, 20));
  const auto hidden = MakeSphere(glm::dvec3(0.0), 1.5, 20);
  vtkCSLFMaterial::SetOpacity(hidden, 0.0);
  scene->SetBlock(1, hidden);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, scene);
  vtkNew<vtkTest::ErrorObserver> observer;
  sampler->AddObserver(vtkCommand::WarningEvent, observer);
  sampler->Update(1);
  CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPolys() > 100);
  CSLF_CHECK(!observer->GetWarning());

  vtkNew<vtkMultiBlockDataSet> far;
  far->SetBlock(0, MakeSphere(glm::dvec3(0.0), 1.0, 20));
  far->SetBlock(1, MakeSphere(glm::dvec3(1e6, 0.0, 0.0), 1.0, 20));
  sampler->SetInputDataObject(far);
  sampler->Update(1);
  CSLF_CHECK(observer->GetWarningMessage().find("hardly see any surface") != std::string::npos);
}

/// Surfaces that rays pass are not in the geometry: translucent ones, all or a part of their points
/// or instances, those with textures, and those that are visible from one side only.
void TestPassed()
{
  const auto sphere = MakeSphere(glm::dvec3(0.0), 1.0, 20);
  vtkCSLFMaterial::SetOpacity(sphere, 0.5);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, sphere);
  vtkNew<vtkTest::ErrorObserver> observer;
  sampler->AddObserver(vtkCommand::WarningEvent, observer);
  sampler->Update(1);
  CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPolys() == 0);
  CSLF_CHECK(observer->GetWarningMessage().find("no geometry") != std::string::npos);

  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, sphere);
  const auto oneSided = MakeSphere(glm::dvec3(3.0, 0.0, 0.0), 1.0, 20);
  vtkCSLFMaterial::SetVisibleSides(oneSided, vtkCSLFMaterial::FrontSide);
  scene->SetBlock(1, oneSided);
  // Opaque where y is above 0.
  const auto half = MakeSphere(glm::dvec3(6.0, 0.0, 0.0), 1.0, 21);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  for (vtkIdType i = 0; i < half->GetNumberOfPoints(); ++i)
  {
    colors->InsertNextTuple4(200, 100, 50, GetPoint(half, i).y > 0.0 ? 255 : 100);
  }
  half->GetPointData()->SetScalars(colors);
  scene->SetBlock(2, half);
  // The second instance is opaque.
  const auto cube = MakeSphere(glm::dvec3(0.0), 1.0, 8);
  for (const double alpha : { 0.5, 1.0 })
  {
    vtkNew<vtkMatrix4x4> place;
    place->SetElement(0, 3, alpha == 1.0 ? 12.0 : 9.0);
    const double color[4] = { 1.0, 1.0, 1.0, alpha };
    vtkCSLFInstances::AddInstance(cube, place, color);
  }
  scene->SetBlock(3, cube);
  sampler->SetInputDataObject(scene);
  observer->Clear();
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  double bounds[6];
  geometry->GetBounds(bounds);
  CSLF_CHECK_NEAR(bounds[0], 5.0, 0.05);
  CSLF_CHECK_NEAR(bounds[1], 13.0, 0.05);
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 point = GetPoint(geometry, i);
    CSLF_CHECK(point.x < 7.1 ? point.y > 0.0 : point.x > 10.9);
  }
  CSLF_CHECK(GetNumber(geometry, cslf::GeometryOpaqueLossName) < 0.01);
  CSLF_CHECK(!geometry->GetFieldData()->GetArray(cslf::GeometryLossName));
  CSLF_CHECK(cslf::IsOpaqueGeometry(geometry) && !cslf::IsCompleteGeometry(geometry) &&
    cslf::IsUsefulGeometry(geometry));
  CSLF_CHECK(
    observer->GetWarningMessage().find("because they are translucent") != std::string::npos);
}

int TestCSLFGeometry(int, char*[])
{
  TestPassed();
  TestThin();
  TestUnseen();
  TestHidden();
  TestShapes();
  TestInstances();
  TestBudget();
  TestDemand();
  return cslf::testing::Result();
}
