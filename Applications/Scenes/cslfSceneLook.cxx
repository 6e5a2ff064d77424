// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneLook.h"

#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Options/cslfTableOptions.h"
#include "vtkCSLFEnvironment.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <CLI/CLI.hpp>

#include <sstream>

namespace cslf::tool
{
void SceneLook::AddTo(CLI::App& command)
{
  const std::string group = "Look of scenes from files";
  vtkCSLFSceneLook* filter = this->Filter;
  command
    .add_option_function<std::string>(
      "--color-by",
      [filter](const std::string& array) { filter->SetColorArrayName(array.c_str()); },
      "the array that colours the surfaces, of points or else of cells; for one of its components, "
      "add a colon and its number, x, y, z, its name or magnitude: velocity:x; none: no array "
      "(default: the file's active scalars, if they vary)")
    ->option_text("ARRAY[:COMPONENT]")
    ->group(group);
  AddOption(command, options::ColorMap, filter, &vtkCSLFSceneLook::SetColorMap)
    ->type_name("NAME")
    ->group(group);
  command
    .add_option_function<std::vector<double>>(
      "--range",
      [filter](const std::vector<double>& range)
      {
        filter->AutomaticColorRangeOff();
        filter->SetColorRange(range[0], range[1]);
      },
      "the values of the colour map's ends (default: the array's smallest and largest value)")
    ->expected(2)
    ->check(Finite())
    ->type_name("MIN MAX")
    ->group(group);
  AddOption(command, options::Light, filter, &vtkCSLFSceneLook::SetLight)
    ->type_name("PRESET")
    ->group(group);
  AddOption(command, options::UpAxis, filter, &vtkCSLFSceneLook::SetUpAxis)
    ->type_name("AXIS")
    ->group(group);
}

vtkSmartPointer<vtkDataObject> SceneLook::Apply(
  const std::vector<vtkSmartPointer<vtkDataObject>>& files) const
{
  const double* range = this->Filter->GetColorRange();
  if (!this->Filter->GetAutomaticColorRange() && !(range[0] < range[1]))
  {
    throw Failure("The first number of --range must be smaller than the second.");
  }
  this->Filter->RemoveAllInputs();
  for (vtkDataObject* file : files)
  {
    this->Filter->AddInputDataObject(file);
  }
  this->Filter->Update();
  ThrowOnError();
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  scene->ShallowCopy(this->Filter->GetOutput());
  return scene;
}

nlohmann::json SceneLook::GetLegend() const
{
  nlohmann::json legend = nlohmann::json::array();
  vtkTable* table = this->Filter->GetLegend();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto get = [table, row](const char* column)
    { return table->GetValueByName(row, column); };
    legend.push_back({ { "array", get("array").ToString() },
      { "range", { get("minimum").ToDouble(), get("maximum").ToDouble() } },
      { "map", get("map").ToString() } });
    const std::string component = get("component").ToString();
    if (!component.empty())
    {
      legend.back()["component"] = component;
    }
  }
  return legend;
}

std::string DescribeLegend(const nlohmann::json& legend)
{
  std::ostringstream text;
  for (const nlohmann::json& row : legend)
  {
    text << "coloured by " << row["array"].get<std::string>();
    if (row.contains("component"))
    {
      text << ":" << row["component"].get<std::string>();
    }
    text << ", " << row["map"].get<std::string>() << " from " << row["range"][0].get<double>()
         << " to " << row["range"][1].get<double>() << "\n";
  }
  return text.str();
}

bool SceneLook::IsLightGiven() const
{
  return this->Filter->GetLight() != vtkCSLFSceneLook::AutomaticLight;
}

void SceneLook::SetUpSky(vtkCSLFEnvironment* sky) const
{
  this->Filter->SetUpEnvironment(sky);
}

SceneAxes SceneLook::GetAxes() const
{
  SceneAxes axes;
  this->Filter->GetAxes(&axes.Right.x, &axes.Up.x, &axes.Front.x);
  return axes;
}
}
