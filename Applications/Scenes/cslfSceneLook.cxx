// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneLook.h"

#include "Console/cslfMessages.h"
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
  this->Colors.AddTo(command, group,
    { "the file's active scalars, if they vary", "", "the array's smallest and largest value" });
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
  this->SetUpFilter();
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

vtkCSLFSceneLook* SceneLook::SetUpFilter() const
{
  this->Colors.CheckRange();
  this->Filter->SetColorArrayName(this->Colors.Array.c_str());
  this->Filter->SetColorMap(this->Colors.Map);
  if (!this->Colors.Range.empty())
  {
    this->Filter->AutomaticColorRangeOff();
    this->Filter->SetColorRange(this->Colors.Range.data());
  }
  this->Filter->RemoveAllInputs();
  return this->Filter;
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
