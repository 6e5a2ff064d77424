// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// usage: cslfBenchmarks [--benchmark_...] [FILE...]    .obj and .ply files to trace besides the
// box, .mp4 and .mkv files to decode
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
    const std::filesystem::path file = argv[i];
    const std::filesystem::path extension = file.extension();
    std::error_code failure;
    const bool isMesh = extension == ".obj" || extension == ".ply";
    const bool isField = extension == ".mp4" || extension == ".mkv";
    if ((!isMesh && !isField) || !std::filesystem::is_regular_file(file, failure))
    {
      std::cerr << "cslfBenchmarks: error: " << argv[i]
                << " is no .obj, .ply, .mp4 or .mkv file.\n";
      return EXIT_FAILURE;
    }
    if (isMesh)
    {
      cslf::benchmarks::AddPathTracing(file.string());
    }
    else
    {
      cslf::benchmarks::AddDecoding(file.string());
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
