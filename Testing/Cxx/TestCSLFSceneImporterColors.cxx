// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Colours between points and between the pixels of a texture: baked as VTK's window interpolates
// them, or as light.
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfColor.h"
#include "cslfTestWindow.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <iostream>
#include <string>

namespace
{
using cslf::testing::BakeOptions;
using cslf::testing::DrawAndTrace;

constexpr int Side = 64;

/// Two large triangles in front of a camera that sees only them.
struct Square
{
  Square()
  {
    vtkNew<vtkPlaneSource> plane;
    vtkNew<vtkTriangleFilter> triangles; // not left to the window, which uses the other diagonal
    triangles->SetInputConnection(plane->GetOutputPort());
    triangles->Update();
    this->Data->ShallowCopy(triangles->GetOutput());
    this->Data->GetPointData()->SetNormals(nullptr);
    this->Mapper->SetInputData(this->Data);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5);
    camera->SetPosition(0.0, 0.0, 2.0);
  }

  /// The colours of a square's corners: blue, red, yellow, black.
  void SetColors()
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(3);
    colors->InsertNextTuple3(0, 0, 255);
    colors->InsertNextTuple3(255, 0, 0);
    colors->InsertNextTuple3(255, 255, 0);
    colors->InsertNextTuple3(0, 0, 0);
    this->Data->GetPointData()->SetScalars(colors);
  }

  /// Numbers at points, mapped by a table.
  void SetNumbers()
  {
    vtkNew<vtkDoubleArray> numbers;
    for (const double number : { 0.0, 1.0, 0.3, 0.6 })
    {
      numbers->InsertNextValue(number);
    }
    this->Data->GetPointData()->SetScalars(numbers);
    vtkNew<vtkLookupTable> table;
    table->SetHueRange(0.667, 0.0);
    this->Mapper->SetLookupTable(table);
    this->Mapper->SetScalarRange(0.0, 1.0);
    this->Mapper->InterpolateScalarsBeforeMappingOff();
  }

  /// A texture of 3 x 2 pixels.
  void SetTexture()
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(3, 2, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    const unsigned char pixels[18] = { 0, 0, 255, 255, 0, 0, 0, 255, 0, 20, 20, 20, 255, 255, 255,
      90, 0, 200 };
    for (int i = 0; i < 18; ++i)
    {
      static_cast<unsigned char*>(image->GetScalarPointer())[i] = pixels[i];
    }
    vtkNew<vtkTexture> texture;
    texture->SetInputData(image);
    texture->InterpolateOn();
    texture->RepeatOff();
    this->Actor->SetTexture(texture);
  }

  void SetLight(double intensity)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    light->SetIntensity(intensity);
    this->Renderer->RemoveAllLights();
    this->Renderer->AddLight(light);
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkPolyData> Data;
};

/// No pixel differs by more than 2 levels, with paths and with radiance caching; interpolated as
/// light, many do.
void Check(Square& square, const std::string& what, bool rulesDiffer = true)
{
  for (const int integrator :
    { vtkCSLFViewTracer::PathTracing, vtkCSLFViewTracer::RadianceCaching })
  {
    BakeOptions options;
    options.HeadlightsAllAround = true;
    options.Integrator = integrator;
    const double displayed = DrawAndTrace(square.Renderer, Side, options).GetPartOutside(2);
    options.InterpolateDisplayedColors = false;
    const double light = DrawAndTrace(square.Renderer, Side, options).GetPartOutside(2);
    std::cout << what << ", integrator " << integrator << ": " << 100.0 * displayed
              << " % of the pixels differ, " << 100.0 * light << " % interpolated as light\n";
    CSLF_CHECK(displayed == 0.0);
    CSLF_CHECK(rulesDiffer ? light > 0.5 : light == displayed);
  }
}

void TestAgainstWindow()
{
  Square square;
  square.SetColors();
  Check(square, "colours");
  square.SetLight(0.5);
  Check(square, "colours in half light");
  square.SetLight(1.0);
  square.Actor->GetProperty()->SetAmbient(0.4);
  square.Actor->GetProperty()->SetDiffuse(0.6);
  Check(square, "colours with an ambient term");
  square.Actor->GetProperty()->LightingOff();
  Check(square, "colours without lighting");
  square.Actor->GetProperty()->LightingOn();
  square.Actor->GetProperty()->SetAmbient(0.0);
  square.Actor->GetProperty()->SetDiffuse(1.0);
  square.SetNumbers();
  Check(square, "numbers mapped at points");
  square.Data->GetPointData()->SetScalars(nullptr);
  square.SetTexture();
  Check(square, "texture");
  square.SetLight(0.4);
  Check(square, "texture in dim light");
  square.SetLight(1.0);
  square.Actor->GetProperty()->SetAmbient(0.4);
  square.Actor->GetProperty()->SetDiffuse(0.6);
  Check(square, "texture with an ambient term");
}

/// VTK 9.1 interpolates colours of physically based shading as light, and so does the bake,
/// whatever the option says.
void TestPhysical()
{
  Square square;
  square.SetColors();
  square.Actor->GetProperty()->SetInterpolationToPBR();
  square.Actor->GetProperty()->SetRoughness(1.0);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(square.Renderer);
  importer->Update();
  double white[3];
  vtkCSLFMaterial::GetDisplayedWhite(importer->GetOutput()->GetBlock(0), white);
  CSLF_CHECK((white[0] > 0.0) == cslf::PhysicalScalarsAreEncoded);
}

/// Red, in [0,1] of the display, where the camera looks.
double Look(vtkCSLFViewTracer* tracer)
{
  tracer->SetSize(1, 1);
  tracer->SetColorTypeToFloat();
  tracer->SetMaximumDepth(1);
  tracer->Update();
  return cslf::LinearToSRGB(tracer->GetOutput()->GetPointData()->GetScalars()->GetComponent(0, 0));
}

/// What was imported has its colours: neither an array that is selected for the scene nor a table
/// nor the visibility of scalars changes them, whether a texture of the mapper's table or points
/// hold them.
void TestFinished()
{
  vtkNew<vtkLookupTable> green;
  green->SetHueRange(1.0 / 3.0, 1.0 / 3.0);
  green->Build();
  vtkNew<vtkCamera> camera;
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.005);
  camera->SetPosition(0.4, -0.4, 2.0);
  camera->SetFocalPoint(0.4, -0.4, 0.0);
  for (const bool isTexture : { true, false })
  {
    Square square;
    square.SetNumbers();
    square.Actor->GetMapper()->SetInterpolateScalarsBeforeMapping(isTexture);
    vtkNew<vtkCSLFSceneImporter> importer;
    importer->SetRenderer(square.Renderer);
    importer->Update();
    auto* block = vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(0));
    CSLF_CHECK(vtkCSLFMaterial::GetFinishedColors(block));
    const char* name = isTexture ? "TextureCoordinates" : vtkCSLFMaterial::ColorsName();
    CSLF_CHECK(block->GetPointData()->HasArray(name));
    vtkNew<vtkFloatArray> other;
    other->SetName("Other");
    other->SetNumberOfTuples(block->GetNumberOfPoints());
    other->Fill(0.5);

    vtkNew<vtkCSLFViewTracer> tracer;
    tracer->SetCamera(camera);
    tracer->SetInputData(importer->GetOutput());
    const double expected = Look(tracer);
    CSLF_CHECK(expected > 0.5);
    block->GetPointData()->AddArray(other);
    block->GetPointData()->SetActiveScalars("Other");
    block->Modified();
    CSLF_CHECK(Look(tracer) == expected);
    for (const char* chosen : { name, "Other" })
    {
      tracer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, chosen);
      tracer->SetLookupTable(green);
      CSLF_CHECK(Look(tracer) == expected);
      tracer->SetLookupTable(nullptr);
      CSLF_CHECK(Look(tracer) == expected);
    }
    tracer->ScalarVisibilityOff();
    CSLF_CHECK(Look(tracer) == expected);
    tracer->ScalarVisibilityOn();
    vtkCSLFMaterial::SetFinishedColors(block, false);
    block->Modified();
    tracer->SetLookupTable(green);
    CSLF_CHECK(Look(tracer) < 0.1);
  }
}

/// Filters pass the option to the importer. Data can set it, and its default is light.
void TestOption()
{
  Square square;
  square.SetColors();
  vtkNew<vtkCamera> camera; // at the middle of the edge between blue and red, on 2 % of it
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.005);
  camera->SetPosition(0.0, -0.49, 2.0);
  camera->SetFocalPoint(0.0, -0.49, 0.0);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetCamera(camera);
  CSLF_CHECK(tracer->GetInterpolateDisplayedColors());
  tracer->SetRenderer(square.Renderer);
  CSLF_CHECK_NEAR(Look(tracer), 128.0 / 255.0, 0.01);
  tracer->InterpolateDisplayedColorsOff();
  CSLF_CHECK_NEAR(Look(tracer), 188.0 / 255.0, 0.01);
  tracer->InterpolateDisplayedColorsOn();
  CSLF_CHECK_NEAR(Look(tracer), 128.0 / 255.0, 0.01);

  vtkNew<vtkCSLFViewTracer> plain;
  plain->SetCamera(camera);
  plain->SetInputData(square.Data);
  CSLF_CHECK_NEAR(Look(plain), 188.0 / 255.0, 0.01);
  vtkCSLFMaterial::SetDisplayedWhite(square.Data, 1.0, 1.0, 1.0);
  CSLF_CHECK_NEAR(Look(plain), 128.0 / 255.0, 0.01);

  // The data's setting takes precedence over the importer's.
  vtkCSLFMaterial::SetDisplayedWhite(square.Data, 0.0, 0.0, 0.0);
  CSLF_CHECK_NEAR(Look(tracer), 188.0 / 255.0, 0.01);
}

/// Emission above white uses the same curve. The light of a lamp agrees with its appearance.
void TestEmission()
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkNew<vtkPolyData> lamp;
  lamp->ShallowCopy(plane->GetOutput());
  vtkNew<vtkDoubleArray> emission;
  emission->SetName(vtkCSLFMaterial::EmissionName());
  emission->SetNumberOfComponents(3);
  for (const double red : { 0.0, 9.0, 0.0, 9.0 })
  {
    emission->InsertNextTuple3(red, red, red);
  }
  lamp->GetPointData()->AddArray(emission);
  vtkCSLFMaterial::SetBaseColor(lamp, 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetDisplayedWhite(lamp, 1.0, 1.0, 1.0);
  vtkNew<vtkCamera> camera;
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.005);
  camera->SetPosition(0.0, 0.0, 0.5);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetCamera(camera);
  tracer->SetInputData(lamp);
  tracer->GetEnvironment()->SetModeToNone();
  Look(tracer);
  const double middle = tracer->GetOutput()->GetPointData()->GetScalars()->GetComponent(0, 0);
  const double white = 1.055 * std::pow(9.0, 1.0 / 2.4) - 0.055;
  CSLF_CHECK_NEAR(middle, cslf::SRGBToLinear(0.5 * white), 0.02);

  // The light on a white square from it: by light sampling, and by an integral.
  vtkNew<vtkPlaneSource> low;
  low->SetCenter(0.0, 0.0, -1.0);
  low->Update();
  vtkNew<vtkPolyData> receiver;
  receiver->ShallowCopy(low->GetOutput());
  vtkCSLFMaterial::SetBaseColor(receiver, 1.0, 1.0, 1.0);
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, lamp);
  scene->SetBlock(1, receiver);
  camera->SetPosition(0.0, 0.0, -0.1);
  camera->SetFocalPoint(0.0, 0.0, -1.0);
  tracer->SetInputData(scene);
  double expected = 0.0;
  constexpr int steps = 200;
  for (int i = 0; i < steps * steps; ++i)
  {
    const double x = (i % steps + 0.5) / steps;
    const double y = (i / steps + 0.5) / steps;
    const double distance2 = 1.0 + (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
    expected +=
      cslf::SRGBToLinear(x * white) / (3.14159265358979 * distance2 * distance2 * steps * steps);
  }
  for (const int integrator :
    { vtkCSLFViewTracer::PathTracing, vtkCSLFViewTracer::RadianceCaching })
  {
    tracer->SetIntegrator(integrator);
    tracer->SetQualityToBest();
    tracer->SetSamples(4096);
    Look(tracer);
    CSLF_CHECK_NEAR(tracer->GetOutput()->GetPointData()->GetScalars()->GetComponent(0, 0), expected,
      0.01 * expected);
  }
}
}

int TestCSLFSceneImporterColors(int, char*[])
{
  TestAgainstWindow();
  TestPhysical();
  TestFinished();
  TestOption();
  TestEmission();
  return cslf::testing::Result();
}
