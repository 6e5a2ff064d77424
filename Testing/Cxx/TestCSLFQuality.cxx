// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares PSNR and SSIM with closed forms and a window summed directly; PSNR of whole fields.
#include "vtkCSLFFieldQuality.h"
#include "vtkCSLFImageQuality.h"

#include "cslfColor.h"
#include "cslfTestField.h"
#include "cslfTesting.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTestErrorObserver.h>

#include <cmath>
#include <functional>
#include <string>

namespace
{
using Shade = std::function<int(int x, int y, int component)>;

vtkSmartPointer<vtkImageData> MakePicture(int width, int height, int components, Shade shade)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      for (int component = 0; component < components; ++component)
      {
        pixel[component] = static_cast<unsigned char>(shade(x, y, component));
      }
    }
  }
  return image;
}

int Noise(int x, int y, int seed)
{
  return static_cast<int>(
    (static_cast<unsigned>(x) * 73856093u ^ static_cast<unsigned>(y + 7 * seed) * 19349663u) %
    191u);
}

void TestConstants()
{
  // Alpha differs and must not count.
  const auto a = MakePicture(20, 15, 4, [](int, int, int c) { return c == 3 ? 10 : 100; });
  const auto b = MakePicture(20, 15, 3, [](int, int, int) { return 107; });
  vtkNew<vtkCSLFImageQuality> quality;
  quality->SetInputData(0, a);
  quality->SetInputData(1, b);
  quality->Update();
  CSLF_CHECK_NEAR(quality->GetPSNR(), 20.0 * std::log10(255.0 / 7.0), 1e-9);
  const double c1 = 0.01 * 255.0 * 0.01 * 255.0;
  const double expected = (2.0 * 100.0 * 107.0 + c1) / (100.0 * 100.0 + 107.0 * 107.0 + c1);
  CSLF_CHECK_NEAR(quality->GetSSIM(), expected, 1e-9);
  CSLF_CHECK(quality->GetNumberOfPixels() == 300);
  quality->SetInputData(1, a);
  quality->Update();
  CSLF_CHECK(quality->GetPSNR() == 60.0);
  CSLF_CHECK_NEAR(quality->GetSSIM(), 1.0, 1e-12);
  quality->SetMaximumPSNR(48.0);
  quality->Update();
  CSLF_CHECK(quality->GetPSNR() == 48.0);
}

/// The SSIM of one window, by the paper's sums.
double SumWindow(int centreX, int centreY, const Shade& shadeA, const Shade& shadeB)
{
  double weights = 0.0;
  double a = 0.0;
  double b = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  for (int y = -5; y <= 5; ++y)
  {
    for (int x = -5; x <= 5; ++x)
    {
      const double weight = std::exp(-(x * x + y * y) / (2.0 * 1.5 * 1.5));
      const double valueA = shadeA(centreX + x, centreY + y, 0);
      const double valueB = shadeB(centreX + x, centreY + y, 0);
      weights += weight;
      a += weight * valueA;
      b += weight * valueB;
      aa += weight * valueA * valueA;
      bb += weight * valueB * valueB;
      ab += weight * valueA * valueB;
    }
  }
  a /= weights;
  b /= weights;
  const double varianceA = aa / weights - a * a;
  const double varianceB = bb / weights - b * b;
  const double covariance = ab / weights - a * b;
  const double c1 = std::pow(0.01 * 255.0, 2);
  const double c2 = std::pow(0.03 * 255.0, 2);
  return (2 * a * b + c1) * (2 * covariance + c2) /
    ((a * a + b * b + c1) * (varianceA + varianceB + c2));
}

void TestWindow()
{
  const Shade shadeA = [](int x, int y, int) { return Noise(x, y, 1); };
  const Shade shadeB = [](int x, int y, int) { return (Noise(x, y, 1) + Noise(x, y, 2)) / 2; };
  vtkNew<vtkCSLFImageQuality> quality;
  quality->SetInputData(0, MakePicture(14, 11, 1, shadeA));
  quality->SetInputData(1, MakePicture(14, 11, 1, shadeB));
  quality->Update();
  double mean = 0.0;
  for (int x = 5; x <= 8; ++x)
  {
    const double expected = SumWindow(x, 5, shadeA, shadeB);
    mean += expected / 4.0;
    CSLF_CHECK_NEAR(quality->GetOutput()->GetScalarComponentAsDouble(x, 5, 0, 0), expected, 1e-9);
  }
  CSLF_CHECK_NEAR(quality->GetSSIM(), mean, 1e-9);
  CSLF_CHECK(mean > 0.1 && mean < 0.99);
}

void TestStencil()
{
  // Pictures that differ by 3 on the left and by 50 on the right, which the stencil excludes.
  const auto a = MakePicture(16, 16, 3, [](int, int, int) { return 80; });
  const auto b = MakePicture(16, 16, 3, [](int x, int, int) { return x < 8 ? 83 : 130; });
  vtkNew<vtkImageStencilData> stencil;
  stencil->SetExtent(0, 15, 0, 15, 0, 0);
  stencil->AllocateExtents();
  for (int y = 0; y < 16; ++y)
  {
    stencil->InsertNextExtent(0, 7, y, 0);
  }
  vtkNew<vtkCSLFImageQuality> quality;
  quality->SetInputData(0, a);
  quality->SetInputData(1, b);
  quality->SetStencilData(stencil);
  quality->Update();
  CSLF_CHECK(quality->GetNumberOfPixels() == 128);
  CSLF_CHECK_NEAR(quality->GetPSNR(), 20.0 * std::log10(255.0 / 3.0), 1e-9);
}

void CheckFails(vtkImageData* a, vtkImageData* b, vtkImageStencilData* stencil, const char* message)
{
  vtkNew<vtkCSLFImageQuality> quality;
  vtkNew<vtkTest::ErrorObserver> observer;
  quality->AddObserver(vtkCommand::ErrorEvent, observer);
  quality->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  quality->SetInputData(0, a);
  quality->SetInputData(1, b);
  quality->SetStencilData(stencil);
  quality->Update();
  CSLF_CHECK(observer->GetErrorMessage().find(message) != std::string::npos);
}

void TestBad()
{
  const Shade shade = [](int, int, int) { return 1; };
  const auto picture = MakePicture(16, 16, 3, shade);
  CheckFails(picture, MakePicture(15, 16, 3, shade), nullptr, "the same size");
  CheckFails(picture, MakePicture(16, 16, 2, shade), nullptr, "gray");
  vtkNew<vtkImageData> floats;
  floats->SetDimensions(16, 16, 1);
  floats->AllocateScalars(VTK_FLOAT, 3);
  CheckFails(picture, floats, nullptr, "unsigned char");
  vtkNew<vtkImageStencilData> nothing;
  nothing->SetExtent(0, 15, 0, 15, 0, 0);
  nothing->AllocateExtents();
  CheckFails(picture, picture, nothing, "no pixel");
}

void TestField()
{
  const cslf::Cube box;
  const auto make = [&](int viewpoints, int first, int last)
  {
    return cslf::testing::MakeTestField(
      cslf::Layout(viewpoints, 8), box, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, 1, first, last);
  };
  const auto a = make(3, 0, -1);
  const auto b = make(3, 10, 19);
  vtkDataArray* colors = b->GetPointData()->GetArray("Color");
  vtkDataArray* depths = b->GetPointData()->GetArray("Depth");
  int covered = 0;
  for (vtkIdType texel = 0; texel < b->GetNumberOfPoints(); ++texel)
  {
    const double green = colors->GetComponent(texel, 1);
    colors->SetComponent(texel, 1, green < 128 ? green + 6 : green - 6);
    // Where nothing is covered, depth may be anything.
    const bool isCovered = colors->GetComponent(texel, 3) > 0;
    const double depth = depths->GetComponent(texel, 0);
    depths->SetComponent(texel, 0, isCovered ? depth + 20 : 0);
    covered += isCovered ? 1 : 0;
  }
  CSLF_CHECK(covered > 0 && covered < b->GetNumberOfPoints());
  vtkNew<vtkCSLFFieldQuality> quality;
  quality->SetInputData(0, a);
  quality->SetInputData(1, b);
  CSLF_CHECK(quality->Measure() == 1);
  CSLF_CHECK(quality->GetNumberOfFigures() == 3);
  CSLF_CHECK(std::string(quality->GetFigureName(0)) == "Color" && !quality->GetIsEqual(0));
  CSLF_CHECK(std::string(quality->GetFigureName(1)) == "Coverage" && quality->GetIsEqual(1));
  CSLF_CHECK(std::string(quality->GetFigureName(2)) == "Depth");
  CSLF_CHECK_NEAR(quality->GetPSNR(0), 20.0 * std::log10(255.0 * std::sqrt(3.0) / 6.0), 1e-9);
  CSLF_CHECK(quality->GetPSNR(1) == 100.0);
  CSLF_CHECK_NEAR(quality->GetPSNR(2), 20.0 * std::log10(65535.0 / 20.0), 1e-9);

  vtkNew<vtkTest::ErrorObserver> observer;
  quality->AddObserver(vtkCommand::ErrorEvent, observer);
  quality->SetInputData(1, make(2, 0, -1));
  CSLF_CHECK(quality->Measure() == 0);
  CSLF_CHECK(observer->GetErrorMessage().find("differ") != std::string::npos);
  CSLF_CHECK(quality->GetNumberOfFigures() == 0 && !quality->GetFigureName(0));
}

/// Float colours are compared as displayed at several exposures, too.
void TestFloatField()
{
  const auto make = []
  {
    return cslf::testing::MakeTestField(
      cslf::Layout(2, 8), cslf::Cube(), VTK_FLOAT, VTK_UNSIGNED_SHORT);
  };
  const auto a = make();
  const auto b = make();
  // A difference that only a long exposure shows, in the dark; and one beyond the white of all but
  // the short exposures.
  vtkDataArray* first = a->GetPointData()->GetArray("Color");
  vtkDataArray* second = b->GetPointData()->GetArray("Color");
  for (vtkIdType texel = 0; texel < b->GetNumberOfPoints(); ++texel)
  {
    for (int c = 0; c < 4; ++c)
    {
      first->SetComponent(texel, c, c == 0 ? 0.0 : c == 1 ? 12.0 : 1.0);
      second->SetComponent(texel, c, c == 0 ? 0.0001 : c == 1 ? 8.0 : 1.0);
    }
  }
  vtkNew<vtkCSLFFieldQuality> quality;
  quality->SetInputData(0, a);
  quality->SetInputData(1, b);
  CSLF_CHECK(quality->Measure() == 1);
  CSLF_CHECK(quality->GetNumberOfFigures() == 8);
  const char* const names[] = { "Color at 1/16", "Color at 1/4", "Color at 1", "Color at 4",
    "Color at 16" };
  const double exposures[] = { 1.0 / 16.0, 0.25, 1.0, 4.0, 16.0 };
  for (int k = 0; k < 5; ++k)
  {
    CSLF_CHECK(std::string(quality->GetFigureName(2 + k)) == names[k]);
    const auto level = [&](double radiance)
    { return std::round(255.0 * cslf::LinearToSRGB(exposures[k] * radiance)); };
    const double squares = std::pow(level(0.0001), 2) + std::pow(level(12.0) - level(8.0), 2);
    const double expected =
      squares > 0.0 ? 10.0 * std::log10(3.0 * 255.0 * 255.0 / squares) : 100.0;
    CSLF_CHECK_NEAR(quality->GetPSNR(2 + k), expected, 1e-9);
    CSLF_CHECK(quality->GetIsEqual(2 + k) == (squares == 0.0));
  }
  CSLF_CHECK(quality->GetIsEqual(4) && !quality->GetIsEqual(2) && !quality->GetIsEqual(6));
}
}

int TestCSLFQuality(int, char*[])
{
  TestConstants();
  TestWindow();
  TestStencil();
  TestBad();
  TestField();
  TestFloatField();
  return cslf::testing::Result();
}
