// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBenchmarks.h"

#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <benchmark/benchmark.h>

#include <algorithm>
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
  tracer->SetEnvironmentModeToNone();
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

void Configure(benchmark::internal::Benchmark* added)
{
  added->Unit(benchmark::kMillisecond)->UseManualTime();
}
}

void AddPathTracing()
{
  Configure(benchmark::RegisterBenchmark("path-tracing/cornell-box", TraceBox));
}

void AddPathTracing(const std::string& fileName)
{
  const std::string name = "path-tracing/" + std::filesystem::path(fileName).stem().string();
  Configure(benchmark::RegisterBenchmark(name.c_str(), TraceMesh, fileName));
}
}
}
