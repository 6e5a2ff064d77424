// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Clipping planes of mappers cut the imported geometry like the drawn one.
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfTestShapes.h"
#include "cslfTesting.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkGlyph3DMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace
{
using cslf::testing::ShapeComparison;

vtkSmartPointer<vtkMultiBlockDataSet> Import(vtkRenderer* renderer)
{
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  importer->Update();
  return importer->GetOutput();
}

unsigned int GetCount(vtkMultiBlockDataSet* scene)
{
  return scene->GetNumberOfBlocks() - 1; // the last one has the lights
}

vtkSmartPointer<vtkPlane> MakePlane(double x, double y, double z, double offset)
{
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetNormal(x, y, z);
  plane->SetOrigin(offset * x, offset * y, offset * z);
  return plane;
}

void CheckPicture(ShapeComparison& window, const char* name, double limit)
{
  const double share = window.Compare();
  std::cout << name << ": " << window.Covered << " pixels drawn, " << 100.0 * share
            << " % of them traced differently\n";
  CSLF_CHECK(window.Covered > 50 && share < limit);
}

void TestSurface(ShapeComparison& window)
{
  // A transformed cube with a corner cut off.
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(cube->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(0.1, 0.0, 0.0);
  actor->RotateX(20.0);
  window.ShowOnly(actor);
  const vtkSmartPointer<vtkPlane> plane = MakePlane(0.8, 0.6, 0.0, 0.2);
  mapper->AddClippingPlane(plane);
  CheckPicture(window, "A cut cube", 0.06);
  const auto cut = Import(window.Renderer);
  auto* block = vtkPolyData::SafeDownCast(cut->GetBlock(0));
  double lowest = 1.0;
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    double point[3];
    block->GetPoint(i, point);
    lowest = std::min(lowest, plane->EvaluateFunction(point));
  }
  CSLF_CHECK_NEAR(lowest, 0.0, 1e-6);

  // Each face has kept its normal, and texture coordinates continue.
  vtkDataArray* normals = block->GetPointData()->GetNormals();
  CSLF_CHECK(normals != nullptr);
  for (vtkIdType i = 0; normals && i < normals->GetNumberOfTuples(); ++i)
  {
    const double* normal = normals->GetTuple3(i);
    CSLF_CHECK_NEAR(std::max(std::abs(normal[0]), std::hypot(normal[1], normal[2])), 1.0, 1e-5);
  }
  vtkDataArray* coordinates = block->GetPointData()->GetTCoords();
  CSLF_CHECK(coordinates && coordinates->GetNumberOfTuples() == block->GetNumberOfPoints());

  // A change of the plane is detected; two planes; nothing left, without a warning.
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(window.Renderer);
  const vtkMTimeType time = importer->GetMTime();
  plane->SetOrigin(0.1, 0.0, 0.0);
  CSLF_CHECK(importer->GetMTime() > time);
  mapper->AddClippingPlane(MakePlane(0.0, -1.0, 0.0, 0.1));
  CheckPicture(window, "A cube cut twice", 0.08);
  plane->SetOrigin(5.0, 0.0, 0.0);
  CSLF_CHECK(GetCount(Import(window.Renderer)) == 0);

  // Edges are cut with the faces.
  plane->SetOrigin(0.0, 0.0, 0.0);
  actor->GetProperty()->EdgeVisibilityOn();
  const auto scene = Import(window.Renderer);
  CSLF_CHECK(GetCount(scene) == 2);
  auto* edges = vtkPolyData::SafeDownCast(scene->GetBlock(1));
  CSLF_CHECK(edges->GetNumberOfLines() > 0);
  double bounds[6];
  edges->GetCellsBounds(bounds);
  CSLF_CHECK(bounds[3] <= -0.1 + 1e-6);
}

void TestColorsOfCells()
{
  // Cells of several kinds keep their data.
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  const double places[][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 2, 0, 0 } };
  for (const double* place : places)
  {
    points->InsertNextPoint(place);
  }
  data->SetPoints(points);
  data->Allocate(4);
  const vtkIdType vertex[] = { 4 };
  const vtkIdType line[] = { 0, 1 };
  const vtkIdType square[] = { 0, 1, 2, 3 };
  data->InsertNextCell(VTK_VERTEX, 1, vertex);
  data->InsertNextCell(VTK_LINE, 2, line);
  data->InsertNextCell(VTK_QUAD, 4, square);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(10, 0, 0);
  colors->InsertNextTuple3(20, 0, 0);
  colors->InsertNextTuple3(30, 0, 0);
  data->GetCellData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->AddClippingPlane(MakePlane(1, 0, 0, 0.5));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const auto scene = Import(renderer);
  CSLF_CHECK(GetCount(scene) == 3);
  for (unsigned int i = 0; i < 3; ++i)
  {
    auto* block = vtkPolyData::SafeDownCast(scene->GetBlock(i));
    vtkDataArray* found = block->GetCellData()->GetScalars();
    CSLF_CHECK(found && found->GetNumberOfTuples() == block->GetNumberOfCells());
    CSLF_CHECK(found && found->GetComponent(0, 0) == 10.0 * (i + 1));
  }
}

void TestComposite(ShapeComparison& window)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 2; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(i == 0 ? -0.5 : 0.5, 0.0, 0.0);
    sphere->SetRadius(0.4);
    sphere->Update();
    blocks->SetBlock(i, sphere->GetOutput());
  }
  vtkNew<cslf::CompositeMapper> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->AddClippingPlane(MakePlane(0.0, 1.0, 0.0, 0.05));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  window.ShowOnly(actor);
  CheckPicture(window, "Cut blocks", 0.08);
}

void TestGlyphs(ShapeComparison& window)
{
  // Five spheres in a row: one is kept, one is cut, three are gone.
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < 5; ++i)
  {
    points->InsertNextPoint(0.4 * (i - 2), 0.0, 0.0);
    colors->InsertNextTuple3(i % 2 == 0 ? 255 : 0, 255, 0);
  }
  data->SetPoints(points);
  data->GetPointData()->SetScalars(colors);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.18);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(24);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(sphere->GetOutputPort());
  mapper->ScalingOff();
  mapper->AddClippingPlane(MakePlane(1, 0, 0, 0.43));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  window.ShowOnly(actor);
  CheckPicture(window, "Cut glyphs", 0.08);
  const auto scene = Import(window.Renderer);
  CSLF_CHECK(GetCount(scene) == 2);
  vtkDataArray* kept =
    scene->GetBlock(0)->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  CSLF_CHECK(kept && kept->GetNumberOfTuples() == 1);
  auto* cut = vtkPolyData::SafeDownCast(scene->GetBlock(1));
  CSLF_CHECK(cut && !cut->GetFieldData()->HasArray(vtkCSLFInstances::InstanceMatrix()));
  double bounds[6];
  cut->GetCellsBounds(bounds);
  CSLF_CHECK_NEAR(bounds[0], 0.43, 1e-6);
  vtkDataArray* ofCut = cut->GetPointData()->GetScalars();
  CSLF_CHECK(ofCut && ofCut->GetComponent(0, 0) == 0.0 && ofCut->GetComponent(0, 1) == 255.0);
}
}

int TestCSLFSceneImporterClipping(int, char*[])
{
  ShapeComparison window;
  TestSurface(window);
  TestColorsOfCells();
  TestComposite(window);
  TestGlyphs(window);
  return cslf::testing::Result();
}
