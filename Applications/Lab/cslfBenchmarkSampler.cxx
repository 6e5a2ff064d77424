// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf-lab sampler: the gain of radiance caching over path tracing at equal quality.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfTable.h"
#include "Options/cslfIntegratorOptions.h"
#include "Options/cslfTableOptions.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfLab.h"

#include "vtkCSLFFieldReference.h"
#include "vtkCSLFSampler.h"

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTrivialProducer.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace cslf::tool
{
namespace
{
struct Options
{
  SceneOptions Scene;
  IntegratorOptions Integrator{ vtkCSLFPathTracer::RadianceCaching };
  std::vector<int> PathSamples{ 16, 64, 256 };
  int Viewpoints = options::Viewpoints.Default;
  int Resolution = options::Resolution.Default;
  int Views = 24;
  int Texels = 100000;
  int ReferenceSamples = 4096;
  int ReferenceSeed = 0;
};

/// Some texels of a viewpoint and their reference colours.
struct Reference
{
  int Slice = 0;
  vtkSmartPointer<vtkIdTypeArray> Texels;
  vtkSmartPointer<vtkDataArray> Colors;
};

/// The cost and quality of one way of sampling.
struct Outcome
{
  std::string Name;
  double SecondsOfAll = 0.0; ///< for the cache and for rendering all viewpoints
  double CacheSeconds = 0.0;
  double ViewSeconds = 0.0; ///< of the measured viewpoints
  double PSNR = 0.0;
};

constexpr double BestPSNR = 60.0;

double ToPSNR(double meanSquareError)
{
  const double peak = 255.0 * 255.0;
  return std::min(BestPSNR, 10.0 * std::log10(peak / std::max(meanSquareError, 1e-30)));
}

/// One random viewpoint from each of several equal ranges of the slices.
std::vector<int> ChooseSlices(const Options& options)
{
  const int slices = 6 * options.Viewpoints * options.Viewpoints;
  const int count = std::min(options.Views, slices);
  std::minstd_rand random(static_cast<unsigned int>(options.ReferenceSeed) + 1);
  std::vector<int> chosen;
  for (int k = 0; k < count; ++k)
  {
    const int first = static_cast<int>(static_cast<long long>(slices) * k / count);
    const int last = static_cast<int>(static_cast<long long>(slices) * (k + 1) / count);
    chosen.push_back(first + static_cast<int>(random() % (last - first)));
  }
  return chosen;
}

vtkImageData* SampleSlice(const Options& options, vtkCSLFSampler* sampler, int slice)
{
  const int extent[6] = { 0, 5 * options.Resolution - 1, 0, options.Resolution - 1, slice, slice };
  sampler->UpdateExtent(extent);
  ThrowOnError();
  return sampler->GetOutput();
}

/// Red, green and blue over black.
double SumErrors(vtkImageData* image, const Options& options, const Reference& reference)
{
  vtkDataArray* colors = image->GetPointData()->GetArray("Color");
  const vtkIdType first =
    static_cast<vtkIdType>(reference.Slice) * 5 * options.Resolution * options.Resolution;
  double sum = 0.0;
  for (vtkIdType k = 0; k < reference.Texels->GetNumberOfTuples(); ++k)
  {
    const vtkIdType texel = reference.Texels->GetValue(k) - first;
    for (int component = 0; component < 3; ++component)
    {
      const double error =
        colors->GetComponent(texel, component) - reference.Colors->GetComponent(k, component);
      sum += error * error;
    }
  }
  return sum;
}

class Comparison
{
public:
  explicit Comparison(const Options& options)
    : Given(options)
    , World(options.Scene.Read())
    , Slices(ChooseSlices(options))
  {
  }

  /// Traces the references, and computes their noise as a PSNR.
  double TraceReferences()
  {
    vtkNew<vtkCSLFSampler> sampler;
    this->SetUp(sampler);
    sampler->SetIntegrator(vtkCSLFPathTracer::PathTracing);
    sampler->SetSamples(1);
    double noise = 0.0;
    for (std::size_t k = 0; k < this->Slices.size(); ++k)
    {
      vtkNew<vtkTrivialProducer> slice;
      slice->SetOutput(SampleSlice(this->Given, sampler, this->Slices[k]));
      vtkNew<vtkCSLFFieldReference> reference;
      this->Given.Scene.Apply(this->World, reference);
      reference->SetInputConnection(1, slice->GetOutputPort());
      reference->SetTexels(std::max(1, this->Given.Texels / static_cast<int>(this->Slices.size())));
      reference->SetSamples(this->Given.ReferenceSamples);
      reference->SetSeed(this->Given.ReferenceSeed + static_cast<int>(k));
      reference->Update();
      ThrowOnError();
      noise += std::pow(10.0, -0.1 * reference->GetNoiseFloor());
      vtkPointData* texels = reference->GetOutput()->GetPointData();
      this->References.push_back({ this->Slices[k],
        vtkIdTypeArray::SafeDownCast(texels->GetArray("Texel")), texels->GetArray("Reference") });
    }
    return -10.0 * std::log10(noise / static_cast<double>(this->Slices.size()));
  }

  Outcome Measure(const std::string& name, vtkCSLFSampler* sampler) const
  {
    this->SetUp(sampler);
    double errors = 0.0;
    double values = 0.0;
    for (const Reference& reference : this->References)
    {
      errors +=
        SumErrors(SampleSlice(this->Given, sampler, reference.Slice), this->Given, reference);
      values += 3.0 * static_cast<double>(reference.Texels->GetNumberOfTuples());
    }
    const double all = 6.0 * this->Given.Viewpoints * this->Given.Viewpoints;
    Outcome outcome{ name };
    outcome.CacheSeconds = sampler->GetCacheSeconds();
    outcome.ViewSeconds = sampler->GetRenderSeconds();
    outcome.SecondsOfAll = outcome.CacheSeconds +
      outcome.ViewSeconds * all / static_cast<double>(this->References.size());
    outcome.PSNR = ToPSNR(errors / values);
    return outcome;
  }

private:
  void SetUp(vtkCSLFSampler* sampler) const
  {
    this->Given.Scene.Apply(this->World, sampler);
    sampler->SetViewpoints(this->Given.Viewpoints);
    sampler->SetResolution(this->Given.Resolution);
  }

  const Options& Given;
  Scene World;
  std::vector<int> Slices;
  std::vector<Reference> References;
};

/// The seconds that path tracing would take for a quality, from the line through the two nearest
/// measured points, in dB over the logarithm of seconds.
double FindSeconds(const std::vector<Outcome>& paths, double psnr)
{
  std::size_t k = 1;
  while (k + 1 < paths.size() && paths[k].PSNR < psnr)
  {
    ++k;
  }
  const Outcome& less = paths[k - 1];
  const Outcome& more = paths[k];
  const double slope = (std::log(more.SecondsOfAll) - std::log(less.SecondsOfAll)) /
    std::max(more.PSNR - less.PSNR, 1e-3);
  return less.SecondsOfAll * std::exp(slope * (psnr - less.PSNR));
}

Result Report(const Options& options, const Outcome& cached, const std::vector<Outcome>& paths,
  double noiseFloor)
{
  const double seconds = FindSeconds(paths, cached.PSNR);
  Result result;
  result.JSON = { { "viewpoints", options.Viewpoints }, { "resolution", options.Resolution },
    { "views", options.Views }, { "texels", options.Texels },
    { "reference_spp", options.ReferenceSamples }, { "noise_floor", noiseFloor },
    { "path_seconds_at_equal_psnr", seconds }, { "ratio", seconds / cached.SecondsOfAll } };
  Table table;
  table.AddRow({ "integrator", "PSNR (dB)", "cache (s)", "measured views (s)", "whole field (s)" });
  std::vector<Outcome> all = paths;
  all.push_back(cached);
  for (const Outcome& outcome : all)
  {
    table.AddRow({ outcome.Name, Format(outcome.PSNR, 2), Format(outcome.CacheSeconds, 2),
      Format(outcome.ViewSeconds, 2), Format(outcome.SecondsOfAll, 1) });
    result.JSON["outcomes"].push_back({ { "name", outcome.Name }, { "psnr", outcome.PSNR },
      { "cache_seconds", outcome.CacheSeconds }, { "view_seconds", outcome.ViewSeconds },
      { "field_seconds", outcome.SecondsOfAll } });
  }
  const bool isMeasured = paths.front().PSNR <= cached.PSNR && cached.PSNR <= paths.back().PSNR;
  result.Text = table.ToMarkdown() + "\nPath tracing takes " + Format(seconds, 0) + " s for " +
    Format(cached.PSNR, 2) + " dB (" + (isMeasured ? "inter" : "extra") +
    "polated): " + Format(seconds / cached.SecondsOfAll, 1) +
    " times as long.\nNoise floor of the reference: " + Format(noiseFloor, 2) + " dB.\n";
  WarnOfNoise(noiseFloor, cached.PSNR, "the cached field", "--reference-spp");
  return result;
}

Result Run(Options options)
{
  std::sort(options.PathSamples.begin(), options.PathSamples.end());
  Comparison comparison(options);
  const double noiseFloor = comparison.TraceReferences();
  std::vector<Outcome> paths;
  for (const int samples : options.PathSamples)
  {
    vtkNew<vtkCSLFSampler> sampler;
    sampler->SetIntegrator(vtkCSLFPathTracer::PathTracing);
    sampler->SetSamples(samples);
    paths.push_back(
      comparison.Measure("path tracing, " + std::to_string(samples) + " samples", sampler));
  }
  vtkNew<vtkCSLFSampler> sampler;
  options.Integrator.Apply(sampler);
  return Report(options, comparison.Measure("as told", sampler), paths, noiseFloor);
}
}

void AddBenchmarkSampler(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("sampler", "Compare an integrator with path tracing at equal quality");
  command->footer(MakeFooter({ "cslf-lab sampler cornell-box -M 9 -N 128" },
    "Samples some viewpoints of a field with the options under \"Light transport\", "
    "by default with radiance caching, and by path tracing with several numbers of "
    "samples. PSNR is that of random texels, as in cslf-lab evaluate-texels. The time "
    "for the whole field is that of the cache plus the rendering time extrapolated "
    "from the measured viewpoints. The time that path tracing needs for the quality "
    "of the other integrator is interpolated or extrapolated from its measurements."));
  const auto options = std::make_shared<Options>();
  options->Scene.AddTo(*command);
  options->Integrator.AddTo(*command);
  command->option_defaults()->always_capture_default();
  AddOption(*command, cslf::options::Viewpoints, options->Viewpoints);
  AddOption(*command, cslf::options::Resolution, options->Resolution);
  command
    ->add_option("--path-spp", options->PathSamples,
      "numbers of samples per texel for path tracing, at least two, for example 16,64")
    ->delimiter(',')
    ->type_name("LIST")
    ->expected(2, 16)
    ->check(Between(1, 1 << 20));
  command->add_option("--views", options->Views, "viewpoints to measure, spread over the field")
    ->check(Between(1, 1000000));
  command->add_option("--texels", options->Texels, "texels to measure in all views together")
    ->check(Between(1, 100000000));
  command
    ->add_option("--reference-spp", options->ReferenceSamples,
      "samples per texel of the reference; rounded up to a multiple of 32")
    ->check(Between(1, 1 << 24));
  command->add_option("--reference-seed", options->ReferenceSeed,
    "random seed of viewpoints, texels and the reference");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
