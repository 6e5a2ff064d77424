// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf scenes: lists the scenes that need no files.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfTable.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfCommands.h"

#include "vtkCSLFInstances.h"
#include "vtkCSLFSceneSource.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>

namespace cslf::tool
{
namespace
{
/// The number of triangles of cells with several corners, such as polygons or strips.
vtkIdType CountTriangles(vtkCellArray* cells)
{
  return cells->GetNumberOfConnectivityIds() - 2 * cells->GetNumberOfCells();
}

/// Adds the sizes of a scene.
void Measure(const std::string& name, nlohmann::json& json)
{
  Scene scene;
  scene.Parts.push_back(ReadScenePart(name));
  vtkIdType triangles = 0;
  vtkIdType instances = 0;
  vtkIdType spheres = 0;
  vtkIdType tubes = 0;
  scene.ForEachPolyData(
    [&](vtkPolyData* data)
    {
      triangles += CountTriangles(data->GetPolys()) + CountTriangles(data->GetStrips());
      spheres += data->GetVerts()->GetNumberOfConnectivityIds();
      tubes +=
        data->GetLines()->GetNumberOfConnectivityIds() - data->GetLines()->GetNumberOfCells();
      vtkDataArray* matrices = data->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
      instances += matrices ? matrices->GetNumberOfTuples() : 0;
    });
  double bounds[6];
  scene.GetBounds(bounds);
  json["triangles"] = triangles;
  json["instances"] = instances;
  json["spheres"] = spheres;
  json["tubes"] = tubes;
  json["bounds"] = bounds;
}

Result Run(bool measure)
{
  Result result;
  result.JSON["scenes"] = nlohmann::json::array();
  Table table;
  for (int i = 0; i < vtkCSLFSceneSource::GetNumberOfScenes(); ++i)
  {
    const std::string name = vtkCSLFSceneSource::GetSceneName(i);
    const std::string description = vtkCSLFSceneSource::GetSceneDescription(i);
    nlohmann::json scene = { { "name", name }, { "description", description } };
    if (measure)
    {
      Measure(name, scene);
    }
    result.JSON["scenes"].push_back(scene);
    table.AddRow({ name, description });
  }
  ThrowOnError();
  result.Text = table.ToText();
  return result;
}
}

void AddScenes(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "scenes", "List the scenes that sample, trace and other commands know by name");
  command->footer(MakeFooter({ "cslf scenes" },
    "JSON keys: scenes, each with name, description, triangles (of each surface once, however many "
    "instances it has), instances, spheres, tubes (segments of lines) and bounds. To count them, "
    "--json makes all scenes, which takes some seconds."));
  command->callback(
    [command, &chosen]
    {
      const bool measure = command->count("--json") > 0;
      chosen = [measure] { return Run(measure); };
    });
}
}
