// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// usage: cslfBenchmarks [--benchmark_...] [MESH...]    .obj and .ply files to trace besides the box
#include "cslfBenchmarks.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

int main(int argc, char* argv[])
{
  benchmark::Initialize(&argc, argv);
  cslf::benchmarks::AddCachedRendering();
  cslf::benchmarks::AddPathTracing();
  for (int i = 1; i < argc; ++i)
  {
    const std::filesystem::path mesh = argv[i];
    std::error_code failure;
    const bool isKnown = mesh.extension() == ".obj" || mesh.extension() == ".ply";
    if (!isKnown || !std::filesystem::is_regular_file(mesh, failure))
    {
      std::cerr << "cslfBenchmarks: error: " << argv[i] << " is no .obj or .ply file.\n";
      return EXIT_FAILURE;
    }
    cslf::benchmarks::AddPathTracing(mesh.string());
  }
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
