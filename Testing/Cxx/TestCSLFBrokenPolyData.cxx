// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Polygonal data that would be read out of bounds: ids of missing points, offsets that do not
// ascend, arrays that are too short or not numeric. The view tracer, the sampler and the importer
// show valid parts, warn of the rest and do not crash.
#include "cslfColor.h"
#include "cslfTesting.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr vtkIdType Far = std::numeric_limits<vtkIdType>::max();

/// Two triangles that make a red square, [-1,1] x [-1,1].
vtkSmartPointer<vtkPolyData> MakeSquare()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1, -1, 0);
  points->InsertNextPoint(1, -1, 0);
  points->InsertNextPoint(1, 1, 0);
  points->InsertNextPoint(-1, 1, 0);
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell({ 0, 1, 2 });
  polygons->InsertNextCell({ 0, 2, 3 });
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < 2; ++i)
  {
    colors->InsertNextTuple3(255, 0, 0);
  }
  auto square = vtkSmartPointer<vtkPolyData>::New();
  square->SetPoints(points);
  square->SetPolys(polygons);
  square->GetCellData()->SetScalars(colors);
  return square;
}

/// A cell of each kind before and after the square, with one id that does not exist.
void AddBrokenCells(vtkPolyData* data, vtkIdType wrong)
{
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ wrong });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, wrong, 1 });
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 0, 1, wrong, 2 });
  data->SetVerts(vertices);
  data->SetLines(lines);
  data->SetStrips(strips);
  data->GetPolys()->InsertNextCell({ 1, 2, wrong });
  data->GetPolys()->InsertNextCell({ 0, 1, 2, 3, wrong });
  auto* square = vtkUnsignedCharArray::SafeDownCast(data->GetCellData()->GetScalars());
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < 7; ++i)
  {
    const bool ofSquare = i == 2 || i == 3;
    colors->InsertNextTuple3(ofSquare ? 255 : 0, ofSquare ? 0 : 255, 0);
  }
  CSLF_CHECK(square != nullptr);
  data->GetCellData()->SetScalars(colors);
}

/// Polygons with these offsets and connectivity.
void AddCells(vtkCellArray* cells, const std::vector<int>& offsets, const std::vector<int>& ids)
{
  vtkNew<vtkIdTypeArray> offsetArray;
  vtkNew<vtkIdTypeArray> idArray;
  for (int offset : offsets)
  {
    offsetArray->InsertNextValue(offset);
  }
  for (int id : ids)
  {
    idArray->InsertNextValue(id);
  }
  cells->SetData(offsetArray, idArray);
}

template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < components * tuples; ++i)
  {
    array->SetValue(i, 1);
  }
  return array;
}

void AddTexts(vtkFieldData* data, const char* name, const std::vector<const char*>& texts)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const char* text : texts)
  {
    array->InsertNextValue(text);
  }
  data->AddArray(array);
}

struct Case
{
  const char* Name;
  std::function<void(vtkPolyData*)> Break;
  const char* Warning;
  bool ShowsSquare;
  bool IsLeftToTracer = false; ///< whether the importer gives no warning
};

/// All faults of cells.
std::vector<Case> MakeCellCases()
{
  const auto withIds = [](vtkIdType wrong)
  { return [wrong](vtkPolyData* data) { AddBrokenCells(data, wrong); }; };
  const auto withOffsets = [](const std::vector<int>& offsets)
  {
    return [offsets](vtkPolyData* data) {
      AddCells(data->GetPolys(), offsets, { 0, 1, 2, 0, 2, 3 });
    };
  };
  const char* ids = "cells with ids of missing points";
  const char* offsets = "cells with invalid offsets";
  return {
    { "one past the last point", withIds(4), ids, true },
    { "negative", withIds(-1), ids, true },
    { "largest", withIds(Far), ids, true },
    { "smallest", withIds(std::numeric_limits<vtkIdType>::min()), ids, true },
    { "descending offsets", withOffsets({ 0, 6, 3 }), offsets, false },
    { "negative offset", withOffsets({ 0, -3, 6 }), offsets, false },
    { "offset past the end", withOffsets({ 0, 3, 6, 1000000 }), offsets, false },
    { "first offset", withOffsets({ 3, 6 }), offsets, false },
    { "offsets of lines",
      [](vtkPolyData* data)
      {
        vtkNew<vtkCellArray> lines;
        AddCells(lines, { 0, 5, 2 }, { 0, 1 });
        data->SetLines(lines);
        data->GetCellData()->Initialize();
      },
      offsets, true },
    { "no points", [](vtkPolyData* data) { data->SetPoints(nullptr); },
      "cells with ids of missing points", false },
    { "points of two coordinates",
      [](vtkPolyData* data) { data->GetPoints()->GetData()->SetNumberOfComponents(2); },
      "cells with ids of missing points", false },
    { "short polygons",
      [](vtkPolyData* data)
      {
        AddCells(data->GetPolys(), { 0, 3, 6, 6, 7, 9 }, { 0, 1, 2, 0, 2, 3, 1, 1, 2 });
        data->GetCellData()->Initialize();
      },
      "", true },
  };
}

/// All faults of arrays.
std::vector<Case> MakeArrayCases()
{
  const char* isShort = "array Short, which is too short";
  const char* ghosts = vtkDataSetAttributes::GhostArrayName();
  const auto withCellArray = [](const vtkSmartPointer<vtkDataArray>& array)
  { return [array](vtkPolyData* data) { data->GetCellData()->AddArray(array); }; };
  return {
    { "short colors of cells",
      [](vtkPolyData* data)
      { data->GetCellData()->SetScalars(MakeArray<vtkUnsignedCharArray>("Short", 3, 1)); },
      isShort, true },
    { "short colors of points",
      [](vtkPolyData* data)
      { data->GetPointData()->SetScalars(MakeArray<vtkUnsignedCharArray>("Short", 3, 3)); },
      isShort, true },
    { "short normals",
      [](vtkPolyData* data)
      { data->GetPointData()->SetNormals(MakeArray<vtkFloatArray>("Short", 3, 1)); },
      isShort, true },
    { "short array that nobody uses", withCellArray(MakeArray<vtkDoubleArray>("Short", 9, 0)),
      isShort, true },
    { "short ghosts", withCellArray(MakeArray<vtkUnsignedCharArray>(ghosts, 1, 1)),
      "which is too short", true },
    { "normals of two components",
      [](vtkPolyData* data)
      { data->GetPointData()->AddArray(MakeArray<vtkFloatArray>("Normals", 2, 4)); },
      "", true },
    { "ghosts of the wrong type", withCellArray(MakeArray<vtkIntArray>(ghosts, 1, 2)), "", true },
    { "instances that are texts",
      [](vtkPolyData* data)
      { AddTexts(data->GetFieldData(), vtkCSLFInstances::InstanceMatrix(), { "here" }); },
      "instances with arrays that do not match", false, true },
    { "lights that are texts",
      [](vtkPolyData* data)
      { AddTexts(data->GetFieldData(), vtkCSLFLight::PointLightPosition(), { "there" }); },
      "1 light(s) with arrays that do not match", true, true },
    { "colors that are texts",
      [](vtkPolyData* data)
      {
        data->GetCellData()->Initialize();
        AddTexts(data->GetCellData(), "Colors", { "red", "green" });
      },
      "is not numeric", true, true },
  };
}

std::vector<Case> MakeCases()
{
  std::vector<Case> cases = MakeCellCases();
  for (const Case& of : MakeArrayCases())
  {
    cases.push_back(of);
  }
  return cases;
}

/// Catches a filter's messages.
struct Messages
{
  vtkNew<vtkTest::ErrorObserver> Own;
  vtkNew<vtkTest::ErrorObserver> OfPipeline;

  explicit Messages(vtkAlgorithm* filter)
  {
    filter->AddObserver(vtkCommand::ErrorEvent, this->Own);
    filter->AddObserver(vtkCommand::WarningEvent, this->Own);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->OfPipeline);
  }

  bool Contain(const std::string& text) const
  {
    return (this->Own->GetWarningMessage() + this->Own->GetErrorMessage()).find(text) !=
      std::string::npos;
  }
};

void CheckViewTracer(const Case& of)
{
  vtkSmartPointer<vtkPolyData> data = MakeSquare();
  of.Break(data);
  vtkNew<vtkCSLFViewTracer> tracer;
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 5);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  tracer->SetCamera(camera);
  tracer->SetSize(4, 4);
  tracer->SetSamples(4);
  tracer->SetColorTypeToFloat();
  tracer->SetInputData(data);
  if (std::string(of.Name) == "colors that are texts")
  {
    tracer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Colors");
  }
  const Messages messages(tracer);
  const bool updated = tracer->GetExecutive()->Update() == 1;
  CSLF_CHECK(messages.Contain(of.Warning));
  CSLF_CHECK(updated == of.ShowsSquare);
  if (updated)
  {
    vtkDataArray* colors = tracer->GetOutput()->GetPointData()->GetScalars();
    for (vtkIdType i : { 2 * 4 + 1, 1 * 4 + 2 })
    {
      CSLF_CHECK(colors->GetComponent(i, 3) == 1.0);
      CSLF_CHECK(colors->GetComponent(i, 0) > 0.5);
    }
  }
}

vtkSmartPointer<vtkCSLFSampler> MakeSampler(vtkPolyData* data)
{
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  sampler->SetInputData(data);
  sampler->SetViewpoints(2);
  sampler->SetResolution(8);
  sampler->SetSamples(1);
  sampler->GetCacheOptions()->SetSamples(16);
  return sampler;
}

void CheckSampler(const Case& of)
{
  vtkSmartPointer<vtkPolyData> data = MakeSquare();
  of.Break(data);
  const auto sampler = MakeSampler(data);
  const Messages messages(sampler);
  CSLF_CHECK((sampler->GetExecutive()->Update() == 1) == of.ShowsSquare);
}

/// The same data in an actor, and as a glyph.
void CheckImporter(const Case& of)
{
  vtkSmartPointer<vtkPolyData> data = MakeSquare();
  of.Break(data);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(1, 2, 3);
  vtkNew<vtkPolyData> places;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 5);
  places->SetPoints(points);
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(places);
  glyphs->SetSourceData(data);
  vtkNew<vtkActor> glyphActor;
  glyphActor->SetMapper(glyphs);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->AddActor(glyphActor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  const Messages messages(importer);
  CSLF_CHECK(importer->GetExecutive()->Update() == 1);
  CSLF_CHECK(messages.Contain(of.Warning) || of.IsLeftToTracer);

  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputConnection(importer->GetOutputPort());
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 50);
  tracer->SetCamera(camera);
  tracer->SetSize(4, 4);
  tracer->SetSamples(1);
  const Messages tracerMessages(tracer);
  tracer->GetExecutive()->Update();
}

void TestNonFinite()
{
  for (double value :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300 })
  {
    vtkSmartPointer<vtkPolyData> data = MakeSquare();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->DeepCopy(data->GetPoints());
    const vtkIdType wrong = points->InsertNextPoint(value, 0, 0);
    data->SetPoints(points);
    AddBrokenCells(data, wrong);
    const auto sampler = MakeSampler(data);
    const Messages messages(sampler);
    CSLF_CHECK(sampler->GetExecutive()->Update() == 1);
    CSLF_CHECK(messages.Contain("polygon(s) with coordinates that are not finite"));
    CSLF_CHECK(messages.Contain("2 line(s) or vertex cell(s) with coordinates"));
  }
}
}

int TestCSLFBrokenPolyData(int, char*[])
{
  for (const Case& of : MakeCases())
  {
    std::cout << of.Name << std::endl;
    CheckViewTracer(of);
    CheckSampler(of);
    CheckImporter(of);
  }
  TestNonFinite();
  return cslf::testing::Result();
}
