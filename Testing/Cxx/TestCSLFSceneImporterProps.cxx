// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Props that choose, place or make their geometry in special ways, compared with what VTK draws:
// levels of detail, nested assemblies, followers, tensor glyphs.
#include "cslfTestShapes.h"
#include "cslfTesting.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkCommand.h>
#include <vtkCubeSource.h>
#include <vtkDefaultPass.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFollower.h>
#include <vtkLODProp3D.h>
#include <vtkLightsPass.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkShaderProperty.h>
#include <vtkSphereSource.h>
#include <vtkTensorGlyph.h>
#include <vtkTestErrorObserver.h>
#include <vtkToneMappingPass.h>
#ifdef CSLF_TEST_LOD
#include <vtkLODActor.h>
#include <vtkQuadricLODActor.h>
#endif

#include <iostream>
#include <string>

namespace
{
using cslf::testing::ShapeComparison;

/// Draws and traces one prop alone.
void Check(ShapeComparison& window, const char* name, vtkProp* prop)
{
  window.ShowOnly(prop);
  const double share = window.Compare();
  std::cout << name << ": " << 100.0 * share << " % of " << window.Covered << " pixels differ\n";
  CSLF_CHECK(window.Covered > 500 && share < 0.08); // pixels on the silhouette
}

/// A bar from the origin along x, red.
void SetBar(vtkActor* actor)
{
  vtkNew<vtkCubeSource> bar;
  bar->SetBounds(0.0, 0.7, -0.1, 0.2, -0.1, 0.1);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(bar->GetOutputPort());
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(1.0, 0.2, 0.2);
}

void TestAssembly(ShapeComparison& window)
{
  vtkNew<vtkActor> red;
  SetBar(red);
  red->SetOrientation(10.0, 20.0, 30.0);
  vtkNew<vtkActor> green;
  SetBar(green);
  green->GetProperty()->SetColor(0.2, 1.0, 0.2);
  green->SetOrigin(0.3, 0.0, 0.0);
  green->SetScale(0.5, 2.0, 1.0);
  vtkNew<vtkAssembly> inner;
  inner->AddPart(red);
  inner->AddPart(green);
  inner->SetOrigin(0.1, 0.2, 0.0);
  inner->SetOrientation(0.0, 0.0, 100.0);
  inner->SetPosition(0.1, -0.3, 0.2);
  vtkNew<vtkActor> blue;
  SetBar(blue);
  blue->GetProperty()->SetColor(0.2, 0.2, 1.0);
  blue->SetPosition(-0.5, -0.5, 0.3);
  vtkNew<vtkAssembly> outer;
  outer->AddPart(inner);
  outer->AddPart(blue);
  outer->SetScale(1.1, 0.8, 0.5);
  outer->RotateX(25.0);
  Check(window, "Nested assemblies", outer);
}

void TestFollower(ShapeComparison& window)
{
  vtkNew<vtkFollower> follower;
  SetBar(follower);
  follower->SetPosition(-0.3, 0.1, 0.0);
  follower->SetOrientation(0.0, 0.0, 40.0);
  follower->SetScale(1.0, 1.5, 1.0);
  follower->SetCamera(window.Renderer->GetActiveCamera());
  Check(window, "Follower", follower);
  vtkCamera* camera = window.Renderer->GetActiveCamera();
  camera->Azimuth(50.0);
  camera->Roll(20.0);
  camera->Elevation(20.0);
  Check(window, "Follower, seen from elsewhere", follower);
  camera->SetPosition(0.0, 0.0, 10.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
}

void TestLevels(ShapeComparison& window)
{
  vtkNew<vtkActor> bar;
  SetBar(bar);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(40);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkLODProp3D> levels;
  const int level = levels->AddLOD(bar->GetMapper(), bar->GetProperty(), 0.0);
  levels->AddLOD(mapper, 0.0);
  levels->SetOrientation(0.0, 0.0, 60.0);
  levels->SetScale(1.2);
  levels->AutomaticLODSelectionOff();
  levels->SetSelectedLODID(level);
  Check(window, "vtkLODProp3D", levels);
#ifdef CSLF_TEST_LOD
  vtkNew<vtkLODActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(0.2, 0.1, 0.0);
  Check(window, "vtkLODActor", actor);
  // It needs an interactor to be drawn.
  vtkNew<vtkQuadricLODActor> quadric;
  quadric->SetMapper(mapper);
  quadric->SetPosition(0.2, 0.1, 0.0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(quadric);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  importer->Update();
  auto* block = vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(0));
  CSLF_CHECK(block && block->GetNumberOfPolys() == sphere->GetOutput()->GetNumberOfPolys());
  CSLF_CHECK(block && block->GetBounds()[0] < -0.2 && block->GetBounds()[1] > 0.6);
#endif
}

/// Ellipsoids, one of them reflected, with colours by a scalar.
void TestTensorGlyphs(ShapeComparison& window)
{
  vtkNew<vtkPoints> places;
  vtkNew<vtkDoubleArray> tensors;
  tensors->SetNumberOfComponents(9);
  vtkNew<vtkDoubleArray> scalars;
  for (int i = 0; i < 3; ++i)
  {
    places->InsertNextPoint(0.6 * (i - 1), 0.1 * i, 0.0);
    const double shear = 0.2 * i;
    tensors->InsertNextTuple9(0.7, shear, 0.0, shear, i == 2 ? -1.1 : 1.1, 0.0, 0.0, 0.0, 0.5);
    scalars->InsertNextValue(i);
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(places);
  points->GetPointData()->SetTensors(tensors);
  points->GetPointData()->SetScalars(scalars);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(32);
  sphere->SetPhiResolution(32);
  vtkNew<vtkTensorGlyph> glyphs;
  glyphs->SetInputData(points);
  glyphs->SetSourceConnection(sphere->GetOutputPort());
  glyphs->SetScaleFactor(0.7);
  glyphs->ColorGlyphsOn();
  glyphs->SetColorModeToScalars();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(glyphs->GetOutputPort());
  mapper->SetScalarRange(0.0, 2.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  Check(window, "Tensor glyphs", actor);
}

/// Parts of an actor or a renderer that are not imported are named.
void TestNamed()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  vtkNew<vtkTest::ErrorObserver> messages;
  importer->AddObserver(vtkCommand::WarningEvent, messages);
  importer->SetRenderer(renderer);
  importer->Update();
  CSLF_CHECK(!messages->GetWarning());
  const auto check = [&](const char* name)
  {
    messages->Clear();
    importer->Update();
    CSLF_CHECK(messages->GetWarningMessage().find(name) != std::string::npos);
  };
  actor->ForceOpaqueOn();
  actor->GetProperty()->SetOpacity(0.5);
  check("ForceOpaque");
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::Color::Impl", true, "//VTK::Color::Impl\n", false);
  check("shader replacements");
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(3, 2, 0.1);
  actor->SetUserMatrix(matrix);
  check("projective matrices");
  // Passes that draw what a renderer without a pass draws are not named, others are, wherever they
  // are.
  vtkNew<vtkSequencePass> sequence;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(vtkNew<vtkDefaultPass>());
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  renderer->SetPass(camera);
  messages->Clear();
  importer->Update();
  CSLF_CHECK(messages->GetWarningMessage().find("render passes") == std::string::npos);
  vtkNew<vtkToneMappingPass> tones;
  tones->SetDelegatePass(vtkNew<vtkDefaultPass>());
  passes->AddItem(tones);
  renderer->Modified();
  check("render passes: vtkToneMappingPass (");
}

/// A renderer that shows no surface.
void TestNothingVisible()
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkCSLFViewTracer> tracer;
  vtkNew<vtkTest::ErrorObserver> messages;
  vtkNew<vtkTest::ErrorObserver> pipelineMessages;
  tracer->AddObserver(vtkCommand::ErrorEvent, messages);
  tracer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineMessages);
  tracer->SetRenderer(renderer);
  tracer->SetCamera(renderer->GetActiveCamera());
  tracer->Update();
  CSLF_CHECK(messages->GetErrorMessage().find("No visible surface") != std::string::npos);
  CSLF_CHECK(messages->GetErrorMessage().find("triangles") == std::string::npos);
}
}

int TestCSLFSceneImporterProps(int, char*[])
{
  ShapeComparison window;
  TestAssembly(window);
  TestFollower(window);
  TestLevels(window);
  TestTensorGlyphs(window);
  TestNamed();
  TestNothingVisible();
  return cslf::testing::Result();
}
