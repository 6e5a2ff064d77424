// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The geometry that is made from the depth of a field: where it lies, its colours, its limits, the
// same for any number of threads, and inputs that have little or nothing to make it from.
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfDescription.h"
#include "cslfFieldSource.h"
#include "cslfProgressWatch.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFGeometryFilter.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkCubeSource.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSphereSource.h>
#include <vtkStaticCellLocator.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedShortArray.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr double Radius = 0.8;

/// Spheres around (-1, 0, 0) and a box around (1, 0, 0) of half the size 0.7, at `origin`.
double FindDistance(const glm::dvec3& point)
{
  const double toSphere = std::abs(glm::distance(point, glm::dvec3(-1.0, 0.0, 0.0)) - Radius);
  const glm::dvec3 beyond = glm::abs(point - glm::dvec3(1.0, 0.0, 0.0)) - 0.7;
  const double inside = std::max({ beyond.x, beyond.y, beyond.z });
  const double toBox =
    inside > 0.0 ? glm::length(glm::max(beyond, glm::dvec3(0.0))) : std::abs(inside);
  return std::min(toSphere, toBox);
}

vtkSmartPointer<vtkImageData> MakeField(
  const glm::dvec3& origin, int viewpoints, int resolution, int colorType = VTK_UNSIGNED_CHAR)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->SetCenter(origin.x - 1.0, origin.y, origin.z);
  sphere->SetRadius(Radius);
  sphere->SetThetaResolution(100);
  sphere->SetPhiResolution(100);
  vtkNew<vtkCubeSource> box;
  box->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  box->SetBounds(
    origin.x + 0.3, origin.x + 1.7, origin.y - 0.7, origin.y + 0.7, origin.z - 0.7, origin.z + 0.7);
  vtkNew<vtkAppendPolyData> both;
  both->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  both->AddInputConnection(sphere->GetOutputPort());
  both->AddInputConnection(box->GetOutputPort());
  both->Update();
  vtkCSLFMaterial::SetBaseColor(both->GetOutput(), 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(both->GetOutput(), 0.0, 1.0, 0.0);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(both->GetOutput());
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(viewpoints);
  sampler->SetResolution(resolution);
  sampler->SetSamples(4);
  sampler->SetMaximumDepth(0);
  sampler->SetColorType(colorType);
  sampler->Update();
  return sampler->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeGeometry(vtkImageData* field, int triangles = 200000)
{
  vtkNew<vtkCSLFGeometryFilter> filter;
  filter->SetInputData(field);
  filter->SetGeometryTriangles(triangles);
  filter->Update(1);
  return filter->GetGeometry();
}

double GetNumber(vtkPolyData* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  CSLF_CHECK(array && array->GetNumberOfValues() == 1);
  return array ? array->GetTuple1(0) : -1.0;
}

/// The geometry lies on the surfaces, and all parts of the surfaces have it.
void TestPlaces(const glm::dvec3& origin, int colorType)
{
  const auto field = MakeField(origin, 5, 64, colorType);
  const auto geometry = MakeGeometry(field);
  CSLF_CHECK(geometry->GetNumberOfPolys() > 100 && geometry->GetNumberOfPolys() < 30000);
  // The cube's edge is 3.5 x 1.1, so a texel at its centre is 0.03.
  const double texel = 0.5 * 3.85 / 64.0;
  double squares = 0.0;
  double most = 0.0;
  vtkDataArray* colors = geometry->GetPointData()->GetScalars();
  CSLF_CHECK(colors && colors->GetDataType() == colorType);
  const double white = colorType == VTK_FLOAT ? 1.0 : 255.0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    double point[3];
    geometry->GetPoint(i, point);
    const double distance = FindDistance(glm::dvec3(point[0], point[1], point[2]) - origin);
    squares += distance * distance;
    most = std::max(most, distance);
    CSLF_CHECK(colors->GetComponent(i, 0) == 0.0 && colors->GetComponent(i, 3) == white);
    CSLF_CHECK_NEAR(colors->GetComponent(i, 1), white, 0.01 * white);
  }
  const double rms = std::sqrt(squares / static_cast<double>(geometry->GetNumberOfPoints()));
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(geometry);
  locator->BuildLocator();
  int lost = 0;
  constexpr int count = 2000;
  for (int i = 0; i < count; ++i)
  {
    // Evenly spread over the sphere, without where the box hides it.
    const double z = 1.0 - 2.0 * (i + 0.5) / count;
    const double side = std::sqrt(1.0 - z * z);
    const double angle = 2.399963 * i;
    const glm::dvec3 direction(side * std::cos(angle), side * std::sin(angle), z);
    const glm::dvec3 place = origin + glm::dvec3(-1.0, 0.0, 0.0) + Radius * direction;
    double point[3] = { place.x, place.y, place.z };
    double closest[3];
    vtkIdType cell = 0;
    int part = 0;
    double square = 0.0;
    locator->FindClosestPoint(point, closest, cell, part, square);
    lost += direction.x < 0.7 && square > texel * texel ? 1 : 0;
  }
  std::cout << geometry->GetNumberOfPolys() << " triangles, " << rms / texel << " texels, at most "
            << most / texel << ", lost " << lost << "\n";
  CSLF_CHECK(rms < 0.3 * texel && most < 2.5 * texel && lost == 0);
  CSLF_CHECK(GetNumber(geometry, cslf::GeometryLossName) < 0.002);
  CSLF_CHECK(GetNumber(geometry, cslf::GeometryErrorName) < 0.2 * texel);
}

void TestBudget(vtkImageData* field)
{
  const auto small = MakeGeometry(field, 300);
  CSLF_CHECK(small->GetNumberOfPolys() > 4 && small->GetNumberOfPolys() <= 300);
  const auto none = MakeGeometry(field, 0);
  CSLF_CHECK(none->GetNumberOfPolys() == 0);
}

bool AreSame(vtkPolyData* a, vtkPolyData* b)
{
  if (a->GetNumberOfPoints() != b->GetNumberOfPoints() ||
    a->GetNumberOfPolys() != b->GetNumberOfPolys())
  {
    return false;
  }
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    double one[3];
    double other[3];
    a->GetPoint(i, one);
    b->GetPoint(i, other);
    for (int k = 0; k < 4; ++k)
    {
      if ((k < 3 && one[k] != other[k]) ||
        a->GetPointData()->GetScalars()->GetComponent(i, k) !=
          b->GetPointData()->GetScalars()->GetComponent(i, k))
      {
        return false;
      }
    }
  }
  return true;
}

void TestThreads(vtkImageData* field)
{
  vtkSMPTools::Initialize(1);
  const auto one = MakeGeometry(field);
  vtkSMPTools::Initialize(2);
  const auto two = MakeGeometry(field);
  vtkSMPTools::Initialize();
  CSLF_CHECK(one->GetNumberOfPolys() > 0 && AreSame(one, two));
}

/// The geometry is made with the whole field or alone, but not with parts of the field, and stays
/// until something changes.
void TestDemand(vtkImageData* field)
{
  vtkNew<vtkCSLFGeometryFilter> filter;
  const auto source = cslf::testing::MakeSource(field);
  filter->SetInputConnection(source->GetOutputPort());
  int part[6];
  std::copy_n(field->GetExtent(), 6, part);
  part[5] = part[4];
  filter->UpdateExtent(part);
  CSLF_CHECK(filter->GetGeometry()->GetNumberOfPolys() == 0);
  filter->UpdateWholeExtent();
  const vtkIdType count = filter->GetGeometry()->GetNumberOfPolys();
  CSLF_CHECK(count > 1000);
  CSLF_CHECK(filter->GetOutput()->GetPointData()->GetArray("Depth") ==
    source->GetOutput()->GetPointData()->GetArray("Depth"));
  const vtkMTimeType time = filter->GetGeometry()->GetMTime();
  filter->Update(1);
  CSLF_CHECK(filter->GetGeometry()->GetMTime() == time);
  filter->SetGeometryTriangles(1000);
  filter->Update(1);
  CSLF_CHECK(filter->GetGeometry()->GetNumberOfPolys() <= 1000);
}

/// Fields with little in them, and samples that mean nothing.
void TestOdd()
{
  for (const int resolution : { 1, 2, 5 })
  {
    const auto field = MakeField(glm::dvec3(0.0), 2, resolution);
    CSLF_CHECK(GetNumber(MakeGeometry(field), cslf::GeometryLossName) <= 1.0);
  }
  const auto empty = MakeField(glm::dvec3(0.0), 2, 8);
  empty->GetPointData()->GetArray("Color")->Fill(0.0);
  empty->GetPointData()->GetArray("Depth")->Fill(65535.0);
  const auto nothing = MakeGeometry(empty);
  CSLF_CHECK(nothing->GetNumberOfPolys() == 0 && nothing->GetNumberOfPoints() == 0);
  CSLF_CHECK(GetNumber(nothing, cslf::GeometryLossName) == 0.0);

  // Depth as floats, some of which are not numbers or outside of their range.
  const auto field = MakeField(glm::dvec3(0.0), 3, 32);
  vtkDataArray* depth = field->GetPointData()->GetArray("Depth");
  vtkNew<vtkFloatArray> floats;
  floats->SetName("Depth");
  const float wrong[] = { std::numeric_limits<float>::quiet_NaN(), -1.0f, 0.0f, 7.0f,
    std::numeric_limits<float>::infinity() };
  for (vtkIdType i = 0; i < depth->GetNumberOfValues(); ++i)
  {
    const double share = depth->GetTuple1(i) / 65535.0;
    floats->InsertNextValue(i % 97 == 0 ? wrong[i / 97 % 5] : static_cast<float>(share));
  }
  std::string error;
  auto description = cslf::Description::ReadFrom(field, error);
  CSLF_CHECK(description.has_value());
  for (cslf::Channel& channel : description->Channels)
  {
    channel =
      channel.Name == "Depth" ? cslf::MakeChannel(cslf::KnownChannel::Depth, VTK_FLOAT) : channel;
  }
  field->GetPointData()->AddArray(floats);
  description->WriteTo(field->GetFieldData());
  const auto holes = MakeGeometry(field);
  CSLF_CHECK(holes->GetNumberOfPolys() > 100);
  double bounds[6];
  holes->GetBounds(bounds);
  CSLF_CHECK(bounds[0] > -2.0 && bounds[1] < 2.0 && bounds[2] > -1.0 && bounds[3] < 1.0);
}

/// What missing viewpoints do not see is not empty.
void TestMissing(vtkImageData* field)
{
  vtkNew<vtkImageData> partial;
  partial->DeepCopy(field);
  vtkNew<vtkIdTypeArray> missing;
  missing->SetName("MissingViewpoints");
  int extent[6];
  partial->GetExtent(extent);
  const vtkIdType strip = vtkIdType(extent[1] + 1) * (extent[3] + 1);
  auto* depth = vtkUnsignedShortArray::SafeDownCast(partial->GetPointData()->GetArray("Depth"));
  for (int slice = 0; slice <= extent[5]; slice += 3)
  {
    missing->InsertNextValue(slice);
    std::fill_n(depth->GetPointer(slice * strip), strip, static_cast<unsigned short>(65535));
  }
  partial->GetFieldData()->AddArray(missing);
  const auto geometry = MakeGeometry(partial);
  CSLF_CHECK(geometry->GetNumberOfPolys() > 100);
  CSLF_CHECK(GetNumber(geometry, cslf::GeometryLossName) < 0.005);
}

void TestInvalid(vtkImageData* field)
{
  vtkNew<vtkImageData> flat;
  flat->ShallowCopy(field);
  std::string error;
  auto description = cslf::Description::ReadFrom(field, error);
  description->Channels.erase(
    std::remove_if(description->Channels.begin(), description->Channels.end(),
      [](const cslf::Channel& channel) { return channel.Name == "Depth"; }),
    description->Channels.end());
  vtkNew<vtkFieldData> own;
  flat->SetFieldData(own);
  description->WriteTo(own);
  vtkNew<vtkImageData> other;
  other->SetDimensions(4, 4, 4);
  other->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (vtkImageData* image : { flat.Get(), other.Get() })
  {
    vtkNew<vtkCSLFGeometryFilter> filter;
    vtkNew<vtkTest::ErrorObserver> observer;
    filter->AddObserver(vtkCommand::ErrorEvent, observer);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
    filter->SetInputData(image);
    filter->Update(1);
    CSLF_CHECK(observer->GetError());
    CSLF_CHECK(
      image != flat.Get() || observer->GetErrorMessage().find("depth") != std::string::npos);
    CSLF_CHECK(filter->GetGeometry()->GetNumberOfPolys() == 0);
  }
}

/// Phases have names. A filter that is asked to stop has no output, and makes it the next time.
void TestPhases(vtkImageData* field)
{
  const std::vector<std::string> phases = { "Reading depths", "Making the geometry",
    "Colouring the geometry" };
  vtkNew<vtkCSLFGeometryFilter> filter;
  filter->SetInputData(field);
  for (const std::string& phase : phases)
  {
    const cslf::testing::ProgressWatch watch(filter, phase, 2);
    filter->Update(1);
    watch.CheckAborted();
    CSLF_CHECK(filter->GetGeometry()->GetNumberOfPolys() == 0);
    filter->SetAbortExecute(0);
  }
  const cslf::testing::ProgressWatch watch(filter);
  filter->Update(1);
  watch.CheckWhole(phases);
  CSLF_CHECK(filter->GetGeometry()->GetNumberOfPolys() > 0);
}
}

int TestCSLFGeometryFilter(int, char*[])
{
  TestPlaces(glm::dvec3(0.0), VTK_UNSIGNED_CHAR);
  TestPlaces(glm::dvec3(5.0e5, 4.0e6, 200.0), VTK_FLOAT);
  const auto field = MakeField(glm::dvec3(0.0), 3, 48);
  TestBudget(field);
  TestThreads(field);
  TestDemand(field);
  TestMissing(field);
  TestInvalid(field);
  TestPhases(field);
  TestOdd();
  return cslf::testing::Result();
}
