// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBenchmarks.h"

#include "vtkCSLFDecoder.h"

#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>

namespace cslf
{
namespace benchmarks
{
namespace
{
/// The whole field is decoded in ranges of this many bytes, because it may not fit in memory.
constexpr double RangeBytes = 1 << 29;
constexpr double TexelBytes = 6.0;

/// An opened decoder of the file, with the field's extent. Null on failure.
bool Open(
  benchmark::State& state, vtkCSLFDecoder* decoder, const std::string& fileName, int extent[6])
{
  decoder->SetFileName(fileName.c_str());
  decoder->UpdateInformation();
  if (decoder->GetErrorCode() != 0)
  {
    state.SkipWithError("The file is no light field.");
    return false;
  }
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(decoder->GetOutputInformation(0), extent);
  return true;
}

double CountTexels(const int extent[6])
{
  return (extent[1] + 1.0) * (extent[3] + 1.0);
}

void DecodeWhole(benchmark::State& state, const std::string& fileName)
{
  vtkNew<vtkCSLFDecoder> decoder;
  int extent[6];
  if (!Open(state, decoder, fileName, extent))
  {
    return;
  }
  const int last = extent[5];
  const int step = std::max(1, static_cast<int>(RangeBytes / (TexelBytes * CountTexels(extent))));
  double texels = 0.0;
  for (auto _ : state)
  {
    decoder->Modified();
    decoder->UpdateInformation();
    for (int first = 0; first <= last; first += step)
    {
      extent[4] = first;
      extent[5] = std::min(first + step - 1, last);
      decoder->UpdateExtent(extent);
    }
    texels += CountTexels(extent) * (last + 1.0);
  }
  state.counters["texels_per_second"] = benchmark::Counter(texels, benchmark::Counter::kIsRate);
}

/// Opens the file and decodes one viewpoint, a different one each time. The system's cache of the
/// file is kept.
void OpenAndDecodeOne(benchmark::State& state, const std::string& fileName)
{
  int extent[6];
  {
    vtkNew<vtkCSLFDecoder> decoder;
    if (!Open(state, decoder, fileName, extent))
    {
      return;
    }
  }
  constexpr int step = 7919; // a prime larger than a group, so that all places in groups are used
  vtkIdType z = 0;
  for (auto _ : state)
  {
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(fileName.c_str());
    vtkNew<vtkImageData> image;
    if (!decoder->GetViewpoint(z, image))
    {
      state.SkipWithError("A viewpoint cannot be read.");
      return;
    }
    z = (z + step) % (extent[5] + 1);
  }
}

void OpenOnly(benchmark::State& state, const std::string& fileName)
{
  for (auto _ : state)
  {
    vtkNew<vtkCSLFDecoder> decoder;
    int extent[6];
    if (!Open(state, decoder, fileName, extent))
    {
      return;
    }
  }
}
}

void AddDecoding(const std::string& fileName)
{
  const std::string name = std::filesystem::path(fileName).filename().string();
  const auto add =
    [&](const std::string& kind, void (*measure)(benchmark::State&, const std::string&))
  {
    benchmark::RegisterBenchmark(("decoding/" + name + ", " + kind).c_str(), measure, fileName)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  };
  add("whole", DecodeWhole);
  add("opening and one viewpoint", OpenAndDecodeOne);
  add("opening", OpenOnly);
}
}
}
