// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSheetScenes.h"

#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfSheetParts.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkClipClosedSurface.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkConeSource.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkDoubleArray.h>
#include <vtkElevationFilter.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightKit.h>
#include <vtkLineSource.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>
#include <vtkTexturedSphereSource.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

#ifdef CSLF_TEST_MOLECULES
#include <vtkMolecule.h>
#include <vtkOpenGLMoleculeMapper.h>
#endif

#include <cmath>
#include <utility>

namespace cslf
{
namespace testing
{
namespace
{
/// A smooth sphere of radius 0.5.
vtkSmartPointer<vtkActor> AddSphere(vtkRenderer* renderer, double x, double y = 0.0)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkSmartPointer<vtkActor> actor = AddActor(renderer, sphere);
  actor->SetPosition(x, y, 0.0);
  return actor;
}

/// The same with perspective.
void LookFromNear(vtkRenderer* renderer, double x, double y, double z, double reach = 1.1)
{
  vtkCamera* camera = Look(renderer, x, y, z, reach);
  camera->ParallelProjectionOff();
  camera->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(reach / camera->GetDistance())));
}

vtkSmartPointer<vtkLight> AddLight(vtkRenderer* renderer, double x, double y, double z)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToSceneLight();
  light->SetPosition(x, y, z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(light);
  return light;
}

void BuildPhong(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkProperty* dull = AddSphere(renderer, -0.55, 0.5)->GetProperty();
  dull->SetColor(0.85, 0.35, 0.25);
  vtkProperty* flat = AddSphere(renderer, 0.55, 0.5)->GetProperty();
  flat->SetInterpolationToFlat();
  flat->SetColor(0.3, 0.6, 0.3);
  for (const double white : { 0.0, 1.0 })
  {
    vtkProperty* shiny = AddSphere(renderer, 1.1 * white - 0.55, -0.5)->GetProperty();
    shiny->SetColor(0.2, 0.35, 0.65);
    shiny->SetSpecular(0.4);
    shiny->SetSpecularPower(20.0);
    if (white > 0.0)
    {
      shiny->SetSpecularColor(1.0, 1.0, 1.0);
    }
  }
  Look(renderer, 0.0, 0.0, 1.0);
}

void BuildPhysical(vtkRenderer* renderer)
{
  AddLight(renderer, 2.0, 3.0, 10.0);
  for (int i = 0; i < 9; ++i)
  {
    vtkProperty* property =
      AddSphere(renderer, 1.15 * (i % 3 - 1), 1.15 * (1 - i / 3))->GetProperty();
    property->SetInterpolationToPBR();
    property->SetColor(0.9, 0.55, 0.25);
    property->SetMetallic(0.5 * (i / 3));
    property->SetRoughness(0.3 + 0.3 * (i % 3));
  }
  LookFromNear(renderer, 0.0, 0.0, 1.0, 1.75);
}

void BuildTextures(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  // The image twice across, turned by 20 degrees.
  vtkNew<vtkPlaneSource> plane;
  vtkSmartPointer<vtkActor> tiles = AddActor(renderer, plane);
  tiles->SetPosition(0.0, 0.52, 0.0);
  tiles->SetScale(2.0, 1.0, 1.0);
  vtkNew<vtkTexture> letters;
  letters->SetInputData(MakeLetters());
  letters->InterpolateOn();
  vtkNew<vtkTransform> turn;
  turn->RotateZ(20.0);
  turn->Scale(2.0, 2.0, 1.0);
  letters->SetTransform(turn);
  tiles->SetTexture(letters);

  // Numbers through a lookup table.
  vtkNew<vtkImageData> numbers;
  numbers->SetDimensions(64, 32, 1);
  numbers->AllocateScalars(VTK_FLOAT, 1);
  for (int i = 0; i < 64 * 32; ++i)
  {
    numbers->GetPointData()->GetScalars()->SetComponent(
      i, 0, std::sin(0.3 * (i % 64)) + 0.05 * (i / 64));
  }
  vtkNew<vtkLookupTable> table;
  table->SetRange(-1.0, 2.5);
  table->SetHueRange(0.65, 0.05);
  table->Build(); // textures leave these to their users
  vtkNew<vtkTexture> mapped;
  mapped->SetInputData(numbers);
  mapped->SetLookupTable(table);
  mapped->SetColorModeToMapScalars();
  vtkNew<vtkTexturedSphereSource> globe;
  globe->SetThetaResolution(64);
  globe->SetPhiResolution(32);
  vtkSmartPointer<vtkActor> ball = AddActor(renderer, globe);
  ball->SetTexture(mapped);
  ball->SetPosition(-0.5, -0.55, 0.0);
  ball->RotateX(-70.0);
  vtkNew<vtkCubeSource> cube;
  vtkSmartPointer<vtkActor> box = AddActor(renderer, cube);
  vtkNew<vtkTexture> plain;
  plain->SetInputData(MakeLetters());
  plain->InterpolateOn();
  box->SetTexture(plain);
  box->SetPosition(0.55, -0.55, 0.0);
  box->SetScale(0.65);
  box->RotateX(25.0);
  box->RotateY(-35.0);
  Look(renderer, 0.0, 0.0, 1.0);
}

/// A wavy sheet with a number at each point, which depends on the position in [-1,1]^2.
template <typename Function>
vtkSmartPointer<vtkPolyData> MakeWaves(const Function& function)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.0, -1.0, 0.0);
  plane->SetPoint1(1.0, -1.0, 0.0);
  plane->SetPoint2(-1.0, 1.0, 0.0);
  plane->SetResolution(96, 96);
  plane->Update();
  vtkSmartPointer<vtkPolyData> data = plane->GetOutput();
  vtkNew<vtkDoubleArray> values;
  values->SetName("Values");
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double point[3];
    data->GetPoint(i, point);
    values->InsertNextValue(function(point[0], point[1]));
    double normal[3] = { 0.45 * std::sin(3.0 * point[0]), 0.45 * std::sin(3.0 * point[1]), 1.0 };
    vtkMath::Normalize(normal);
    normals->InsertNextTuple(normal);
    point[2] = 0.15 * (std::cos(3.0 * point[0]) + std::cos(3.0 * point[1]));
    data->GetPoints()->SetPoint(i, point);
  }
  data->GetPointData()->SetScalars(values);
  data->GetPointData()->SetNormals(normals);
  return data;
}

void BuildTable(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkSmartPointer<vtkActor> actor = AddData(renderer,
    MakeWaves([](double x, double y)
      { return std::hypot(x - 0.1, y) < 0.3 ? vtkMath::Nan() : 60.0 * x + 25.0 * y + 50.0; }));
  vtkNew<vtkLookupTable> table;
  table->SetHueRange(0.66, 0.0);
  table->SetNanColor(0.5, 0.5, 0.5, 1.0);
  table->UseBelowRangeColorOn();
  table->SetBelowRangeColor(1.0, 0.0, 1.0, 1.0);
  table->UseAboveRangeColorOn();
  table->SetAboveRangeColor(1.0, 1.0, 1.0, 1.0);
  actor->GetMapper()->SetLookupTable(table);
  actor->GetMapper()->SetScalarRange(0.0, 100.0);
  actor->GetMapper()->InterpolateScalarsBeforeMappingOn();
  Look(renderer, 0.0, 0.0, 1.0, 1.05);
}

void BuildLogarithms(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkSmartPointer<vtkActor> actor = AddData(
    renderer, MakeWaves([](double x, double y) { return std::pow(10.0, 1.5 + x + 0.5 * y); }));
  vtkNew<vtkLookupTable> table;
  table->SetScaleToLog10();
  table->SetNumberOfTableValues(12);
  table->SetHueRange(0.1, 0.75);
  actor->GetMapper()->SetLookupTable(table);
  actor->GetMapper()->SetScalarRange(1.0, 1000.0);
  actor->GetMapper()->InterpolateScalarsBeforeMappingOn();
  Look(renderer, 0.0, -0.5, 1.0);
}

void BuildColors(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  // Numbers of points, mapped there; colours of cells.
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(96);
  vtkNew<vtkElevationFilter> height;
  height->SetInputConnection(sphere->GetOutputPort());
  height->SetLowPoint(0.0, -0.5, 0.0);
  height->SetHighPoint(0.0, 0.5, 0.0);
  AddActor(renderer, height)->SetPosition(-0.45, 0.45, 0.0);
  vtkNew<vtkCylinderSource> cylinder;
  cylinder->SetResolution(12);
  cylinder->CappingOff();
  cylinder->Update();
  vtkNew<vtkPolyData> sides;
  sides->ShallowCopy(cylinder->GetOutput());
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < sides->GetNumberOfCells(); ++i)
  {
    colors->InsertNextTuple3(i % 3 == 0 ? 230 : 60, i % 3 == 1 ? 200 : 90, i % 3 == 2 ? 220 : 50);
  }
  sides->GetCellData()->SetScalars(colors);
  vtkSmartPointer<vtkActor> actor = AddData(renderer, sides);
  actor->SetPosition(0.45, -0.4, 0.0);
  actor->RotateX(30.0);
  Look(renderer, 0.0, 0.0, 1.0);
}

/// A white ball and a cone that do not shadow each other.
void AddTargets(vtkRenderer* renderer)
{
  AddSphere(renderer, -0.45, 0.45)->GetProperty()->SetColor(0.9, 0.9, 0.9);
  vtkNew<vtkConeSource> cone;
  cone->SetResolution(48);
  cone->SetDirection(0.0, 1.0, 0.0);
  vtkSmartPointer<vtkActor> actor = AddActor(renderer, cone);
  actor->GetProperty()->SetColor(0.9, 0.75, 0.4);
  actor->SetPosition(0.45, -0.4, 0.0);
}

void BuildHeadlight(vtkRenderer* renderer)
{
  AddTargets(renderer);
  LookFromNear(renderer, 0.0, 0.4, 1.0);
  AddHeadlight(renderer);
}

void BuildLightKit(vtkRenderer* renderer)
{
  AddTargets(renderer);
  Look(renderer, 0.0, 0.4, 1.0);
  vtkNew<vtkLightKit> kit;
  kit->AddLightsToRenderer(renderer);
}

void BuildAttenuated(vtkRenderer* renderer)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(8, 8);
  AddActor(renderer, plane)->GetProperty()->SetColor(0.9, 0.9, 0.9);
  vtkSmartPointer<vtkLight> light = AddLight(renderer, -0.2, 0.1, 0.35);
  light->PositionalOn();
  light->SetConeAngle(90.0);
  light->SetAttenuationValues(0.3, 0.5, 2.0);
  light->SetDiffuseColor(1.0, 0.85, 0.6);
  Look(renderer, 0.0, 0.0, 1.0, 0.52);
}

void BuildSpotLight(vtkRenderer* renderer)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(8, 8);
  AddActor(renderer, plane)->GetProperty()->SetColor(0.9, 0.9, 0.9);
  vtkSmartPointer<vtkLight> light = AddLight(renderer, 0.5, 0.4, 1.5);
  light->PositionalOn();
  light->SetConeAngle(14.0);
  light->SetExponent(20.0);
  light->SetDiffuseColor(0.6, 0.9, 1.0);
  Look(renderer, 0.0, 0.0, 1.0, 0.52);
}

void BuildSceneLights(vtkRenderer* renderer)
{
  AddTargets(renderer);
  Look(renderer, 0.0, 0.4, 1.0);
  AddLight(renderer, -0.5, 2.0, 2.0)->SetDiffuseColor(1.0, 0.8, 0.5);
  vtkSmartPointer<vtkLight> fill = AddLight(renderer, 0.5, -2.0, 1.0);
  fill->SetDiffuseColor(0.3, 0.5, 1.0);
  fill->SetIntensity(0.7);
}

void BuildGlyphs(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> directions;
  directions->SetName("Directions");
  directions->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> speeds;
  speeds->SetName("Speeds");
  for (int i = 0; i < 25; ++i)
  {
    const double x = 0.5 * (i % 5) - 1.0;
    const double y = 0.5 * (i / 5) - 1.0;
    points->InsertNextPoint(x, y, 0.0);
    directions->InsertNextTuple3(-y, x, 0.4 - 0.3 * x);
    speeds->InsertNextValue(0.2 + 0.3 * std::hypot(x, y));
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(directions);
  data->GetPointData()->SetScalars(speeds);
  vtkNew<vtkArrowSource> arrow;
  arrow->SetTipResolution(24);
  arrow->SetShaftResolution(24);
  arrow->SetTipRadius(0.2);
  arrow->SetShaftRadius(0.08);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(arrow->GetOutputPort());
  mapper->SetOrientationArray("Directions");
  mapper->SetScaleArray("Speeds");
  mapper->SetScaleModeToScaleByMagnitude();
  mapper->SetScaleFactor(1.1);
  mapper->SetScalarRange(0.2, 0.65);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  Look(renderer, 0.2, 0.3, 1.0, 1.35);
}

#ifdef CSLF_TEST_MOLECULES
void BuildMolecule(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  // Ethanol, in angstroms.
  const double atoms[9][4] = { { 6, -1.17, -0.40, 0.0 }, { 6, 0.0, 0.55, 0.0 },
    { 8, 1.19, -0.22, 0.0 }, { 1, -1.13, -1.03, 0.89 }, { 1, -1.13, -1.03, -0.89 },
    { 1, -2.10, 0.17, 0.0 }, { 1, -0.04, 1.19, 0.89 }, { 1, -0.04, 1.19, -0.89 },
    { 1, 1.94, 0.38, 0.0 } };
  const int bonds[8][2] = { { 0, 1 }, { 1, 2 }, { 0, 3 }, { 0, 4 }, { 0, 5 }, { 1, 6 }, { 1, 7 },
    { 2, 8 } };
  vtkNew<vtkMolecule> molecule;
  for (const double* atom : atoms)
  {
    molecule->AppendAtom(static_cast<unsigned short>(atom[0]), atom[1], atom[2], atom[3]);
  }
  for (const int* bond : bonds)
  {
    molecule->AppendBond(bond[0], bond[1], 1);
  }
  vtkNew<vtkOpenGLMoleculeMapper> mapper;
  mapper->SetInputData(molecule);
  mapper->UseBallAndStickSettings();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  Look(renderer, 0.4, 0.3, 1.0, 2.2);
}
#endif

/// A plane through a point, which keeps what is in front of it.
vtkSmartPointer<vtkPlane> MakePlane(double x, double y, double z)
{
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetNormal(x, y, z);
  return plane;
}

void BuildClipped(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkSmartPointer<vtkActor> open = AddSphere(renderer, -0.45, 0.45);
  open->GetProperty()->SetColor(0.85, 0.6, 0.3);
  vtkSmartPointer<vtkPlane> plane = MakePlane(-0.4, -0.6, -0.7);
  plane->SetOrigin(-0.45, 0.45, 0.15);
  open->GetMapper()->AddClippingPlane(plane);

  // Closed by caps with their own colours.
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(48);
  vtkNew<vtkPlaneCollection> planes;
  planes->AddItem(MakePlane(-0.3, -0.5, -0.8));
  vtkNew<vtkClipClosedSurface> closed;
  closed->SetInputConnection(sphere->GetOutputPort());
  closed->SetClippingPlanes(planes);
  closed->SetScalarModeToColors();
  closed->SetBaseColor(0.3, 0.5, 0.8);
  closed->SetClipColor(0.9, 0.3, 0.3);
  AddActor(renderer, closed)->SetPosition(0.45, -0.45, 0.0);
  Look(renderer, 0.0, 0.0, 1.0);
}

void BuildComposite(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 4; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(48);
    sphere->SetPhiResolution(48);
    sphere->SetCenter(0.8 * (i % 2) - 0.4, 0.8 * (i / 2) - 0.4, -0.3 * i);
    sphere->Update();
    blocks->SetBlock(i, sphere->GetOutput());
  }
  vtkNew<cslf::CompositeMapper> mapper;
  mapper->SetInputDataObject(blocks);
  vtkNew<vtkCompositeDataDisplayAttributes> looks;
  mapper->SetCompositeDataDisplayAttributes(looks);
  const double red[3] = { 0.85, 0.25, 0.2 };
  const double blue[3] = { 0.25, 0.4, 0.85 };
  looks->SetBlockColor(blocks->GetBlock(0), red);
  looks->SetBlockColor(blocks->GetBlock(1), blue);
  looks->SetBlockOpacity(blocks->GetBlock(1), 0.5);
  looks->SetBlockVisibility(blocks->GetBlock(2), false);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.75, 0.3);
  renderer->AddActor(actor);
  Look(renderer, 0.0, 0.0, 1.0);
}

void BuildUnlit(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkProperty* ambient = AddSphere(renderer, -0.55, 0.5)->GetProperty();
  ambient->SetColor(0.8, 0.5, 0.3);
  ambient->SetAmbient(0.4);
  ambient->SetDiffuse(0.6);
  vtkProperty* full = AddSphere(renderer, 0.55, 0.5)->GetProperty();
  full->SetColor(0.3, 0.6, 0.8);
  full->LightingOff();
  // Wide lines, drawn as tubes, with invisible ends.
  for (int i = 0; i < 4; ++i)
  {
    vtkNew<vtkLineSource> line;
    line->SetPoint1(-1.3, -0.2 - 0.25 * i, 0.0);
    line->SetPoint2(1.3, -0.3 - 0.2 * i, 0.0);
    vtkProperty* tube = AddActor(renderer, line)->GetProperty();
    tube->SetColor(0.3 + 0.2 * i, 0.7 - 0.1 * i, 0.4);
    tube->SetLineWidth(24.0);
    tube->RenderLinesAsTubesOn();
  }
  Look(renderer, 0.0, 0.0, 1.0);
}
}

std::vector<SheetScene> MakeSheetScenes()
{
  std::vector<SheetScene> scenes = {
    { "Phong: matte, flat, shiny", BuildPhong, Expectation::Bounds, 28.0, 66.0 },
    { "PBR: roughness, metal", BuildPhysical, Expectation::Window, 6.0, 24.0, 8.0 },
    { "Textures: transform, table", BuildTextures },
    { "Table: NaN, below, above", BuildTable },
    { "Logarithmic table", BuildLogarithms },
    { "Colours of points, of cells", BuildColors },
    { "Headlight, perspective", BuildHeadlight },
    { "Light kit", BuildLightKit, Expectation::Bounds, 9.0, 42.0 },
    { "Point light, attenuated", BuildAttenuated, Expectation::Bounds, 33.0, 40.0 },
    { "Spot light", BuildSpotLight, Expectation::Bounds, 8.0, 36.0 },
    { "Two scene lights", BuildSceneLights, Expectation::Bounds, 25.0, 70.0 },
    { "Glyphs", BuildGlyphs },
#ifdef CSLF_TEST_MOLECULES
    { "Molecule", BuildMolecule },
#endif
    { "Clipped: open, closed", BuildClipped },
    { "Composite: colour, opacity", BuildComposite, Expectation::Bounds, 28.0, 70.0 },
    { "Ambient, no lighting, tubes", BuildUnlit },
  };
  const std::vector<SheetScene> others = MakeRepresentationScenes();
  scenes.insert(scenes.end(), others.begin(), others.end());
  return scenes;
}
}
}
