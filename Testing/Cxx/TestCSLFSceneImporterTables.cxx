// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Scalars with lookup tables of all kinds: the bake shows the same as VTK's window, and the user's
// table is not changed.
#include "cslfTestWindow.h"
#include "cslfTesting.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkCommand.h>
#include <vtkDiscretizableColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>

#include <cmath>
#include <functional>

namespace
{
// The strips of the square with a constant value at their edges.
constexpr int Strips = 32;

/// A square whose scalars are a function of x in [0,1], in front of a camera that sees only the
/// square.
struct Square
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkDoubleArray> Scalars;

  explicit Square(const std::function<double(double)>& function, int components = 1)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetXResolution(Strips);
    plane->Update();
    this->Data->ShallowCopy(plane->GetOutput());
    this->Scalars->SetName("Values");
    this->Scalars->SetNumberOfComponents(components);
    for (vtkIdType i = 0; i < this->Data->GetNumberOfPoints(); ++i)
    {
      const double x = static_cast<double>(i % (Strips + 1)) / Strips;
      const double tuple[3] = { function(x), 0.5 * function(1.0 - x), 0.25 };
      this->Scalars->InsertNextTuple(tuple);
    }
    this->Data->GetPointData()->SetScalars(this->Scalars);
    this->Mapper->SetInputData(this->Data);
    this->Mapper->InterpolateScalarsBeforeMappingOn();
    vtkNew<vtkActor> actor;
    actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(actor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5);
    camera->SetPosition(0.0, 0.0, 2.0);
  }

  void SetTable(vtkScalarsToColors* table) { this->Mapper->SetLookupTable(table); }

  /// Imports, compares with the window, and checks that the table has not changed.
  void Check(const char* what)
  {
    vtkScalarsToColors* table = this->Mapper->GetLookupTable();
    const double alpha = table->GetAlpha();
    const double low = table->GetRange()[0];
    vtkNew<vtkCSLFSceneImporter> importer;
    importer->SetRenderer(this->Renderer);
    importer->Update();
    const vtkMTimeType time = importer->GetMTime();
    vtkNew<vtkCSLFSceneImporter> again;
    again->SetRenderer(this->Renderer);
    again->Update();
    CSLF_CHECK(importer->GetMTime() == time);
    CSLF_CHECK(table->GetAlpha() == alpha && table->GetRange()[0] == low);

    cslf::testing::BakeOptions options;
    options.HeadlightsAllAround = true;
    const auto pictures = cslf::testing::DrawAndTrace(this->Renderer, 96, options);
    const double outside = pictures.GetPartOutside(2);
    std::cout << what << ": " << 100.0 * outside << " % of the pixels differ\n";
    CSLF_CHECK(outside < 0.005);
  }
};

void AddSpecialColors(vtkLookupTable* table)
{
  table->SetUseBelowRangeColor(true);
  table->SetBelowRangeColor(1.0, 0.0, 1.0, 1.0);
  table->SetUseAboveRangeColor(true);
  table->SetAboveRangeColor(1.0, 1.0, 1.0, 1.0);
  table->SetNanColor(0.2, 0.6, 0.2, 1.0);
}

/// From -20 to 120, with NaN in the middle.
double FromBelowToAbove(double x)
{
  return std::abs(x - 0.5) < 0.1 ? vtkMath::Nan() : 140.0 * x - 20.0;
}

/// The imported texture of the square, which is neither repeated nor interpolated.
vtkSmartPointer<vtkImageData> ImportTexture(const Square& square)
{
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(square.Renderer);
  importer->Update();
  auto image = vtkSmartPointer<vtkImageData>::New();
  bool repeat = true;
  bool interpolate = true;
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(importer->GetOutput()->GetBlock(0),
    vtkCSLFMaterial::BaseColorTexture, image, repeat, interpolate));
  CSLF_CHECK(!repeat && !interpolate);
  return image;
}

void TestRange()
{
  // The range of the mapper, not of the table.
  Square square([](double x) { return 100.0 * x; });
  square.Mapper->SetScalarRange(0.0, 100.0);
  const auto image = ImportTexture(square);
  const int width = image->GetDimensions()[0];
  double middle[4];
  double last[4];
  image->GetPointData()->GetScalars()->GetTuple(width / 2, middle);
  image->GetPointData()->GetScalars()->GetTuple(width - 1, last);
  CSLF_CHECK(middle[1] != last[1] && middle[2] != last[2]);
  square.Check("range of the mapper");
}

void TestSpecialColors()
{
  Square square(FromBelowToAbove);
  square.Mapper->SetScalarRange(0.0, 100.0);
  vtkNew<vtkLookupTable> table;
  table->SetHueRange(0.0, 0.7);
  AddSpecialColors(table);
  square.SetTable(table);
  square.Check("below, above and NaN of a table");

  // Without them, the ends are extended.
  table->SetUseBelowRangeColor(false);
  table->SetUseAboveRangeColor(false);
  square.Check("ends of a table");

  vtkNew<vtkLookupTable> own;
  own->SetNumberOfTableValues(5);
  for (int i = 0; i < 5; ++i)
  {
    own->SetTableValue(i, 0.2 * i, 1.0 - 0.2 * i, 0.5, 1.0);
  }
  AddSpecialColors(own);
  square.SetTable(own);
  square.Check("five colours");

  // The array's own table takes precedence.
  square.SetTable(table);
  square.Scalars->SetLookupTable(own);
  square.Check("table of the array");
}

void TestFunctions()
{
  Square square(FromBelowToAbove);
  vtkNew<vtkDiscretizableColorTransferFunction> colors;
  colors->AddRGBPoint(0.0, 0.2, 0.3, 0.8);
  colors->AddRGBPoint(50.0, 0.9, 0.9, 0.9);
  colors->AddRGBPoint(100.0, 0.7, 0.0, 0.1);
  colors->SetColorSpaceToDiverging();
  colors->SetNanColor(1.0, 1.0, 0.0);
  colors->SetUseBelowRangeColor(true);
  colors->SetBelowRangeColor(0.0, 0.0, 0.0);
  colors->SetUseAboveRangeColor(true);
  colors->SetAboveRangeColor(0.0, 1.0, 1.0);
  square.SetTable(colors);
  square.Check("transfer function");
  colors->DiscretizeOn();
  colors->SetNumberOfValues(12);
  square.Check("discrete transfer function");

  vtkNew<vtkPiecewiseFunction> opacities;
  opacities->AddPoint(0.0, 0.2);
  opacities->AddPoint(100.0, 1.0);
  colors->SetScalarOpacityFunction(opacities);
  colors->EnableOpacityMappingOn();
  const auto image = ImportTexture(square);
  CSLF_CHECK_NEAR(image->GetPointData()->GetScalars()->GetComponent(1, 3), 0.2 * 255.0, 10.0);
  CSLF_CHECK_NEAR(image->GetPointData()->GetScalars()->GetComponent(12, 3), 255.0, 10.0);

  vtkNew<vtkColorTransferFunction> plain;
  plain->AddHSVPoint(0.0, 0.6, 1.0, 1.0);
  plain->AddHSVPoint(100.0, 0.0, 1.0, 1.0);
  plain->ClampingOff();
  square.SetTable(plain);
  square.Check("function that does not clamp");
}

void TestTimes()
{
  // Seconds since 1970 are too large for exact floats.
  const double start = 1.7e9;
  Square square([start](double x) { return start + 100.0 * x; });
  square.Mapper->SetScalarRange(start, start + 100.0);
  square.Check("time stamps");
  vtkNew<vtkDiscretizableColorTransferFunction> colors;
  colors->AddRGBPoint(start, 0.0, 0.0, 1.0);
  colors->AddRGBPoint(start + 100.0, 1.0, 0.5, 0.0);
  square.SetTable(colors);
  square.Check("time stamps through a function");
}

void TestLogarithms()
{
  Square square([](double x) { return std::pow(10.0, 4.0 * x - 1.0); });
  square.Mapper->SetScalarRange(1.0, 1000.0);
  vtkNew<vtkLookupTable> table;
  table->SetScaleToLog10();
  square.SetTable(table);
  square.Check("logarithmic table");
  AddSpecialColors(table);
  square.Check("logarithmic table, below and above");
  vtkNew<vtkDiscretizableColorTransferFunction> colors;
  colors->AddRGBPoint(1.0, 0.0, 0.0, 1.0);
  colors->AddRGBPoint(1000.0, 1.0, 0.9, 0.0);
  colors->SetUseLogScale(1);
  colors->SetScaleToLog10();
  square.SetTable(colors);
  square.Check("logarithmic function");
}

void TestVectors()
{
  Square square([](double x) { return 2.0 * x; }, 3);
  square.Mapper->SetScalarRange(0.0, 2.0);
  vtkNew<vtkLookupTable> table;
  table->SetVectorModeToMagnitude();
  square.SetTable(table);
  square.Check("magnitude");
  table->SetVectorModeToComponent();
  table->SetVectorComponent(1);
  square.Check("component");
}

/// Tables without values: the actor's colour, and a warning, of the importer and of the tracer.
void TestEmptyTables()
{
  Square square([](double x) { return x; });
  vtkNew<vtkLookupTable> empty;
  empty->SetNumberOfTableValues(0);
  vtkNew<vtkColorTransferFunction> function;
  vtkNew<vtkDiscretizableColorTransferFunction> steps;
  for (vtkScalarsToColors* table : { static_cast<vtkScalarsToColors*>(empty),
         static_cast<vtkScalarsToColors*>(function), static_cast<vtkScalarsToColors*>(steps) })
  {
    square.SetTable(table);
    for (const bool interpolate : { false, true })
    {
      square.Mapper->SetInterpolateScalarsBeforeMapping(interpolate);
      vtkNew<vtkCSLFSceneImporter> importer;
      importer->SetRenderer(square.Renderer);
      vtkNew<vtkTest::ErrorObserver> messages;
      importer->AddObserver(vtkCommand::WarningEvent, messages);
      importer->Update();
      CSLF_CHECK(messages->GetWarningMessage().find("lookup table without") != std::string::npos);
      auto* block = vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(0));
      CSLF_CHECK(block && !block->GetPointData()->GetScalars());
      vtkNew<vtkImageData> image;
      bool repeat = false;
      bool smooth = false;
      CSLF_CHECK(!vtkCSLFMaterial::GetTexture(
        block, vtkCSLFMaterial::BaseColorTexture, image, repeat, smooth));
    }
    vtkNew<vtkCSLFViewTracer> tracer;
    tracer->SetInputData(square.Mapper->GetInput());
    tracer->SetCamera(square.Renderer->GetActiveCamera());
    tracer->SetSize(4, 4);
    tracer->SetSamples(1);
    tracer->SetLookupTable(table);
    vtkNew<vtkTest::ErrorObserver> messages;
    tracer->AddObserver(vtkCommand::WarningEvent, messages);
    tracer->Update();
    CSLF_CHECK(messages->GetWarningMessage().find("lookup table without") != std::string::npos);
  }
}
}

int TestCSLFSceneImporterTables(int, char*[])
{
  TestRange();
  TestSpecialColors();
  TestFunctions();
  TestTimes();
  TestLogarithms();
  TestVectors();
  TestEmptyTables();
  return cslf::testing::Result();
}
