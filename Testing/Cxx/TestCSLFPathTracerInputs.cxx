// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The path tracer's inputs: colours, materials, blocks, and broken data.
#include "cslfColor.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkContourFilter.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRTAnalyticSource.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <string>

namespace
{
/// A square in the plane z = 0, from (x, -1) to (x + 2, 1), as a quadrilateral or a strip.
vtkSmartPointer<vtkPolyData> MakeSquare(double x, bool strip = false)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x, -1, 0);
  points->InsertNextPoint(x + 2, -1, 0);
  points->InsertNextPoint(x + 2, 1, 0);
  points->InsertNextPoint(x, 1, 0);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(4);
  for (vtkIdType corner : { 0, 1, strip ? 3 : 2, strip ? 2 : 3 })
  {
    cells->InsertCellPoint(corner);
  }
  auto square = vtkSmartPointer<vtkPolyData>::New();
  square->SetPoints(points);
  if (strip)
  {
    square->SetStrips(cells);
  }
  else
  {
    square->SetPolys(cells);
  }
  return square;
}

/// A view tracer that looks at [-2,2] x [-1,1] from above, and its messages.
struct Viewer
{
  vtkNew<vtkCSLFViewTracer> Tracer;
  vtkNew<vtkCamera> Camera;
  vtkNew<vtkTest::ErrorObserver> Messages;
  vtkNew<vtkTest::ErrorObserver> PipelineMessages;

  Viewer()
  {
    this->Camera->SetPosition(0, 0, 5);
    this->Camera->ParallelProjectionOn();
    this->Camera->SetParallelScale(1.0);
    this->Tracer->SetCamera(this->Camera);
    this->Tracer->SetSize(8, 4);
    this->Tracer->SetSamples(16);
    this->Tracer->SetColorTypeToFloat();
    this->Tracer->AddObserver(vtkCommand::ErrorEvent, this->Messages);
    this->Tracer->AddObserver(vtkCommand::WarningEvent, this->Messages);
    this->Tracer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->PipelineMessages);
  }

  bool Update() { return this->Tracer->GetExecutive()->Update() == 1; }

  /// The colour at a point of the plane.
  glm::dvec4 GetColor(double x, double y)
  {
    const int column = static_cast<int>((x + 2.0) * 2.0);
    const int row = static_cast<int>((y + 1.0) * 2.0);
    double color[4];
    this->Tracer->GetOutput()->GetPointData()->GetScalars()->GetTuple(row * 8 + column, color);
    return { color[0], color[1], color[2], color[3] };
  }

  bool WarnsOf(const char* what)
  {
    const bool warned = this->Messages->GetWarningMessage().find(what) != std::string::npos;
    this->Messages->Clear();
    return warned;
  }

  bool FailsWith(const char* what)
  {
    const bool failed =
      !this->Update() && this->Messages->GetErrorMessage().find(what) != std::string::npos;
    this->Messages->Clear();
    this->PipelineMessages->Clear();
    return failed;
  }
};

/// Whether a colour is that of a flat diffuse surface of that sRGB colour under a white sky.
bool Shows(const glm::dvec4& color, double red, double green, double blue)
{
  return color.w == 1.0 &&
    glm::distance(glm::dvec3(color), cslf::SRGBToLinear(glm::dvec3(red, green, blue))) < 2e-3;
}

void TestBlocksAndConnections()
{
  auto left = MakeSquare(-2);
  auto right = MakeSquare(0, true);
  vtkCSLFMaterial::SetBaseColor(left, 1.0, 0.0, 0.0);
  vtkCSLFMaterial::SetBaseColor(right, 0.0, 0.5, 0.0);
  const auto check = [](Viewer& viewer)
  {
    CSLF_CHECK(viewer.Update());
    CSLF_CHECK(viewer.Tracer->GetOutput()->IsA("vtkImageData"));
    CSLF_CHECK(Shows(viewer.GetColor(-1, 0.5), 1.0, 0.0, 0.0));
    CSLF_CHECK(Shows(viewer.GetColor(1, -0.5), 0.0, 0.5, 0.0));
    CSLF_CHECK(!viewer.Messages->GetError() && !viewer.Messages->GetWarning());
  };
  {
    Viewer viewer;
    viewer.Tracer->AddInputData(left);
    viewer.Tracer->AddInputData(right);
    check(viewer);
  }
  {
    // A block takes missing values from its root.
    vtkNew<vtkMultiBlockDataSet> inner;
    inner->SetBlock(0, nullptr);
    auto plain = MakeSquare(0, true);
    inner->SetBlock(1, plain);
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, left);
    blocks->SetBlock(1, inner);
    vtkCSLFMaterial::SetBaseColor(blocks, 0.0, 0.5, 0.0);
    Viewer viewer;
    viewer.Tracer->SetInputDataObject(blocks);
    check(viewer);

    // A change of a block is detected.
    vtkCSLFMaterial::SetBaseColor(plain, 0.0, 0.0, 1.0);
    blocks->Modified();
    CSLF_CHECK(viewer.Update());
    CSLF_CHECK(Shows(viewer.GetColor(1, -0.5), 0.0, 0.0, 1.0));
  }
  {
    vtkNew<vtkPartitionedDataSet> first;
    first->SetPartition(0, left);
    first->SetPartition(1, right);
    vtkNew<vtkPartitionedDataSetCollection> collection;
    collection->SetPartitionedDataSet(0, first);
    Viewer viewer;
    viewer.Tracer->SetInputDataObject(collection);
    check(viewer);
  }
}

void TestColors()
{
  // Bytes are colours; their alpha is opacity.
  auto square = MakeSquare(-2);
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName("Bytes");
  bytes->SetNumberOfComponents(4);
  bytes->InsertNextTuple4(255, 51, 0, 128);
  square->GetCellData()->SetScalars(bytes);
  Viewer viewer;
  viewer.Tracer->AddInputData(square);
  CSLF_CHECK(viewer.Update());
  const glm::dvec4 half = viewer.GetColor(-1, 0);
  CSLF_CHECK(half.w > 0.0 && half.w < 1.0);
  CSLF_CHECK(Shows(glm::dvec4(glm::dvec3(half) / half.w, 1.0), 1.0, 0.2, 0.0));
  viewer.Tracer->ScalarVisibilityOff();
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK(Shows(viewer.GetColor(-1, 0), 0.8, 0.8, 0.8));
  viewer.Tracer->ScalarVisibilityOn();

  // Numbers go through a lookup table: a default one over all inputs, red for the lowest, blue for
  // the highest.
  vtkNew<vtkFloatArray> low;
  low->SetName("Numbers");
  low->InsertNextValue(3.0f);
  vtkNew<vtkFloatArray> high;
  high->SetName("Numbers");
  high->InsertNextValue(7.0f);
  square->GetCellData()->SetScalars(low);
  auto other = MakeSquare(0);
  other->GetCellData()->SetScalars(high);
  viewer.Tracer->AddInputData(other);
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK(Shows(viewer.GetColor(-1, 0), 1.0, 0.0, 0.0));
  CSLF_CHECK(Shows(viewer.GetColor(1, 0), 0.0, 0.0, 1.0));

  // A given table.
  vtkNew<vtkLookupTable> table;
  table->SetRange(0.0, 10.0);
  table->SetHueRange(0.0, 0.0);
  table->SetSaturationRange(0.0, 0.0);
  table->SetValueRange(0.0, 1.0);
  table->SetNumberOfTableValues(11);
  table->SetRampToLinear();
  viewer.Tracer->SetLookupTable(table);
  CSLF_CHECK(viewer.Update());
  double mapped[3];
  table->GetColor(3.0, mapped);
  const double grey = mapped[0];
  CSLF_CHECK_NEAR(grey, 0.3, 0.01);
  CSLF_CHECK(Shows(viewer.GetColor(-1, 0), grey, grey, grey));

  // An array of points by name: interpolated.
  vtkNew<vtkUnsignedCharArray> corners;
  corners->SetName("Corners");
  corners->SetNumberOfComponents(3);
  for (int i = 0; i < 4; ++i)
  {
    corners->InsertNextTuple3(0, i < 2 ? 0 : 255, 0);
  }
  square->GetPointData()->AddArray(corners);
  viewer.Tracer->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "Corners");
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK_NEAR(viewer.GetColor(-1, 0.25).y, 0.625, 0.02);
  CSLF_CHECK_NEAR(viewer.GetColor(-1, -0.75).y, 0.125, 0.02);
  CSLF_CHECK(Shows(viewer.GetColor(1, 0), 0.8, 0.8, 0.8));
  CSLF_CHECK(!viewer.Messages->GetError() && !viewer.Messages->GetWarning());
}

void TestBrokenData()
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto square = MakeSquare(-2);
  vtkPoints* points = square->GetPoints();
  const vtkIdType broken = points->InsertNextPoint(nan, 0, 0);
  const vtkIdType infinite = points->InsertNextPoint(std::numeric_limits<double>::infinity(), 0, 0);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (int i = 0; i < 6; ++i)
  {
    normals->InsertNextTuple3(i == 0 ? nan : 0.0, 0.0, i == 1 ? 0.0 : 1.0);
  }
  square->GetPointData()->SetNormals(normals);
  vtkCellArray* polygons = square->GetPolys();
  const vtkIdType triangles[][3] = { { 0, 1, broken }, { 0, infinite, 2 }, { 0, 1, 1 },
    { 2, 2, 2 } };
  for (const auto& triangle : triangles)
  {
    polygons->InsertNextCell(3, triangle);
  }
  const vtkIdType pentagon[] = { 0, 1, 2, broken, 3 };
  polygons->InsertNextCell(5, pentagon);
  const vtkIdType collinear[] = { 0, 1, 0, 1, 0 };
  polygons->InsertNextCell(4, collinear);
  polygons->InsertNextCell(5, collinear);
  // The cells keep their colours.
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(255, 0, 0);
  for (int i = 0; i < 7; ++i)
  {
    colors->InsertNextTuple3(0, 255, 0);
  }
  square->GetCellData()->SetScalars(colors);
  Viewer viewer;
  viewer.Tracer->SetInputData(square);
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK(Shows(viewer.GetColor(-1, 0.3), 1.0, 0.0, 0.0));
  CSLF_CHECK(viewer.GetColor(1, 0).w == 0.0);
  CSLF_CHECK(viewer.WarnsOf("3 polygon(s) with coordinates that are not finite"));

  // The colours of lines differ from those of polygons; textures without coordinates.
  vtkNew<vtkCellArray> lines;
  const vtkIdType line[] = { 0, 1 };
  lines->InsertNextCell(2, line);
  auto lined = MakeSquare(-2);
  lined->SetLines(lines);
  vtkNew<vtkUnsignedCharArray> linedColors;
  linedColors->SetNumberOfComponents(3);
  linedColors->InsertNextTuple3(0, 255, 0); // of the line
  linedColors->InsertNextTuple3(255, 0, 0);
  lined->GetCellData()->SetScalars(linedColors);
  vtkNew<vtkImageData> image;
  image->SetDimensions(1, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkCSLFMaterial::SetTexture(lined, vtkCSLFMaterial::BaseColorTexture, image);
  viewer.Tracer->SetInputData(lined);
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK(Shows(viewer.GetColor(-1, 0.3), 1.0, 0.0, 0.0));
  CSLF_CHECK(viewer.WarnsOf("1 block(s)' textures"));

  vtkNew<vtkPolyData> nothing;
  viewer.Tracer->SetInputData(nothing);
  CSLF_CHECK(viewer.FailsWith("no triangles"));
  vtkNew<vtkMultiBlockDataSet> images;
  images->SetBlock(0, vtkSmartPointer<vtkImageData>::New());
  images->SetBlock(1, MakeSquare(-2));
  viewer.Tracer->SetInputDataObject(images);
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK(viewer.WarnsOf("vtkImageData"));

  // It works again after an error.
  viewer.Tracer->SetInputData(lined);
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK(Shows(viewer.GetColor(-1, 0.3), 1.0, 0.0, 0.0));
  viewer.Messages->Clear();
}

void TestLightsInFieldData()
{
  // A light in a block of its own; a point light in a scene whose size is not 1.
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, MakeSquare(-2));
  scene->SetBlock(1, MakeSquare(0));
  auto lights = vtkSmartPointer<vtkPolyData>::New();
  const double direction[3] = { 0.0, 0.0, -2.0 };
  const double position[3] = { -0.75, 0.25, 2.0 };
  const double irradiance[3] = { 1.0, 0.0, 0.0 };
  const double intensity[3] = { 0.0, 4.0, 0.0 };
  vtkCSLFLight::AddDirectionalLight(lights, direction, irradiance);
  vtkCSLFLight::AddPointLight(lights, position, intensity);
  scene->SetBlock(2, lights);
  Viewer viewer;
  viewer.Tracer->SetInputDataObject(scene);
  viewer.Tracer->GetEnvironment()->SetModeToNone();
  viewer.Tracer->SetSize(80, 40);
  CSLF_CHECK(viewer.Update());
  double color[4];
  viewer.Tracer->GetOutput()->GetPointData()->GetScalars()->GetTuple(25 * 80 + 25, color);
  const double reflected = cslf::SRGBToLinear(0.8) / 3.14159265;
  CSLF_CHECK_NEAR(color[0], reflected, 1e-3);
  CSLF_CHECK_NEAR(color[1], reflected, 1e-3);

  const double zero[3] = { 0.0, 0.0, 0.0 };
  vtkCSLFLight::AddDirectionalLight(lights, zero, irradiance);
  scene->Modified();
  CSLF_CHECK(viewer.Update());
  CSLF_CHECK(viewer.WarnsOf("1 light(s)"));
}

/// A contour of image data that is complete before the request, or made with the picture.
void ConnectContour(Viewer& viewer, bool isWhole)
{
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->SetWholeExtent(-5, 5, -5, 5, -5, 5);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(wavelet->GetOutputPort());
  contour->SetValue(0, 200.0);
  if (isWhole)
  {
    contour->Update();
    viewer.Tracer->SetInputDataObject(contour->GetOutput());
  }
  else
  {
    viewer.Tracer->SetInputConnection(contour->GetOutputPort());
  }
}

/// The picture's extent must not determine which part of image data upstream is contoured.
void TestImageUpstream()
{
  Viewer whole;
  ConnectContour(whole, true);
  CSLF_CHECK(whole.Update());
  Viewer connected;
  ConnectContour(connected, false);
  CSLF_CHECK(connected.Update());
  int seen = 0;
  for (double x = -1.75; x < 2.0; x += 0.5)
  {
    for (double y = -0.75; y < 1.0; y += 0.5)
    {
      const glm::dvec4 color = whole.GetColor(x, y);
      CSLF_CHECK(connected.GetColor(x, y) == color);
      seen += color.a > 0.0 ? 1 : 0;
    }
  }
  CSLF_CHECK(seen > 0);
}
}

int TestCSLFPathTracerInputs(int, char*[])
{
  TestBlocksAndConnections();
  TestColors();
  TestBrokenData();
  TestLightsInFieldData();
  TestImageUpstream();
  return cslf::testing::Result();
}
