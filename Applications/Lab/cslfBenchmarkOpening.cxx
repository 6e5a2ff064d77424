// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf-lab opening: the time from opening a file to its first picture.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfTable.h"
#include "Measurements/cslfStatistics.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfPictures.h"
#include "cslfLab.h"

#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>

namespace cslf::tool
{
namespace
{
struct Options
{
  std::string Field;
  std::string Folder;
  std::string Lookup;
  int Size = 512;
  int Repeats = 10;
};

/// Elapsed time, and the processor time of all threads together.
struct Duration
{
  double Seconds = 0.0;
  double CPUSeconds = 0.0;
};

class Stopwatch
{
public:
  Duration Read() const
  {
    return { std::chrono::duration<double>(Clock::now() - this->Start).count(),
      static_cast<double>(std::clock() - this->CPUStart) / CLOCKS_PER_SEC };
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
  std::clock_t CPUStart = std::clock();
};

/// The phases between a program's start and its first picture, in order.
enum Phase
{
  Window,  ///< making a window and clearing it, before anything is opened
  Opening, ///< reading the file's header
  Drawing, ///< decoding the coarsest viewpoints and drawing
  PhaseCount
};

constexpr const char* PhaseNames[] = { "window", "opening", "drawing" };

/// The time of each phase when the file was opened once.
using Phases = std::vector<Duration>;

struct Findings
{
  std::string Device;
  std::string Lookup;
  std::vector<Phases> Repeats;
  vtkSmartPointer<vtkImageData> Picture; ///< the last phase before the first picture
};

void OpenOnce(const Options& options, Findings& findings)
{
  Phases phases(PhaseCount);
  vtkNew<vtkCamera> nowhere;
  const Stopwatch making;
  OffscreenWindow window(options.Size, options.Size);
  window.Draw(nowhere);
  phases[Window] = making.Read();

  const Stopwatch opening;
  const FieldFile file = OpenField(options.Field);
  phases[Opening] = opening.Read();

  const Stopwatch drawing;
  findings.Lookup = ChooseLookup(options.Lookup, file);
  ReadToDraw(file);
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(file.Reader->GetOutputPort());
  if (file.GeometryReader)
  {
    mapper->SetInputConnection(1, file.GetGeometry());
  }
  mapper->SetLookup(FindLookup(findings.Lookup));
  mapper->StreamingOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  window.AddActor(actor);
  window.Draw(CameraOptions().MakeCamera(file.Field.Box, MeasuringDistance));
  phases[Drawing] = drawing.Read();
  findings.Repeats.push_back(phases);
  findings.Device = window.GetDeviceName();
  findings.Picture = window.Grab();
}

/// The sum of the phases from `first` on.
Duration Sum(const Phases& phases, int first)
{
  Duration sum;
  for (int phase = first; phase < PhaseCount; ++phase)
  {
    sum.Seconds += phases[phase].Seconds;
    sum.CPUSeconds += phases[phase].CPUSeconds;
  }
  return sum;
}

nlohmann::json ToJSON(const Phases& phases)
{
  nlohmann::json json;
  for (int phase = 0; phase < PhaseCount; ++phase)
  {
    json[PhaseNames[phase]] = { { "seconds", phases[phase].Seconds },
      { "cpu_seconds", phases[phase].CPUSeconds } };
  }
  return json;
}

/// A row of milliseconds.
void AddRow(Table& table, const std::string& name, const std::vector<Duration>& durations)
{
  std::vector<double> seconds;
  std::vector<double> cpuSeconds;
  for (const Duration& duration : durations)
  {
    seconds.push_back(1000.0 * duration.Seconds);
    cpuSeconds.push_back(1000.0 * duration.CPUSeconds);
  }
  std::vector<std::string> row = { name };
  for (const auto& values : { seconds, cpuSeconds })
  {
    row.push_back(Format(values.front(), 1));
    row.push_back(
      values.size() > 1 ? Format(Minimum({ values.begin() + 1, values.end() }), 1) : "");
    row.push_back(values.size() > 1 ? Format(Median({ values.begin() + 1, values.end() }), 1) : "");
  }
  table.AddRow(row);
}

std::string MakeTable(const Findings& findings)
{
  Table table;
  table.AddRow({ "", "first time (ms)", "then: minimum", "median", "CPU, first time (ms)",
    "then: minimum", "median" });
  const auto collect = [&findings](const auto& get)
  {
    std::vector<Duration> durations;
    for (const Phases& phases : findings.Repeats)
    {
      durations.push_back(get(phases));
    }
    return durations;
  };
  for (int phase = 0; phase < PhaseCount; ++phase)
  {
    AddRow(table, PhaseNames[phase], collect([phase](const Phases& p) { return p[phase]; }));
  }
  AddRow(table, "opening and drawing", collect([](const Phases& p) { return Sum(p, Opening); }));
  AddRow(table, "all", collect([](const Phases& p) { return Sum(p, Window); }));
  return table.ToMarkdown();
}

Result Run(const Options& options)
{
  RequireDisplay();
  OpenField(FieldInput{ options.Field });
  std::error_code failure;
  std::filesystem::create_directories(options.Folder, failure);
  RequireWritable(options.Folder + "/benchmark");
  Findings findings;
  for (int repeat = 0; repeat < options.Repeats; ++repeat)
  {
    OpenOnce(options, findings);
  }
  WritePicture(options.Folder + "/opening.png", findings.Picture);
  Result result;
  result.JSON = { { "field", options.Field }, { "bytes", CountBytes(options.Field) },
    { "size", options.Size }, { "lookup", findings.Lookup }, { "device", findings.Device },
    { "repeats", nlohmann::json::array() } };
  for (const Phases& phases : findings.Repeats)
  {
    result.JSON["repeats"].push_back(ToJSON(phases));
  }
  const std::string size = std::to_string(options.Size);
  result.Text = MakeTable(findings) + "\n" + options.Field + ", " +
    std::to_string(CountBytes(options.Field)) + " bytes: " + findings.Lookup + " lookup, " + size +
    " x " + size + ", drawn with " + findings.Device + ".\n";
  WriteResult(result, options.Folder, "opening");
  return result;
}
}

void AddBenchmarkOpening(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "opening", "Measure the time from opening a light field to the first picture");
  command->footer(MakeFooter({ "cslf-lab opening box.mp4 -o bench --repeats 10" },
    "Writes opening.md, opening.json and the first picture into the folder. Each repetition "
    "creates and clears a new window, opens the file and draws a picture from its coarsest "
    "viewpoints, as vtkCSLFMapper does with Streaming. Times are wall-clock milliseconds and CPU "
    "milliseconds; the latter include all threads, but not other programs. The first repetition is "
    "listed separately, because drivers and the system cache data for the others. The driver's "
    "shader cache on disk is used; to avoid that with Mesa, set MESA_SHADER_CACHE_DIR to an empty "
    "folder."));
  const auto options = std::make_shared<Options>();
  command->add_option("field", options->Field, std::string("the light field: ") + FieldFormats)
    ->type_name(FilePlaceholder)
    ->required();
  command->add_option("-o,--output", options->Folder, "folder for the results")
    ->type_name(FolderPlaceholder)
    ->required();
  command->option_defaults()->always_capture_default();
  AddLookup(*command, options->Lookup, "the lookup");
  command->add_option("--size", options->Size, "width and height of a picture, in pixels")
    ->check(Between(1, 8192));
  command->add_option("--repeats", options->Repeats, "repetitions")->check(Between(1, 10000));
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
