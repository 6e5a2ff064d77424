// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf-lab codec: quality against size, and speed, of a field coded in many ways.
#include "Console/cslfHelp.h"
#include "Console/cslfTable.h"
#include "Options/cslfTableOptions.h"
#include "Pictures/cslfPictures.h"
#include "cslfChart.h"
#include "cslfCodecSweep.h"
#include "cslfLab.h"

#include <vtkAlgorithm.h>
#include <vtkImageData.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>

namespace cslf::tool
{
namespace
{
struct Options : BenchmarkOptions
{
  std::vector<double> CRFs{ 16, 20, 24, 28, 32, 36 };
  std::vector<std::string> Codecs{ "hevc" };
  std::vector<std::string> Presets{ "slow" };
  std::vector<std::string> PixelFormats{ "auto" };
  int GroupLength = options::GroupLength.Default;
  int Repeats = 1;
};

/// The same coder at several rate factors.
struct Series
{
  std::string Name;
  std::vector<CodecPoint> Points;
};

/// A quality and a size that are plotted against each other.
struct Measure
{
  std::string Key;   ///< of files and JSON
  std::string Title; ///< of plots and tables
  std::function<double(const CodecPoint&)> PSNR;
  std::function<double(const CodecPoint&)> Bytes;
};

double CountFileBytes(const CodecPoint& point)
{
  return point.Bytes;
}

double CountColorBytes(const CodecPoint& point)
{
  return point.Tracks.front().second;
}

std::vector<Measure> MakeMeasures(const std::vector<LookupName>& lookups)
{
  const auto field = [](const CodecPoint& point) { return point.FieldPSNR; };
  std::vector<Measure> measures = { { "field", "Colour of the field, bytes of all tracks", field,
                                      CountFileBytes },
    { "field-color", "Colour of the field, bytes of the colour track", field, CountColorBytes } };
  for (std::size_t k = 0; k < lookups.size(); ++k)
  {
    measures.push_back({ std::string("views-") + lookups[k].Name,
      std::string("Novel views, ") + lookups[k].Name + " lookup, bytes of all tracks",
      [k](const CodecPoint& point) { return point.ViewPSNR[k]; }, CountFileBytes });
  }
  return measures;
}

/// Every coder that the options select, named by what distinguishes it.
std::vector<std::pair<std::string, CodingOptions>> ListCoders(const Options& options)
{
  std::vector<std::pair<std::string, CodingOptions>> coders;
  for (const std::string& codec : options.Codecs)
  {
    for (const std::string& preset : options.Presets)
    {
      for (const std::string& format : options.PixelFormats)
      {
        CodingOptions coding;
        coding.Codec = codec;
        coding.Preset = preset;
        coding.PixelFormat = format;
        coding.GroupLength = options.GroupLength;
        std::string name = options.Codecs.size() > 1 ? codec : "";
        const auto add = [&name](bool varies, const std::string& part)
        { name += varies ? (name.empty() ? "" : " ") + part : ""; };
        add(options.Presets.size() > 1, preset);
        add(options.PixelFormats.size() > 1, format);
        add(name.empty(), codec);
        coders.emplace_back(name, coding);
      }
    }
  }
  return coders;
}

std::vector<RatePoint> ToCurve(const Series& series, const Measure& measure)
{
  std::vector<RatePoint> curve;
  for (const CodecPoint& point : series.Points)
  {
    curve.push_back({ measure.Bytes(point), measure.PSNR(point) });
  }
  return curve;
}

void WriteCharts(
  const Options& options, const std::vector<Series>& all, const std::vector<Measure>& measures)
{
  for (const Measure& measure : measures)
  {
    Chart chart{ measure.Title, "bytes", "PSNR (dB)", ChartScale::Bytes, {} };
    for (const Series& series : all)
    {
      ChartCurve curve;
      curve.Name = series.Name;
      for (const RatePoint& point : ToCurve(series, measure))
      {
        curve.X.push_back(point.Bytes);
        curve.Y.push_back(point.PSNR);
      }
      chart.Curves.push_back(curve);
    }
    WriteChart(options.Folder + "/" + measure.Key + ".png", chart);
  }
}

nlohmann::json ToJSON(const CodecPoint& point, const std::vector<LookupName>& lookups)
{
  nlohmann::json json = { { "crf", point.CRF }, { "bytes", point.Bytes }, { "ratio", point.Ratio },
    { "psnr", point.FieldPSNR }, { "channels", point.Channels },
    { "encode_megapixels_per_second", point.EncodeRate },
    { "decode_megapixels_per_second", point.DecodeRate } };
  for (const auto& [name, bytes] : point.Tracks)
  {
    json["tracks"][name] = bytes;
  }
  for (std::size_t k = 0; k < point.ViewPSNR.size(); ++k)
  {
    json["views"][lookups[k].Name] = point.ViewPSNR[k];
  }
  return json;
}

std::string MakeTable(const std::vector<Series>& all, const std::vector<LookupName>& lookups)
{
  std::vector<std::string> head = { "coder", "CRF", "bytes", "ratio" };
  for (const auto& track : all.front().Points.front().Tracks)
  {
    head.push_back(track.first);
  }
  head.insert(head.end(), { "PSNR (dB)", "encode (Mpixel/s)", "decode (Mpixel/s)" });
  for (const LookupName& lookup : lookups)
  {
    head.push_back(std::string(lookup.Name) + " (dB)");
  }
  Table table;
  table.AddRow(head);
  for (const Series& series : all)
  {
    for (const CodecPoint& point : series.Points)
    {
      std::vector<std::string> row = { series.Name, Format(point.CRF, 1), Format(point.Bytes, 0),
        Format(point.Ratio, 1) };
      for (const auto& track : point.Tracks)
      {
        row.push_back(Format(track.second, 0));
      }
      row.insert(row.end(),
        { Format(point.FieldPSNR, 2), Format(point.EncodeRate, 2), Format(point.DecodeRate, 1) });
      for (const double psnr : point.ViewPSNR)
      {
        row.push_back(Format(psnr, 2));
      }
      table.AddRow(row);
    }
  }
  return table.ToMarkdown();
}

/// The logarithm of the bytes as a function of PSNR.
class RateCurve
{
public:
  explicit RateCurve(std::vector<RatePoint> points)
  {
    std::sort(points.begin(), points.end(),
      [](const RatePoint& a, const RatePoint& b) { return a.PSNR < b.PSNR; });
    for (const RatePoint& point : points)
    {
      if (point.Bytes > 0.0 && (this->X.empty() || point.PSNR > this->X.back()))
      {
        this->X.push_back(point.PSNR);
        this->Y.push_back(std::log(point.Bytes));
      }
    }
    if (this->IsValid())
    {
      this->FindSlopes();
    }
  }

  bool IsValid() const { return this->X.size() >= 2; }
  double GetMinimum() const { return this->X.front(); }
  double GetMaximum() const { return this->X.back(); }
  const std::vector<double>& GetKnots() const { return this->X; }

  double Evaluate(double x) const
  {
    const auto above = std::upper_bound(this->X.begin() + 1, this->X.end() - 1, x);
    const auto k = static_cast<std::size_t>(above - this->X.begin()) - 1;
    const double width = this->X[k + 1] - this->X[k];
    const double t = (x - this->X[k]) / width;
    const double u = 1.0 - t;
    return u * u * (1.0 + 2.0 * t) * this->Y[k] + t * t * (3.0 - 2.0 * t) * this->Y[k + 1] +
      width * t * u * (u * this->Slopes[k] - t * this->Slopes[k + 1]);
  }

private:
  /// Harmonic means of the neighbouring chords' slopes, flat where these differ in sign.
  void FindSlopes()
  {
    const std::size_t last = this->X.size() - 1;
    const auto chord = [this](std::size_t k)
    { return (this->Y[k + 1] - this->Y[k]) / (this->X[k + 1] - this->X[k]); };
    this->Slopes.assign(last + 1, 0.0);
    this->Slopes[0] = chord(0);
    this->Slopes[last] = chord(last - 1);
    for (std::size_t k = 1; k < last; ++k)
    {
      const double before = this->X[k] - this->X[k - 1];
      const double after = this->X[k + 1] - this->X[k];
      if (chord(k - 1) * chord(k) > 0.0)
      {
        const double first = (before + 2.0 * after) / chord(k - 1);
        const double second = (2.0 * before + after) / chord(k);
        this->Slopes[k] = 3.0 * (before + after) / (first + second);
      }
    }
  }

  std::vector<double> X;
  std::vector<double> Y;
  std::vector<double> Slopes;
};

/// The Bjontegaard delta rate (ITU-T VCEG-M33): the relative difference of the tested coder's bytes
/// from the reference's at equal PSNR, averaged over the PSNR that both reach; -0.1 is 10 % fewer.
/// The logarithm of the bytes is interpolated over PSNR by piecewise cubics that are monotone where
/// the points are (Fritsch and Carlson 1980). Nothing if a curve has fewer than two points or the
/// curves share no range.
std::optional<double> ComputeDeltaRate(
  const std::vector<RatePoint>& reference, const std::vector<RatePoint>& tested)
{
  const RateCurve first(reference);
  const RateCurve second(tested);
  if (!first.IsValid() || !second.IsValid())
  {
    return std::nullopt;
  }
  const double low = std::max(first.GetMinimum(), second.GetMinimum());
  const double high = std::min(first.GetMaximum(), second.GetMaximum());
  if (!(high > low))
  {
    return std::nullopt;
  }
  std::vector<double> knots = { low, high };
  for (const RateCurve* curve : { &first, &second })
  {
    std::copy_if(curve->GetKnots().begin(), curve->GetKnots().end(), std::back_inserter(knots),
      [=](double knot) { return knot > low && knot < high; });
  }
  std::sort(knots.begin(), knots.end());
  // Simpson's rule is exact for cubics, and the curves are cubics between the knots of both.
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k)
  {
    const auto difference = [&](double x) { return second.Evaluate(x) - first.Evaluate(x); };
    const double middle = 0.5 * (knots[k] + knots[k + 1]);
    sum += (knots[k + 1] - knots[k]) / 6.0 *
      (difference(knots[k]) + 4.0 * difference(middle) + difference(knots[k + 1]));
  }
  return std::exp(sum / (high - low)) - 1.0;
}

/// The difference of the other coders from the first, in bytes at equal quality.
std::string MakeDeltas(
  const std::vector<Series>& all, const std::vector<Measure>& measures, nlohmann::json& json)
{
  Table table;
  std::vector<std::string> head = { "bytes against " + all.front().Name };
  for (const Measure& measure : measures)
  {
    head.push_back(measure.Key);
  }
  table.AddRow(head);
  for (std::size_t k = 1; k < all.size(); ++k)
  {
    std::vector<std::string> row = { all[k].Name };
    for (const Measure& measure : measures)
    {
      const auto delta = ComputeDeltaRate(ToCurve(all.front(), measure), ToCurve(all[k], measure));
      json["delta_rates"][all[k].Name][measure.Key] =
        delta ? nlohmann::json(*delta) : nlohmann::json();
      row.push_back(delta ? Format(100.0 * *delta, 1) + " %" : "no common PSNR");
    }
    table.AddRow(row);
  }
  return all.size() > 1 ? "\n" + table.ToMarkdown() : "";
}

Result Report(const Options& options, const std::vector<Series>& all,
  const std::vector<LookupName>& lookups, double noiseFloor)
{
  const std::vector<Measure> measures = MakeMeasures(lookups);
  WriteCharts(options, all, measures);
  Result result;
  result.JSON = { { "field", options.Field }, { "repeats", options.Repeats },
    { "series", nlohmann::json::array() } };
  for (const Series& series : all)
  {
    nlohmann::json points = nlohmann::json::array();
    for (const CodecPoint& point : series.Points)
    {
      points.push_back(ToJSON(point, lookups));
    }
    result.JSON["series"].push_back({ { "name", series.Name }, { "points", points } });
  }
  result.Text = MakeTable(all, lookups) + MakeDeltas(all, measures, result.JSON);
  if (!lookups.empty())
  {
    result.JSON["views"] = options.DescribeViews(noiseFloor);
    result.Text += BenchmarkOptions::DescribeNoise(noiseFloor);
  }
  options.Write(result, "codec");
  return result;
}

Result Run(Options options)
{
  RequireDisplay();
  const FieldFile file = options.ReadField();
  auto* field = vtkImageData::SafeDownCast(file.Reader->GetOutputDataObject(0));
  CodecSweep sweep(field, file.Field.Grid, options.Folder, options.Repeats);
  const BenchmarkViews views = options.Begin(file.Field);
  if (!views.Views.empty())
  {
    // The geometry is not coded.
    FieldFile coded = file;
    coded.GeometryReader = nullptr;
    sweep.SetViews(views.Views, GetLookups(coded));
  }
  std::vector<Series> all;
  std::sort(options.CRFs.begin(), options.CRFs.end());
  for (const auto& [name, coder] : ListCoders(options))
  {
    all.push_back({ name, {} });
    for (const double crf : options.CRFs)
    {
      coder.Rate->SetCRF(crf);
      all.back().Points.push_back(sweep.Measure(coder, name));
    }
  }
  return Report(options, all, sweep.GetLookups(), views.NoiseFloor);
}
}

void AddBenchmarkCodec(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "codec", "Measure quality against size, and speed, of several codec settings");
  command->footer(MakeFooter({ "cslf-lab codec box.vti -o bench --crfs 18,22,26,30" },
    "Codes the field with all combinations of the lists and writes codec.md, codec.json and plots "
    "into the folder. PSNR is measured for red, green and blue over all texels, against the given "
    "field; with --scene also for novel views with every lookup, as in cslf evaluate. The ratio "
    "compares 24 bits per texel with all tracks. Speeds are the medians of --repeats runs, in "
    "millions of texels per second, for all tracks together, including file access. The bytes of "
    "each coder at equal PSNR are compared with those of the first (Bjontegaard delta rate). Depth "
    "and coverage use the encoder's default rate factors."));
  const auto options = std::make_shared<Options>();
  options->AddTo(*command);
  command->option_defaults()->always_capture_default();
  command->add_option("--crfs", options->CRFs, "rate factors of colour, for example 20,24,28")
    ->delimiter(',')
    ->type_name("LIST")
    ->check(Between(0.0, 51.0));
  command->add_option("--codecs", options->Codecs, "codecs, for example hevc,av1")
    ->delimiter(',')
    ->type_name("LIST");
  command->add_option("--presets", options->Presets, "presets, for example fast,medium")
    ->delimiter(',')
    ->type_name("LIST");
  command
    ->add_option("--pixel-formats", options->PixelFormats,
      "pixel formats of colour, for example yuv444p,yuv420p")
    ->delimiter(',')
    ->type_name("LIST");
  AddOption(*command, cslf::options::GroupLength, options->GroupLength);
  command->add_option("--repeats", options->Repeats, "repetitions for measuring the speed")
    ->check(Between(1, 1000));
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
