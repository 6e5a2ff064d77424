// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFSeriesWriter.h"

#include "Coding/Codecs/cslfAV.h"
#include "Coding/Reading/cslfFieldReader.h"
#include "Files/cslfFileSeries.h"
#include "Files/cslfFileSystem.h"
#include "Files/cslfWorkFolder.h"
#include "PathTracing/Scene/cslfFingerprint.h"
#include "Pipeline/cslfGuard.h"
#include "cslfCube.h"
#include "cslfDescription.h"
#include "cslfJSON.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneLook.h"

#include <vtkBoundingBox.h>
#include <vtkCommand.h>
#include <vtkCommunicator.h>
#include <vtkInformation.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

vtkStandardNewMacro(vtkCSLFSeriesWriter);
vtkCxxSetSmartPointerMacro(vtkCSLFSeriesWriter, Encoder, vtkCSLFEncoder);
vtkCxxSetSmartPointerMacro(vtkCSLFSeriesWriter, Look, vtkCSLFSceneLook);
vtkCxxSetSmartPointerMacro(vtkCSLFSeriesWriter, Sampler, vtkCSLFSampler);

namespace
{
/// The digits of a step's number in a file name, at least.
constexpr int NumberDigits = 4;

/// The finished steps of an unfinished series, in its work folder.
constexpr const char* StepsName = "steps.json";

bool IsSteps(const std::string& name)
{
  return name == StepsName;
}

std::string HashText(const std::string& text)
{
  cslf::Fingerprint hash;
  hash.Add(std::vector<char>(text.begin(), text.end()));
  return hash.Finish();
}

/// Whether a file is a whole light field of the scene with that hash.
bool IsWhole(const std::string& fileName, const std::string& scene)
{
  const cslf::AVLogSilence silence;
  cslf::OpenError ignored;
  const std::shared_ptr<cslf::FieldReader> file = cslf::FieldReader::Open(fileName, ignored);
  if (!file)
  {
    return false;
  }
  const auto sampling = nlohmann::json::parse(file->GetHeader().Field.Sampling, nullptr, false);
  const auto found = sampling.find("scene");
  return found != sampling.end() && *found == scene && file->GetHeader().Missing.empty() &&
    cslf::FieldView(file, 0).FindMissing([](double) { return true; }).empty();
}

/// Sets a sampler's cube, and restores it at the end.
class CubeSetting
{
public:
  explicit CubeSetting(vtkCSLFSampler* sampler)
    : Sampler(sampler)
    , IsAutomatic(sampler->GetAutomaticCube())
  {
    sampler->GetCubeCenter(this->Center);
    sampler->GetCubeEdges(this->Edges);
  }
  ~CubeSetting()
  {
    this->Sampler->SetAutomaticCube(this->IsAutomatic);
    this->Sampler->SetCubeCenter(this->Center);
    this->Sampler->SetCubeEdges(this->Edges);
  }
  CubeSetting(const CubeSetting&) = delete;
  CubeSetting& operator=(const CubeSetting&) = delete;

private:
  vtkCSLFSampler* Sampler;
  bool IsAutomatic;
  double Center[3];
  double Edges[3];
};

/// Lets a look's ranges grow, until the end.
class GrowingRanges
{
public:
  explicit GrowingRanges(vtkCSLFSceneLook* look)
    : Look(look)
    , IsGrowing(look && look->GetGrowColorRange())
  {
    if (look)
    {
      look->GrowColorRangeOn();
    }
  }
  ~GrowingRanges()
  {
    if (this->Look)
    {
      this->Look->SetGrowColorRange(this->IsGrowing);
    }
  }
  GrowingRanges(const GrowingRanges&) = delete;
  GrowingRanges& operator=(const GrowingRanges&) = delete;

private:
  vtkCSLFSceneLook* Look;
  bool IsGrowing;
};
}

namespace cslf
{
/// The index that is being made, on the first rank.
class SeriesIndex
{
public:
  /// An index that may exist.
  explicit SeriesIndex(const std::string& fileName)
    : FileName(fileName)
    , Work(fileName, IsSteps)
  {
  }

  /// Excludes other writers. With `restart`, finds what earlier runs have finished.
  bool Open(bool restart, std::string& error)
  {
    if (!this->Work.Reserve(error))
    {
      return false;
    }
    std::string ignored;
    for (const std::string& name : { this->FileName, this->Work.GetName(StepsName) })
    {
      const auto earlier = restart ? FileSeries::Read(name, ignored) : std::nullopt;
      for (std::size_t i = 0; earlier && i < earlier->Files.size(); ++i)
      {
        this->Remember(earlier->Files[i]);
      }
    }
    return true;
  }

  /// The path of a file.
  std::string GetPath(const std::string& name) const
  {
    return ToName(ToPath(this->FileName).parent_path() / ToPath(name));
  }

  bool IsKnown(const SeriesFile& file) const
  {
    return std::any_of(this->Known.Files.begin(), this->Known.Files.end(),
      [&file](const SeriesFile& known)
      { return known.Name == file.Name && known.Hash == file.Hash; });
  }

  /// Makes way for a file that replaces an earlier one: an index that names that must go first.
  bool Prepare(std::string& error)
  {
    std::error_code ignored;
    return this->IsPrepared ||
      (this->Keep(error) &&
        (this->IsPrepared = !std::filesystem::exists(ToPath(this->FileName), ignored) ||
            RemoveFile(ResolveTarget(this->FileName))));
  }

  /// Adds a finished file.
  bool Add(const SeriesFile& file, std::string& error)
  {
    this->Made.Files.push_back(file);
    this->Remember(file);
    return this->Keep(error);
  }

  bool Publish(bool replaces, std::string& warning, std::string& error)
  {
    const std::string text = this->Made.ToText();
    const std::string name =
      this->Work.GetScratchName(ToName(ToPath(this->Work.GetTarget()).filename()));
    if (!MakeFile(name, text.data(), text.size(), error) ||
      !PublishFile(name, this->Work.GetTarget(), error, replaces))
    {
      return false;
    }
    this->Work.Close(warning);
    return true;
  }

private:
  void Remember(const SeriesFile& file)
  {
    std::vector<SeriesFile>& files = this->Known.Files;
    files.erase(std::remove_if(files.begin(), files.end(),
                  [&file](const SeriesFile& known)
                  { return known.Name == file.Name || known.Time == file.Time; }),
      files.end());
    files.push_back(file);
  }

  /// Nothing is kept if nothing is known.
  bool Keep(std::string& error) const
  {
    if (this->Known.Files.empty())
    {
      return true;
    }
    const std::string text = this->Known.ToText();
    return this->Work.Write(StepsName, text.data(), text.size(), error);
  }

  std::string FileName;
  WorkFolder Work;
  FileSeries Known; ///< of this run and earlier ones
  FileSeries Made;
  bool IsPrepared = false;
};
}

vtkCSLFSeriesWriter::vtkCSLFSeriesWriter() = default;
vtkCSLFSeriesWriter::~vtkCSLFSeriesWriter() = default;

vtkCSLFSampler* vtkCSLFSeriesWriter::GetSampler()
{
  return this->Sampler;
}

vtkCSLFEncoder* vtkCSLFSeriesWriter::GetEncoder()
{
  return this->Encoder;
}

vtkCSLFSceneLook* vtkCSLFSeriesWriter::GetLook()
{
  return this->Look;
}

std::string vtkCSLFSeriesWriter::GetIndexName() const
{
  const char* name = this->Encoder ? this->Encoder->GetFileName() : nullptr;
  return name ? std::string(name) + cslf::FileSeriesExtension : std::string();
}

bool vtkCSLFSeriesWriter::Fail(const std::string& text)
{
  vtkErrorMacro(<< text);
  return false;
}

bool vtkCSLFSeriesWriter::IsFirstRank() const
{
  vtkMultiProcessController* controller = this->Encoder->GetController();
  return !controller || controller->GetLocalProcessId() == 0;
}

// Whether it is so on all ranks, so that all of them go on or end. What only the first one knows is
// true on the others.
bool vtkCSLFSeriesWriter::Agree(bool isSo) const
{
  int mine = isSo ? 1 : 0;
  int all = mine;
  vtkMultiProcessController* controller = this->Encoder->GetController();
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    controller->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  }
  return all != 0;
}

void vtkCSLFSeriesWriter::RequestTime(double time)
{
  for (int port = 0; port < this->Sampler->GetNumberOfOutputPorts(); ++port)
  {
    this->Sampler->GetOutputInformation(port)->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  }
}

bool vtkCSLFSeriesWriter::FindSteps(std::vector<Step>& steps)
{
  this->Sampler->UpdateInformation();
  vtkInformation* information = this->Sampler->GetOutputInformation(0);
  vtkInformationDoubleVectorKey* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  const int count = information->Has(key) ? information->Length(key) : 0;
  if (count == 0)
  {
    return this->Fail("The input of the sampler has no time steps.");
  }
  const double* times = information->Get(key);
  for (int i = 0; i < count; ++i)
  {
    if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
    {
      return this->Fail("The times of the input are not finite, or do not increase.");
    }
  }
  for (int i = std::max(0, this->TimeStepRange[0]); i < count && i <= this->TimeStepRange[1];
       i += std::min(this->TimeStepInterval, count))
  {
    steps.push_back({ i, times[i] });
  }
  return !steps.empty() ||
    this->Fail("There are no such time steps: the input has " + std::to_string(count) +
      ", numbered from 0.");
}

// Places the cube around all steps. The ranges of colours grow meanwhile.
bool vtkCSLFSeriesWriter::FixCube(const std::vector<Step>& steps)
{
  vtkBoundingBox box;
  for (const Step& step : steps)
  {
    this->RequestTime(step.Time);
    if (!this->Agree(!this->Sampler->UpdateRecord().empty()))
    {
      return false;
    }
    box.AddBounds(this->Sampler->GetSceneBounds());
  }
  if (this->Sampler->GetAutomaticCube())
  {
    double bounds[6];
    box.GetBounds(bounds);
    const cslf::Cube cube = cslf::Cube::FromBounds(bounds, this->Sampler->GetOffset());
    this->Sampler->AutomaticCubeOff();
    this->Sampler->SetCubeCenter(cube.Center.x, cube.Center.y, cube.Center.z);
    this->Sampler->SetCubeEdges(cube.Edges.x, cube.Edges.y, cube.Edges.z);
  }
  return true;
}

int vtkCSLFSeriesWriter::Write()
{
  this->NumberOfSteps = 0;
  this->DoneSteps = 0;
  this->KeptSteps = 0;
  if (!this->Sampler || !this->Encoder || this->GetIndexName().empty())
  {
    return this->Fail("There is no sampler, no encoder, or no name of its file.") ? 1 : 0;
  }
  const std::string name = this->Encoder->GetFileName();
  const bool isWritten =
    cslf::GuardMethod(this, "The series was not written", [this] { return this->WriteSteps(); });
  this->Encoder->SetFileName(name.c_str());
  return isWritten ? 1 : 0;
}

bool vtkCSLFSeriesWriter::WriteSteps()
{
  std::vector<Step> steps;
  if (!this->FindSteps(steps))
  {
    return false;
  }
  this->NumberOfSteps = static_cast<int>(steps.size());
  const std::string indexName = this->GetIndexName();
  const CubeSetting cube(this->Sampler);
  const GrowingRanges ranges(this->Look);
  std::string error;
  std::optional<cslf::SeriesIndex> index;
  std::error_code ignored;
  if (this->IsFirstRank())
  {
    if (!this->Encoder->GetOverwrite() && std::filesystem::exists(cslf::ToPath(indexName), ignored))
    {
      error = "it exists";
    }
    else if (!index.emplace(indexName).Open(this->Encoder->GetRestart(), error))
    {
      error = error.empty() ? "it cannot be made" : error;
    }
  }
  if (!this->Agree(error.empty()))
  {
    return this->IsFirstRank() && this->Fail("Cannot write " + indexName + ": " + error + ".");
  }
  const bool hasRange = !this->Look || !this->Look->GetAutomaticColorRange();
  if ((this->Sampler->GetAutomaticCube() || !hasRange) && !this->FixCube(steps))
  {
    return false;
  }
  const std::filesystem::path path = cslf::ToPath(this->Encoder->GetFileName());
  for (const Step& step : steps)
  {
    std::ostringstream number;
    number << "_" << std::setw(NumberDigits) << std::setfill('0') << step.Number;
    this->StepFileName = cslf::ToName(path.parent_path() / path.stem()) + number.str() +
      cslf::ToName(path.extension());
    this->InvokeEvent(vtkCommand::StartEvent);
    if (!this->WriteStep(step, index ? &*index : nullptr))
    {
      return false;
    }
    ++this->DoneSteps;
  }
  std::string warning;
  if (index && !index->Publish(this->Encoder->GetOverwrite(), warning, error))
  {
    return this->Fail("Cannot write " + indexName + ": " + error + ".");
  }
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  return true;
}

// Writes a step unless it is finished.
bool vtkCSLFSeriesWriter::WriteStep(const Step& step, cslf::SeriesIndex* index)
{
  this->RequestTime(step.Time);
  const std::string record = this->Sampler->UpdateRecord();
  if (!this->Agree(!record.empty()))
  {
    return false;
  }
  const std::string name = cslf::ToName(cslf::ToPath(this->StepFileName).filename());
  const cslf::SeriesFile file{ name, step.Time, HashText(record + this->Encoder->MakeRecord()) };
  std::string error;
  if (this->Agree(!index ||
        (index->IsKnown(file) && IsWhole(this->StepFileName, this->Sampler->GetSceneHash()))))
  {
    ++this->KeptSteps;
  }
  else
  {
    if (!this->Agree(!index || index->Prepare(error)))
    {
      return index && this->Fail("Cannot replace the earlier series: " + error + ".");
    }
    this->Encoder->SetFileName(this->StepFileName.c_str());
    if (!this->Encoder->Write())
    {
      return false;
    }
  }
  return this->Agree(!index || index->Add(file, error)) ||
    (index &&
      this->Fail("Cannot note that " + this->StepFileName + " is finished: " + error + "."));
}

void vtkCSLFSeriesWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Sampler: " << this->Sampler << "\n";
  os << indent << "Encoder: " << this->Encoder << "\n";
  os << indent << "Look: " << this->Look << "\n";
  os << indent << "TimeStepRange: " << this->TimeStepRange[0] << ", " << this->TimeStepRange[1]
     << "\n";
  os << indent << "TimeStepInterval: " << this->TimeStepInterval << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "DoneSteps: " << this->DoneSteps << "\n";
  os << indent << "KeptSteps: " << this->KeptSteps << "\n";
  os << indent << "StepFileName: " << this->StepFileName << "\n";
}
