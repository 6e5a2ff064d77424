// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Exact colours: what a scalar bar shows, whatever the shape, the material and the light.
#include "cslfDescription.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVariant.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>

namespace
{
using Color = std::array<int, 3>;

constexpr int Side = 64;

/// A picture of [-1,1] x [-1,1] against -z.
struct Picture
{
  vtkNew<vtkCSLFViewTracer> Tracer;

  Picture()
  {
    vtkNew<vtkCamera> camera;
    camera->SetPosition(0.0, 0.0, 10.0);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(1.0);
    this->Tracer->SetCamera(camera);
    this->Tracer->SetSize(Side, Side);
    this->Tracer->SetSamples(16);
    this->Tracer->SetColorsToExact();
    // Nothing of this may matter.
    this->Tracer->SetIntegratorToRadianceCaching();
    this->Tracer->SetExposure(3.0);
    this->Tracer->GetEnvironment()->SetColor(1.0, 0.2, 0.1);
  }

  const unsigned char* Get(int column, int row) const
  {
    return static_cast<unsigned char*>(this->Tracer->GetOutput()->GetScalarPointer(column, row, 0));
  }

  /// Checks all pixels that are covered.
  void Check(const std::string& name, const std::function<Color(double x, double y)>& expect,
    int tolerance = 1) const
  {
    int covered = 0;
    int wrong = 0;
    for (int row = 0; row < Side; ++row)
    {
      for (int column = 0; column < Side; ++column)
      {
        const unsigned char* pixel = this->Get(column, row);
        if (pixel[3] < 255)
        {
          continue;
        }
        ++covered;
        const Color color =
          expect((2.0 * column + 1.0) / Side - 1.0, (2.0 * row + 1.0) / Side - 1.0);
        for (int i = 0; i < 3; ++i)
        {
          if (std::abs(pixel[i] - color[i]) > tolerance && wrong++ < 3)
          {
            std::cerr << name << ": component " << i << " at " << column << ", " << row << " is "
                      << int(pixel[i]) << ", expected " << color[i] << "\n";
          }
        }
      }
    }
    CSLF_CHECK(covered > 100);
    CSLF_CHECK(wrong == 0);
  }

  void Check(const std::string& name, const Color& color) const
  {
    this->Check(name, [&](double, double) { return color; });
  }

  void Trace(vtkPolyData* data)
  {
    this->Tracer->SetInputData(data);
    this->Tracer->Update();
  }
};

/// The square [-1,1] x [-1,1], with the scalars `get(x)`.
vtkSmartPointer<vtkPolyData> MakeSquare(
  const std::function<double(double)>& get = nullptr, int resolution = 1)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.0, -1.0, 0.0);
  plane->SetPoint1(1.0, -1.0, 0.0);
  plane->SetPoint2(-1.0, 1.0, 0.0);
  plane->SetResolution(resolution, 1);
  plane->Update();
  const vtkSmartPointer<vtkPolyData> square = plane->GetOutput();
  if (get)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName("values");
    for (vtkIdType i = 0; i < square->GetNumberOfPoints(); ++i)
    {
      values->InsertNextValue(get(square->GetPoint(i)[0]));
    }
    square->GetPointData()->SetScalars(values);
  }
  return square;
}

Color MapThrough(vtkScalarsToColors* table, double value)
{
  const unsigned char* color = table->MapValue(value);
  return { color[0], color[1], color[2] };
}

/// Two triangles over the whole range show all colours of the table, and no others.
void TestTables()
{
  vtkNew<vtkColorTransferFunction> smooth;
  smooth->SetColorSpaceToDiverging();
  smooth->AddRGBPoint(0.0, 0.230, 0.299, 0.754);
  smooth->AddRGBPoint(3.0, 0.706, 0.016, 0.150);
  Picture picture;
  picture.Tracer->SetLookupTable(smooth);
  picture.Trace(MakeSquare([](double x) { return 1.5 + 1.5 * x; }));
  // A pixel is a mean over 1/64 of the range.
  picture.Check(
    "smooth", [&](double x, double) { return MapThrough(smooth, 1.5 + 1.5 * x); }, 2);

  vtkNew<vtkLookupTable> steps;
  steps->SetNumberOfTableValues(8);
  steps->SetTableRange(-1.0, 1.0);
  steps->Build();
  picture.Tracer->SetLookupTable(steps);
  picture.Trace(MakeSquare([](double x) { return x; }));
  picture.Check("steps", [&](double x, double) { return MapThrough(steps, x); });

  // Cells are not interpolated.
  const auto cells = MakeSquare(nullptr, 8);
  vtkNew<vtkDoubleArray> numbers;
  for (int i = 0; i < 8; ++i)
  {
    numbers->InsertNextValue((i + 0.5) / 4.0 - 1.0);
  }
  cells->GetCellData()->SetScalars(numbers);
  picture.Trace(cells);
  picture.Check("cells", [&](double x, double) { return MapThrough(steps, x); });

  // Beyond the range, and without a number.
  steps->UseBelowRangeColorOn();
  steps->SetBelowRangeColor(1.0, 1.0, 1.0, 1.0);
  steps->UseAboveRangeColorOn();
  steps->SetAboveRangeColor(0.0, 0.0, 0.0, 1.0);
  steps->SetNanColor(0.2, 0.4, 0.6, 1.0);
  picture.Trace(MakeSquare([](double x) { return 2.0 * x; }));
  picture.Check("beyond", [&](double x, double) { return MapThrough(steps, 2.0 * x); });
  picture.Trace(MakeSquare([](double) { return vtkMath::Nan(); }));
  picture.Check("no number", { 51, 102, 153 });

  steps->SetUseBelowRangeColor(false);
  steps->SetUseAboveRangeColor(false);
  steps->SetTableRange(1.0, 100.0);
  steps->SetScaleToLog10();
  picture.Trace(MakeSquare([](double x) { return std::pow(10.0, 1.0 + x); }, 256));
  picture.Check(
    "logarithmic", [&](double x, double) { return MapThrough(steps, std::pow(10.0, 1.0 + x)); });
}

/// Colours of points are interpolated as displayed.
void TestPointColors()
{
  const auto square = MakeSquare();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < square->GetNumberOfPoints(); ++i)
  {
    const double bright = square->GetPoint(i)[0] > 0.0 ? 255.0 : 0.0;
    colors->InsertNextTuple3(bright, 100.0, 255.0 - bright);
  }
  square->GetPointData()->SetScalars(colors);
  Picture picture;
  picture.Trace(square);
  picture.Check("points",
    [](double x, double)
    {
      const int level = static_cast<int>(std::lround(127.5 + 127.5 * x));
      return Color{ level, 100, 255 - level };
    });
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const unsigned char pixels[6] = { 10, 200, 30, 250, 60, 7 };
  std::copy_n(pixels, 6, static_cast<unsigned char*>(image->GetScalarPointer()));
  const auto textured = MakeSquare();
  vtkCSLFMaterial::SetBaseColor(textured, 1.0, 1.0, 1.0);
  vtkCSLFMaterial::SetTexture(textured, vtkCSLFMaterial::BaseColorTexture, image, false, false);
  picture.Trace(textured);
  picture.Check("texture",
    [&pixels](double x, double)
    {
      const unsigned char* pixel = pixels + (x < 0.0 ? 0 : 3);
      return Color{ pixel[0], pixel[1], pixel[2] };
    });
}

/// Every material shows its base colour under every light, with its opacity.
void TestMaterials()
{
  const Color expected{ 64, 128, 191 };
  const auto set = [](vtkDataObject* data)
  { vtkCSLFMaterial::SetBaseColor(data, 64.0 / 255.0, 128.0 / 255.0, 191.0 / 255.0); };
  for (const char* name : { "plain", "metal", "glass", "glossy", "lit" })
  {
    const std::string kind = name;
    const auto square = MakeSquare();
    set(square);
    vtkCSLFMaterial::SetMetallic(square, kind == "metal" ? 1.0 : 0.0);
    vtkCSLFMaterial::SetRoughness(square, kind == "plain" ? 1.0 : 0.0);
    vtkCSLFMaterial::SetIndexOfRefraction(square, kind == "plain" ? 1.0 : 1.5);
    vtkCSLFMaterial::SetTransmission(square, kind == "glass" ? 1.0 : 0.0);
    const double towards[3] = { 0.0, 0.0, -1.0 };
    const double irradiance[3] = { 9.0, 1.0, 4.0 };
    if (kind == "lit")
    {
      vtkCSLFLight::AddDirectionalLight(square, towards, irradiance);
    }
    Picture picture;
    picture.Trace(square);
    picture.Check(kind, expected);
  }
  Picture picture;
  const auto thin = MakeSquare();
  set(thin);
  vtkCSLFMaterial::SetOpacity(thin, 0.5);
  picture.Tracer->SetSamples(256);
  picture.Trace(thin);
  double sums[4] = { 0.0, 0.0, 0.0, 0.0 };
  for (int i = 0; i < Side * Side; ++i)
  {
    for (int c = 0; c < 4; ++c)
    {
      sums[c] += picture.Get(i % Side, i / Side)[c];
    }
  }
  CSLF_CHECK_NEAR(sums[3] / (Side * Side), 127.5, 1.0);
  for (int c = 0; c < 3; ++c)
  {
    CSLF_CHECK_NEAR(255.0 * sums[c] / sums[3], expected[c], 1.0);
  }
  const auto lamp = MakeSquare();
  vtkCSLFMaterial::SetBaseColor(lamp, 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(lamp, 1.0, 0.0, 7.0);
  picture.Trace(lamp);
  picture.Check("lamp", { 255, 0, 255 });
}

/// Spheres, tubes and instances shade nothing either.
void TestShapes()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-0.5, -0.5, 0.0);
  points->InsertNextPoint(0.5, 0.5, 0.0);
  const vtkIdType ids[2] = { 0, 1 };
  for (const bool isTube : { false, true })
  {
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(isTube ? 2 : 1, ids);
    isTube ? data->SetLines(cells) : data->SetVerts(cells);
    vtkCSLFMaterial::SetPointRadius(data, 0.4);
    vtkCSLFMaterial::SetLineRadius(data, 0.2);
    vtkCSLFMaterial::SetBaseColor(data, 0.4, 0.8, 0.2);
    Picture picture;
    picture.Trace(data);
    picture.Check(isTube ? "tube" : "sphere", { 102, 204, 51 });
  }
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.4);
  ball->Update();
  vtkPolyData* data = ball->GetOutput();
  vtkNew<vtkMatrix4x4> matrix;
  const double colors[2][4] = { { 1.0, 0.2, 0.0, 1.0 }, { 0.0, 0.2, 1.0, 1.0 } };
  for (int i = 0; i < 2; ++i)
  {
    matrix->SetElement(0, 3, i - 0.5);
    vtkCSLFInstances::AddInstance(data, matrix, colors[i]);
  }
  Picture picture;
  picture.Trace(data);
  picture.Check("instances",
    [](double x, double) {
      return x < 0.0 ? Color{ 255, 51, 0 } : Color{ 0, 51, 255 };
    });
}

/// A renderer's lights, shading and coefficients do not matter, and its scalars are interpolated.
void TestRenderer()
{
  vtkNew<vtkColorTransferFunction> table;
  table->AddRGBPoint(-1.0, 1.0, 0.0, 0.0);
  table->AddRGBPoint(0.0, 0.0, 1.0, 0.0);
  table->AddRGBPoint(1.0, 0.0, 0.0, 1.0);
  for (const int interpolation : { VTK_FLAT, VTK_PHONG, VTK_PBR })
  {
    for (const bool isColored : { false, true })
    {
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputData(
        MakeSquare(isColored ? [](double x) { return x; } : std::function<double(double)>()));
      mapper->SetLookupTable(table);
      mapper->UseLookupTableScalarRangeOn();
      vtkNew<vtkActor> actor;
      actor->SetMapper(mapper);
      actor->GetProperty()->SetInterpolation(interpolation);
      actor->GetProperty()->SetColor(0.2, 0.4, 0.8);
      actor->GetProperty()->SetAmbient(0.3);
      actor->GetProperty()->SetDiffuse(0.6);
      actor->GetProperty()->SetSpecular(0.5);
      actor->GetProperty()->SetMetallic(0.7);
      vtkNew<vtkLight> light;
      light->SetPosition(3.0, 2.0, 5.0);
      light->SetColor(1.0, 0.5, 0.2);
      light->SetIntensity(0.4);
      vtkNew<vtkRenderer> renderer;
      renderer->AddActor(actor);
      renderer->AddLight(light);
      Picture picture;
      picture.Tracer->SetRenderer(renderer);
      picture.Tracer->Update();
      const std::string name = "renderer, " + std::to_string(interpolation);
      if (!isColored)
      {
        picture.Check(name, { 51, 102, 204 });
        continue;
      }
      // VTK's texture of the table has steps.
      picture.Check(
        name + ", scalars", [&](double x, double) { return MapThrough(table, x); }, 4);
      CSLF_CHECK(!mapper->GetInterpolateScalarsBeforeMapping());
    }
  }
}

/// All texels of a field that see nothing else show the colour, and its geometry has it.
void TestField()
{
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(32);
  ball->SetPhiResolution(32);
  ball->Update();
  vtkCSLFMaterial::SetBaseColor(ball->GetOutput(), 0.2, 0.6, 0.4);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(ball->GetOutput());
  sampler->SetViewpoints(2);
  sampler->SetResolution(16);
  sampler->SetSamples(4);
  sampler->GetEnvironment()->SetIntensity(0.5);
  CSLF_CHECK(sampler->GetColors() == vtkCSLFSampler::Lit);
  const auto measure = [&]
  {
    sampler->Update();
    int worst = 0;
    auto* texels =
      vtkUnsignedCharArray::SafeDownCast(sampler->GetOutput()->GetPointData()->GetScalars());
    for (vtkIdType i = 0; i < texels->GetNumberOfTuples(); ++i)
    {
      const double* color = texels->GetTuple4(i);
      const double error = std::max(
        { std::abs(color[0] - 51.0), std::abs(color[1] - 153.0), std::abs(color[2] - 102.0) });
      worst = color[3] == 255.0 ? std::max(worst, static_cast<int>(error)) : worst;
    }
    return worst;
  };
  const int lit = measure();
  const auto describe = [&]
  {
    vtkFieldData* fields = sampler->GetOutput()->GetFieldData();
    return fields->GetAbstractArray(cslf::Description::FieldDataName)
      ->GetVariantValue(0)
      .ToString();
  };
  CSLF_CHECK(lit > 1 && describe().find("exact") == std::string::npos);
  sampler->SetColorsToExact();
  CSLF_CHECK(measure() <= 1);
  CSLF_CHECK(sampler->GetUsedIntegrator() == vtkCSLFSampler::PathTracing);
  CSLF_CHECK(sampler->GetUsedMaximumDepth() == 0 && sampler->GetUsedExposure() == 1.0);
  CSLF_CHECK(describe().find("exact") != std::string::npos);
  vtkDataArray* colors = sampler->GetGeometry()->GetPointData()->GetScalars();
  CSLF_CHECK(colors->GetNumberOfTuples() > 0);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    CSLF_CHECK_NEAR(colors->GetComponent(i, 1), 153.0, 1.0);
  }
  sampler->SetColorsToLit();
  CSLF_CHECK(measure() == lit);
}
}

int TestCSLFExactColors(int, char*[])
{
  TestTables();
  TestPointColors();
  TestMaterials();
  TestShapes();
  TestRenderer();
  TestField();
  return cslf::testing::Result();
}
