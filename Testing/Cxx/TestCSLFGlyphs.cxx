// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The glyphs of a mapper as instances, drawn by VTK and traced: their positions and colours.
#include "cslfTestShapes.h"
#include "cslfTesting.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkBitArray.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkConeSource.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
vtkSmartPointer<vtkPolyData> MakePoints()
{
  const double places[][3] = { { -2, -2, 0 }, { 2, -2, 0 }, { 2, 2, 0 }, { -2, 2, 0 },
    { 0, 0, 0 } };
  const double directions[][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 2, 0 }, { 1, 1, 1 },
    { 0, 0, 0 } };
  // Of the same rotations, as quaternions and as angles.
  const double half = std::sqrt(0.5);
  const double quaternions[][4] = { { 1, 0, 0, 0 }, { half, 0, 0, half }, { half, half, 0, 0 },
    { 0.5, 0.5, 0.5, 0.5 }, { half, 0, half, 0 } };
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("Directions");
  vectors->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> turns;
  turns->SetName("Quaternions");
  turns->SetNumberOfComponents(4);
  vtkNew<vtkDoubleArray> angles;
  angles->SetName("Angles");
  angles->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName("Sizes");
  sizes->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> values;
  values->SetName("Values");
  vtkNew<vtkBitArray> masks;
  masks->SetName("Masks");
  for (int i = 0; i < 5; ++i)
  {
    points->InsertNextPoint(places[i]);
    vectors->InsertNextTuple(directions[i]);
    turns->InsertNextTuple(quaternions[i]);
    angles->InsertNextTuple3(20.0 * i, 30.0, 50.0 * i);
    sizes->InsertNextTuple3(0.5 + 0.2 * i, 1.0, 1.5 - 0.2 * i);
    values->InsertNextValue(static_cast<float>(i));
    masks->InsertNextValue(i == 1 ? 0 : 1);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  for (vtkDataArray* array :
    { static_cast<vtkDataArray*>(vectors), static_cast<vtkDataArray*>(turns),
      static_cast<vtkDataArray*>(angles), static_cast<vtkDataArray*>(sizes),
      static_cast<vtkDataArray*>(values), static_cast<vtkDataArray*>(masks) })
  {
    data->GetPointData()->AddArray(array);
  }
  data->GetPointData()->SetActiveScalars("Values");
  return data;
}

/// Glyphs in VTK's window, and the same glyphs traced.
struct Glyphs
{
  vtkNew<vtkGlyph3DMapper> Mapper;
  vtkNew<vtkActor> Actor;
  cslf::testing::ShapeComparison Shapes;
  vtkRenderer* Renderer = this->Shapes.Renderer;

  Glyphs()
  {
    this->Mapper->SetInputData(MakePoints());
    vtkNew<vtkConeSource> cone;
    cone->SetResolution(12);
    cone->SetCenter(0.3, 0.1, 0.0); // so that rotations are visible
    this->Mapper->SetSourceConnection(cone->GetOutputPort());
    this->Mapper->SetScaleArray("Sizes");
    this->Mapper->SetOrientationArray("Directions");
    this->Mapper->SetMaskArray("Masks");
    this->Mapper->SetSourceIndexArray("Values");
    this->Mapper->SetScalarRange(0.0, 4.0);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->SetPosition(0.2, 0.1, 0.0);
    this->Renderer->AddActor(this->Actor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(1, 2, 10);
    camera->SetParallelScale(4.0);
    this->Renderer->ResetCameraClippingRange(-5, 5, -5, 5, -5, 5);
  }

  /// The share of the pixels where only one of the two pictures has a glyph, or both have other
  /// hues.
  double Compare()
  {
    const double share = this->Shapes.Compare();
    CSLF_CHECK(this->Shapes.Covered > 200);
    return share;
  }
};

void TestAgainstDrawing()
{
  Glyphs glyphs;
  vtkGlyph3DMapper* mapper = glyphs.Mapper;
  constexpr double edges = 0.15; // of the pixels lie on outlines
  mapper->ScalarVisibilityOff();
  CSLF_CHECK(glyphs.Compare() < edges); // directions
  mapper->SetOrientationModeToRotation();
  mapper->SetOrientationArray("Angles");
  CSLF_CHECK(glyphs.Compare() < edges);
  mapper->SetOrientationModeToQuaternion();
  mapper->SetOrientationArray("Quaternions");
  CSLF_CHECK(glyphs.Compare() < edges);
  mapper->SetScaleModeToScaleByVectorComponents();
  mapper->SetScaleFactor(1.5);
  CSLF_CHECK(glyphs.Compare() < edges);
  mapper->SetScaleModeToScaleByMagnitude();
  mapper->ClampingOn();
  mapper->SetRange(0.5, 2.5);
  CSLF_CHECK(glyphs.Compare() < edges);
  mapper->SetScaleModeToNoDataScaling();
  mapper->MaskingOn();
  CSLF_CHECK(glyphs.Compare() < edges);
  mapper->ScalarVisibilityOn();
  CSLF_CHECK(glyphs.Compare() < edges);
  vtkNew<vtkArrowSource> arrow;
  mapper->SetSourceConnection(1, arrow->GetOutputPort());
  mapper->SourceIndexingOn();
  CSLF_CHECK(glyphs.Compare() < edges);
}

void TestStructure()
{
  // One copy of the geometry, and as many instances as points that are not masked.
  Glyphs glyphs;
  glyphs.Mapper->MaskingOn();
  glyphs.Actor->GetProperty()->EdgeVisibilityOn();
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(glyphs.Renderer);
  importer->Update();
  vtkMultiBlockDataSet* output = importer->GetOutput();
  CSLF_CHECK(output->GetNumberOfBlocks() == 3);
  for (unsigned int i : { 0u, 1u })
  {
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(i));
    CSLF_CHECK(block && block->GetNumberOfPoints() > 0 && block->GetNumberOfPoints() < 100);
    vtkDataArray* places = block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
    CSLF_CHECK(places && places->GetNumberOfTuples() == 4);
    vtkDataArray* colors = block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceColor());
    CSLF_CHECK((colors != nullptr) == (i == 0));
  }
  const vtkMTimeType time = importer->GetMTime();
  glyphs.Mapper->SetScaleFactor(2.0);
  CSLF_CHECK(importer->GetMTime() > time);
}

/// The number of instances of the first block that the importer makes of glyphs, and its warnings.
vtkIdType CountInstances(Glyphs& glyphs, std::string& warnings)
{
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(glyphs.Renderer);
  vtkNew<vtkTest::ErrorObserver> messages;
  importer->AddObserver(vtkCommand::WarningEvent, messages);
  importer->Update();
  warnings = messages->GetWarningMessage();
  vtkDataArray* places = importer->GetOutput()->GetBlock(0)->GetFieldData()->GetArray(
    vtkCSLFInstances::InstanceMatrix());
  return places ? places->GetNumberOfTuples() : 0;
}

/// Only glyphs whose own values are NaN are left out.
void TestNotFinite()
{
  Glyphs glyphs;
  glyphs.Mapper->SetScaleModeToScaleByMagnitude();
  auto* points = vtkPolyData::SafeDownCast(glyphs.Mapper->GetInput());
  std::string warnings;
  for (const char* name : { "Directions", "Sizes", "Values" })
  {
    vtkDataArray* array = points->GetPointData()->GetArray(name);
    const double before = array->GetComponent(2, 0);
    array->SetComponent(2, 0, vtkMath::Nan());
    glyphs.Mapper->SetSourceIndexing(std::string(name) == "Values");
    CSLF_CHECK(CountInstances(glyphs, warnings) == 4);
    CSLF_CHECK(warnings.find("1 glyph(s)") != std::string::npos);
    array->SetComponent(2, 0, before);
  }
  CSLF_CHECK(CountInstances(glyphs, warnings) == 5);
  CSLF_CHECK(warnings.find("glyph(s)") == std::string::npos);
}

/// Arrays shorter than the points are not read.
void TestShortArrays()
{
  Glyphs glyphs;
  glyphs.Mapper->SetScaleModeToScaleByMagnitude();
  glyphs.Mapper->MaskingOn();
  glyphs.Mapper->SourceIndexingOn();
  auto* points = vtkPolyData::SafeDownCast(glyphs.Mapper->GetInput());
  for (const char* name : { "Directions", "Sizes", "Values", "Masks" })
  {
    points->GetPointData()->GetArray(name)->SetNumberOfTuples(3);
  }
  std::string warnings;
  CSLF_CHECK(CountInstances(glyphs, warnings) == 5);
  for (const char* name : { "Directions", "Sizes", "Values", "Masks" })
  {
    CSLF_CHECK(warnings.find("array " + std::string(name) + ", which") != std::string::npos);
  }
}

/// A pixel's width is relative to the diagonal of the scene, whatever the scale of the glyphs.
void TestWidths()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(3, 4, 12);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScaleModeToNoDataScaling();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLineWidth(4.0);
  actor->GetProperty()->EdgeVisibilityOn();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  for (double scale : { 0.01, 0.1, 10.0 })
  {
    vtkNew<vtkCubeSource> cube; // 0.02 wide in the world
    cube->SetXLength(0.02 / scale);
    cube->SetYLength(0.02 / scale);
    cube->SetZLength(0.02 / scale);
    mapper->SetSourceConnection(cube->GetOutputPort());
    mapper->SetScaleFactor(scale);
    importer->Update();
    vtkDataObject* edges = importer->GetOutput()->GetBlock(1);
    const double diagonal = std::sqrt(3.02 * 3.02 + 4.02 * 4.02 + 12.02 * 12.02);
    const double width = 2.0 * scale * vtkCSLFMaterial::GetLineRadius(edges);
    CSLF_CHECK_NEAR(width / (4.0 * importer->GetPixelSize() * diagonal), 1.0, 1e-6);
  }
}
}

int TestCSLFGlyphs(int, char*[])
{
  TestStructure();
  TestNotFinite();
  TestShortArrays();
  TestWidths();
  TestAgainstDrawing();
  return cslf::testing::Result();
}
