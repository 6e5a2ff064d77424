// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Colours and arrays of cells: surfaces keep their borders and exact values, points of neighbours
// are apart, and a map can be changed.
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfCube.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArraySelection.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
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
constexpr int Cells = 8;
constexpr double Range = 7.0;
const cslf::Cube Box{ { 0.0, 0.0, 0.0 }, { 2.4, 2.4, 2.4 } };

/// Of the cell at a place of the sheet, from -1 to 1: neighbours differ.
int GetNumber(double x, double y)
{
  const int column = std::clamp(static_cast<int>((x + 1.0) / 2.0 * Cells), 0, Cells - 1);
  const int row = std::clamp(static_cast<int>((y + 1.0) / 2.0 * Cells), 0, Cells - 1);
  return 3 * column + 5 * row;
}

double GetValue(double x, double y)
{
  return GetNumber(x, y) % static_cast<int>(Range + 1.0);
}

/// A part of a sheet of square cells, between two columns, which is divided into smaller cells.
vtkSmartPointer<vtkPolyData> MakeSheet(int first, int last)
{
  constexpr int parts = 4;
  vtkNew<vtkPlaneSource> source;
  const double from = 2.0 * first / Cells - 1.0;
  const double to = 2.0 * last / Cells - 1.0;
  source->SetOrigin(from, -1.0, 0.0);
  source->SetPoint1(to, -1.0, 0.0);
  source->SetPoint2(from, 1.0, 0.0);
  source->SetResolution(parts * (last - first), parts * Cells);
  source->Update();
  const vtkSmartPointer<vtkPolyData> sheet = source->GetOutput();
  sheet->GetPointData()->Initialize();
  vtkNew<vtkDoubleArray> values;
  values->SetName("Value");
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("Number");
  for (vtkIdType i = 0; i < sheet->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    sheet->GetCellBounds(i, bounds);
    const double x = 0.5 * (bounds[0] + bounds[1]);
    const double y = 0.5 * (bounds[2] + bounds[3]);
    values->InsertNextValue(GetValue(x, y));
    numbers->InsertNextValue(GetNumber(x, y));
  }
  sheet->GetCellData()->SetScalars(values);
  sheet->GetCellData()->AddArray(numbers);
  return sheet;
}

vtkSmartPointer<vtkCSLFSampler> MakeSampler()
{
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  sampler->SetViewpoints(2);
  sampler->SetResolution(64);
  sampler->SetQuality(vtkCSLFSampler::Preview);
  sampler->SetAutomaticCube(false);
  sampler->SetCubeCenter(&glm::dvec3(Box.Center)[0]);
  sampler->SetCubeEdges(&glm::dvec3(Box.Edges)[0]);
  sampler->GetEnvironment()->SetColor(1.0, 1.0, 1.0);
  return sampler;
}

/// The share of a surface, by area, with a point that is wrong, given the middle of its triangle.
double MeasureShare(
  vtkPolyData* surface, const std::function<bool(std::size_t, const glm::dvec3&)>& isWrong)
{
  double off = 0.0;
  double sum = 0.0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCellPoints(i, corners);
    glm::dvec3 places[3];
    for (int k = 0; k < 3; ++k)
    {
      surface->GetPoint(corners->GetId(k), &places[k].x);
    }
    const glm::dvec3 middle = (places[0] + places[1] + places[2]) / 3.0;
    const double area = glm::length(glm::cross(places[1] - places[0], places[2] - places[0]));
    bool isAnyWrong = false;
    for (int k = 0; k < 3; ++k)
    {
      isAnyWrong = isAnyWrong || isWrong(static_cast<std::size_t>(corners->GetId(k)), middle);
    }
    sum += area;
    off += isAnyWrong ? area : 0.0;
  }
  return off / sum;
}

/// The file's geometry has the cells' borders, hardly more triangles than these need, and their
/// values, and nothing is left for viewpoints.
void Check(vtkPolyData* geometry, const std::string& title)
{
  std::string error;
  const std::vector<unsigned char> bytes = cslf::EncodeGeometry(geometry, Box, 64, error);
  const auto decoded = cslf::DecodeGeometry(bytes, Box, error);
  CSLF_CHECK(decoded != nullptr);
  const cslf::MappedPoints points = cslf::FindMappedPoints(decoded);
  CSLF_CHECK(points.Maps.size() == 1 && points.Maps[0].GetScalarName() == "Value");
  CSLF_CHECK(points.Arrays.size() == 1 && points.Arrays[0].Name == "Number");
  const double off = MeasureShare(decoded,
    [&](std::size_t point, const glm::dvec3& middle)
    {
      return std::abs(points.Scalars[point] - GetValue(middle.x, middle.y)) > 0.001 * Range ||
        points.Arrays[0].GetValue(point, 0) != GetNumber(middle.x, middle.y);
    });
  std::cout << title << ": " << decoded->GetNumberOfCells() << " triangles, " << 100.0 * off
            << " % of the surface is off.\n";
  CSLF_CHECK(off <= 1e-3);
  CSLF_CHECK(decoded->GetNumberOfCells() <= 6 * Cells * Cells);
  const auto colors = cslf::FindPointColors(decoded);
  CSLF_CHECK(colors.Front && colors.Back);
}

void TestSheet()
{
  const auto sampler = MakeSampler();
  sampler->GetSurfaceArraySelection()->EnableArray("Number");
  sampler->SetInputData(MakeSheet(0, Cells));
  sampler->Update();
  Check(sampler->GetGeometry(), "A sheet");
}

/// Pieces of one surface are joined and sorted; blocks that touch each other have borders like
/// cells.
void TestParts(bool arePieces)
{
  vtkNew<vtkMultiBlockDataSet> parts;
  parts->SetBlock(0, MakeSheet(3, Cells));
  parts->SetBlock(1, MakeSheet(0, 3));
  const auto sampler = MakeSampler();
  sampler->SetDistributedScene(arePieces);
  sampler->GetSurfaceArraySelection()->EnableArray("Number");
  sampler->SetInputData(parts);
  sampler->Update();
  Check(sampler->GetGeometry(), arePieces ? "Pieces" : "Blocks");
}

void TestRenderer()
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeSheet(0, Cells));
  mapper->SetScalarModeToUseCellData();
  mapper->SetScalarRange(0.0, Range);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const auto sampler = MakeSampler();
  sampler->SetRenderer(renderer);
  sampler->GetSurfaceArraySelection()->EnableArray("Number");
  sampler->Update();
  Check(sampler->GetGeometry(), "A renderer");
}

/// Tubes around lines that have values: each keeps its own.
void TestLines()
{
  vtkNew<vtkPolyData> lines;
  vtkNew<vtkPoints> ends;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkDoubleArray> values;
  values->SetName("Value");
  for (int i = 0; i < 2; ++i)
  {
    const double y = i == 0 ? -0.5 : 0.5;
    const vtkIdType line[] = { ends->InsertNextPoint(-0.9, y, 0.0),
      ends->InsertNextPoint(0.9, y, 0.0) };
    cells->InsertNextCell(2, line);
    values->InsertNextValue(i == 0 ? 2.0 : 6.0);
  }
  lines->SetPoints(ends);
  lines->SetLines(cells);
  lines->GetCellData()->SetScalars(values);
  vtkCSLFMaterial::SetLineRadius(lines, 0.2);
  const auto sampler = MakeSampler();
  sampler->SetInputData(lines);
  sampler->Update();
  vtkPolyData* geometry = sampler->GetGeometry();
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(points.Maps.size() == 1);
  const double off = MeasureShare(geometry,
    [&](std::size_t point, const glm::dvec3& middle)
    { return std::abs(points.Scalars[point] - (middle.y < 0.0 ? 2.0 : 6.0)) > 0.001 * Range; });
  std::cout << 100.0 * off << " % of the lines is off.\n";
  CSLF_CHECK(off < 0.001);
}

/// Cells that are smaller than texels, with values that vary smoothly, need few triangles, and no
/// steps.
void TestSmallCells()
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-1.0, -1.0, 0.0);
  source->SetPoint1(1.0, -1.0, 0.0);
  source->SetPoint2(-1.0, 1.0, 0.0);
  source->SetResolution(150, 150);
  source->Update();
  vtkPolyData* sheet = source->GetOutput();
  sheet->GetPointData()->Initialize();
  vtkNew<vtkDoubleArray> values;
  values->SetName("Value");
  for (vtkIdType i = 0; i < sheet->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    sheet->GetCellBounds(i, bounds);
    values->InsertNextValue(Range * 0.5 * (1.0 + 0.5 * (bounds[0] + bounds[1])));
  }
  sheet->GetCellData()->SetScalars(values);
  const auto sampler = MakeSampler();
  sampler->SetInputData(sheet);
  sampler->Update();
  vtkPolyData* geometry = sampler->GetGeometry();
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(points.Maps.size() == 1);
  const double off = MeasureShare(geometry,
    [&](std::size_t point, const glm::dvec3&)
    {
      double place[3];
      geometry->GetPoint(static_cast<vtkIdType>(point), place);
      return std::abs(points.Scalars[point] - Range * 0.5 * (1.0 + place[0])) > 0.01 * Range;
    });
  std::cout << "Small cells: " << geometry->GetNumberOfCells() << " triangles, " << 100.0 * off
            << " % of the surface is off.\n";
  CSLF_CHECK(off < 0.01 && geometry->GetNumberOfCells() <= 400);
}

/// Points of neighbours that are at one place may have colours of their own, too.
void TestCopiedPoints()
{
  const auto left = MakeSheet(0, 4);
  const auto right = MakeSheet(4, Cells);
  vtkNew<vtkPolyData> both;
  vtkNew<vtkPoints> places;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkPolyData* side : { left.Get(), right.Get() })
  {
    const vtkIdType first = places->GetNumberOfPoints();
    for (vtkIdType i = 0; i < side->GetNumberOfPoints(); ++i)
    {
      places->InsertNextPoint(side->GetPoint(i));
      side == left ? colors->InsertNextTuple3(200, 0, 0) : colors->InsertNextTuple3(0, 0, 200);
    }
    vtkNew<vtkIdList> corners;
    for (vtkIdType i = 0; i < side->GetNumberOfCells(); ++i)
    {
      side->GetCellPoints(i, corners);
      for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
      {
        corners->SetId(k, first + corners->GetId(k));
      }
      cells->InsertNextCell(corners);
    }
  }
  both->SetPoints(places);
  both->SetPolys(cells);
  both->GetPointData()->SetScalars(colors);
  const auto sampler = MakeSampler();
  sampler->SetInputData(both);
  sampler->Update();
  vtkPolyData* geometry = sampler->GetGeometry();
  vtkDataArray* front = cslf::FindPointColors(geometry).Front;
  int middle = 0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const double* color = front->GetTuple4(i);
    CSLF_CHECK((color[0] > 150.0 && color[2] < 20.0) || (color[0] < 20.0 && color[2] > 150.0));
    double place[3];
    geometry->GetPoint(i, place);
    middle += std::abs(place[0]) < 1e-3 ? 1 : 0;
  }
  std::cout << geometry->GetNumberOfCells() << " triangles, " << middle
            << " points at the border\n";
  CSLF_CHECK(middle >= 4 && geometry->GetNumberOfCells() <= 100);
}
}

int TestCSLFGeometryCells(int, char*[])
{
  TestSheet();
  TestParts(true);
  TestParts(false);
  TestRenderer();
  TestLines();
  TestSmallCells();
  TestCopiedPoints();
  return cslf::testing::Result();
}
