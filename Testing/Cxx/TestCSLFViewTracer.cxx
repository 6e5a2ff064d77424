// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The view tracer's cameras, and environments seen directly and in a mirror.
#include "cslfColor.h"
#include "cslfProgressWatch.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkSphereSource.h>
#include <vtkTestErrorObserver.h>
#include <vtkTestUtilities.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <sstream>
#include <string>

namespace
{
glm::dvec4 GetPixel(vtkCSLFViewTracer* tracer, int x, int y)
{
  double color[4] = { -1.0, -1.0, -1.0, -1.0 };
  vtkImageData* picture = tracer->GetOutput();
  vtkDataArray* colors = picture->GetPointData()->GetScalars();
  CSLF_CHECK(colors);
  if (colors)
  {
    colors->GetTuple(y * picture->GetDimensions()[0] + x, color);
  }
  return { color[0], color[1], color[2], color[3] };
}

/// Small spheres must appear where the camera's matrices put them.
void TestCamera(bool parallel, double distance)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(3.0 * distance, -2.0 * distance, 4.0 * distance);
  camera->SetFocalPoint(0.1, 0.2, 0.3);
  camera->SetViewUp(0, 1, 0.2);
  camera->SetViewAngle(40.0 / distance);
  camera->SetParallelProjection(parallel);
  camera->SetParallelScale(1.6);
  camera->SetClippingRange(1.0 * distance, 9.0 * distance);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetCamera(camera);
  tracer->SetSize(61, 43);
  tracer->SetSamples(4);
  tracer->SetColorTypeToFloat();
  const glm::dvec3 centers[] = { { 1, 0.2, 0 }, { -0.7, 0.9, 0.4 }, { 0, -0.5, 1 } };
  for (const glm::dvec3& center : centers)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(center.x, center.y, center.z);
    sphere->SetRadius(0.12);
    tracer->SetInputConnection(sphere->GetOutputPort());
    tracer->Update();
    double x = 0.0;
    double y = 0.0;
    double sum = 0.0;
    for (int j = 0; j < 43; ++j)
    {
      for (int i = 0; i < 61; ++i)
      {
        const double alpha = GetPixel(tracer, i, j).w;
        x += alpha * (i + 0.5);
        y += alpha * (j + 0.5);
        sum += alpha;
      }
    }
    const double world[4] = { center.x, center.y, center.z, 1.0 };
    double view[4];
    camera->GetCompositeProjectionTransformMatrix(61.0 / 43.0, -1, 1)->MultiplyPoint(world, view);
    CSLF_CHECK(sum > 4.0);
    CSLF_CHECK_NEAR(x / sum, 61.0 * 0.5 * (1.0 + view[0] / view[3]), 0.25);
    CSLF_CHECK_NEAR(y / sum, 43.0 * 0.5 * (1.0 + view[1] / view[3]), 0.25);
  }
}

/// The share of a picture that a sphere covers, with VTK's default clipping range.
double MeasureSphere(double size)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0.4 * size, -0.2 * size, 0.1 * size);
  sphere->SetRadius(0.5 * size);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.5 * size, 1.0 * size, 3.0 * size);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputConnection(sphere->GetOutputPort());
  tracer->SetCamera(camera);
  tracer->SetSize(32, 24);
  tracer->SetSamples(16);
  tracer->SetColorTypeToFloat();
  tracer->Update();
  double sum = 0.0;
  for (int y = 0; y < 24; ++y)
  {
    for (int x = 0; x < 32; ++x)
    {
      sum += GetPixel(tracer, x, y).w / (32.0 * 24.0);
    }
  }
  return sum;
}

/// Scenes of all sizes look alike.
void TestSizes()
{
  const double share = MeasureSphere(1.0);
  CSLF_CHECK(share > 0.05 && share < 0.9);
  for (const double size : { 1e-14, 1e-6, 1e6, 1e10, 1e12, 1e14 })
  {
    CSLF_CHECK_NEAR(MeasureSphere(size), share, 2e-3);
  }
}

/// The environment in directions that a perspective camera at the origin sees.
void TestEnvironments(const std::string& fileName)
{
  // A lat-long image whose pixels differ, as VTK writes it: its first row is the lowest.
  constexpr int width = 8;
  constexpr int height = 4;
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      pixel[0] = static_cast<unsigned char>(20 * x);
      pixel[1] = static_cast<unsigned char>(60 * y);
      pixel[2] = 200;
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(fileName.c_str());
  writer->SetInputData(image);
  writer->Write();

  vtkNew<vtkSphereSource> mirror; // behind the camera
  mirror->SetCenter(0, 0, 0);
  mirror->SetRadius(0.01);
  vtkNew<vtkCamera> camera;
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputConnection(mirror->GetOutputPort());
  tracer->SetCamera(camera);
  tracer->SetSize(1, 1);
  tracer->SetSamples(1);
  tracer->SetColorTypeToFloat();
  tracer->GetEnvironment()->ShowOn();
  tracer->GetEnvironment()->SetModeToImage();
  tracer->GetEnvironment()->SetFileName(fileName.c_str());
  camera->SetViewAngle(0.001);
  const auto look = [&](const glm::dvec3& direction)
  {
    camera->SetPosition(direction.x, direction.y, direction.z);
    camera->SetFocalPoint(2.0 * direction.x, 2.0 * direction.y, 2.0 * direction.z);
    camera->SetViewUp(0.3, 0.5, -0.7);
    tracer->Update();
    return GetPixel(tracer, 0, 0);
  };
  const double up[2][3] = { { 0, 1, 0 }, { 0, 0, 1 } };
  for (int turned = 0; turned < 2; ++turned)
  {
    tracer->GetEnvironment()->SetUp(up[turned][0], up[turned][1], up[turned][2]);
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        // VTK's environment textures: s = atan2(z, x) / 2 pi + 1/2, t = asin(y) / pi + 1/2.
        const double azimuth = 2.0 * vtkMath::Pi() * ((x + 0.5) / width - 0.5);
        const double altitude = vtkMath::Pi() * ((y + 0.5) / height - 0.5);
        const glm::dvec3 own(std::cos(altitude) * std::cos(azimuth), std::sin(altitude),
          std::cos(altitude) * std::sin(azimuth));
        const glm::dvec3 world = turned ? glm::dvec3(own.x, -own.z, own.y) : own;
        const glm::dvec4 color = look(world);
        CSLF_CHECK_NEAR(cslf::LinearToSRGB(color.x) * 255.0, 20.0 * x, 0.1);
        CSLF_CHECK_NEAR(cslf::LinearToSRGB(color.y) * 255.0, 60.0 * y, 0.1);
        CSLF_CHECK(color.w == 1.0);
      }
    }
  }

  // A gradient along an axis.
  tracer->GetEnvironment()->SetModeToGradient();
  tracer->GetEnvironment()->SetUp(0, 3, 0);
  tracer->GetEnvironment()->SetColor(1, 1, 0);
  tracer->GetEnvironment()->SetBottomColor(0, 0, 0);
  tracer->GetEnvironment()->SetIntensity(2.0);
  CSLF_CHECK_NEAR(look({ 0, 1, 0 }).x, 2.0, 1e-4);
  CSLF_CHECK_NEAR(look({ 0, -1, 0 }).x, 0.0, 1e-4);
  CSLF_CHECK_NEAR(look({ 0.8, 0.6, 0 }).x, 1.6, 1e-4);
  CSLF_CHECK_NEAR(look({ 0.8, 0.6, 0 }).z, 0.0, 1e-4);
}

void TestMirrorInView(const std::string& fileName)
{
  // A mirror seen head on shows the environment behind the camera.
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkNew<vtkPolyData> mirror;
  mirror->ShallowCopy(plane->GetOutput());
  vtkCSLFMaterial::SetMetallic(mirror, 1.0);
  vtkCSLFMaterial::SetRoughness(mirror, 0.0);
  vtkCSLFMaterial::SetBaseColor(mirror, 1.0, 1.0, 1.0);
  vtkNew<vtkCamera> camera;
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputData(mirror);
  tracer->SetCamera(camera);
  tracer->SetSize(1, 1);
  tracer->SetColorTypeToFloat();
  tracer->GetEnvironment()->SetModeToImage();
  tracer->GetEnvironment()->SetFileName(fileName.c_str());
  camera->SetViewAngle(0.001);
  for (int i = 0; i < 20; ++i)
  {
    const glm::dvec3 from =
      glm::normalize(glm::dvec3(std::cos(1.3 * i), std::sin(1.3 * i), 0.2 + 0.1 * i));
    tracer->GetEnvironment()->ShowOff();
    camera->SetPosition(from.x, from.y, from.z);
    camera->SetFocalPoint(0, 0, 0);
    camera->SetViewUp(0.3, 0.5, -0.7);
    tracer->Update();
    const glm::dvec4 reflected = GetPixel(tracer, 0, 0);
    const glm::dvec3 back(-2.0 * from.x, -2.0 * from.y, 2.0 * from.z);
    tracer->GetEnvironment()->ShowOn();
    camera->SetPosition(back.x, back.y, back.z);
    camera->SetFocalPoint(2.0 * back.x, 2.0 * back.y, 2.0 * back.z);
    tracer->Update();
    const glm::dvec4 direct = GetPixel(tracer, 0, 0);
    CSLF_CHECK(glm::distance(reflected, direct) < 1e-3);
  }
}

void TestOutputAndErrors()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputConnection(sphere->GetOutputPort());
  tracer->SetSize(20, 10);
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> pipeline;
  tracer->AddObserver(vtkCommand::ErrorEvent, observer);
  tracer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipeline);
  CSLF_CHECK(tracer->GetExecutive()->Update() == 0);
  CSLF_CHECK(observer->CheckErrorMessage("Camera is not set") == 0);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 2);
  tracer->SetCamera(camera);
  tracer->SetSize(20, 0);
  CSLF_CHECK(tracer->GetExecutive()->Update() == 0);
  CSLF_CHECK(observer->CheckErrorMessage("Size") == 0);

  // Bytes are the encoded floats.
  tracer->SetSize(20, 10);
  tracer->SetColorTypeToFloat();
  tracer->Update();
  vtkNew<vtkImageData> linear;
  linear->DeepCopy(tracer->GetOutput());
  tracer->SetColorTypeToUnsignedChar();
  tracer->Update();
  auto* bytes =
    vtkUnsignedCharArray::SafeDownCast(tracer->GetOutput()->GetPointData()->GetArray("Color"));
  CSLF_CHECK(bytes && bytes->GetNumberOfTuples() == 200);
  for (vtkIdType i = 0; bytes && i < 200; ++i)
  {
    double color[4];
    linear->GetPointData()->GetScalars()->GetTuple(i, color);
    unsigned char encoded[4];
    cslf::EncodeColor({ color[0], color[1], color[2] }, color[3], encoded);
    for (int c = 0; c < 4; ++c)
    {
      CSLF_CHECK(std::abs(encoded[c] - bytes->GetTypedComponent(i, c)) <= 1);
    }
  }
  // A moved camera is detected.
  camera->SetPosition(0, 0, 100);
  tracer->Update();
  CSLF_CHECK(GetPixel(tracer, 4, 5).w == 0.0);
  // Phases have names and can be stopped; the next update makes the picture.
  tracer->Modified();
  {
    const cslf::testing::ProgressWatch watch(tracer, "Tracing the picture");
    tracer->Update();
    watch.CheckAborted();
    CSLF_CHECK(tracer->GetOutput()->GetNumberOfPoints() == 0);
    tracer->SetAbortExecute(0);
  }
  {
    const cslf::testing::ProgressWatch watch(tracer);
    tracer->Update();
    watch.CheckWhole({ "Tracing the picture" });
    CSLF_CHECK(tracer->GetOutput()->GetNumberOfPoints() == 200);
  }
  std::ostringstream text;
  tracer->Print(text);
  CSLF_CHECK(text.str().find("Size: 20 10") != std::string::npos);
}
}

int TestCSLFViewTracer(int argc, char* argv[])
{
  char* directory =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  const std::string fileName = std::string(directory) + "/TestCSLFViewTracer.png";
  delete[] directory;
  TestCamera(false, 1.0);
  TestCamera(true, 1.0);
  TestCamera(false, 40.0);
  TestSizes();
  TestEnvironments(fileName);
  TestMirrorInView(fileName);
  TestOutputAndErrors();
  return cslf::testing::Result();
}
