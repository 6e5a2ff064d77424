// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBenchmarks.h"

#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace cslf
{
namespace benchmarks
{
namespace
{
constexpr int PictureSize = 512;
constexpr int Samples = 4;

/// The tool's default camera: in front, two cube edges from the centre.
vtkSmartPointer<vtkCamera> MakeCamera(const double bounds[6])
{
  double center[3];
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetFocalPoint(center);
  camera->SetPosition(center[0], center[1], center[2] + 2.0 * 1.1 * longest);
  camera->SetViewAngle(40.0);
  return camera;
}

void Trace(benchmark::State& state, vtkCSLFViewTracer* tracer, const double bounds[6])
{
  tracer->SetCamera(MakeCamera(bounds));
  tracer->SetSize(PictureSize, PictureSize);
  tracer->SetSamples(Samples);
  tracer->Update(); // builds the scene
  double rays = 0.0;
  double seconds = 0.0;
  for (auto _ : state)
  {
    tracer->Modified();
    tracer->Update();
    rays += static_cast<double>(tracer->GetNumberOfRays());
    seconds += tracer->GetRenderSeconds();
    state.SetIterationTime(tracer->GetRenderSeconds());
  }
  state.counters["rays_per_second"] = rays / seconds;
}

void TraceBox(benchmark::State& state)
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputConnection(box->GetOutputPort());
  tracer->GetEnvironment()->SetModeToNone();
  const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  Trace(state, tracer, bounds);
}

template <typename Reader>
vtkSmartPointer<vtkPolyData> Read(const std::string& fileName)
{
  vtkNew<Reader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  return reader->GetOutput();
}

void TraceMesh(benchmark::State& state, const std::string& fileName)
{
  const bool isOBJ = std::filesystem::path(fileName).extension() == ".obj";
  const auto mesh = isOBJ ? Read<vtkOBJReader>(fileName) : Read<vtkPLYReader>(fileName);
  if (mesh->GetNumberOfPolys() == 0)
  {
    state.SkipWithError("The file has no polygons.");
    return;
  }
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputData(mesh);
  Trace(state, tracer, mesh->GetBounds());
}

/// A floor below 1000 small spheres, some of which emit light.
vtkSmartPointer<vtkMultiBlockDataSet> MakeLamps(int count)
{
  constexpr int spheres = 1000;
  vtkNew<vtkPlaneSource> floor;
  floor->Update();
  vtkNew<vtkPolyData> lamps[2]; // dark ones, and those that shine
  for (vtkPolyData* part : { lamps[0].Get(), lamps[1].Get() })
  {
    vtkNew<vtkPoints> places;
    vtkNew<vtkCellArray> vertices;
    part->SetPoints(places);
    part->SetVerts(vertices);
    vtkCSLFMaterial::SetPointRadius(part, 0.002);
  }
  vtkCSLFMaterial::SetEmission(lamps[1], 50.0, 50.0, 50.0);
  for (int i = 0; i < spheres; ++i)
  {
    // The sequence of R2 (Roberts, 2018) spreads them evenly.
    const double place[3] = { std::fmod(0.7548776662 * i, 1.0) - 0.5,
      std::fmod(0.5698402910 * i, 1.0) - 0.5, 0.1 };
    vtkPolyData* part = lamps[i % (spheres / count) == 0 ? 1 : 0];
    const vtkIdType point = part->GetPoints()->InsertNextPoint(place);
    part->GetVerts()->InsertNextCell(1, &point);
  }
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  scene->SetBlock(0, floor->GetOutput());
  scene->SetBlock(1, lamps[1]);
  scene->SetBlock(2, lamps[0]);
  return scene;
}

void TraceLamps(benchmark::State& state)
{
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputData(MakeLamps(static_cast<int>(state.range(0))));
  tracer->GetEnvironment()->SetModeToNone();
  const double bounds[6] = { -0.5, 0.5, -0.5, 0.5, -0.1, 0.1 };
  Trace(state, tracer, bounds);
}

void Configure(benchmark::internal::Benchmark* added)
{
  added->Unit(benchmark::kMillisecond)->UseManualTime();
}
}

void AddPathTracing()
{
  Configure(benchmark::RegisterBenchmark("path-tracing/cornell-box", TraceBox));
  auto* lamps = benchmark::RegisterBenchmark("path-tracing/lamps", TraceLamps);
  Configure(lamps->Arg(10)->Arg(100)->Arg(1000));
}

void AddPathTracing(const std::string& fileName)
{
  const std::string name = "path-tracing/" + std::filesystem::path(fileName).stem().string();
  Configure(benchmark::RegisterBenchmark(name.c_str(), TraceMesh, fileName));
}
}
}
