// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneFiles.h"

#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfOutputFiles.h"
#include "Files/cslfFileSeries.h"
#include "Files/cslfFileSystem.h"
#include "Options/cslfTableOptions.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "Pipeline/cslfValidPolyData.h"
#include "cslfJSONText.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFPathTracer.h"
#include "vtkCSLFSceneSource.h"

#include <vtkBoundingBox.h>
#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiBlockDataSetAlgorithm.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <type_traits>

namespace cslf::tool
{
namespace
{
constexpr const char* CornellBoxName = "cornell-box";
constexpr const char* WhiteEnvironment = "white";

/// The value for glass and plastics, and of glTF's metallic-roughness material.
constexpr double UsualIndexOfRefraction = 1.5;

using Part = vtkSmartPointer<vtkDataObject>;

/// The files of a scene at the times of a series.
class vtkSceneSeries : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkSceneSeries* New();
  vtkTypeMacro(vtkSceneSeries, vtkMultiBlockDataSetAlgorithm);

  std::vector<double> Times;
  std::function<std::vector<Part>(double time)> Read;

protected:
  vtkSceneSeries() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* output = outputVector->GetInformationObject(0);
    const double range[2] = { this->Times.front(), this->Times.back() };
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), this->Times.data(),
      static_cast<int>(this->Times.size()));
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* information = outputVector->GetInformationObject(0);
    vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(information);
    const auto key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    const double asked = information->Has(key) ? information->Get(key) : this->Times.front();
    const double time = this->Times[FindTimeStep(this->Times, asked)];
    try
    {
      unsigned int block = 0;
      for (const Part& part : this->Read(time))
      {
        output->SetBlock(block++, part);
      }
    }
    catch (const std::exception& failure)
    {
      vtkErrorMacro(<< failure.what());
      return 0;
    }
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(vtkSceneSeries);

constexpr const char* InputHelp =
  "the scene: .ply .stl .obj .gltf .glb files, data sets of VTK (.vtp .vtm .vtu .vti .vtr .vts "
  ".vtk "
  ".pvd, parallel ones such as .pvtu, and series such as .vtp.series), or names that cslf scenes "
  "lists";

constexpr const char* EnvironmentHelp =
  "environment light instead of --light: white, gradient (white above, dark below), none, or the "
  "file of a lat-long image";

/// Takes a field's sampling parameter for a row's value that the command line does not give.
template <typename T>
void TakeDefault(
  const CLI::App* command, const nlohmann::json& sampling, const NumberOption<T>& row, T& value)
{
  const auto found = sampling.find(row.Key);
  if (found == sampling.end() || (command && command->count(row.Flag) > 0))
  {
    return;
  }
  try
  {
    if constexpr (std::is_integral_v<T>)
    {
      value = ToInteger<T>(*found);
    }
    else
    {
      found->get_to(value);
    }
  }
  catch (const std::exception&)
  {
    AddWarning(std::string("The field's sampling parameter ") + row.Key + " is invalid.");
  }
}

/// Three numbers of a field's sampling parameters. False if there are none.
bool FindTriple(const nlohmann::json& from, const char* key, std::array<double, 3>& value)
{
  const auto found = from.find(key);
  const bool isThere = found != from.end() && found->is_array() && found->size() == value.size() &&
    std::all_of(found->begin(), found->end(), [](const auto& item) { return item.is_number(); });
  if (isThere)
  {
    found->get_to(value);
  }
  return isThere;
}
}

void Scene::GetBounds(double bounds[6]) const
{
  if (!FindSceneBounds({ this->Parts.begin(), this->Parts.end() }, bounds))
  {
    vtkBoundingBox(-0.5, 0.5, -0.5, 0.5, -0.5, 0.5).GetBounds(bounds);
  }
}

void Scene::ForEachPolyData(const std::function<void(vtkPolyData*)>& visit) const
{
  for (const Part& part : this->Parts)
  {
    tool::ForEachPolyData(part, visit);
  }
}

void SceneOptions::AddTo(CLI::App& command)
{
  command.add_option("input", this->Inputs, InputHelp)->type_name(ScenePlaceholder)->required();
  this->AddLightAndMaterialTo(command);
}

void SceneOptions::AddOptionalTo(CLI::App& command)
{
  command.add_option("input,--scene", this->Inputs, InputHelp)->type_name(ScenePlaceholder);
  this->AddLightAndMaterialTo(command);
}

void SceneOptions::AddLightAndMaterialTo(CLI::App& command)
{
  this->Command = &command;
  if (!command.get_option_no_throw(TimeFlag))
  {
    // A field of the command may have added it.
    command
      .add_option_function<double>(
        TimeFlag, [](double) {}, TimeHelp)
      ->check(Finite())
      ->type_name("TIME");
  }
  this->Look.AddTo(command);
  const std::string light = "Light";
  vtkCSLFEnvironment* environment = this->Light;
  command
    .add_option_function<std::string>(
      options::EnvironmentMode.Flag, [this](const std::string& name) { this->ChooseLight(name); },
      EnvironmentHelp)
    ->type_name(FilePlaceholder)
    ->check(Suggest("white, gradient, none"))
    ->group(light)
    ->excludes(command.get_option("--light"));
  AddOption(command, options::EnvironmentIntensity, environment, &vtkCSLFEnvironment::SetIntensity)
    ->group(light);
  AddOption(command, options::ShowEnvironment, environment, &vtkCSLFEnvironment::SetShow)
    ->group(light);
  AddOption(command, options::Colors, this->Colors)->group(light);
  AddOption(command, options::Exposure, this->Exposure, Positive())->group(light);
  AddOption(command, options::MaximumDepth, this->MaximumDepth)->group(light);
  const std::string material = "Material of the scene, except for cornell-box";
  AddOptional(command, options::Roughness, this->Roughness)
    ->description(options::Roughness.Help + std::string("; gives the surface a glossy boundary"))
    ->group(material);
  AddOptional(command, options::Metallic, this->Metallic)->group(material);
  command
    .add_option(options::BaseColor.Flag, this->BaseColor,
      options::BaseColor.Help +
        std::string("; replaces the colours of the files (default: their colours, or gray)"))
    ->expected(3)
    ->check(Between(0.0, 1.0))
    ->type_name("R G B")
    ->group(material);
  AddOption(command, options::PointRadius, this->PointRadius)->group(material);
}

void SceneOptions::TakeDefaults(const nlohmann::json& sampling)
{
  const bool hasColors = this->Command && this->Command->count(options::Colors.Flag) > 0;
  const auto colors = sampling.find(options::Colors.Key);
  if (!hasColors && colors != sampling.end() && *colors == options::Colors.Names[1])
  {
    this->Colors = vtkCSLFPathTracer::Exact;
  }
  TakeDefault(this->Command, sampling, options::Exposure, this->Exposure);
  TakeDefault(this->Command, sampling, options::MaximumDepth, this->MaximumDepth);
  const auto found = sampling.find("environment");
  if (found != sampling.end() && found->is_object())
  {
    this->TakeLight(*found);
  }
}

/// Takes the environment of a field, unless the command line chooses another one.
void SceneOptions::TakeLight(const nlohmann::json& environment)
{
  double intensity = this->Light->GetIntensity();
  TakeDefault(this->Command, environment, options::EnvironmentIntensity, intensity);
  this->Light->SetIntensity(intensity);
  const auto named = environment.find(options::EnvironmentMode.Key);
  const std::string mode = named != environment.end() && named->is_string() ? *named : "";
  if (this->IsLightChosen || this->Look.IsLightGiven() || mode.empty() || mode == "scene")
  {
    return;
  }
  if (mode == "image")
  {
    throw Failure("The field was sampled with an environment image: specify it by --environment.");
  }
  this->ChooseLight(mode == "none" || mode == "gradient" ? mode : WhiteEnvironment);
  std::array<double, 3> value;
  if (FindTriple(environment, options::EnvironmentColor.Key, value))
  {
    this->Light->SetColor(value.data());
  }
  if (FindTriple(environment, options::EnvironmentBottomColor.Key, value))
  {
    this->Light->SetBottomColor(value.data());
  }
  if (FindTriple(environment, options::EnvironmentUp.Key, value))
  {
    this->Light->SetUp(value.data());
  }
}

bool SceneOptions::HasCornellBox() const
{
  return std::find(this->Inputs.begin(), this->Inputs.end(), CornellBoxName) != this->Inputs.end();
}

std::optional<double> SceneOptions::GetTime() const
{
  const CLI::Option* time = this->Command ? this->Command->get_option_no_throw(TimeFlag) : nullptr;
  return time && time->count() > 0 ? std::make_optional(time->as<double>()) : std::nullopt;
}

std::vector<double> SceneOptions::FindTimes() const
{
  std::set<double> times;
  for (std::size_t i = 0; i < this->Inputs.size(); ++i)
  {
    const std::string& input = this->Inputs[i];
    std::error_code failure;
    if (!this->IsFile(i) || !std::filesystem::is_regular_file(ToPath(input), failure))
    {
      continue;
    }
    const std::vector<double> own = FindSceneTimes(input);
    times.insert(own.begin(), own.end());
  }
  return { times.begin(), times.end() };
}

/// Reads the inputs that are files, or the others, and gives them their materials.
std::vector<Part> SceneOptions::ReadParts(std::optional<double> time, bool areFiles) const
{
  std::vector<Part> parts;
  for (std::size_t i = 0; i < this->Inputs.size(); ++i)
  {
    if (this->IsFile(i) == areFiles)
    {
      parts.push_back(ReadScenePart(this->Inputs[i], time));
      if (this->Inputs[i] != CornellBoxName)
      {
        this->SetMaterial(parts.back());
      }
    }
  }
  return parts;
}

Scene SceneOptions::Read() const
{
  return this->ReadAt(this->GetTime());
}

Scene SceneOptions::ReadAt(std::optional<double> time) const
{
  Scene scene;
  scene.Parts = this->ReadParts(time, false);
  scene.Parts.push_back(this->Look.Apply(this->ReadParts(time, true)));
  scene.Legend = this->Look.GetLegend();
  this->RequireEnvironment();
  return scene;
}

void SceneOptions::RequireEnvironment() const
{
  std::error_code failure;
  if (this->Light->GetMode() == vtkCSLFEnvironment::ImageEnvironment &&
    !std::filesystem::is_regular_file(ToPath(this->Light->GetFileName()), failure))
  {
    throw Failure(std::string("There is no environment image ") + this->Light->GetFileName() + ".");
  }
}

/// Whether an input is a file, not the name of a scene.
bool SceneOptions::IsFile(std::size_t input) const
{
  return !vtkCSLFSceneSource::HasScene(this->Inputs[input].c_str());
}

void SceneOptions::ChooseLight(const std::string& name)
{
  static const std::map<std::string, int> modes = {
    { "none", vtkCSLFEnvironment::NoEnvironment },
    { WhiteEnvironment, vtkCSLFEnvironment::ConstantEnvironment },
    { "gradient", vtkCSLFEnvironment::GradientEnvironment },
  };
  const auto named = modes.find(name);
  const bool isImage = named == modes.end();
  this->Light->SetMode(isImage ? vtkCSLFEnvironment::ImageEnvironment : named->second);
  this->Light->SetFileName(isImage ? name.c_str() : nullptr);
  this->IsLightChosen = true;
}

void SceneOptions::RequireOther(const std::string& output) const
{
  for (std::size_t i = 0; i < this->Inputs.size(); ++i)
  {
    if (this->IsFile(i))
    {
      tool::RequireOther(this->Inputs[i], output);
    }
  }
  if (this->Light->GetMode() == vtkCSLFEnvironment::ImageEnvironment && this->Light->GetFileName())
  {
    tool::RequireOther(this->Light->GetFileName(), output);
  }
}

void SceneOptions::SetMaterial(vtkDataObject* part) const
{
  ForEachPolyData(part,
    [this](vtkPolyData* polyData)
    {
      if (this->Roughness || this->Metallic)
      {
        vtkCSLFMaterial::SetIndexOfRefraction(polyData, UsualIndexOfRefraction);
        vtkCSLFMaterial::SetRoughness(
          polyData, this->Roughness.value_or(options::Roughness.Default));
        vtkCSLFMaterial::SetMetallic(polyData, this->Metallic.value_or(options::Metallic.Default));
      }
      if (this->PointRadius > 0.0 && polyData->GetNumberOfVerts() > 0 &&
        vtkCSLFMaterial::GetPointRadius(polyData) == 0.0)
      {
        vtkCSLFMaterial::SetPointRadius(polyData, this->PointRadius);
      }
      if (this->BaseColor)
      {
        const std::vector<double>& color = *this->BaseColor;
        vtkCSLFMaterial::SetBaseColor(polyData, color[0], color[1], color[2]);
        polyData->GetPointData()->SetActiveScalars(nullptr);
        polyData->GetCellData()->SetActiveScalars(nullptr);
      }
    });
}

void SceneOptions::Apply(const Scene& scene, vtkCSLFPathTracer* tracer) const
{
  for (const Part& part : scene.Parts)
  {
    tracer->AddInputDataObject(0, part);
  }
  this->ApplyLight(tracer);
}

vtkCSLFSceneLook* SceneOptions::ApplySeries(
  const std::vector<double>& times, vtkCSLFPathTracer* tracer) const
{
  this->RequireEnvironment();
  vtkNew<vtkSceneSeries> series;
  series->Times = times;
  series->Read = [this](double time) { return this->ReadParts(time, true); };
  vtkCSLFSceneLook* look = this->Look.SetUpFilter();
  look->SetInputConnection(series->GetOutputPort());
  // The times are those of the first input.
  tracer->SetInputConnection(0, look->GetOutputPort());
  for (const Part& part : this->ReadParts(std::nullopt, false))
  {
    tracer->AddInputDataObject(0, part);
  }
  this->ApplyLight(tracer);
  return look;
}

void SceneOptions::ApplyLight(vtkCSLFPathTracer* tracer) const
{
  const auto named = std::find_if(this->Inputs.begin(), this->Inputs.end(),
    [](const std::string& input) { return vtkCSLFSceneSource::HasScene(input.c_str()); });
  if (this->Look.IsLightGiven() || (!this->IsLightChosen && named == this->Inputs.end()))
  {
    this->Look.SetUpSky(this->Light);
  }
  else if (!this->IsLightChosen)
  {
    vtkNew<vtkCSLFSceneSource> source;
    source->SetSceneName(named->c_str());
    source->SetUpEnvironment(this->Light);
  }
  tracer->SetEnvironment(this->Light);
  tracer->SetColors(this->Colors);
  tracer->SetExposure(this->Exposure);
  tracer->SetMaximumDepth(this->MaximumDepth);
}
}
