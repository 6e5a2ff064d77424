// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf info: describes the contents of a light field's file.
#include "Console/cslfHelp.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfTable.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfFieldScalars.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfCommands.h"
#include "cslfJoin.h"

#include <vtkAlgorithm.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>

#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

namespace cslf::tool
{
namespace
{
struct Options
{
  std::string FileName;
  std::optional<double> Time;
};

std::string JoinNumbers(const nlohmann::json& numbers)
{
  return JoinAs(
    numbers, [](const nlohmann::json& number) { return number.dump(); }, " ");
}

nlohmann::json ListParts(const FieldFile& file)
{
  nlohmann::json parts = nlohmann::json::array();
  for (const FieldPart& part : GetParts(file))
  {
    parts.push_back({ { "type", part.Type }, { "name", part.Name },
      { "bytes", part.Bytes->GetNumberOfValues() } });
  }
  return parts;
}

/// The geometry in a video or beside image data. Null if there is none.
nlohmann::json SummarizeGeometry(const FieldFile& file)
{
  vtkPolyData* geometry = file.ReadGeometry();
  if (!geometry || geometry->GetNumberOfPolys() == 0)
  {
    return nullptr;
  }
  nlohmann::json json = { { "triangles", geometry->GetNumberOfPolys() } };
  if (const auto error = GetGeometryError(geometry))
  {
    json["error"] = *error;
  }
  if (const auto loss = GetGeometryLoss(geometry))
  {
    json["loss"] = *loss;
  }
  json["recolorable"] = MeasureRecolorable(geometry);
  json["surfaces"] = IsOpaqueGeometry(geometry) ? "opaque" : "all";
  return json;
}

nlohmann::json SummarizeAll(const std::vector<FieldScalars>& scalars)
{
  nlohmann::json json = nlohmann::json::array();
  for (const FieldScalars& each : scalars)
  {
    json.push_back(Summarize(each));
  }
  return json;
}

std::string DescribeGeometry(const nlohmann::json& json)
{
  if (json.is_null())
  {
    return "none";
  }
  std::ostringstream text;
  text << json["triangles"].dump() << " triangles"
       << (json["surfaces"] == "opaque" ? " of the opaque surfaces" : "") << std::setprecision(3);
  if (json.contains("error"))
  {
    text << ", error " << json["error"].get<double>();
  }
  if (json.contains("loss"))
  {
    text << ", loss " << 100.0 * json["loss"].get<double>() << " %";
  }
  if (json["recolorable"] > 0.0)
  {
    text << ", " << 100.0 * json["recolorable"].get<double>() << " % in other colours on request";
  }
  return text.str();
}

/// The times of a series in words.
std::string DescribeSteps(const nlohmann::json& steps)
{
  return JoinAs(
    steps, [](const nlohmann::json& step) { return step["time"].dump(); }, " ");
}

Result Run(const Options& options)
{
  const FieldFile file = OpenField(options.FileName, options.Time);
  Result result;
  result.JSON = Summarize(file.Field);
  result.JSON["codec"] = GetCodecName(file);
  result.JSON["bytes"] = CountBytes(file);
  result.JSON["steps"] = ListSteps(file);
  result.JSON["missing"] = CountMissing(file);
  result.JSON["unfinished"] = IsUnfinished(file);
  result.JSON["geometry"] = SummarizeGeometry(file);
  const std::vector<FieldScalars> scalars = ListScalars(file);
  result.JSON["scalars"] = SummarizeAll(scalars);
  result.JSON["parts"] = ListParts(file);

  const nlohmann::json& json = result.JSON;
  Table table;
  if (!json["steps"].empty())
  {
    table.AddRow({ "times", DescribeSteps(json["steps"]) });
  }
  table.AddRow({ "viewpoints",
    json["views"].dump() + " x " + json["views"].dump() + " on 6 faces, " +
      json["slices"].dump() });
  table.AddRow({ "resolution",
    json["resolution"].dump() + " x " + json["resolution"].dump() + " texels on 5 faces" });
  table.AddRow({ "center", JoinNumbers(json["center"]) });
  table.AddRow({ "edge", JoinNumbers(json["edge"]) });
  for (const auto& channel : json["channels"])
  {
    table.AddRow({ "channel",
      channel["name"].get<std::string>() + ", " + channel["components"].dump() + " x " +
        channel["type"].get<std::string>() + ", " + channel["encoding"].get<std::string>() });
  }
  for (const auto& [name, value] : json["sampling"].items())
  {
    table.AddRow({ name, value.dump() });
  }
  if (file.Field.Measured)
  {
    table.AddRow({ "certificate", file.Field.Measured->Describe() });
  }
  table.AddRow({ "codec", json["codec"].get<std::string>() });
  table.AddRow({ "bytes", json["bytes"].dump() });
  table.AddRow({ "missing",
    json["missing"].dump() + " viewpoints" +
      (json["unfinished"].get<bool>() ? ", the field is unfinished" : "") });
  table.AddRow({ "geometry", DescribeGeometry(json["geometry"]) });
  for (const FieldScalars& each : scalars)
  {
    table.AddRow({ "scalars", Describe(each) });
  }
  for (const auto& part : json["parts"])
  {
    table.AddRow({ "part",
      part["type"].get<std::string>() + " \"" + part["name"].get<std::string>() + "\", " +
        part["bytes"].dump() + " bytes" });
  }
  result.Text = table.ToText();
  return result;
}
}

void AddInfo(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand("info", "List the contents of a light field's file");
  command->footer(MakeFooter({ "cslf info box.mp4" },
    "JSON keys: views (M, along each side of a face), slices (6 M^2), resolution (N), center, edge "
    "(one number, or three if they differ), channels, sampling, certificate (see cslf verify; only "
    "of "
    "files that have one), codec, bytes, steps (of a series: time, file, bytes), missing "
    "(viewpoints "
    "that cannot be read), unfinished (whether it is a preview of a field that is being written), "
    "geometry (triangles, error: their distance from the surfaces, loss: the share of the surfaces "
    "that they lack, recolorable: the share of their area that can be shown in other colours; null "
    "if there is none), scalars (what a lookup table coloured: array, "
    "component if it has several, points, range, map_range, logarithmic), parts (additional parts "
    "of a video: type, name, bytes)."));
  const auto options = std::make_shared<Options>();
  command->add_option("field", options->FileName, std::string("the light field: ") + ReadFormats)
    ->type_name(FilePlaceholder)
    ->required();
  command->add_option(TimeFlag, options->Time, TimeHelp)->check(Finite())->type_name("TIME");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
