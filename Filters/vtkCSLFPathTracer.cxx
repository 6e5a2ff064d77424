// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFPathTracer.h"

#include "Parallel/cslfSceneGather.h"
#include "PathTracing/cslfSceneBuilder.h"
#include "PathTracing/cslfTexelRenderer.h"
#include "cslfColor.h"
#include "cslfVTKCompatibility.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkPolyData.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <nlohmann/json.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>
#include <vector>

vtkCxxSetObjectMacro(vtkCSLFPathTracer, Controller, vtkMultiProcessController);

namespace
{
glm::dvec3 ToVector(const double tuple[3])
{
  return { tuple[0], tuple[1], tuple[2] };
}

glm::dvec3 ToLinear(const double color[3])
{
  return cslf::SRGBToLinear(glm::clamp(ToVector(color), 0.0, 1.0));
}

std::vector<vtkDataObject*> GetInputs(vtkInformationVector* connections)
{
  std::vector<vtkDataObject*> inputs;
  for (int i = 0; i < connections->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkDataObject* input = vtkDataObject::GetData(connections, i))
    {
      inputs.push_back(input);
    }
  }
  return inputs;
}

/// Writes the times of a data object and all its leaves.
void WriteTimes(vtkDataObject* data, std::ostream& key)
{
  key << data->GetMTime() << ' ';
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      key << leaf->GetCurrentFlatIndex() << ':' << leaf->GetCurrentDataObject()->GetMTime() << ' ';
    }
  }
}
}

struct vtkCSLFPathTracer::vtkInternals
{
  vtkSmartPointer<vtkScalarsToColors> LookupTable;
  cslf::BuiltScene Scene;
  std::string SceneKey; // what the scene was built from; empty if there is none

  /// On failure returns false and says why.
  static bool MakeEnvironment(
    vtkCSLFPathTracer* self, cslf::Environment& environment, std::string& error);
};

bool vtkCSLFPathTracer::vtkInternals::MakeEnvironment(
  vtkCSLFPathTracer* self, cslf::Environment& environment, std::string& error)
{
  const int mode = self->EnvironmentMode;
  if (mode == NoEnvironment)
  {
    environment = cslf::Environment();
    return true;
  }
  const glm::dvec3 up = ToVector(self->EnvironmentUp);
  if (!(glm::length(up) > 0.0))
  {
    error = "EnvironmentUp must not be 0.";
    return false;
  }
  const cslf::EnvironmentAxes axes = cslf::EnvironmentAxes::FromUp(up);
  const double intensity = self->EnvironmentIntensity;
  if (mode == ImageEnvironment)
  {
    if (!self->EnvironmentFileName)
    {
      error = "EnvironmentFileName is not set.";
      return false;
    }
    cslf::EnvironmentImage image;
    if (!cslf::ReadEnvironmentImage(self->EnvironmentFileName, image, error))
    {
      return false;
    }
    environment = cslf::Environment(std::move(image), static_cast<float>(intensity), axes);
    return true;
  }
  const double* bottom =
    mode == GradientEnvironment ? self->EnvironmentBottomColor : self->EnvironmentColor;
  environment = cslf::Environment(
    intensity * ToLinear(bottom), intensity * ToLinear(self->EnvironmentColor), axes);
  return true;
}

vtkCSLFPathTracer::vtkCSLFPathTracer()
  : Internals(std::make_unique<vtkInternals>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkCSLFPathTracer::~vtkCSLFPathTracer()
{
  this->SetController(nullptr);
  this->SetEnvironmentFileName(nullptr);
}

vtkMTimeType vtkCSLFPathTracer::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  vtkScalarsToColors* table = this->Internals->LookupTable;
  return table ? std::max(time, table->GetMTime()) : time;
}

void vtkCSLFPathTracer::SetLookupTable(vtkScalarsToColors* lookupTable)
{
  if (this->Internals->LookupTable != lookupTable)
  {
    this->Internals->LookupTable = lookupTable;
    this->Modified();
  }
}

vtkScalarsToColors* vtkCSLFPathTracer::GetLookupTable()
{
  return this->Internals->LookupTable;
}

int vtkCSLFPathTracer::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port != 0)
  {
    return 0;
  }
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkCSLFPathTracer::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  // Every texel sees the whole scene.
  const bool gathers = this->MustGather();
  const int piece = gathers ? this->Controller->GetLocalProcessId() : 0;
  const int pieces = gathers ? this->Controller->GetNumberOfProcesses() : 1;
  for (int i = 0; i < inputVector[0]->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* info = inputVector[0]->GetInformationObject(i);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return 1;
}

const cslf::BuiltScene* vtkCSLFPathTracer::UpdateScene(vtkInformationVector** inputVector)
{
  if (this->Internals->SceneKey.empty() ||
    this->Internals->SceneKey != this->MakeSceneKey(inputVector))
  {
    this->Internals->SceneKey.clear();
    if (!this->BuildScene(inputVector))
    {
      return nullptr;
    }
    this->Internals->SceneKey = this->MakeSceneKey(inputVector);
  }
  return &this->Internals->Scene;
}

std::string vtkCSLFPathTracer::MakeSceneKey(vtkInformationVector** inputVector)
{
  std::ostringstream key;
  key << std::setprecision(17);
  for (vtkDataObject* input : GetInputs(inputVector[0]))
  {
    WriteTimes(input, key);
  }
  vtkScalarsToColors* table = this->Internals->LookupTable;
  key << this->MustGather() << ' ' << this->ScalarVisibility << ' '
      << this->GetInputArrayInformation(0)->GetMTime() << ' ' << (table ? table->GetMTime() : 0)
      << ' ' << this->EnvironmentMode << ' ' << this->EnvironmentIntensity << ' '
      << (this->EnvironmentFileName ? this->EnvironmentFileName : "");
  for (int i = 0; i < 3; ++i)
  {
    key << ' ' << this->EnvironmentColor[i] << ' ' << this->EnvironmentBottomColor[i] << ' '
        << this->EnvironmentUp[i];
  }
  return key.str();
}

bool vtkCSLFPathTracer::BuildScene(vtkInformationVector** inputVector)
{
  cslf::SceneOptions options;
  std::string error;
  if (!vtkInternals::MakeEnvironment(this, options.Surroundings, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  options.LookupTable = this->Internals->LookupTable;
  options.FindScalars = [this](vtkPolyData* data, bool& ofCells) -> vtkDataArray*
  {
    if (!this->ScalarVisibility)
    {
      return nullptr;
    }
    int association = vtkDataObject::FIELD_ASSOCIATION_NONE;
    vtkDataArray* array = this->GetInputArrayToProcess(0, data, association);
    ofCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
    const bool usable = ofCells || association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
    return usable ? array : nullptr;
  };
  std::vector<vtkDataObject*> inputs = GetInputs(inputVector[0]);
  std::vector<vtkSmartPointer<vtkDataObject>> gathered;
  if (this->MustGather())
  {
    if (!cslf::GatherScene(this->Controller, inputs, gathered, error))
    {
      vtkErrorMacro(<< error);
      return false;
    }
    inputs.assign(gathered.begin(), gathered.end());
  }
  this->Internals->Scene = cslf::BuildScene(inputs, options);
  if (!this->Internals->Scene.World)
  {
    vtkErrorMacro(<< this->Internals->Scene.Error);
    return false;
  }
  if (!this->Internals->Scene.Warning.empty())
  {
    vtkWarningMacro(<< this->Internals->Scene.Warning);
  }
  return true;
}

bool vtkCSLFPathTracer::MustGather()
{
  return this->DistributedScene && this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

cslf::RenderSettings vtkCSLFPathTracer::GetRenderSettings()
{
  cslf::RenderSettings settings;
  settings.Samples = this->Samples;
  settings.Seed = static_cast<std::uint32_t>(this->Seed);
  settings.Exposure = this->Exposure;
  settings.ShowEnvironment = this->ShowEnvironment;
  settings.Paths.MaximumDepth = this->MaximumDepth;
  return settings;
}

std::string vtkCSLFPathTracer::DescribeSampling()
{
  static const char* const modes[] = { "none", "constant", "gradient", "image" };
  nlohmann::json environment = { { "mode", modes[this->EnvironmentMode] } };
  if (this->EnvironmentMode != NoEnvironment)
  {
    environment["intensity"] = this->EnvironmentIntensity;
    environment["up"] = this->EnvironmentUp;
  }
  if (this->EnvironmentMode == ConstantEnvironment || this->EnvironmentMode == GradientEnvironment)
  {
    environment["color"] = this->EnvironmentColor;
  }
  if (this->EnvironmentMode == GradientEnvironment)
  {
    environment["bottom_color"] = this->EnvironmentBottomColor;
  }
  const nlohmann::json sampling = { { "scene", this->Internals->Scene.Fingerprint },
    { "samples", this->Samples }, { "maximum_depth", this->MaximumDepth }, { "seed", this->Seed },
    { "exposure", this->Exposure }, { "show_environment", this->ShowEnvironment },
    { "environment", environment } };
  return sampling.dump();
}

bool vtkCSLFPathTracer::Render(const cslf::TexelRenderer& renderer)
{
  return renderer.Render(
    [this](double progress)
    {
      this->UpdateProgress(progress);
      return !cslf::IsAborted(this);
    });
}

void vtkCSLFPathTracer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "MaximumDepth: " << this->MaximumDepth << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "ShowEnvironment: " << this->ShowEnvironment << "\n";
  os << indent << "EnvironmentMode: " << this->EnvironmentMode << "\n";
  os << indent << "EnvironmentColor: " << this->EnvironmentColor[0] << " "
     << this->EnvironmentColor[1] << " " << this->EnvironmentColor[2] << "\n";
  os << indent << "EnvironmentBottomColor: " << this->EnvironmentBottomColor[0] << " "
     << this->EnvironmentBottomColor[1] << " " << this->EnvironmentBottomColor[2] << "\n";
  os << indent << "EnvironmentIntensity: " << this->EnvironmentIntensity << "\n";
  os << indent << "EnvironmentFileName: "
     << (this->EnvironmentFileName ? this->EnvironmentFileName : "(none)") << "\n";
  os << indent << "EnvironmentUp: " << this->EnvironmentUp[0] << " " << this->EnvironmentUp[1]
     << " " << this->EnvironmentUp[2] << "\n";
  os << indent << "ScalarVisibility: " << this->ScalarVisibility << "\n";
  os << indent << "DistributedScene: " << this->DistributedScene << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "LookupTable: " << this->Internals->LookupTable.Get() << "\n";
}
