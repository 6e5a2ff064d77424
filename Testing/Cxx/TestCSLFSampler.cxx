// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The sampler's output: its shape, its depth, the same bytes for all threads and slabs, its errors.
#include "cslfColor.h"
#include "cslfDescription.h"
#include "cslfJSON.h"
#include "cslfProgressWatch.h"
#include "cslfTesting.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFSampler.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
vtkSmartPointer<vtkPolyData> MakeSphere(double radius, const double center[3])
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetCenter(center[0], center[1], center[2]);
  source->SetThetaResolution(128);
  source->SetPhiResolution(128);
  source->Update();
  vtkSmartPointer<vtkPolyData> sphere = source->GetOutput();
  return sphere;
}

std::string GetBytes(vtkImageData* image, const char* name)
{
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  CSLF_CHECK(array);
  const auto* bytes = array ? static_cast<const char*>(array->GetVoidPointer(0)) : nullptr;
  return bytes ? std::string(bytes, array->GetNumberOfValues() * array->GetDataTypeSize())
               : std::string();
}

cslf::Description GetDescription(vtkImageData* image)
{
  std::string error;
  const auto description = cslf::Description::ReadFrom(image, error);
  CSLF_CHECK(description.has_value());
  if (!error.empty())
  {
    std::cerr << error << "\n";
  }
  return description.value_or(cslf::Description());
}

/// The box, which has its own lamp.
void SetUp(vtkCSLFSampler* sampler, vtkCSLFCornellBoxSource* box, int viewpoints, int resolution,
  int samples)
{
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(viewpoints);
  sampler->SetResolution(resolution);
  sampler->SetSamples(samples);
}

void TestShapeAndSlabs(int viewpoints, int resolution, int type)
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, box, viewpoints, resolution, 3);
  sampler->SetSeed(11);
  sampler->SetColorType(type);
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 2 }, [&sampler]() { sampler->Update(); });
  vtkImageData* field = sampler->GetOutput();
  const cslf::Description description = GetDescription(field);
  CSLF_CHECK(description.Grid == cslf::Layout(viewpoints, resolution));
  CSLF_CHECK(field->GetExtent()[5] == 6 * viewpoints * viewpoints - 1);
  CSLF_CHECK_NEAR(description.Box.Edges.x, 2.2, 1e-9);
  CSLF_CHECK_NEAR(glm::length(description.Box.Center), 0.0, 1e-9);
  CSLF_CHECK(description.FindChannel(cslf::ColorName)->Type == type);
  const auto sampling = nlohmann::json::parse(description.Sampling);
  CSLF_CHECK(sampling["samples"] == 3 && sampling["seed"] == 11);
  const std::string color = GetBytes(field, cslf::ColorName);
  const std::string depth = GetBytes(field, cslf::DepthName);
  CSLF_CHECK(field->GetPointData()->GetScalars()->GetName() == std::string(cslf::ColorName));

  // One thread, slices one by one, by another filter: the same bytes. The scene is built once.
  vtkNew<vtkCSLFSampler> slabs;
  SetUp(slabs, box, viewpoints, resolution, 3);
  slabs->SetSeed(11);
  slabs->SetColorType(type);
  std::string slabColor;
  std::string slabDepth;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1 },
    [&]()
    {
      for (int z = 0; z < 6 * viewpoints * viewpoints; ++z)
      {
        int extent[6] = { 0, 5 * resolution - 1, 0, resolution - 1, z, z };
        CSLF_CHECK(slabs->UpdateExtent(extent) == 1);
        CSLF_CHECK(
          slabs->GetOutput()->GetExtent()[4] == z && slabs->GetOutput()->GetExtent()[5] == z);
        GetDescription(slabs->GetOutput());
        slabColor += GetBytes(slabs->GetOutput(), cslf::ColorName);
        slabDepth += GetBytes(slabs->GetOutput(), cslf::DepthName);
      }
    });
  CSLF_CHECK(slabColor == color);
  CSLF_CHECK(slabDepth == depth);

  // The same scene has the same hash in every process.
  const auto scene = sampling["scene"].get<std::string>();
  CSLF_CHECK(scene.size() == 32);
  const auto again = nlohmann::json::parse(GetDescription(slabs->GetOutput()).Sampling);
  CSLF_CHECK(again["scene"] == scene);

  // Another seed gives other noise.
  sampler->SetSeed(12);
  sampler->SetGenerateDepth(false);
  sampler->Update();
  CSLF_CHECK(GetBytes(sampler->GetOutput(), cslf::ColorName) != color);
  CSLF_CHECK(!sampler->GetOutput()->GetPointData()->GetArray(cslf::DepthName));
}

/// Channels besides colour are selected by name, and a change of the selection samples anew.
void TestChannels()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(2);
  sampler->SetResolution(4);
  sampler->SetSamples(1);
  vtkDataArraySelection* channels = sampler->GetChannelSelection();
  for (int i = 0; i < channels->GetNumberOfArrays(); ++i)
  {
    const std::string name = channels->GetArrayName(i);
    CSLF_CHECK(name != cslf::ColorName);
    CSLF_CHECK((channels->GetArraySetting(i) != 0) == (name == cslf::DepthName));
  }
  CSLF_CHECK(sampler->GetGenerateDepth());
  channels->DisableAllArrays();
  CSLF_CHECK(!sampler->GetGenerateDepth());
  sampler->Update();
  CSLF_CHECK(sampler->GetOutput()->GetPointData()->GetNumberOfArrays() == 1);
  channels->EnableAllArrays();
  CSLF_CHECK(sampler->GetGenerateDepth());
  sampler->Update();
  CSLF_CHECK(
    sampler->GetOutput()->GetPointData()->GetNumberOfArrays() == 1 + channels->GetNumberOfArrays());
  CSLF_CHECK(GetDescription(sampler->GetOutput()).FindError().empty());
}

/// Pieces are z slabs, which together are the whole.
void TestPieces()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, box, 2, 16, 2);
  sampler->Update();
  const std::string whole = GetBytes(sampler->GetOutput(), cslf::ColorName);
  const std::size_t slice = whole.size() / 24;
  for (int pieces : { 2, 5, 24 })
  {
    int end = 0;
    for (int piece = 0; piece < pieces; ++piece)
    {
      CSLF_CHECK(sampler->UpdatePiece(piece, pieces, 0) == 1);
      vtkImageData* field = sampler->GetOutput();
      const cslf::Description description = GetDescription(field);
      const int* extent = field->GetExtent();
      CSLF_CHECK(extent[4] <= end && extent[5] >= end - 1);
      CSLF_CHECK(extent[5] - extent[4] <= 24 / pieces + 1);
      end = extent[5] + 1;
      CSLF_CHECK(GetBytes(field, cslf::ColorName) ==
        whole.substr(slice * extent[4], slice * (extent[5] - extent[4] + 1)));
    }
    CSLF_CHECK(end == 24);
  }
}

/// The scene's hash in a sampler's description.
std::string IdentifyScene(vtkPolyData* polyData)
{
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(polyData);
  sampler->SetViewpoints(2);
  sampler->SetResolution(1);
  sampler->SetSamples(1);
  sampler->Update();
  const auto sampling = nlohmann::json::parse(GetDescription(sampler->GetOutput()).Sampling);
  return sampling["scene"].get<std::string>();
}

/// The hash depends on everything visible in the scene, and on nothing else.
void TestSceneHash()
{
  vtkNew<vtkSphereSource> source;
  source->Update();
  const auto copy = [&source]()
  {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->DeepCopy(source->GetOutput());
    return data;
  };
  const auto sphere = copy();
  std::set<std::string> hashes = { IdentifyScene(sphere) };
  CSLF_CHECK(hashes.count(IdentifyScene(copy())) == 1);

  const auto expectAnother = [&hashes](vtkPolyData* data)
  { CSLF_CHECK(hashes.insert(IdentifyScene(data)).second); };
  const auto moved = copy();
  double point[3];
  moved->GetPoint(3, point);
  moved->GetPoints()->SetPoint(3, point[0], point[1], point[2] + 1e-3);
  expectAnother(moved);
  const auto flat = copy();
  flat->GetPointData()->SetNormals(nullptr);
  expectAnother(flat);
  const auto rough = copy();
  vtkCSLFMaterial::SetRoughness(rough, 0.25);
  expectAnother(rough);
  const auto lit = copy();
  const double place[3] = { 0.0, 5.0, 0.0 };
  const double power[3] = { 1.0, 1.0, 1.0 };
  vtkCSLFLight::AddPointLight(lit, place, power);
  expectAnother(lit);
  const auto colored = copy();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(colored->GetNumberOfPoints());
  colors->FillValue(100);
  colored->GetPointData()->SetScalars(colors);
  expectAnother(colored);
}

/// The first hit of a sphere, as a fraction of the way.
std::optional<double> HitSphere(const glm::dvec3& from, const glm::dvec3& path,
  const glm::dvec3& center, double radius, double& cosine)
{
  const glm::dvec3 offset = from - center;
  const double a = glm::dot(path, path);
  const double b = glm::dot(offset, path);
  const double c = glm::dot(offset, offset) - radius * radius;
  const double root = b * b - a * c;
  if (root < 0.0)
  {
    return std::nullopt;
  }
  const double hit = (-b - std::sqrt(root)) / a;
  cosine = std::abs(glm::dot(glm::normalize(offset + hit * path), glm::normalize(path)));
  return hit;
}

void TestDepthAndCoverage()
{
  // A sphere far from the origin, in a cube of unequal edges.
  const double center[3] = { 1000.0, -2000.0, 500.0 };
  const glm::dvec3 middle(center[0], center[1], center[2]);
  constexpr double radius = 3.0;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(MakeSphere(radius, center));
  sampler->SetViewpoints(3);
  sampler->SetResolution(18);
  sampler->SetSamples(4);
  sampler->AutomaticCubeOff();
  sampler->SetCubeCenter(center[0] + 1.0, center[1], center[2]);
  sampler->SetCubeEdges(9.0, 6.5, 8.0);
  sampler->SetColorTypeToFloat();
  sampler->Update();
  vtkImageData* field = sampler->GetOutput();
  const cslf::Description description = GetDescription(field);
  vtkDataArray* color = field->GetPointData()->GetArray(cslf::ColorName);
  vtkDataArray* depth = field->GetPointData()->GetArray(cslf::DepthName);
  const cslf::Layout& grid = description.Grid;
  int compared = 0;
  for (int z = 0; z < grid.GetSlices(); ++z)
  {
    const cslf::Viewpoint viewpoint = grid.ViewpointOf(z);
    const glm::dvec3 from = description.Box.PointToWorld(grid.ViewpointPosition(viewpoint));
    for (int y = 0; y < grid.GetResolution(); ++y)
    {
      for (int x = 0; x < grid.GetStripWidth(); ++x)
      {
        const int face = cslf::ExitFaceOf(viewpoint.Face, x / grid.GetResolution());
        const glm::dvec2 st(
          grid.TexelCoordinate(x % grid.GetResolution()), grid.TexelCoordinate(y));
        const glm::dvec3 to = description.Box.PointToWorld(cslf::FaceToCube(face, st));
        double cosine = 0.0;
        const auto hit = HitSphere(from, to - from, middle, radius, cosine);
        const vtkIdType texel =
          (vtkIdType(z) * grid.GetResolution() + y) * grid.GetStripWidth() + x;
        const double alpha = color->GetComponent(texel, 3);
        const double stored = depth->GetComponent(texel, 0) / 65535.0;
        CSLF_CHECK(alpha > 0.0 || stored == 1.0);
        if (hit && cosine > 0.5)
        {
          ++compared;
          CSLF_CHECK_NEAR(stored, *hit, 5e-4);
          CSLF_CHECK(alpha == 1.0);
          // A convex surface of the default grey under the default white sky.
          CSLF_CHECK_NEAR(color->GetComponent(texel, 0), cslf::SRGBToLinear(0.8), 0.005);
        }
        if (alpha > 0.0)
        {
          CSLF_CHECK(stored < 0.9);
        }
      }
    }
  }
  CSLF_CHECK(compared > 1000);

  // With the environment shown, every texel is covered. A texel that sees only sky is at the
  // distance of the cube.
  sampler->GetEnvironment()->ShowOn();
  sampler->SetSamples(1);
  sampler->Update();
  color = sampler->GetOutput()->GetPointData()->GetArray(cslf::ColorName);
  depth = sampler->GetOutput()->GetPointData()->GetArray(cslf::DepthName);
  CSLF_CHECK(color->GetRange(3)[0] == 1.0);
  CSLF_CHECK(color->GetRange(0)[1] == 1.0);
  CSLF_CHECK(depth->GetRange(0)[1] == 65535.0);
}

void TestWhiteFurnace()
{
  // A white diffuse sphere under a uniform sky looks like the sky.
  const double center[3] = { 0.0, 0.0, 0.0 };
  auto sphere = MakeSphere(1.0, center);
  vtkCSLFMaterial::SetBaseColor(sphere, 1.0, 1.0, 1.0);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(sphere);
  sampler->SetViewpoints(2);
  sampler->SetResolution(16);
  sampler->SetSamples(32);
  sampler->SetColorTypeToFloat();
  sampler->GetEnvironment()->SetColor(0.5, 0.6, 0.7);
  sampler->GetEnvironment()->SetIntensity(2.0);
  sampler->SetExposure(0.25);
  for (bool smooth : { true, false })
  {
    if (!smooth)
    {
      sphere->GetPointData()->SetNormals(nullptr);
      sampler->SetInputData(sphere);
    }
    sampler->Update();
    vtkDataArray* color = sampler->GetOutput()->GetPointData()->GetArray(cslf::ColorName);
    const glm::dvec3 expected = 0.5 * cslf::SRGBToLinear(glm::dvec3(0.5, 0.6, 0.7));
    int covered = 0;
    for (vtkIdType texel = 0; texel < color->GetNumberOfTuples(); ++texel)
    {
      const double alpha = color->GetComponent(texel, 3);
      for (int c = 0; c < 3 && alpha == 1.0; ++c)
      {
        CSLF_CHECK_NEAR(color->GetComponent(texel, c) / expected[c], 1.0, 0.005);
      }
      covered += alpha == 1.0 ? 1 : 0;
    }
    CSLF_CHECK(covered > 300);
  }
}

void TestErrors()
{
  const double center[3] = { 0.0, 0.0, 0.0 };
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(MakeSphere(1.0, center));
  sampler->SetViewpoints(2);
  sampler->SetResolution(2);
  sampler->SetSamples(1);
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> pipeline;
  sampler->AddObserver(vtkCommand::ErrorEvent, observer);
  sampler->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipeline);
  const auto expect = [&](const char* message)
  {
    CSLF_CHECK(sampler->GetExecutive()->Update() == 0);
    CSLF_CHECK(observer->CheckErrorMessage(message) == 0);
    pipeline->Clear();
  };
  sampler->AutomaticCubeOff();
  sampler->SetCubeEdges(1.99, 3.0, 3.0);
  expect("must strictly contain");
  sampler->SetCubeEdges(3.0, 3.0, -3.0);
  expect("above 0");
  sampler->AutomaticCubeOn();
  sampler->SetOffset(0.0);
  CSLF_CHECK(sampler->GetOffset() > 0.0);
  sampler->SetColorType(VTK_DOUBLE);
  expect("ColorType");
  sampler->SetColorTypeToFloat();
  sampler->GetEnvironment()->SetModeToImage();
  expect("FileName is not set");
  sampler->GetEnvironment()->SetFileName("no such file.exr");
  expect("cannot be read");
  sampler->GetEnvironment()->SetModeToGradient();
  sampler->GetEnvironment()->SetUp(0, 0, 0);
  expect("Up must not be 0");
  sampler->GetEnvironment()->SetUp(0, 0, 1);
  CSLF_CHECK(sampler->GetExecutive()->Update() == 1);
  CSLF_CHECK(sampler->GetOutput()->GetNumberOfPoints() == 5 * 2 * 2 * 24);
  CSLF_CHECK(!observer->GetError() && !pipeline->GetError());
}

vtkSmartPointer<vtkCSLFSampler> MakeBoxSampler()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(2);
  sampler->SetResolution(8);
  sampler->SetSamples(1);
  sampler->SetIntegratorToRadianceCaching();
  sampler->GetCacheOptions()->SetSamples(16);
  sampler->GetCacheOptions()->SetSpacing(0.05);
  return sampler;
}

// Each phase has a name, progress never runs backwards, and each phase can be aborted: the outputs
// are empty then, and the next update makes them.
void TestPhases()
{
  const std::vector<std::string> phases = { "Reading the scene", "Building the tree of the scene",
    "Filling the radiance cache", "Checking the radiance cache", "Sampling viewpoints",
    "Making the geometry", "Colouring the geometry" };
  const auto whole = MakeBoxSampler();
  {
    const cslf::testing::ProgressWatch watch(whole);
    whole->Update();
    watch.CheckWhole(phases);
  }
  const vtkIdType points = whole->GetGeometry()->GetNumberOfPoints();
  CSLF_CHECK(points > 0);
  for (std::size_t k = 0; k < phases.size(); ++k)
  {
    const auto sampler = MakeBoxSampler();
    {
      const cslf::testing::ProgressWatch watch(sampler, phases[k]);
      sampler->Update();
      watch.CheckAborted();
    }
    CSLF_CHECK(sampler->GetOutput()->GetNumberOfPoints() == 0);
    CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPoints() == 0);
    sampler->SetAbortExecute(0);
    sampler->Update();
    CSLF_CHECK(GetBytes(sampler->GetOutput(), "Color") == GetBytes(whole->GetOutput(), "Color"));
    CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPoints() == points);
  }
  std::ostringstream text;
  whole->Print(text);
  CSLF_CHECK(text.str().find("Viewpoints: 2") != std::string::npos);
}
}

int TestCSLFSampler(int, char*[])
{
  TestShapeAndSlabs(2, 5, VTK_UNSIGNED_CHAR);
  TestShapeAndSlabs(3, 8, VTK_FLOAT);
  TestDepthAndCoverage();
  TestChannels();
  TestPieces();
  TestSceneHash();
  TestWhiteFurnace();
  TestErrors();
  TestPhases();
  return cslf::testing::Result();
}
