// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Tubes that are much longer than thick, compared with closed forms: their outline, their light,
// and the light that passes them if they are translucent.
#include "cslfColor.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <initializer_list>

namespace
{
constexpr double Half = 1.0; // of a tube's length

// Not an axis along which rounding errors vanish.
const double Axis[3] = { 0.8, 0.6, 0.0 };

/// A line through the origin, in equal parts.
vtkSmartPointer<vtkPolyData> MakeLine(double radius, int parts = 1)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(parts + 1);
  for (int i = 0; i <= parts; ++i)
  {
    const double place = Half * (2.0 * i / parts - 1.0);
    cells->InsertCellPoint(
      points->InsertNextPoint(place * Axis[0], place * Axis[1], place * Axis[2]));
  }
  auto line = vtkSmartPointer<vtkPolyData>::New();
  line->SetPoints(points);
  line->SetLines(cells);
  vtkCSLFMaterial::SetLineRadius(line, radius);
  return line;
}

struct View
{
  double Along;  ///< the line, from its middle
  double Across; ///< it
  double Width;
  int Samples;
};

/// A small square, seen along the axis of z: the mean of its colours.
struct Picture
{
  static constexpr int Size = 16;
  double Mean[4] = { 0.0, 0.0, 0.0, 0.0 };

  Picture(vtkDataObject* scene, const View& view)
  {
    vtkNew<vtkCamera> camera;
    const double x = view.Along * Axis[0] - view.Across * Axis[1];
    const double y = view.Along * Axis[1] + view.Across * Axis[0];
    camera->SetPosition(x, y, 2.0);
    camera->SetFocalPoint(x, y, 0.0);
    camera->SetViewUp(Axis);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5 * view.Width);
    vtkNew<vtkCSLFViewTracer> tracer;
    tracer->SetInputDataObject(scene);
    tracer->SetCamera(camera);
    tracer->SetSize(Size, Size);
    tracer->SetSamples(view.Samples);
    tracer->GetEnvironment()->SetModeToNone();
    tracer->SetColorTypeToFloat();
    tracer->SetMaximumDepth(1);
    tracer->Update();
    vtkDataArray* colors = tracer->GetOutput()->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < Size * Size; ++i)
    {
      for (int c = 0; c < 4; ++c)
      {
        this->Mean[c] += colors->GetComponent(i, c) / (Size * Size);
      }
    }
  }
};

/// The tube covers half of a square that is four radii wide, everywhere along it, also if the
/// radius grows.
void TestOutline()
{
  for (const double ratio : { 60.0, 600.0, 6000.0 })
  {
    const double radius = 2.0 * Half / ratio;
    auto cone = MakeLine(radius);
    vtkNew<vtkFloatArray> radii;
    radii->SetName(vtkCSLFMaterial::LineRadiusName());
    radii->InsertNextValue(static_cast<float>(0.1 * radius));
    radii->InsertNextValue(static_cast<float>(radius));
    cone->GetPointData()->AddArray(radii);
    for (const double place : { -0.8, 0.0, 0.37, 0.93 })
    {
      const double alpha = Picture(MakeLine(radius), { place, 0.0, 4.0 * radius, 64 }).Mean[3];
      CSLF_CHECK_NEAR(alpha, 0.5, 0.001);
      const double width = 4.0 * radius * (0.55 + 0.45 * place / Half);
      CSLF_CHECK_NEAR(Picture(cone, { place, 0.0, width, 64 }).Mean[3], 0.5, 0.002);
    }
  }
}

/// The light of an emissive tube on a plane below, seen from above beside the tube: the irradiance
/// of a cylinder that is completely above the horizon is that of a line with its brightness.
void TestLight()
{
  constexpr double radiance = 10.0;
  for (const double ratio : { 60.0, 600.0, 6000.0 })
  {
    const double radius = 2.0 * Half / ratio;
    for (const double opacity : { 1.0, 0.4 })
    {
      for (const double steps : { 1.0, 10.0 })
      {
        const double height = 2.0 * steps * radius;
        const double aside = 3.0 * steps * radius;
        auto line = MakeLine(radius);
        vtkCSLFMaterial::SetEmission(line, radiance, radiance, radiance);
        vtkCSLFMaterial::SetOpacity(line, opacity);
        vtkNew<vtkPlaneSource> plane;
        plane->SetOrigin(-2, -2, -height);
        plane->SetPoint1(2, -2, -height);
        plane->SetPoint2(-2, 2, -height);
        plane->Update();
        vtkNew<vtkMultiBlockDataSet> scene;
        scene->SetBlock(0, line);
        scene->SetBlock(1, plane->GetOutput());
        const double light =
          Picture(scene, { 0.0, aside, 0.25 * radius, 256 }).Mean[0] / cslf::SRGBToLinear(0.8);
        const double distance = std::hypot(height, aside);
        const double angle = std::atan((Half + 0.25 * vtkMath::Pi() * radius) / distance);
        const double part = (angle + std::sin(angle) * std::cos(angle)) * 2.0 / vtkMath::Pi();
        const double expected = opacity * radiance * radius * height / (distance * distance) * part;
        CSLF_CHECK_NEAR(light / expected, 1.0, 0.01);
      }
    }
  }
}

/// Light hits a translucent tube once, wherever it is divided: no part is denser.
void TestOpacity()
{
  for (const double ratio : { 60.0, 600.0, 6000.0 })
  {
    const double radius = 2.0 * Half / ratio;
    auto line = MakeLine(radius);
    vtkCSLFMaterial::SetEmission(line, 2, 2, 2);
    vtkCSLFMaterial::SetOpacity(line, 0.4);
    constexpr int squares = 64; // one after the other, including joints of pieces
    double sum = 0.0;
    for (int i = 0; i < squares; ++i)
    {
      const Picture picture(line, { (i - 0.5 * squares) * 0.9 * radius, 0.0, radius, 16 });
      CSLF_CHECK_NEAR(picture.Mean[3], 0.4, 0.05);
      CSLF_CHECK_NEAR(picture.Mean[0], 2.0 * picture.Mean[3], 1e-5);
      sum += picture.Mean[3] / squares;
    }
    CSLF_CHECK_NEAR(sum, 0.4, 0.005);
  }
}

void AddEmissions(vtkDataSetAttributes* attributes, std::initializer_list<float> values)
{
  vtkNew<vtkFloatArray> emissions;
  emissions->SetName(vtkCSLFMaterial::EmissionName());
  emissions->SetNumberOfComponents(3);
  for (const float value : values)
  {
    emissions->InsertNextTuple3(value, value, value);
  }
  attributes->AddArray(emissions);
}

/// Values of points vary evenly along the line; values of cells are those of their line.
void TestValues()
{
  constexpr double radius = 2.0 * Half / 600.0;
  auto line = MakeLine(radius);
  AddEmissions(line->GetPointData(), { 0.0f, 2.0f });
  for (const double place : { -0.93, -0.5, 0.0, 0.37, 0.93 })
  {
    const Picture picture(line, { place, 0.0, 0.5 * radius, 1 });
    CSLF_CHECK_NEAR(picture.Mean[0], 1.0 + place / Half, 1e-3);
  }

  auto bright = MakeLine(radius, 2);
  const vtkIdType halves[2][2] = { { 0, 1 }, { 1, 2 } };
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(2, halves[0]);
  cells->InsertNextCell(2, halves[1]);
  bright->SetLines(cells);
  AddEmissions(bright->GetCellData(), { 0.25f, 0.75f });
  for (const double place : { -0.9, -0.1, 0.1, 0.9 })
  {
    const Picture picture(bright, { place, 0.0, 0.5 * radius, 1 });
    CSLF_CHECK_NEAR(picture.Mean[0], place < 0.0 ? 0.25 : 0.75, 1e-5);
  }
}
}

int TestCSLFLongTubes(int, char*[])
{
  TestOutline();
  TestLight();
  TestOpacity();
  TestValues();
  return cslf::testing::Result();
}
