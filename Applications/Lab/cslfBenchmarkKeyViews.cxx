// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf-lab key-views: novel views from few coded viewpoints with depth, compared with the
// paper's way, which uses all viewpoints without depth.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfTable.h"
#include "Measurements/cslfStatistics.h"
#include "Pictures/cslfPictures.h"
#include "cslfChart.h"
#include "cslfCodecSweep.h"
#include "cslfLab.h"

#include "vtkCSLFMapper.h"
#include "vtkCSLFResample.h"

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTrivialProducer.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

namespace cslf::tool
{
namespace
{
/// Video needs at least this many texels along each side.
constexpr int MinimumResolution = 16;

struct Options : BenchmarkOptions
{
  std::vector<int> Steps{ 2, 4 };
  std::vector<int> Divisors{ 1 };
  std::vector<double> CRFs{ 16, 22, 28, 34, 40 };
  std::vector<double> DepthCRFs{ 4, 10 };
  double CoverageCRF = options::CoverageCRF.Default;
  std::string Preset = options::Preset.Default;
};

/// One set of viewpoints, coded at several rate factors.
struct Series
{
  std::string Name;
  int Viewpoints = 0; ///< along each side of a face
  int Resolution = 0; ///< along each side of an image
  double Limit = 0.0; ///< the PSNR of novel views before anything is coded, in dB
  std::vector<CodecPoint> Points;
  std::vector<double> DepthCRFs; ///< of each point
};

/// One of the paper's files, compared with key views.
struct Comparison
{
  RatePoint Paper;
  std::optional<double> Ratio; ///< the paper's bytes divided by those with the same PSNR
  bool IsBound = false;        ///< whether this is only a lower bound
  std::optional<double> Gain;  ///< in dB, at the same bytes
};

RatePoint ToRatePoint(const CodecPoint& point)
{
  return { point.Bytes, point.ViewPSNR.front() };
}

/// The field in the paper's form: only colour, over black.
vtkSmartPointer<vtkImageData> MakePlainField(vtkImageData* image, Description field)
{
  vtkDataArray* colors = image->GetPointData()->GetArray(ColorName);
  auto opaque = vtk::TakeSmartPointer(colors->NewInstance());
  opaque->DeepCopy(colors);
  opaque->FillComponent(3, colors->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0);
  field.Channels = { *field.FindChannel(KnownChannel::Color) };
  auto plain = vtkSmartPointer<vtkImageData>::New();
  plain->SetExtent(image->GetExtent());
  plain->GetPointData()->AddArray(opaque);
  field.WriteTo(plain->GetFieldData());
  return plain;
}

vtkSmartPointer<vtkImageData> TakeKeyViews(const FieldFile& file, int step, int divisor)
{
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(file.Reader->GetOutputPort());
  resample->SetViewpointStride(step);
  resample->SetResolutionDivisor(divisor);
  {
    const ProgressBar bar(resample, "Taking key views");
    resample->UpdateWholeExtent();
  }
  ThrowOnError();
  return resample->GetOutput();
}

/// The quality of novel views of an uncoded image.
double MeasureLimit(vtkImageData* image, const LookupName& lookup, const Options& options,
  const std::vector<NovelView>& views)
{
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(image);
  FieldRenderer renderer(producer->GetOutputPort(), options.Novel.Size, options.Novel.Size);
  return Mean(MeasureViews(renderer, lookup.Lookup, views).PSNR);
}

/// Codes an image with these rate factors of depth. Images without depth have only one.
Series Measure(const Options& options, const std::string& name, vtkImageData* image,
  const std::vector<double>& depthCRFs, const LookupName& lookup,
  const std::vector<NovelView>& views)
{
  std::string error;
  const Description field = *Description::ReadFrom(image, error);
  Series series;
  series.Name = name;
  series.Viewpoints = field.Grid.GetViewpoints();
  series.Resolution = field.Grid.GetResolution();
  series.Limit = MeasureLimit(image, lookup, options, views);
  CodecSweep sweep(image, field.Grid, options.Folder, 1);
  sweep.SetViews(views, { lookup });
  for (const double depthCRF : depthCRFs)
  {
    for (const double crf : options.CRFs)
    {
      CodingOptions coding;
      coding.Rate->SetCRF(crf);
      coding.Rate->SetDepthCRF(depthCRF);
      coding.Rate->SetCoverageCRF(options.CoverageCRF);
      coding.Preset = options.Preset;
      series.Points.push_back(sweep.Measure(coding, name));
      series.DepthCRFs.push_back(depthCRF);
    }
  }
  return series;
}

/// The paper's series first.
std::vector<Series> MeasureAll(
  const Options& options, const FieldFile& file, const std::vector<NovelView>& views)
{
  auto* image = vtkImageData::SafeDownCast(file.Reader->GetOutputDataObject(0));
  const LookupName bilinear{ vtkCSLFMapper::BILINEAR,
    vtkCSLFMapper::GetLookupName(vtkCSLFMapper::BILINEAR) };
  const LookupName depth{ vtkCSLFMapper::DEPTH,
    vtkCSLFMapper::GetLookupName(vtkCSLFMapper::DEPTH) };
  std::vector<Series> all;
  // Without depth, its rate factor means nothing.
  all.push_back(Measure(options, "paper: all views, no depth", MakePlainField(image, file.Field),
    { options.DepthCRFs.front() }, bilinear, views));
  for (const int step : options.Steps)
  {
    for (const int divisor : options.Divisors)
    {
      std::string name =
        step == 1 ? "all views with depth" : "key views, step " + std::to_string(step);
      name += divisor == 1 ? "" : ", N / " + std::to_string(divisor);
      const auto keys = step == 1 && divisor == 1 ? vtkSmartPointer<vtkImageData>(image)
                                                  : TakeKeyViews(file, step, divisor);
      all.push_back(Measure(options, name, keys, options.DepthCRFs, depth, views));
    }
  }
  return all;
}

/// The points that no other point beats in both bytes and PSNR, the smallest first.
std::vector<RatePoint> FindFront(std::vector<RatePoint> points)
{
  std::sort(points.begin(), points.end(),
    [](const RatePoint& a, const RatePoint& b)
    { return a.Bytes < b.Bytes || (a.Bytes == b.Bytes && a.PSNR > b.PSNR); });
  std::vector<RatePoint> front;
  for (const RatePoint& point : points)
  {
    if (front.empty() || point.PSNR > front.back().PSNR)
    {
      front.push_back(point);
    }
  }
  return front;
}

/// The bytes at which a front has this PSNR: between two points their logarithm is linear in dB. A
/// lower PSNR than that of the smallest point takes its bytes. Nothing for a higher PSNR than all.
std::optional<double> FindBytes(const std::vector<RatePoint>& front, double psnr)
{
  const auto above = std::find_if(
    front.begin(), front.end(), [psnr](const RatePoint& point) { return point.PSNR >= psnr; });
  if (above == front.end())
  {
    return std::nullopt;
  }
  if (above == front.begin())
  {
    return above->Bytes;
  }
  const RatePoint& below = *(above - 1);
  const double part = (psnr - below.PSNR) / (above->PSNR - below.PSNR);
  return below.Bytes * std::pow(above->Bytes / below.Bytes, part);
}

/// The PSNR that a front has at these bytes, likewise. The best one for more bytes than all;
/// nothing for fewer than those of the smallest point.
std::optional<double> FindPSNR(const std::vector<RatePoint>& front, double bytes)
{
  const auto above = std::find_if(
    front.begin(), front.end(), [bytes](const RatePoint& point) { return point.Bytes > bytes; });
  if (above == front.begin())
  {
    return std::nullopt;
  }
  const RatePoint& below = *(above - 1);
  if (above == front.end())
  {
    return below.PSNR;
  }
  const double part = std::log(bytes / below.Bytes) / std::log(above->Bytes / below.Bytes);
  return below.PSNR + part * (above->PSNR - below.PSNR);
}

/// Of all files of key views, only those count that no other file beats in both size and quality.
std::vector<Comparison> Compare(const std::vector<Series>& all)
{
  std::vector<RatePoint> keys;
  for (auto series = all.begin() + 1; series != all.end(); ++series)
  {
    std::transform(
      series->Points.begin(), series->Points.end(), std::back_inserter(keys), ToRatePoint);
  }
  const std::vector<RatePoint> front = FindFront(keys);
  std::vector<Comparison> comparisons;
  for (const CodecPoint& point : all.front().Points)
  {
    Comparison comparison;
    comparison.Paper = ToRatePoint(point);
    const auto bytes = FindBytes(front, comparison.Paper.PSNR);
    if (bytes)
    {
      comparison.Ratio = comparison.Paper.Bytes / *bytes;
      comparison.IsBound = front.front().PSNR > comparison.Paper.PSNR;
    }
    const auto psnr = FindPSNR(front, comparison.Paper.Bytes);
    if (psnr)
    {
      comparison.Gain = *psnr - comparison.Paper.PSNR;
    }
    comparisons.push_back(comparison);
  }
  return comparisons;
}

nlohmann::json ToJSON(const Series& series)
{
  nlohmann::json json = { { "name", series.Name }, { "viewpoints", series.Viewpoints },
    { "resolution", series.Resolution }, { "uncoded_psnr", series.Limit },
    { "points", nlohmann::json::array() } };
  for (std::size_t k = 0; k < series.Points.size(); ++k)
  {
    const CodecPoint& point = series.Points[k];
    nlohmann::json tracks;
    for (const auto& [name, bytes] : point.Tracks)
    {
      tracks[name] = bytes;
    }
    json["points"].push_back({ { "crf", point.CRF }, { "depth_crf", series.DepthCRFs[k] },
      { "bytes", point.Bytes }, { "tracks", tracks }, { "field_psnr", point.FieldPSNR },
      { "psnr", point.ViewPSNR.front() } });
  }
  return json;
}

nlohmann::json ToJSON(const Comparison& comparison)
{
  return { { "bytes", comparison.Paper.Bytes }, { "psnr", comparison.Paper.PSNR },
    { "ratio", comparison.Ratio ? nlohmann::json(*comparison.Ratio) : nlohmann::json() },
    { "ratio_is_bound", comparison.IsBound },
    { "gain", comparison.Gain ? nlohmann::json(*comparison.Gain) : nlohmann::json() } };
}

std::string MakeSeriesTable(const std::vector<Series>& all)
{
  Table table;
  table.AddRow(
    { "", "M", "N", "CRF", "of depth", "bytes", "novel views (dB)", "colour of the field (dB)" });
  for (const Series& series : all)
  {
    const std::string viewpoints = std::to_string(series.Viewpoints);
    const std::string resolution = std::to_string(series.Resolution);
    table.AddRow(
      { series.Name, viewpoints, resolution, "not coded", "", "", Format(series.Limit, 2), "" });
    for (std::size_t k = 0; k < series.Points.size(); ++k)
    {
      const CodecPoint& point = series.Points[k];
      const bool hasDepth = point.Tracks.size() > 1;
      table.AddRow({ series.Name, viewpoints, resolution, Format(point.CRF, 1),
        hasDepth ? Format(series.DepthCRFs[k], 1) : "", Format(point.Bytes, 0),
        Format(point.ViewPSNR.front(), 2), Format(point.FieldPSNR, 2) });
    }
  }
  return table.ToMarkdown();
}

std::string MakeComparisonTable(const std::vector<Comparison>& comparisons)
{
  Table table;
  table.AddRow({ "paper's method: bytes", "dB", "key views: ratio of bytes at equal dB",
    "gain (dB) at equal bytes" });
  for (const Comparison& comparison : comparisons)
  {
    table.AddRow({ Format(comparison.Paper.Bytes, 0), Format(comparison.Paper.PSNR, 2),
      !comparison.Ratio ? "not reached"
                        : (comparison.IsBound ? "more than " : "") + Format(*comparison.Ratio, 1),
      comparison.Gain ? Format(*comparison.Gain, 2) : "not reached" });
  }
  return table.ToMarkdown();
}

/// The best result of each way.
std::string DescribeLimits(const std::vector<Series>& all)
{
  const auto best = std::max_element(
    all.begin() + 1, all.end(), [](const Series& a, const Series& b) { return a.Limit < b.Limit; });
  return "\nWithout coding, the paper's method has " + Format(all.front().Limit, 2) +
    " dB with M = " + std::to_string(all.front().Viewpoints) + ", and key views at best " +
    Format(best->Limit, 2) + " dB with M = " + std::to_string(best->Viewpoints) + ".\n";
}

/// One curve of key views for each M, of files that no other one beats in both size and quality.
void WritePlot(const Options& options, const std::vector<Series>& all)
{
  std::map<int, std::vector<RatePoint>> keys;
  for (auto series = all.begin() + 1; series != all.end(); ++series)
  {
    std::transform(series->Points.begin(), series->Points.end(),
      std::back_inserter(keys[series->Viewpoints]), ToRatePoint);
  }
  Chart chart{ "Novel views", "bytes of the file", "PSNR (dB)", ChartScale::Bytes, {} };
  const auto add = [&chart](const std::string& name, const std::vector<RatePoint>& points)
  {
    ChartCurve curve{ name, {}, {} };
    for (const RatePoint& point : points)
    {
      curve.X.push_back(point.Bytes);
      curve.Y.push_back(point.PSNR);
    }
    chart.Curves.push_back(curve);
  };
  std::vector<RatePoint> paper;
  const Series& first = all.front();
  std::transform(first.Points.begin(), first.Points.end(), std::back_inserter(paper), ToRatePoint);
  add(first.Name, paper);
  for (const auto& [viewpoints, points] : keys)
  {
    add("with depth, M = " + std::to_string(viewpoints), FindFront(points));
  }
  WriteChart(options.Folder + "/key-views.png", chart);
}

/// Throws a Failure if the field cannot be coded as requested.
void CheckField(const Options& options, const Description& field)
{
  if (!field.FindChannel(KnownChannel::Depth))
  {
    throw Failure("Key views need a depth channel, which the field does not have.");
  }
  for (const int step : options.Steps)
  {
    if ((field.Grid.GetViewpoints() - 1) % step != 0)
    {
      throw Failure("A step of " + std::to_string(step) +
        " does not divide M - 1 = " + std::to_string(field.Grid.GetViewpoints() - 1) + ".");
    }
  }
  const int resolution = field.Grid.GetResolution();
  for (const int divisor : options.Divisors)
  {
    if (resolution % divisor != 0 || resolution / divisor < MinimumResolution)
    {
      throw Failure("A divisor of " + std::to_string(divisor) +
        " does not divide N = " + std::to_string(resolution) + " into 16 or more.");
    }
  }
}

Result Run(Options options)
{
  RequireDisplay();
  if (options.Scene.IsEmpty())
  {
    throw Failure("Novel views need the scene.");
  }
  CheckField(options, OpenField(options.Field).Field);
  const FieldFile file = options.ReadField();
  const BenchmarkViews views = options.Begin(file.Field);
  std::sort(options.CRFs.begin(), options.CRFs.end());
  const std::vector<Series> all = MeasureAll(options, file, views.Views);
  const std::vector<Comparison> comparisons = Compare(all);
  WritePlot(options, all);
  double best = 0.0;
  for (const Series& series : all)
  {
    best = std::max(best, series.Limit);
  }
  WarnOfRemovedNoise(views.NoiseFloor, best, "the best novel views", "--spp");

  Result result;
  result.JSON = { { "field", options.Field }, { "preset", options.Preset },
    { "coverage_crf", options.CoverageCRF }, { "views", options.DescribeViews(views.NoiseFloor) },
    { "series", nlohmann::json::array() }, { "comparisons", nlohmann::json::array() } };
  for (const Series& series : all)
  {
    result.JSON["series"].push_back(ToJSON(series));
  }
  for (const Comparison& comparison : comparisons)
  {
    result.JSON["comparisons"].push_back(ToJSON(comparison));
  }
  result.Text = MakeSeriesTable(all) + "\n" + MakeComparisonTable(comparisons) +
    DescribeLimits(all) + BenchmarkOptions::DescribeNoise(views.NoiseFloor);
  options.Write(result, "key-views");
  return result;
}
}

void AddBenchmarkKeyViews(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "key-views", "Compare key views with depth and the paper's method: novel views against size");
  command->footer(MakeFooter({ "cslf-lab key-views box.vti cornell-box -o bench" },
    "Writes key-views.md, key-views.json and a plot into the folder. The paper's method codes all "
    "viewpoints as colour over black, without coverage and depth, and uses the bilinear lookup. "
    "The other method codes every STEP-th viewpoint with coverage and depth, optionally with fewer "
    "texels, and uses the depth lookup, which draws still views with four rays per pixel. Both use "
    "the same encoder, preset and rate factors of colour. PSNR is that of novel views, as in cslf "
    "evaluate. Each of the paper's files is compared, at equal PSNR and at equal bytes, with the "
    "best key-view files: those for which no other is both smaller and better. Between these, the "
    "logarithm of bytes is interpolated linearly in dB."));
  const auto options = std::make_shared<Options>();
  options->AddTo(*command);
  command->option_defaults()->always_capture_default();
  command
    ->add_option(
      "--steps", options->Steps, "steps of key views, for example 2,4; each must divide M - 1")
    ->delimiter(',')
    ->type_name("LIST")
    ->check(Between(1, 4096));
  command
    ->add_option("--divisors", options->Divisors,
      "divisors of the resolution of key views, for example 1,2; each must divide N into at least "
      "16")
    ->delimiter(',')
    ->type_name("LIST")
    ->check(Between(1, 16384));
  command->add_option("--crfs", options->CRFs, "rate factors of colour, for example 20,28,36")
    ->delimiter(',')
    ->type_name("LIST")
    ->check(Between(0.0, 51.0));
  command->add_option("--depth-crfs", options->DepthCRFs, "rate factors of the key views' depth")
    ->delimiter(',')
    ->type_name("LIST")
    ->check(Between(0.0, 51.0));
  command
    ->add_option("--coverage-crf", options->CoverageCRF, "rate factor of the key views' coverage")
    ->check(Between(0.0, 51.0));
  command->add_option("--preset", options->Preset, "x265 preset for both methods");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
