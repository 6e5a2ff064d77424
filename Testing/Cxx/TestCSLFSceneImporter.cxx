// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Converts what a renderer shows to data: geometry, colours, materials, lights; and detects
// changes.
#include "cslfColor.h"
#include "cslfTesting.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkCubeAxesActor.h>
#include <vtkDataArray.h>
#include <vtkDataSetMapper.h>
#include <vtkElevationFilter.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
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
#include <vtkTextActor.h>
#include <vtkTexture.h>
#include <vtkTransform.h>

#include <cmath>
#include <string>

namespace
{
struct Importer
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkCSLFSceneImporter> Filter;
  vtkNew<vtkTest::ErrorObserver> Messages;

  Importer()
  {
    this->Filter->SetRenderer(this->Renderer);
    this->Filter->AddObserver(vtkCommand::WarningEvent, this->Messages);
  }

  vtkMultiBlockDataSet* Update()
  {
    this->Filter->Update();
    return this->Filter->GetOutput();
  }

  vtkPolyData* GetBlock(unsigned int index)
  {
    return vtkPolyData::SafeDownCast(this->Update()->GetBlock(index));
  }

  vtkDataArray* GetLight(const char* name)
  {
    vtkMultiBlockDataSet* output = this->Update();
    // VTK's writers leave out blocks without points.
    CSLF_CHECK(this->GetBlock(output->GetNumberOfBlocks() - 1)->GetNumberOfPoints() > 0);
    return output->GetBlock(output->GetNumberOfBlocks() - 1)->GetFieldData()->GetArray(name);
  }

  bool WarnsOf(const char* what)
  {
    this->Filter->Modified();
    this->Update();
    const bool warned = this->Messages->GetWarningMessage().find(what) != std::string::npos;
    this->Messages->Clear();
    return warned;
  }
};

vtkSmartPointer<vtkActor> MakeActor(vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

void CheckBounds(vtkDataSet* data, double lowX, double highX, double lowY, double highY)
{
  double bounds[6];
  data->GetBounds(bounds);
  CSLF_CHECK_NEAR(bounds[0], lowX, 1e-5);
  CSLF_CHECK_NEAR(bounds[1], highX, 1e-5);
  CSLF_CHECK_NEAR(bounds[2], lowY, 1e-5);
  CSLF_CHECK_NEAR(bounds[3], highY, 1e-5);
}

void TestPlacement()
{
  Importer importer;
  vtkNew<vtkPlaneSource> plane; // from -0.5 to 0.5
  auto actor = MakeActor(plane);
  actor->SetPosition(2, 0, 0);
  actor->SetScale(2, 1, 1);
  vtkNew<vtkTransform> user;
  user->Translate(0, 3, 0);
  actor->SetUserTransform(user);
  importer.Renderer->AddActor(actor);

  // Parts of assemblies, one of them mirrored; invisible ones are ignored.
  vtkNew<vtkAssembly> assembly;
  assembly->SetPosition(0, -5, 0);
  auto part = MakeActor(plane);
  part->SetScale(-1, 1, 1);
  assembly->AddPart(part);
  auto hidden = MakeActor(plane);
  hidden->VisibilityOff();
  assembly->AddPart(hidden);
  importer.Renderer->AddActor(assembly);

  CSLF_CHECK(importer.Update()->GetNumberOfBlocks() == 3);
  CheckBounds(importer.GetBlock(0), 1.0, 3.0, 2.5, 3.5);
  vtkPolyData* mirrored = importer.GetBlock(1);
  CheckBounds(mirrored, -0.5, 0.5, -5.5, -4.5);
  CSLF_CHECK(importer.GetBlock(0)->GetPointData()->GetNormals() != nullptr);

  // The front of the mirrored square still faces z.
  vtkIdType count;
  const vtkIdType* ids;
  mirrored->GetPolys()->GetCellAtId(0, count, ids);
  double corners[3][3];
  for (int i = 0; i < 3; ++i)
  {
    mirrored->GetPoint(ids[i], corners[i]);
  }
  const double turn = (corners[1][0] - corners[0][0]) * (corners[2][1] - corners[1][1]) -
    (corners[1][1] - corners[0][1]) * (corners[2][0] - corners[1][0]);
  CSLF_CHECK(turn > 0.0);

  // Changes of sources, actors, parts, properties and the list of props are detected.
  vtkMTimeType time = importer.Filter->GetMTime();
  const auto changes = [&time, &importer]
  {
    const vtkMTimeType before = time;
    time = importer.Filter->GetMTime();
    return time > before;
  };
  CSLF_CHECK(!changes());
  plane->SetXResolution(2);
  CSLF_CHECK(changes());
  CSLF_CHECK(importer.GetBlock(0)->GetNumberOfPolys() == 2);
  changes();
  CSLF_CHECK(!changes());
  actor->GetProperty()->SetColor(1, 0, 0);
  CSLF_CHECK(changes());
  part->SetPosition(0, 0, 1);
  CSLF_CHECK(changes());
  user->Translate(1, 0, 0);
  CSLF_CHECK(changes());
  hidden->VisibilityOn();
  CSLF_CHECK(changes());
  importer.Renderer->RemoveActor(assembly);
  CSLF_CHECK(changes());
  CSLF_CHECK(importer.Update()->GetNumberOfBlocks() == 2);
}

void TestColors()
{
  Importer importer;
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkElevationFilter> elevation; // 0 at the left, 1 at the right
  elevation->SetInputConnection(plane->GetOutputPort());
  elevation->SetLowPoint(-0.5, 0, 0);
  elevation->SetHighPoint(0.5, 0, 0);
  auto actor = MakeActor(elevation);
  importer.Renderer->AddActor(actor);
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->SetTableValue(0, 1.0, 0.0, 0.0, 1.0);
  table->SetTableValue(1, 0.0, 0.0, 1.0, 0.5);
  table->SetRange(0.0, 1.0);
  vtkMapper* mapper = actor->GetMapper();
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();

  vtkDataArray* colors = importer.GetBlock(0)->GetPointData()->GetScalars();
  CSLF_CHECK(colors && colors->GetNumberOfComponents() == 4);
  CSLF_CHECK(colors && colors->GetComponent(0, 0) == 255.0 && colors->GetComponent(0, 3) == 255.0);
  CSLF_CHECK(colors && colors->GetComponent(1, 2) == 255.0 &&
    std::abs(colors->GetComponent(1, 3) - 127.5) <= 0.5);
  const vtkMTimeType before = importer.Filter->GetMTime();
  table->SetTableValue(0, 0.0, 1.0, 0.0, 1.0);
  CSLF_CHECK(importer.Filter->GetMTime() > before);
  CSLF_CHECK(importer.GetBlock(0)->GetPointData()->GetScalars()->GetComponent(0, 1) == 255.0);

  // An array of cells by name; then none.
  elevation->Update();
  vtkNew<vtkFloatArray> cells;
  cells->SetName("Cells");
  cells->InsertNextValue(1.0f);
  vtkNew<vtkPolyData> data;
  data->ShallowCopy(elevation->GetOutput());
  data->GetCellData()->AddArray(cells);
  vtkPolyDataMapper::SafeDownCast(mapper)->SetInputData(data);
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("Cells");
  CSLF_CHECK(importer.GetBlock(0)->GetPointData()->GetScalars() == nullptr);
  colors = importer.GetBlock(0)->GetCellData()->GetScalars();
  CSLF_CHECK(colors && colors->GetComponent(0, 2) == 255.0);
  mapper->ScalarVisibilityOff();
  CSLF_CHECK(importer.GetBlock(0)->GetCellData()->GetScalars() == nullptr);

  // Interpolated before they are mapped: half of the square is of one colour.
  mapper->ScalarVisibilityOn();
  mapper->SetScalarModeToUsePointData();
  mapper->InterpolateScalarsBeforeMappingOn();
  importer.Renderer->AutomaticLightCreationOn();
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 2);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetRenderer(importer.Renderer);
  tracer->SetCamera(camera);
  tracer->SetSize(10, 2);
  tracer->SetSamples(64);
  tracer->SetColorTypeToFloat();
  camera->SetParallelScale(0.1);
  tracer->Update();
  for (int column = 0; column < 10; ++column)
  {
    double color[4];
    tracer->GetOutput()->GetPointData()->GetScalars()->GetTuple(column, color);
    const bool left = column < 5;
    CSLF_CHECK_NEAR(color[3], left ? 1.0 : 0.5, left ? 0.0 : 0.25);
    CSLF_CHECK_NEAR(color[1] / color[3], left ? 1.0 : 0.0, 1e-3);
    CSLF_CHECK_NEAR(color[2] / color[3], left ? 0.0 : 1.0, 1e-3);
  }
}

void TestMaterials()
{
  Importer importer;
  vtkNew<vtkPlaneSource> plane;
  auto actor = MakeActor(plane);
  importer.Renderer->AddActor(actor);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPBR();
  property->SetColor(1.0, 0.5, 0.25);
  property->SetMetallic(1.0);
  property->SetRoughness(0.25);
  property->SetOpacity(0.5);
  vtkPolyData* block = importer.GetBlock(0);
  double color[3];
  vtkCSLFMaterial::GetBaseColor(block, color);
  CSLF_CHECK_NEAR(color[1], cslf::LinearToSRGB(0.5), 0.02); // it is linear
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(block) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(block) == 0.25);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(block) == 0.5);

  // The actor's texture; the data's own material takes precedence; flat shading.
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  actor->SetTexture(texture);
  property->SetInterpolationToFlat();
  vtkNew<vtkPolyData> data;
  plane->Update();
  data->ShallowCopy(plane->GetOutput());
  vtkCSLFMaterial::SetTransmission(data, 0.9);
  vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(data);
  block = importer.GetBlock(0);
  vtkNew<vtkImageData> read;
  bool repeat = false;
  bool interpolate = true;
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(
    block, vtkCSLFMaterial::BaseColorTexture, read, repeat, interpolate));
  CSLF_CHECK(read->GetDimensions()[0] == 3 && repeat && !interpolate);
  CSLF_CHECK(vtkCSLFMaterial::GetTransmission(block) == 0.9);
  CSLF_CHECK(block->GetPointData()->GetNormals() == nullptr);
  actor->SetTexture(nullptr);

  // Wireframe, edges and points become lines and vertices.
  property->SetRepresentationToWireframe();
  property->SetLineWidth(3.0);
  block = importer.GetBlock(0);
  CSLF_CHECK(block->GetNumberOfLines() == 4 && block->GetNumberOfPolys() == 0);
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetLineRadius(block), 0.0015 * std::sqrt(2.0), 1e-9);
  property->SetRepresentationToPoints();
  block = importer.GetBlock(0);
  CSLF_CHECK(block->GetNumberOfVerts() == 4 && block->GetNumberOfPolys() == 0);
  property->SetRepresentationToSurface();
  property->EdgeVisibilityOn();
  property->SetEdgeColor(0.0, 1.0, 0.0);
  CSLF_CHECK(importer.Update()->GetNumberOfBlocks() == 3);
  CSLF_CHECK(importer.GetBlock(0)->GetNumberOfPolys() == 1);
  CSLF_CHECK(importer.GetBlock(1)->GetNumberOfLines() == 4);
  vtkCSLFMaterial::GetBaseColor(importer.GetBlock(1), color);
  CSLF_CHECK(color[0] == 0.0 && color[1] == 1.0);

  // The surface of other data.
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(3, 3, 3);
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputData(volume);
  property->EdgeVisibilityOff();
  actor->SetMapper(mapper);
  CSLF_CHECK(importer.GetBlock(0)->GetNumberOfPolys() == 24);

  // Parts that are not represented are named.
  CSLF_CHECK(!importer.WarnsOf("differs from the window"));
  vtkNew<vtkTextActor> text;
  importer.Renderer->AddActor(text);
  vtkNew<vtkCubeAxesActor> axes;
  importer.Renderer->AddActor(axes);
  vtkNew<vtkActor> nothing;
  importer.Renderer->AddActor(nothing);
  property->BackfaceCullingOn();
  property->EdgeVisibilityOn();
  CSLF_CHECK(importer.WarnsOf("edges of culled faces (visible from all sides)"));
  CSLF_CHECK(importer.WarnsOf("props other than actors and volumes: vtkCubeAxesActor, vtk"));
  CSLF_CHECK(importer.WarnsOf("TextActor"));
  CSLF_CHECK(!importer.WarnsOf("vtkOpenGLActor"));
}

void TestLights()
{
  // A renderer that would create a headlight; one that has one.
  Importer importer;
  vtkDataArray* radiance = importer.GetLight(vtkCSLFLight::EnvironmentRadiance());
  CSLF_CHECK(radiance && radiance->GetComponent(0, 0) == 1.0);
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  light->SetIntensity(0.5);
  light->SetDiffuseColor(1.0, 0.5, 0.0);
  importer.Renderer->AddLight(light);
  radiance = importer.GetLight(vtkCSLFLight::EnvironmentRadiance());
  CSLF_CHECK_NEAR(radiance->GetComponent(0, 1), cslf::SRGBToLinear(0.5 * 0.5), 1e-9);
  CSLF_CHECK(importer.GetLight(vtkCSLFLight::DirectionalLightDirection()) == nullptr);

  // From where the camera is.
  importer.Filter->HeadlightsAllAroundOff();
  vtkCamera* camera = importer.Renderer->GetActiveCamera();
  camera->SetPosition(3, 0, 0);
  camera->SetFocalPoint(0, 0, 0);
  radiance = importer.GetLight(vtkCSLFLight::EnvironmentRadiance());
  CSLF_CHECK(radiance->GetComponent(0, 0) == 0.0);
  vtkDataArray* direction = importer.GetLight(vtkCSLFLight::DirectionalLightDirection());
  CSLF_CHECK(direction && direction->GetComponent(0, 0) < 0.0);
  CSLF_CHECK_NEAR(direction->GetComponent(0, 1), 0.0, 1e-9);
  const vtkMTimeType before = importer.Filter->GetMTime();
  camera->SetPosition(0, 3, 0);
  CSLF_CHECK(importer.Filter->GetMTime() > before);

  // A camera light moves with the camera; a scene light with a cone is a spot light.
  light->SetLightTypeToCameraLight();
  light->SetPosition(0, 0, 1); // where the camera is
  light->SetFocalPoint(0, 0, 0);
  camera->SetPosition(0, 0, -2);
  direction = importer.GetLight(vtkCSLFLight::DirectionalLightDirection());
  CSLF_CHECK(direction && direction->GetComponent(0, 2) > 0.0);
  light->SetLightTypeToSceneLight();
  light->PositionalOn();
  light->SetConeAngle(30.0);
  light->SetExponent(2.0);
  vtkDataArray* cone = importer.GetLight(vtkCSLFLight::SpotLightCone());
  CSLF_CHECK(cone && cone->GetComponent(0, 0) == 30.0 && cone->GetComponent(0, 1) > 2.0);
  CSLF_CHECK(importer.GetLight(vtkCSLFLight::SpotLightDirection())->GetComponent(0, 2) < 0.0);
  light->SwitchOff();
  CSLF_CHECK(importer.GetLight(vtkCSLFLight::SpotLightCone()) == nullptr);

  // The environment texture, if it lights the scene.
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 2, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  importer.Renderer->SetEnvironmentTexture(texture);
  CSLF_CHECK(importer.GetLight(vtkCSLFLight::EnvironmentImage()) == nullptr);
  importer.Renderer->UseImageBasedLightingOn();
  importer.Renderer->SetEnvironmentUp(0, 0, 1);
  vtkDataArray* pixels = importer.GetLight(vtkCSLFLight::EnvironmentImage());
  CSLF_CHECK(pixels && pixels->GetNumberOfTuples() == 8);
  CSLF_CHECK(importer.GetLight(vtkCSLFLight::EnvironmentUp())->GetComponent(0, 2) == 1.0);
  image->SetDimensions(1, 4, 2); // in the plane YZ
  image->AllocateScalars(VTK_FLOAT, 3);
  CSLF_CHECK(!importer.WarnsOf("environment"));
  vtkDataArray* layout = importer.GetLight(vtkCSLFLight::EnvironmentImageLayout());
  CSLF_CHECK(layout && layout->GetComponent(0, 0) == 4.0 && layout->GetComponent(0, 1) == 2.0);
}

/// The colour in the middle of a picture.
void Look(vtkCSLFViewTracer* tracer, double color[4])
{
  tracer->Update();
  tracer->GetOutput()->GetPointData()->GetScalars()->GetTuple(5, color);
}

void TestTracing()
{
  // A surface under a spot light, inside and outside its cone; the environment of the data replaces
  // that of the parameters.
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPlaneSource> plane;
  auto actor = MakeActor(plane);
  actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOn();
  light->SetPosition(0, 0, 2);
  light->SetConeAngle(10.0);
  renderer->AddLight(light);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 3);
  camera->SetParallelScale(0.01);
  camera->ParallelProjectionOn();
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetRenderer(renderer);
  CSLF_CHECK(tracer->GetRenderer() == renderer);
  tracer->SetCamera(camera);
  tracer->SetSize(4, 3);
  tracer->SetSamples(16);
  tracer->SetColorTypeToFloat();
  double color[4];
  Look(tracer, color);
  // At the focal point, VTK's surface would show its colour times the intensity.
  CSLF_CHECK_NEAR(color[0], 1.0, 1e-3);
  CSLF_CHECK(color[3] == 1.0);
  camera->SetPosition(0.45, 0, 3); // at 12.7 degrees
  camera->SetFocalPoint(0.45, 0, 0);
  Look(tracer, color);
  CSLF_CHECK(color[0] == 0.0 && color[3] == 1.0);
  light->SetConeAngle(90.0);
  Look(tracer, color);
  CSLF_CHECK_NEAR(color[0], 2.0 / std::hypot(2.0, 0.45), 2e-3); // it has no attenuation
  light->SwitchOff();
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  headlight->SetIntensity(0.25);
  renderer->AddLight(headlight);
  Look(tracer, color);
  CSLF_CHECK_NEAR(color[0], cslf::SRGBToLinear(0.25), 1e-3);

  // Without a renderer or an input there is nothing to trace.
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  tracer->AddObserver(vtkCommand::ErrorEvent, errors);
  tracer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  tracer->SetRenderer(nullptr);
  tracer->Update();
  CSLF_CHECK(
    errors->GetErrorMessage().find("neither an input nor a renderer") != std::string::npos);
}
}

int TestCSLFSceneImporter(int, char*[])
{
  TestPlacement();
  TestColors();
  TestMaterials();
  TestLights();
  TestTracing();
  return cslf::testing::Result();
}
