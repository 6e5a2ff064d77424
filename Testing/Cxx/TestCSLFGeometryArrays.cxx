// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays of points that gave surfaces no colours: from the sampler's geometry to a file and back,
// with their errors; and the light of surfaces of one colour, apart from that.
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfColor.h"
#include "cslfCube.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"
#include "vtkTestErrorObserver.h"

#include <vtkActor.h>
#include <vtkDataArraySelection.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
constexpr int Resolution = 64;
const cslf::Cube Box{ { 0.0, 0.0, 0.0 }, { 2.4, 2.4, 2.4 } };

/// Points of the unit ball.
double GetWave(const glm::dvec3& point)
{
  return 300.0 + 20.0 * std::sin(3.0 * point.x) * std::cos(2.0 * point.y);
}

glm::dvec3 GetFlow(const glm::dvec3& point)
{
  return { -point.y, point.x, 0.1 * point.z };
}

/// Eight octants, with numbers that need more than 16 bits.
int GetOctant(const glm::dvec3& point)
{
  return 100000 + 70000 * (point.x > 0.0) + 1000 * (point.y > 0.0) + (point.z > 0.0);
}

/// What is known only above.
double GetCap(const glm::dvec3& point)
{
  return point.z > 0.0 ? point.z : vtkMath::Nan();
}

vtkSmartPointer<vtkPolyData> MakeBall()
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(128);
  source->SetPhiResolution(128);
  source->Update();
  const vtkSmartPointer<vtkPolyData> ball = source->GetOutput();
  vtkNew<vtkDoubleArray> wave;
  wave->SetName("Wave");
  vtkNew<vtkFloatArray> flow;
  flow->SetName("Flow");
  flow->SetNumberOfComponents(3);
  flow->SetComponentName(2, "up");
  vtkNew<vtkIntArray> octant;
  octant->SetName("Octant");
  vtkNew<vtkDoubleArray> cap;
  cap->SetName("Cap");
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 point;
    ball->GetPoint(i, &point.x);
    wave->InsertNextValue(GetWave(point));
    const glm::dvec3 velocity = GetFlow(point);
    flow->InsertNextTuple(&velocity.x);
    octant->InsertNextValue(GetOctant(point));
    cap->InsertNextValue(GetCap(point));
  }
  ball->GetPointData()->Initialize();
  for (vtkDataArray* array : std::vector<vtkDataArray*>{ wave, flow, octant, cap })
  {
    ball->GetPointData()->AddArray(array);
  }
  vtkCSLFMaterial::SetBaseColor(ball, 0.8, 0.3, 0.1);
  return ball;
}

vtkSmartPointer<vtkCSLFSampler> MakeSampler(const std::vector<std::string>& arrays)
{
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  sampler->SetViewpoints(2);
  sampler->SetResolution(Resolution);
  sampler->SetQuality(vtkCSLFSampler::Preview);
  sampler->SetAutomaticCube(false);
  sampler->SetCubeCenter(&glm::dvec3(Box.Center)[0]);
  sampler->SetCubeEdges(&glm::dvec3(Box.Edges)[0]);
  sampler->GetEnvironment()->SetColor(0.9, 0.8, 0.7);
  for (const std::string& name : arrays)
  {
    sampler->GetSurfaceArraySelection()->EnableArray(name.c_str());
  }
  return sampler;
}

vtkSmartPointer<vtkPolyData> Recode(vtkPolyData* geometry)
{
  std::string error;
  const std::vector<unsigned char> bytes = cslf::EncodeGeometry(geometry, Box, Resolution, error);
  const auto decoded = cslf::DecodeGeometry(bytes, Box, error);
  CSLF_CHECK(decoded != nullptr);
  return decoded;
}

const cslf::SurfaceArray* Find(const cslf::MappedPoints& points, const std::string& name)
{
  const auto found = std::find_if(points.Arrays.begin(), points.Arrays.end(),
    [&name](const cslf::SurfaceArray& array) { return array.Name == name; });
  CSLF_CHECK(found != points.Arrays.end());
  return found != points.Arrays.end() ? &*found : nullptr;
}

/// The area of the triangles around each point.
std::vector<double> FindAreas(vtkPolyData* geometry)
{
  std::vector<double> areas(static_cast<std::size_t>(geometry->GetNumberOfPoints()), 0.0);
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < geometry->GetNumberOfCells(); ++i)
  {
    geometry->GetCellPoints(i, corners);
    glm::dvec3 places[3];
    for (int k = 0; k < 3; ++k)
    {
      geometry->GetPoint(corners->GetId(k), &places[k].x);
    }
    const double area = glm::length(glm::cross(places[1] - places[0], places[2] - places[0]));
    for (int k = 0; k < 3; ++k)
    {
      areas[static_cast<std::size_t>(corners->GetId(k))] += area;
    }
  }
  return areas;
}

/// The share of the surface, by area, whose values are off by more than a limit, at points of the
/// unit ball that count. Where nothing is expected, it is what is not a number. Points of slivers
/// alone, which are hardly seen, may have any value.
double FindShareOff(vtkPolyData* geometry, const cslf::SurfaceArray& array, int component,
  double limit, const std::function<double(const glm::dvec3&)>& expected,
  const std::function<bool(const glm::dvec3&)>& counts)
{
  const std::vector<double> areas = FindAreas(geometry);
  double off = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    glm::dvec3 point;
    geometry->GetPoint(static_cast<vtkIdType>(i), &point.x);
    point = glm::normalize(point);
    if (counts(point))
    {
      const double value = array.GetValue(i, component);
      const double wanted = expected(point);
      const bool isRight =
        std::isnan(wanted) ? std::isnan(value) : std::abs(value - wanted) <= limit;
      off += isRight ? 0.0 : areas[i];
      sum += areas[i];
    }
  }
  std::cout << array.Name << ": " << 100.0 * off / sum << " % of the surface is off by more than "
            << limit << ".\n";
  return off / sum;
}

bool IsAnywhere(const glm::dvec3&)
{
  return true;
}

/// Away from where integers change, and from the ends of what is known.
bool IsInside(const glm::dvec3& at)
{
  return std::min({ std::abs(at.x), std::abs(at.y), std::abs(at.z) }) > 0.2;
}

double GetSpeed(const glm::dvec3& at)
{
  return glm::length(GetFlow(at));
}

void CheckArrays(vtkPolyData* geometry)
{
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(points.Arrays.size() == 4);
  const cslf::SurfaceArray& wave = *Find(points, "Wave");
  CSLF_CHECK(FindShareOff(geometry, wave, 0, 0.005 * 40.0, GetWave, IsAnywhere) < 0.005);
  CSLF_CHECK(FindShareOff(geometry, wave, 0, 0.001 * 40.0, GetWave, IsAnywhere) < 0.25);
  const cslf::SurfaceArray& flow = *Find(points, "Flow");
  CSLF_CHECK(flow.Components.size() == 3 && flow.Components[2].Name == "up");
  CSLF_CHECK(FindShareOff(geometry, flow, -1, 0.01, GetSpeed, IsAnywhere) < 0.005);
  const cslf::SurfaceArray& octant = *Find(points, "Octant");
  CSLF_CHECK(octant.IsInteger);
  CSLF_CHECK(FindShareOff(geometry, octant, 0, 0.0, GetOctant, IsInside) < 1e-4);
  CSLF_CHECK(FindShareOff(geometry, *Find(points, "Cap"), 0, 0.01, GetCap, IsInside) < 1e-4);
}

/// Files keep values: to a thousandth of the range, and integers and what is no number exactly.
void CheckCodes(const cslf::SurfaceArray& array, const cslf::SurfaceArray& decoded)
{
  for (std::size_t c = 0; c < array.Components.size(); ++c)
  {
    const auto range = *array.GetRange(static_cast<int>(c));
    std::vector<double> values = array.Components[c].Values;
    std::vector<double> others = decoded.Components[c].Values;
    const auto takeHoles = [](std::vector<double>& from)
    {
      const auto end =
        std::remove_if(from.begin(), from.end(), [](double value) { return std::isnan(value); });
      const auto holes = from.end() - end;
      from.erase(end, from.end());
      std::sort(from.begin(), from.end());
      return holes;
    };
    // The order of points is another in files.
    const auto holes = takeHoles(values);
    CSLF_CHECK(holes == takeHoles(others));
    double most = 0.0;
    bool areIntegersExact = true;
    for (std::size_t i = 0; i < std::min(values.size(), others.size()); ++i)
    {
      most = std::max(most, std::abs(values[i] - others[i]));
      areIntegersExact = areIntegersExact &&
        (!array.IsInteger || values[i] != std::floor(values[i]) || values[i] == others[i]);
    }
    std::cout << "A file's " << array.Name << " is off by " << most << " of " << range[1] - range[0]
              << ".\n";
    CSLF_CHECK(values.size() == others.size() && most <= 0.001 * (range[1] - range[0]));
    CSLF_CHECK(areIntegersExact);
  }
}

/// A surface of one colour has arrays, and light apart from that.
void TestOneColor()
{
  const auto ball = MakeBall();
  const auto sampler = MakeSampler({ "Wave", "Flow", "Octant", "Cap" });
  sampler->SetInputData(ball);
  sampler->Update();
  vtkPolyData* geometry = sampler->GetGeometry();
  CheckArrays(geometry);
  const auto recoded = Recode(geometry);
  CheckArrays(recoded);
  const cslf::MappedPoints points = cslf::FindMappedPoints(recoded);
  const cslf::MappedPoints before = cslf::FindMappedPoints(geometry);
  for (const cslf::SurfaceArray& array : before.Arrays)
  {
    CheckCodes(array, *Find(points, array.Name));
  }
  CSLF_CHECK(points.Maps.size() == 1 && points.Maps[0].IsOneColor);
  glm::dvec3 light(0.0);
  for (const glm::vec3& each : points.Light[0])
  {
    light += glm::dvec3(each) / double(points.Light[0].size());
  }
  const glm::dvec3 environment(0.9, 0.8, 0.7);
  for (int c = 0; c < 3; ++c)
  {
    CSLF_CHECK_NEAR(light[c], environment[c], 0.015);
  }
  // The colours are those of a bake without arrays.
  const auto plain = MakeSampler({});
  plain->SetInputData(ball);
  plain->Update();
  CSLF_CHECK(cslf::FindMappedPoints(plain->GetGeometry()).IsEmpty());
  const auto findMean = [](vtkPolyData* data)
  {
    vtkDataArray* colors = cslf::FindPointColors(data).Front;
    glm::dvec3 sum(0.0);
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      const double* color = colors->GetTuple4(i);
      sum += glm::dvec3(color[0], color[1], color[2]) / double(colors->GetNumberOfTuples());
    }
    return sum;
  };
  const glm::dvec3 mean = findMean(recoded);
  const glm::dvec3 expected = findMean(plain->GetGeometry());
  for (int c = 0; c < 3; ++c)
  {
    CSLF_CHECK_NEAR(mean[c], expected[c], 1.5);
  }
}

/// Beside an array that colours, and of a renderer.
void TestRenderer()
{
  const auto ball = MakeBall();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(ball);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("Wave");
  mapper->SetScalarRange(280.0, 320.0);
  mapper->InterpolateScalarsBeforeMappingOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const auto sampler = MakeSampler({});
  sampler->GetSurfaceArraySelection()->SetUnknownArraySetting(1);
  sampler->SetRenderer(renderer);
  sampler->Update();
  const auto geometry = Recode(sampler->GetGeometry());
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(points.Maps.size() == 1 && points.Maps[0].Array == "Wave");
  // The scalars of the map are not there twice.
  CSLF_CHECK(points.Arrays.size() == 3);
  CSLF_CHECK(geometry->GetPointData()->HasArray("Wave"));
  CSLF_CHECK(FindShareOff(geometry, *Find(points, "Flow"), -1, 0.01, GetSpeed, IsAnywhere) < 0.005);
}

/// An array that does not exist is named; a changed one is read again.
void TestChanges()
{
  const auto ball = MakeBall();
  const auto sampler = MakeSampler({ "Wave", "Missing" });
  vtkNew<vtkTest::ErrorObserver> observer;
  sampler->AddObserver(vtkCommand::WarningEvent, observer);
  sampler->SetInputData(ball);
  sampler->Update();
  CSLF_CHECK(observer->GetWarningMessage().find("Missing") != std::string::npos);
  observer->Clear();
  sampler->GetSurfaceArraySelection()->DisableArray("Missing");
  vtkDataArray* wave = ball->GetPointData()->GetArray("Wave");
  wave->Fill(7.0);
  wave->Modified();
  ball->Modified();
  sampler->Update();
  const auto geometry = Recode(sampler->GetGeometry());
  const auto points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK((*Find(points, "Wave")->GetRange(0))[0] == 7.0);
  CSLF_CHECK((*Find(points, "Wave")->GetRange(0))[1] == 7.0);
}

/// Files from anywhere.
void TestHostile()
{
  const auto sampler = MakeSampler({ "Wave", "Flow" });
  sampler->SetInputData(MakeBall());
  sampler->Update();
  std::string error;
  const std::vector<unsigned char> bytes =
    cslf::EncodeGeometry(sampler->GetGeometry(), Box, Resolution, error);
  const std::string text(bytes.begin(), bytes.end());
  for (const auto& [word, other] : std::vector<std::pair<std::string, std::string>>{
         { "\"steps\":[1022]", "\"steps\":[1000]" }, { "\"steps\":[1022]", "\"steps\":[-999]" },
         { "\"steps\":[1022]", "\"steps\":[9e99]" }, { "\"steps\":[1022]", "\"steps\":102256" },
         { "\"name\":\"Wave\"", "\"name\":\"\"    " }, { "\"body_bytes\":0", "\"body_bytes\":9" },
         { "\"components\"", "\"componentz\"" }, { "\"ranges\"", "\"rangez\"" } })
  {
    const std::size_t place = text.find(word);
    CSLF_CHECK(place != std::string::npos);
    std::string changed = text;
    changed.replace(std::min(place, text.size()), word.size(), other);
    const bool isDecoded =
      cslf::DecodeGeometry({ changed.begin(), changed.end() }, Box, error) != nullptr;
    std::cout << other << (isDecoded ? " is read.\n" : " is refused.\n");
    CSLF_CHECK(!isDecoded);
  }
  // Arrays that do not fit are as if there were none.
  vtkNew<vtkPolyData> changed;
  changed->DeepCopy(sampler->GetGeometry());
  changed->GetPointData()->RemoveArray("Flow");
  CSLF_CHECK(cslf::FindMappedPoints(changed).Arrays.size() == 1);
  CSLF_CHECK(!cslf::EncodeGeometry(changed, Box, Resolution, error).empty());
}
}

int TestCSLFGeometryArrays(int, char*[])
{
  TestOneColor();
  TestRenderer();
  TestChanges();
  TestHostile();
  return cslf::testing::Result();
}
