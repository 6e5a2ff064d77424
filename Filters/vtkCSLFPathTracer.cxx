// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFPathTracer.h"

#include "Pipeline/cslfGuard.h"

#include "Options/cslfOption.h"
#include "Options/cslfOptionTable.h"
#include "Parallel/cslfSceneGather.h"
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "PathTracing/Texels/cslfArithmetic.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfScenePipeline.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfColor.h"
#include "cslfJSON.h"
#include "vtkCSLFPathTracerInternals.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArraySelection.h>
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkExtentTranslator.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerRequestKey.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <iomanip>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

vtkCxxSetObjectMacro(vtkCSLFPathTracer, Controller, vtkMultiProcessController);

namespace options = cslf::options;

namespace
{
///@{
/// The progress when a renderer's scene is imported, when the scene is read, and when its tree is
/// built.
constexpr double ImportProgress = 0.02;
constexpr double ReadProgress = 0.03;
constexpr double BuiltProgress = 0.06;
///@}

glm::dvec3 ToVector(const double tuple[3])
{
  return { tuple[0], tuple[1], tuple[2] };
}

std::array<double, 3> ToArray(const double tuple[3])
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

/// Writes the modification times of a data object and all its leaves.
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

/// Writes everything of an environment that is part of a scene.
void WriteEnvironment(vtkCSLFEnvironment* environment, std::ostream& key)
{
  const char* fileName = environment->GetFileName();
  key << environment->GetMode() << ' ' << environment->GetIntensity() << ' '
      << (fileName ? fileName : "");
  for (const double* tuple :
    { environment->GetColor(), environment->GetBottomColor(), environment->GetUp() })
  {
    key << ' ' << tuple[0] << ' ' << tuple[1] << ' ' << tuple[2];
  }
}

/// On failure returns false and says why.
bool MakeEnvironment(vtkCSLFEnvironment* from, cslf::Environment& environment, std::string& error)
{
  const int mode = from->GetMode();
  if (mode == vtkCSLFEnvironment::NoEnvironment)
  {
    environment = cslf::Environment();
    return true;
  }
  const glm::dvec3 up = ToVector(from->GetUp());
  if (!(glm::length(up) > 0.0))
  {
    error = "The environment's Up must not be 0.";
    return false;
  }
  const cslf::EnvironmentAxes axes = cslf::EnvironmentAxes::FromUp(up);
  const double intensity = from->GetIntensity();
  if (mode == vtkCSLFEnvironment::ImageEnvironment)
  {
    if (!from->GetFileName())
    {
      error = "The environment's FileName is not set.";
      return false;
    }
    cslf::EnvironmentImage image;
    if (!cslf::ReadEnvironmentImage(from->GetFileName(), image, error))
    {
      return false;
    }
    environment = cslf::Environment(std::move(image), static_cast<float>(intensity), axes);
    return true;
  }
  const double* bottom =
    mode == vtkCSLFEnvironment::GradientEnvironment ? from->GetBottomColor() : from->GetColor();
  environment =
    cslf::Environment(intensity * ToLinear(bottom), intensity * ToLinear(from->GetColor()), axes);
  return true;
}

/// The environment in the record. A scene's own one replaces it.
nlohmann::json DescribeEnvironment(vtkCSLFEnvironment* environment, bool isReplaced)
{
  if (isReplaced)
  {
    return { { options::EnvironmentMode.Key, "scene" } };
  }
  const int mode = environment->GetMode();
  nlohmann::json record = { { options::EnvironmentMode.Key,
    options::EnvironmentMode.Names[mode] } };
  if (mode != vtkCSLFEnvironment::NoEnvironment)
  {
    record[options::EnvironmentIntensity.Key] = environment->GetIntensity();
    record[options::EnvironmentUp.Key] = ToArray(environment->GetUp());
  }
  const bool isGradient = mode == vtkCSLFEnvironment::GradientEnvironment;
  if (isGradient || mode == vtkCSLFEnvironment::ConstantEnvironment)
  {
    record[options::EnvironmentColor.Key] = ToArray(environment->GetColor());
  }
  if (isGradient)
  {
    record[options::EnvironmentBottomColor.Key] = ToArray(environment->GetBottomColor());
  }
  return record;
}
}

vtkCSLFPathTracer::vtkCSLFPathTracer()
  : Colors(options::Colors.Default)
  , Interreflection(options::Interreflection.Default)
  , Quality(options::Quality.Default)
  , Samples(options::Samples.Default)
  , NoiseTarget(options::NoiseTarget.Default)
  , MaximumDepth(options::MaximumDepth.Default)
  , Seed(options::Seed.Default)
  , Exposure(options::Exposure.Default)
  , ScalarVisibility(options::ScalarVisibility.Default)
  , InterpolateDisplayedColors(options::InterpolateDisplayedColors.Default)
  , DistributedScene(options::DistributedScene.Default)
  , Internals(std::make_unique<vtkInternals>(*this))
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkCSLFPathTracer::~vtkCSLFPathTracer()
{
  this->SetController(nullptr);
}

vtkExecutive* vtkCSLFPathTracer::CreateDefaultExecutive()
{
  if (vtkAlgorithm::DefaultExecutivePrototype)
  {
    return this->Superclass::CreateDefaultExecutive();
  }
  auto* executive = cslf::ScenePipeline::New();
  executive->MustGather = [this] { return this->MustGather(); };
  executive->GatherAsFailed = [this]
  {
    std::string error = "its input has failed.";
    cslf::ShareError(this->Controller, error);
  };
  return executive;
}

vtkTypeBool vtkCSLFPathTracer::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
    {
      cslf::SetBakeQuality(outputs->GetInformationObject(port), this->Quality);
      cslf::OfferScene(outputs->GetInformationObject(port), &this->Internals->Offered);
    }
  }
  return cslf::GuardRequest(this, request, outputs,
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

vtkMTimeType vtkCSLFPathTracer::GetMTime()
{
  vtkMTimeType time = std::max({ this->Superclass::GetMTime(),
    this->Internals->Environment->GetMTime(), this->Internals->CacheOptions->GetMTime() });
  if (vtkScalarsToColors* table = this->Internals->LookupTable)
  {
    time = std::max(time, table->GetMTime());
  }
  if (vtkCSLFSceneImporter* importer = this->Internals->Importer)
  {
    time = std::max(time, importer->GetMTime());
  }
  return time;
}

int vtkCSLFPathTracer::GetUsedIntegrator()
{
  // The cache knows the light on surfaces, but not in volumes.
  const cslf::Scene* scene = this->Internals->Scene.World.get();
  const bool hasVolumes = scene && scene->GetVolumes();
  return this->Colors == Exact || hasVolumes ? PathTracing : this->Integrator;
}

int vtkCSLFPathTracer::GetUsedMaximumDepth()
{
  return this->Colors == Exact ? 0 : this->MaximumDepth;
}

double vtkCSLFPathTracer::GetUsedExposure()
{
  return this->Colors == Exact ? 1.0 : this->Exposure;
}

int vtkCSLFPathTracer::GetUsedSamples()
{
  return this->Samples > 0 ? this->Samples : cslf::QualityPresets[this->Quality].Samples;
}

double vtkCSLFPathTracer::GetUsedNoiseTarget()
{
  return this->NoiseTarget >= 0.0 ? this->NoiseTarget
                                  : cslf::QualityPresets[this->Quality].NoiseTarget;
}

double vtkCSLFPathTracer::GetUsedCacheTolerance()
{
  const double tolerance = this->Internals->CacheOptions->GetTolerance();
  return tolerance > 0.0 ? tolerance : cslf::QualityPresets[this->Quality].CacheTolerance;
}

int vtkCSLFPathTracer::GetUsedCacheSamples()
{
  const int samples = this->Internals->CacheOptions->GetSamples();
  return samples > 0 ? samples : cslf::QualityPresets[this->Quality].CacheSamples;
}

cslfSetOptionMacro(vtkCSLFPathTracer, Integrator, Integrator);
cslfSetOptionMacro(vtkCSLFPathTracer, Colors, Colors);
cslfSetOptionMacro(vtkCSLFPathTracer, Interreflection, Interreflection);
cslfSetOptionMacro(vtkCSLFPathTracer, Quality, Quality);
cslfSetOptionMacro(vtkCSLFPathTracer, Samples, Samples);
cslfSetOptionMacro(vtkCSLFPathTracer, NoiseTarget, NoiseTarget);
cslfSetOptionMacro(vtkCSLFPathTracer, MaximumDepth, MaximumDepth);
cslfSetOptionMacro(vtkCSLFPathTracer, Exposure, Exposure);

void vtkCSLFPathTracer::SetEnvironment(vtkCSLFEnvironment* environment)
{
  cslf::SetOptions(this, this->Internals->Environment, environment);
}

vtkCSLFEnvironment* vtkCSLFPathTracer::GetEnvironment()
{
  return this->Internals->Environment;
}

void vtkCSLFPathTracer::SetCacheOptions(vtkCSLFRadianceCacheOptions* cacheOptions)
{
  cslf::SetOptions(this, this->Internals->CacheOptions, cacheOptions);
}

vtkCSLFRadianceCacheOptions* vtkCSLFPathTracer::GetCacheOptions()
{
  return this->Internals->CacheOptions;
}

void vtkCSLFPathTracer::SetRenderer(vtkRenderer* renderer)
{
  if (this->GetRenderer() == renderer)
  {
    return;
  }
  this->Internals->Importer = nullptr;
  if (renderer)
  {
    this->Internals->Importer = vtkSmartPointer<vtkCSLFSceneImporter>::New();
    this->Internals->Importer->SetRenderer(renderer);
  }
  this->Modified();
}

vtkRenderer* vtkCSLFPathTracer::GetRenderer()
{
  vtkCSLFSceneImporter* importer = this->Internals->Importer;
  return importer ? importer->GetRenderer() : nullptr;
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
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
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
    // Otherwise the output's extent would be requested from the inputs' sources, such as image
    // data.
    info->Remove(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
    // Another way of splitting would make sources that are up to date execute again.
    vtkExtentTranslator::UPDATE_SPLIT_MODE()->Remove(info);
  }
  return 1;
}

std::vector<vtkDataObject*> vtkCSLFPathTracer::GetSceneInputs(vtkInformationVector** inputVector)
{
  std::vector<vtkDataObject*> inputs = GetInputs(inputVector[0]);
  if (vtkCSLFSceneImporter* importer = this->Internals->Importer)
  {
    importer->SetInterpolateDisplayedColors(this->InterpolateDisplayedColors);
    importer->SetExactColors(this->Colors == Exact);
    importer->SetSurfaceArraySelection(this->FindKeptArrays());
    std::optional<cslf::Phase> phase;
    const auto report = [this, &phase](vtkAlgorithm* running)
    {
      if (!phase)
      {
        phase.emplace(this, "Importing the scene", ImportProgress);
      }
      return phase->Report(running->GetProgress());
    };
    const cslf::PipelineWatch watch({ importer }, report);
    importer->Update();
    inputs.push_back(importer->GetOutput());
  }
  return inputs;
}

const cslf::BuiltScene* vtkCSLFPathTracer::UpdateScene(vtkInformationVector** inputVector)
{
  if (auto* executive = dynamic_cast<cslf::ScenePipeline*>(this->GetExecutive()))
  {
    executive->SetGathered();
  }
  const std::vector<vtkDataObject*> inputs = this->GetSceneInputs(inputVector);
  // Other ranks are met in BuildScene.
  if (cslf::IsAborted(this) && !this->MustGather())
  {
    return nullptr;
  }
  const std::string key = this->MakeSceneKey(inputs);
  if (this->Internals->SceneKey != key)
  {
    this->Internals->SceneKey.clear();
    this->Internals->CacheKey.clear();
    this->Internals->Cache.reset();
    this->Internals->IsProbe = false;
    if (!this->BuildScene(inputs))
    {
      return nullptr;
    }
    this->Internals->SceneKey = this->MakeSceneKey(inputs);
  }
  return &this->Internals->Scene;
}

void vtkCSLFPathTracer::WritePipelineTimes(std::ostream& key)
{
  // All ranks must detect a change together. Data may change on some ranks only, for example if the
  // source cannot make pieces and the other ranks have no data. The pipeline changes on all ranks.
  for (int i = 0; i < this->GetNumberOfInputConnections(0); ++i)
  {
    auto* executive = vtkDemandDrivenPipeline::SafeDownCast(this->GetInputExecutive(0, i));
    key << (executive ? executive->GetPipelineMTime() : 0) << ' ';
    vtkInformation* info = this->GetInputInformation(0, i);
    if (info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
    {
      key << info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()) << ' ';
    }
  }
  if (vtkCSLFSceneImporter* importer = this->Internals->Importer)
  {
    key << importer->GetMTime() << ' ';
  }
}

std::string vtkCSLFPathTracer::MakeSceneKey(const std::vector<vtkDataObject*>& inputs)
{
  std::ostringstream key;
  key << std::setprecision(17);
  if (this->MustGather())
  {
    this->WritePipelineTimes(key);
  }
  else
  {
    for (vtkDataObject* input : inputs)
    {
      WriteTimes(input, key);
    }
  }
  vtkScalarsToColors* table = this->Internals->LookupTable;
  vtkDataArraySelection* kept = this->FindKeptArrays();
  key << this->Colors << ' ' << this->DistributedScene << ' ' << this->MustGather() << ' '
      << this->ScalarVisibility << ' ' << this->GetInputArrayInformation(0)->GetMTime() << ' '
      << (table ? table->GetMTime() : 0) << ' ' << (kept ? kept->GetMTime() : 0) << ' ';
  WriteEnvironment(this->Internals->Environment, key);
  return key.str();
}

bool vtkCSLFPathTracer::BuildScene(const std::vector<vtkDataObject*>& inputs)
{
  cslf::SceneOptions sceneOptions;
  std::string error;
  if (inputs.empty())
  {
    error = "There is neither an input nor a renderer.";
  }
  else
  {
    // Before the ranks meet, an exception must not keep one away.
    cslf::Guard([&]
      { return MakeEnvironment(this->Internals->Environment, sceneOptions.Surroundings, error); },
      error);
  }
  std::vector<vtkSmartPointer<vtkDataObject>> parts(inputs.begin(), inputs.end());
  // If one rank cannot take part, the others learn it here.
  if (this->MustGather())
  {
    this->GatherScene(parts, sceneOptions.Ranks, error);
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
    return false;
  }
  sceneOptions.LookupTable = this->Internals->LookupTable;
  bool hasTexts = false;
  sceneOptions.FindScalars = [this, &hasTexts](vtkPolyData* data, bool& ofCells) -> vtkDataArray*
  {
    if (!this->ScalarVisibility)
    {
      return nullptr;
    }
    int association = vtkDataObject::FIELD_ASSOCIATION_NONE;
    vtkAbstractArray* found = this->GetInputAbstractArrayToProcess(0, data, association);
    auto* array = vtkDataArray::SafeDownCast(found);
    hasTexts = hasTexts || (found && !array);
    ofCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
    const bool usable = ofCells || association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
    return usable ? array : nullptr;
  };
  if (vtkDataArraySelection* kept = this->FindKeptArrays())
  {
    sceneOptions.KeepsArray = [kept](const std::string& name)
    { return kept->ArrayIsEnabled(name.c_str()) != 0; };
  }
  sceneOptions.ExactColors = this->Colors == Exact;
  sceneOptions.InPieces = this->DistributedScene;
  std::optional<cslf::Phase> phase;
  phase.emplace(this, "Reading the scene", ReadProgress);
  sceneOptions.Reading = [&phase](double share) { return phase->Report(share); };
  sceneOptions.Building = [this, &phase, isFirst = true](double share) mutable
  {
    if (std::exchange(isFirst, false))
    {
      phase.emplace(this, "Building the tree of the scene", BuiltProgress);
    }
    return phase->Report(share);
  };
  this->Internals->Scene = cslf::BuildScene({ parts.begin(), parts.end() }, sceneOptions);
  phase.reset();
  if (!this->Internals->Scene.World)
  {
    if (this->Internals->Scene.IsAborted)
    {
      return false;
    }
    if (this->Internals->Scene.IsEmpty && this->Internals->Importer)
    {
      vtkErrorMacro(
        "No visible surface was found in the renderer: add a visible actor whose mapper "
        "draws polygons, lines or points, or a volume. "
        << this->Internals->Scene.Warning);
      return false;
    }
    vtkErrorMacro(<< this->Internals->Scene.Error);
    return false;
  }
  if (this->Interreflection == Neutral && this->GetUsedIntegrator() != RadianceCaching)
  {
    vtkWarningMacro("Interreflection is neutral only with radiance caching.");
  }
  if (!this->Internals->Scene.Warning.empty())
  {
    vtkWarningMacro(<< this->Internals->Scene.Warning);
  }
  if (hasTexts)
  {
    vtkWarningMacro("The array to color by is not numeric and was ignored: choose another one with "
                    "SetInputArrayToProcess.");
  }
  return true;
}

void vtkCSLFPathTracer::GatherScene(
  std::vector<vtkSmartPointer<vtkDataObject>>& parts, std::vector<int>& ranks, std::string& error)
{
  this->GatheredBytes = 0;
  cslf::SceneGather gather(this->Controller, cslf::GetArithmetic());
  if (!gather.Begin({ parts.begin(), parts.end() }, error))
  {
    return;
  }
  this->GatheredBytes = gather.GetCost().Pieces;
  vtkDebugMacro("Gathering a scene of " << this->GatheredBytes << " bytes.");
  const std::string warning = gather.GetCost().FindWarning();
  if (!warning.empty() && this->Controller->GetLocalProcessId() == 0)
  {
    vtkWarningMacro(<< warning);
  }
  if (!gather.AreAlike() && this->Controller->GetLocalProcessId() == 0)
  {
    vtkWarningMacro("The ranks' processors or libraries compute differently, so the last bits of a "
                    "texel depend on its rank: use processors of one kind and the same libraries.");
  }
  if (gather.Finish(error))
  {
    parts = gather.GetObjects();
    ranks = gather.GetRanks();
  }
}

bool vtkCSLFPathTracer::MustGather()
{
  return this->DistributedScene && this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

std::string vtkCSLFPathTracer::DescribeSampling()
{
  vtkCSLFEnvironment* environment = this->Internals->Environment;
  nlohmann::json sampling = { { "scene", this->Internals->Scene.Fingerprint },
    { "arithmetic", cslf::GetArithmetic() },
    { "integrator",
      this->GetUsedIntegrator() == RadianceCaching ? "radiance-caching" : "path-tracing" },
    { options::Quality.Key, options::Quality.Names[this->Quality] },
    { options::Samples.Key, this->GetUsedSamples() },
    { options::MaximumDepth.Key, this->GetUsedMaximumDepth() }, { options::Seed.Key, this->Seed },
    { options::Exposure.Key, this->GetUsedExposure() },
    { options::ShowEnvironment.Key, environment->GetShow() },
    { "environment", DescribeEnvironment(environment, this->Internals->Scene.HasEnvironment) } };
  if (this->GetUsedNoiseTarget() > 0.0)
  {
    sampling[options::NoiseTarget.Key] = this->GetUsedNoiseTarget();
  }
  if (this->Colors == Exact)
  {
    sampling[options::Colors.Key] = options::Colors.Names[this->Colors];
  }
  if (this->GetUsedIntegrator() == RadianceCaching)
  {
    if (this->Interreflection == Neutral)
    {
      sampling[options::Interreflection.Key] = options::Interreflection.Names[Neutral];
    }
    vtkCSLFRadianceCacheOptions* cacheOptions = this->Internals->CacheOptions;
    sampling["cache"] = { { options::CacheTolerance.Key, this->GetUsedCacheTolerance() },
      { options::CacheSpacing.Key, cacheOptions->GetSpacing() },
      { options::CacheSamples.Key, this->GetUsedCacheSamples() } };
    const cslf::RadianceCache* cache = this->Internals->Cache.get();
    if (cache && !this->Internals->CacheKey.empty() && cache->IsCoarsened())
    {
      sampling["cache"]["used_spacing"] = 0.5 * cache->GetSpacing();
    }
    if (cache && !this->Internals->CacheKey.empty() && cache->GetCheck().Texels > 0)
    {
      const cslf::CacheCheck& check = cache->GetCheck();
      sampling["cache"]["check"] = { { "texels", check.Texels }, { "mean", check.Mean },
        { "mean_error", check.MeanError }, { "rms", check.RMS }, { "rms_error", check.RMSError } };
    }
  }
  return sampling.dump();
}

void vtkCSLFPathTracer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Colors: " << this->Colors << "\n";
  os << indent << "Interreflection: " << this->Interreflection << "\n";
  os << indent << "Integrator: " << this->Integrator << "\n";
  os << indent << "CacheOptions:\n";
  this->Internals->CacheOptions->PrintSelf(os, indent.GetNextIndent());
  os << indent << "CheckedTexels: " << this->CheckedTexels << "\n";
  os << indent << "CacheMeanDifference: " << this->CacheMeanDifference << " +- "
     << this->CacheMeanDifferenceError << "\n";
  os << indent << "CacheRMSDifference: " << this->CacheRMSDifference << " +- "
     << this->CacheRMSDifferenceError << "\n";
  os << indent << "UsedCacheSpacing: " << this->UsedCacheSpacing << "\n";
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n";
  os << indent << "NumberOfCacheRays: " << this->NumberOfCacheRays << "\n";
  os << indent << "NumberOfCachePoints: " << this->NumberOfCachePoints << "\n";
  os << indent << "RenderSeconds: " << this->RenderSeconds << "\n";
  os << indent << "CacheSeconds: " << this->CacheSeconds << "\n";
  os << indent << "CacheProbeSeconds: " << this->CacheProbeSeconds << "\n";
  os << indent << "ExpectedCacheSeconds: " << this->ExpectedCacheSeconds << "\n";
  os << indent << "Quality: " << this->Quality << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "NoiseTarget: " << this->NoiseTarget << "\n";
  os << indent << "MaximumDepth: " << this->MaximumDepth << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "Environment:\n";
  this->Internals->Environment->PrintSelf(os, indent.GetNextIndent());
  os << indent << "ScalarVisibility: " << this->ScalarVisibility << "\n";
  os << indent << "InterpolateDisplayedColors: " << this->InterpolateDisplayedColors << "\n";
  os << indent << "Renderer: " << this->GetRenderer() << "\n";
  os << indent << "DistributedScene: " << this->DistributedScene << "\n";
  os << indent << "GatheredBytes: " << this->GatheredBytes << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "LookupTable: " << this->Internals->LookupTable.Get() << "\n";
}
