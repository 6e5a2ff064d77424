// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The colours of a map of scalars stay apart from light: in the sampler's geometry, in files, and
// in what readers compute of both. Scalars are what they were, and other maps show what a bake with
// them shows.
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Coding/Geometry/cslfGeometryTexels.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfColor.h"
#include "cslfCube.h"
#include "cslfLayout.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMapper.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <atomic>
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

using Scalar = std::function<double(const double* point)>;

double GetHeight(const double* point)
{
  return 100.0 + 50.0 * point[2];
}

/// Hues that turn so often over a range.
vtkSmartPointer<vtkLookupTable> MakeHues(double first, double last, int turns)
{
  constexpr int steps = 2048;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(steps);
  table->SetTableRange(first, last);
  for (int i = 0; i < steps; ++i)
  {
    double color[3];
    vtkMath::HSVToRGB(
      std::fmod(turns * (i + 0.5) / steps, 1.0), 0.8, 0.9, color, color + 1, color + 2);
    table->SetTableValue(i, color[0], color[1], color[2]);
  }
  table->SetNanColor(0.1, 0.2, 0.3, 1.0);
  return table;
}

vtkSmartPointer<vtkPolyData> MakeBall(const Scalar& scalar, vtkLookupTable* table)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(96);
  source->SetPhiResolution(96);
  source->Update();
  const vtkSmartPointer<vtkPolyData> ball = source->GetOutput();
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Height");
  heights->SetLookupTable(table);
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    heights->InsertNextValue(scalar(ball->GetPoint(i)));
  }
  ball->GetPointData()->SetScalars(heights);
  return ball;
}

vtkSmartPointer<vtkCSLFSampler> Sample(vtkDataObject* scene)
{
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  sampler->SetInputData(scene);
  sampler->SetViewpoints(2);
  sampler->SetResolution(Resolution);
  sampler->SetQuality(vtkCSLFSampler::Preview);
  sampler->SetAutomaticCube(false);
  sampler->SetCubeCenter(&glm::dvec3(Box.Center)[0]);
  sampler->SetCubeEdges(&glm::dvec3(Box.Edges)[0]);
  sampler->GetEnvironment()->SetColor(0.9, 0.8, 0.7);
  sampler->Update();
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

/// Scalars are those of the places, at most that share of the range away.
void CheckScalars(vtkPolyData* geometry, const Scalar& scalar, double error)
{
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(points.Maps.size() == 1);
  CSLF_CHECK(points.Numbers.size() == static_cast<std::size_t>(geometry->GetNumberOfPoints()));
  const double size = points.Maps[0].Range[1] - points.Maps[0].Range[0];
  double most = 0.0;
  for (std::size_t i = 0; i < points.Numbers.size(); ++i)
  {
    CSLF_CHECK(points.Has(i));
    // Triangles lie within the ball.
    glm::dvec3 place;
    geometry->GetPoint(static_cast<vtkIdType>(i), &place.x);
    place = glm::normalize(place);
    most = std::max(most, std::abs(points.Scalars[i] - scalar(&place.x)) / size);
  }
  std::cout << "Scalars are off by at most " << most << " of the range.\n";
  CSLF_CHECK(most < error);
}

/// The colours of points are those of light and map.
void CheckColors(vtkPolyData* geometry)
{
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  const cslf::PointColorArrays arrays = cslf::FindPointColors(geometry);
  CSLF_CHECK(arrays.Front && arrays.Exact);
  for (std::size_t i = 0; i < points.Numbers.size(); ++i)
  {
    const glm::dvec3 shown =
      cslf::ShowLight(points.Light[0][i], points.GetMap(i), points.GetPlace(i));
    for (int c = 0; c < 3; ++c)
    {
      CSLF_CHECK_NEAR(
        arrays.Front->GetComponent(static_cast<vtkIdType>(i), c), 255.0 * shown[c], 1.0);
    }
  }
}

/// The PSNR of what viewpoints see of a geometry, beside what was sampled.
double CompareTexels(vtkPolyData* geometry, vtkImageData* field)
{
  const cslf::Layout grid(2, Resolution);
  const cslf::GeometryTexels texels(geometry, Box, grid);
  CSLF_CHECK(texels.AreAllExact());
  auto* colors = vtkUnsignedCharArray::SafeDownCast(field->GetPointData()->GetArray("Color"));
  cslf::DrawnTexels drawn(std::size_t(5) * Resolution * Resolution, true);
  const std::atomic<bool> isStopped{ false };
  double sum = 0.0;
  double count = 0.0;
  for (int slice = 0; slice < grid.GetSlices(); ++slice)
  {
    CSLF_CHECK(texels.Draw(slice, drawn, isStopped));
    for (std::size_t i = 0; i < drawn.Colors.size(); ++i)
    {
      const unsigned char* own =
        colors->GetPointer(4 * static_cast<vtkIdType>(slice * drawn.Colors.size() + i));
      for (int c = 0; own[3] == 255 && drawn.Colors[i].w == 255 && c < 3; ++c)
      {
        sum += std::pow(own[c] - drawn.Colors[i][c], 2.0);
        count += 1.0;
      }
    }
  }
  CSLF_CHECK(count > 10000.0);
  return 10.0 * std::log10(255.0 * 255.0 / (sum / count));
}

/// Maps that are much finer than triangles.
void TestSteepMap()
{
  const auto table = MakeHues(50.0, 150.0, 6);
  const auto sampler = Sample(MakeBall(GetHeight, table));
  vtkPolyData* geometry = sampler->GetGeometry();
  CheckScalars(geometry, GetHeight, 0.002);
  CheckColors(geometry);
  const auto recoded = Recode(geometry);
  CheckScalars(recoded, GetHeight, 0.003);
  CheckColors(recoded);
  const cslf::ColorMap map = cslf::FindMappedPoints(recoded).Maps[0];
  const cslf::ColorMap own = cslf::FindMappedPoints(geometry).Maps[0];
  CSLF_CHECK(map.Array == "Height" && map.Component.empty() && !map.IsLogarithmic);
  CSLF_CHECK(map.Range[0] == 50.0 && map.Range[1] == 150.0);
  CSLF_CHECK(map.Colors == own.Colors && map.NanColor == own.NanColor);
  for (vtkPolyData* data : { geometry, recoded.GetPointer() })
  {
    // Texels are means over their footprints, which the colour at their centre is not.
    const double quality = CompareTexels(data, sampler->GetOutput());
    std::cout << "Texels: " << quality << " dB.\n";
    CSLF_CHECK(quality > 34.0);
  }
  const auto smooth = Sample(MakeBall(GetHeight, MakeHues(50.0, 150.0, 1)));
  const double quality = CompareTexels(Recode(smooth->GetGeometry()), smooth->GetOutput());
  std::cout << "Texels of a smooth map: " << quality << " dB.\n";
  CSLF_CHECK(quality > 45.0);
}

/// Another map shows what a bake with it has: a convex surface lights nothing.
void TestOtherMap()
{
  const auto other = MakeHues(60.0, 120.0, 1);
  const vtkSmartPointer<vtkPolyData> first =
    Sample(MakeBall(GetHeight, MakeHues(50.0, 150.0, 1)))->GetGeometry();
  const vtkSmartPointer<vtkPolyData> baked = Sample(MakeBall(GetHeight, other))->GetGeometry();
  cslf::MappedPoints points = cslf::FindMappedPoints(first);
  const cslf::MappedPoints expected = cslf::FindMappedPoints(baked);
  cslf::ColorMap map = cslf::MakeColorMap(other);
  CSLF_CHECK(map.Colors == expected.Maps[0].Colors);
  glm::dvec3 means[2] = {};
  for (const int k : { 0, 1 })
  {
    const cslf::MappedPoints& own = k == 0 ? points : expected;
    for (const glm::vec3& light : own.Light[0])
    {
      means[k] += glm::dvec3(light) / double(own.Light[0].size());
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    CSLF_CHECK_NEAR(means[0][c], means[1][c], 0.003);
    // Light is that of the environment.
    const double environment = c == 0 ? 0.9 : c == 1 ? 0.8 : 0.7;
    CSLF_CHECK_NEAR(means[0][c], cslf::LinearToSRGB(cslf::SRGBToLinear(environment)), 0.01);
  }
}

/// Values that are not numbers, or out of range, and logarithms.
void TestSpecialScalars()
{
  const auto logarithmic = MakeHues(1.0, 100.0, 1);
  logarithmic->SetScaleToLog10();
  const auto power = [](const double* point) { return std::pow(10.0, 1.0 + point[2]); };
  const auto recoded = Recode(Sample(MakeBall(power, logarithmic))->GetGeometry());
  const cslf::MappedPoints points = cslf::FindMappedPoints(recoded);
  CSLF_CHECK(points.Maps.size() == 1 && points.Maps[0].IsLogarithmic);
  for (std::size_t i = 0; i < points.Scalars.size(); ++i)
  {
    double place[3];
    recoded->GetPoint(static_cast<vtkIdType>(i), place);
    CSLF_CHECK_NEAR(points.Scalars[i] / power(place), 1.0, 0.05);
  }

  const auto some = [](const double* point) {
    return point[0] > 0.3 ? vtkMath::Nan() : point[0] < -0.3 ? 1000.0 : 100.0;
  };
  const auto table = MakeHues(50.0, 150.0, 1);
  table->SetAboveRangeColor(1.0, 1.0, 1.0, 1.0);
  table->UseAboveRangeColorOn();
  const auto sampler = Sample(MakeBall(some, table));
  const auto broken = Recode(sampler->GetGeometry());
  const cslf::MappedPoints mixed = cslf::FindMappedPoints(broken);
  std::array<int, 3> counts{};
  for (std::size_t i = 0; i < mixed.Scalars.size(); ++i)
  {
    double place[3];
    broken->GetPoint(static_cast<vtkIdType>(i), place);
    if (std::abs(std::abs(place[0]) - 0.3) < 0.15)
    {
      continue;
    }
    const double scalar = mixed.Scalars[i];
    const int kind = place[0] > 0.3 ? 0 : place[0] < -0.3 ? 1 : 2;
    ++counts[kind];
    CSLF_CHECK(kind == 0 ? std::isnan(scalar) : scalar > 0.0);
    if (kind > 0)
    {
      CSLF_CHECK_NEAR(scalar, kind == 1 ? 1000.0 : 100.0, kind == 1 ? 60.0 : 12.0);
    }
  }
  CSLF_CHECK(counts[0] > 10 && counts[1] > 10 && counts[2] > 10);
}

/// Many small balls, each with one scalar, beside a surface without any.
void TestBodies()
{
  constexpr int side = 16;
  vtkNew<vtkPolyData> balls;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("CSLF:PointRadius");
  vtkNew<vtkDoubleArray> values;
  values->SetName("Charge");
  values->SetLookupTable(MakeHues(0.0, 256.0, 1));
  for (int i = 0; i < side * side; ++i)
  {
    vertices->InsertNextCell(
      { points->InsertNextPoint(0.12 * (i % side) - 0.9, 0.12 * (i / side) - 0.9, 0.0) });
    radii->InsertNextValue(0.04F);
    values->InsertNextValue(i);
  }
  balls->SetPoints(points);
  balls->SetVerts(vertices);
  balls->GetPointData()->AddArray(radii);
  balls->GetPointData()->SetScalars(values);
  const auto geometry = Recode(Sample(balls)->GetGeometry());
  CSLF_CHECK(geometry->GetFieldData()->HasArray(cslf::GeometryGroupsName));
  const cslf::MappedPoints mapped = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(mapped.Maps.size() == 1 && mapped.Maps[0].Array == "Charge");
  for (std::size_t i = 0; i < mapped.Scalars.size(); ++i)
  {
    double place[3];
    geometry->GetPoint(static_cast<vtkIdType>(i), place);
    const double expected =
      std::round((place[0] + 0.9) / 0.12) + side * std::round((place[1] + 0.9) / 0.12);
    CSLF_CHECK_NEAR(mapped.Scalars[i], expected, 0.2);
  }
}

/// The geometry of an actor with a mapper, from a file.
vtkSmartPointer<vtkPolyData> Import(vtkMapper* mapper)
{
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  importer->Update();
  return Recode(Sample(importer->GetOutputDataObject(0))->GetGeometry());
}

/// What a window maps by its mapper, with the names of array and component.
void TestImporter()
{
  const auto ball = MakeBall(GetHeight, nullptr);
  vtkNew<vtkFloatArray> vectors;
  vectors->SetName("Velocity");
  vectors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    vectors->InsertNextTuple3(ball->GetPoint(i)[2], 0.0, 1.0);
  }
  ball->GetPointData()->AddArray(vectors);
  const auto table = MakeHues(1.0, 1.5, 1);
  table->SetVectorModeToMagnitude();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(ball);
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("Velocity");
  mapper->InterpolateScalarsBeforeMappingOn();
  const auto geometry = Import(mapper);
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(points.Maps.size() == 1);
  CSLF_CHECK(points.Maps[0].Array == "Velocity" && points.Maps[0].Component == "Magnitude");
  vtkDataArray* speeds = geometry->GetPointData()->GetArray("Velocity Magnitude");
  CSLF_CHECK(speeds && speeds->GetLookupTable());
  CSLF_CHECK_NEAR(speeds->GetRange()[0], 1.0, 0.01);
  CSLF_CHECK_NEAR(speeds->GetRange()[1], std::sqrt(2.0), 0.01);
}

/// Scalars that are mapped first, where that is not seen, and those of glyphs.
void TestMappedFirst()
{
  for (const int turns : { 1, 24 })
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(MakeBall(GetHeight, nullptr));
    mapper->SetLookupTable(MakeHues(50.0, 150.0, turns));
    mapper->UseLookupTableScalarRangeOn();
    // Colours between points of fine rainbows are not on the map.
    CSLF_CHECK(cslf::FindMappedPoints(Import(mapper)).IsEmpty() == (turns > 1));
  }

  constexpr int side = 12;
  vtkNew<vtkPolyData> places;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> values;
  values->SetName("Charge");
  for (int i = 0; i < side * side; ++i)
  {
    points->InsertNextPoint(0.15 * (i % side) - 0.9, 0.15 * (i / side) - 0.9, 0.0);
    values->InsertNextValue(i);
  }
  places->SetPoints(points);
  places->GetPointData()->SetScalars(values);
  vtkNew<vtkSphereSource> source;
  source->SetRadius(0.05);
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(places);
  glyphs->SetSourceConnection(source->GetOutputPort());
  glyphs->ScalingOff();
  glyphs->SetLookupTable(MakeHues(0.0, side * side, 1));
  glyphs->UseLookupTableScalarRangeOn();
  const cslf::MappedPoints mapped = cslf::FindMappedPoints(Import(glyphs));
  CSLF_CHECK(mapped.Maps.size() == 1 && mapped.Maps[0].Array == "Charge");
  CSLF_CHECK(!mapped.Scalars.empty());
  const auto least = std::minmax_element(mapped.Scalars.begin(), mapped.Scalars.end());
  CSLF_CHECK_NEAR(*least.first, 0.0, 0.2);
  CSLF_CHECK_NEAR(*least.second, side * side - 1.0, 0.2);
  for (const double scalar : mapped.Scalars)
  {
    CSLF_CHECK_NEAR(scalar, std::round(scalar), 0.2);
  }
}

/// Files from anywhere.
void TestHostile()
{
  const auto sampler = Sample(MakeBall(GetHeight, MakeHues(50.0, 150.0, 1)));
  std::string error;
  const std::vector<unsigned char> bytes =
    cslf::EncodeGeometry(sampler->GetGeometry(), Box, Resolution, error);
  const std::string text(bytes.begin(), bytes.end());
  for (const auto& [word, other] : std::vector<std::pair<std::string, std::string>>{
         { "\"steps\":2048", "\"steps\":2047" }, { "\"steps\":2048", "\"steps\":-999" },
         { "\"steps\":2048", "\"steps\":9999" }, { "light8", "srgb8\"" },
         { "\"light_steps\":", "\"light_stepz\":" }, { "\"bits\":", "\"bitz\":" },
         { "[50.0,150.0]", "[50.0,-15.0]" }, { "\"color_maps\"", "\"color_mapz\"" } })
  {
    const std::size_t place = text.find(word);
    CSLF_CHECK(place != std::string::npos);
    std::string changed = text;
    changed.replace(std::min(place, text.size()), word.size(), other);
    CSLF_CHECK(!cslf::DecodeGeometry({ changed.begin(), changed.end() }, Box, error));
  }
  // Arrays that do not fit are as if there were none.
  vtkNew<vtkPolyData> changed;
  changed->DeepCopy(sampler->GetGeometry());
  changed->GetPointData()->RemoveArray("Height");
  CSLF_CHECK(cslf::FindMappedPoints(changed).IsEmpty());
  CSLF_CHECK(!cslf::EncodeGeometry(changed, Box, Resolution, error).empty());
  changed->DeepCopy(sampler->GetGeometry());
  CSLF_CHECK(!cslf::FindMappedPoints(changed).IsEmpty());
  changed->GetPointData()->GetArray(cslf::LightName)->SetComponent(0, 1, vtkMath::Inf());
  CSLF_CHECK(cslf::FindMappedPoints(changed).IsEmpty());
}
}

int TestCSLFGeometryMaps(int, char*[])
{
  TestSteepMap();
  TestOtherMap();
  TestSpecialScalars();
  TestBodies();
  TestImporter();
  TestMappedFirst();
  TestHostile();
  return cslf::testing::Result();
}
