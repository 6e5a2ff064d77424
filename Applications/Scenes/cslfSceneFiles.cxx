// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneFiles.h"

#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Fields/cslfOutputFiles.h"
#include "Fields/cslfSceneChecks.h"
#include "Files/cslfFileSystem.h"
#include "cslfGridReader.h"
#include "cslfOBJReader.h"
#include "cslfPLYReader.h"
#include "cslfSTLReader.h"

#include "Console/cslfNumberChecks.h"
#include "Options/cslfTableOptions.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "Pipeline/cslfValidPolyData.h"
#include "cslfJSONText.h"
#include "cslfJoin.h"
#include "vtkCSLFGLTFReader.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFPathTracer.h"
#include "vtkCSLFSceneSource.h"

#include <vtkBoundingBox.h>
#include <vtkCellData.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <new>
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

template <typename Reader>
Part ReadWith(const std::string& fileName)
{
  vtkNew<Reader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

using Readers = std::map<std::string, std::function<Part(const std::string&)>>;

/// The readers of one file by its extension.
const Readers& GetFileReaders()
{
  static const Readers readers = []
  {
    Readers all = {
      { ".ply", ReadPLY },
      { ".stl", ReadSTL },
      { ".obj", ReadOBJ },
      { ".vtk", ReadLegacyGrid },
      { ".gltf", ReadWith<vtkCSLFGLTFReader> },
      { ".glb", ReadWith<vtkCSLFGLTFReader> },
    };
    for (const char* extension : { ".vtp", ".vtm", ".vtu", ".vti", ".vtr", ".vts", ".vtpd", ".vtpc",
           ".pvtp", ".pvtu", ".pvti", ".pvtr", ".pvts" })
    {
      all[extension] = ReadXMLGrid;
    }
    return all;
  }();
  return readers;
}

/// The reader of a file; null if there is none for its extension.
const Readers::mapped_type* FindReader(const Readers& readers, const std::string& fileName)
{
  const auto found = readers.find(ToLower(ToName(ToPath(fileName).extension())));
  return found == readers.end() ? nullptr : &found->second;
}

/// A file that a collection names.
Part ReadEntry(const std::string& fileName)
{
  std::error_code failure;
  const auto* reader = FindReader(GetFileReaders(), fileName);
  if (!reader || !std::filesystem::is_regular_file(ToPath(fileName), failure))
  {
    throw Failure(reader ? "there is no file " + fileName + "."
                         : "it names " + fileName + ", which is not a scene.");
  }
  RequireReadable(fileName);
  return (*reader)(fileName);
}

/// The readers of files and of collections.
const Readers& GetReaders()
{
  static const Readers readers = []
  {
    Readers all = GetFileReaders();
    all[".pvd"] = [](const std::string& fileName) { return ReadCollection(fileName, ReadEntry); };
    return all;
  }();
  return readers;
}

/// Removes cells that would be read out of bounds, with warnings.
Part MakePartSound(vtkDataObject* part, const std::string& input)
{
  std::set<std::string> removed;
  const auto makeSound = [&removed](vtkPolyData* polyData)
  {
    const ValidPolyData sound = MakeSound(polyData);
    sound.AddRemoved(removed);
    return sound.Data;
  };
  Part result = part;
  if (auto* polyData = vtkPolyData::SafeDownCast(part))
  {
    result = makeSound(polyData);
  }
  else if (auto* tree = vtkDataObjectTree::SafeDownCast(part))
  {
    vtkSmartPointer<vtkDataObjectTreeIterator> leaf;
    leaf.TakeReference(tree->NewTreeIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      if (auto* data = vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()))
      {
        tree->SetDataSetFrom(leaf, makeSound(data));
      }
    }
  }
  for (const std::string& what : removed)
  {
    AddWarning("Invalid parts of " + input + " were left out: " + what + ".");
  }
  return result;
}

/// Calls `visit` for each polydata of a data object.
void ForEachPolyData(vtkDataObject* part, const std::function<void(vtkPolyData*)>& visit)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(part);
  if (!tree)
  {
    if (auto* polyData = vtkPolyData::SafeDownCast(part))
    {
      visit(polyData);
    }
    return;
  }
  vtkSmartPointer<vtkDataObjectTreeIterator> iterator;
  iterator.TakeReference(tree->NewTreeIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    if (auto* polyData = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject()))
    {
      visit(polyData);
    }
  }
}

/// Whether a point has coordinates that are finite as floats, as the tracer needs them.
bool HasFinitePoint(vtkDataObject* part)
{
  bool isFound = false;
  ForEachPolyData(part,
    [&isFound](vtkPolyData* polyData)
    {
      for (vtkIdType i = 0; !isFound && i < polyData->GetNumberOfPoints(); ++i)
      {
        const double* point = polyData->GetPoint(i);
        isFound = std::all_of(
          point, point + 3, [](double coordinate) { return std::abs(coordinate) < VTK_FLOAT_MAX; });
      }
    });
  return isFound;
}

constexpr const char* InputHelp =
  "the scene: .ply .stl .obj .gltf .glb files, data sets of VTK (.vtp .vtm .vtu .vti .vtr .vts "
  ".vtk "
  ".pvd and parallel ones such as .pvtu), or names that cslf scenes lists";

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

bool IsSceneName(const std::string& input)
{
  return vtkCSLFSceneSource::HasScene(input.c_str()) || FindReader(GetReaders(), input);
}

Part ReadScenePart(const std::string& input)
{
  if (vtkCSLFSceneSource::HasScene(input.c_str()))
  {
    vtkNew<vtkCSLFSceneSource> source;
    source->SetSceneName(input.c_str());
    source->Update();
    return source->GetOutputDataObject(0);
  }
  const std::filesystem::path path = ToPath(input);
  const auto* reader = FindReader(GetReaders(), input);
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
  {
    throw Failure("There is no file " + input + ".");
  }
  if (!reader)
  {
    throw Failure(input + " is not a scene: supported are " +
      JoinAs(GetReaders(), [](const auto& item) { return item.first; }) +
      " and the names that cslf scenes lists.");
  }
  Part part;
  try
  {
    RequireReadable(input);
    part = MakePartSound((*reader)(input), input);
  }
  catch (const Failure& failure)
  {
    const std::string text = failure.what();
    const std::string prefix = "Cannot read " + input + ": ";
    throw Failure(text.rfind(prefix, 0) == 0 ? text : prefix + text);
  }
  catch (const std::bad_alloc&)
  {
    throw Failure("Cannot read " + input + ": there is not enough memory.");
  }
  catch (const std::exception&)
  {
    // The standard library's messages about wrong sizes do not help users.
    throw Failure("Cannot read " + input + ": it is damaged or too large.");
  }
  const std::string error = GetFirstError();
  vtkIdType cells = 0;
  tool::ForEachPolyData(
    part, [&](vtkPolyData* polyData) { cells += polyData->GetNumberOfCells(); });
  if (cells == 0 || !error.empty())
  {
    // Some readers only warn of files that they cannot read.
    const std::vector<std::string> warnings = GetWarnings();
    const std::string cause = warnings.empty() ? "it has no cells." : warnings.back();
    throw Failure("Cannot read " + input + ": " + (error.empty() ? cause : error));
  }
  if (!HasFinitePoint(part))
  {
    throw Failure("Cannot read " + input + ": the coordinates of its points are not finite.");
  }
  return part;
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

Scene SceneOptions::Read() const
{
  Scene scene;
  std::vector<Part> files;
  for (std::size_t i = 0; i < this->Inputs.size(); ++i)
  {
    const Part part = ReadScenePart(this->Inputs[i]);
    if (this->Inputs[i] != CornellBoxName)
    {
      this->SetMaterial(part);
    }
    (this->IsFile(i) ? files : scene.Parts).push_back(part);
  }
  scene.Parts.push_back(this->Look.Apply(files));
  scene.Legend = this->Look.GetLegend();
  std::error_code failure;
  if (this->Light->GetMode() == vtkCSLFEnvironment::ImageEnvironment &&
    !std::filesystem::is_regular_file(ToPath(this->Light->GetFileName()), failure))
  {
    throw Failure(std::string("There is no environment image ") + this->Light->GetFileName() + ".");
  }
  return scene;
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
