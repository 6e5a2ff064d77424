// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFEncoder.h"

#include "Certificate/cslfCertifier.h"
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Coding/Writing/cslfEncodeSession.h"
#include "Options/cslfOption.h"
#include "Options/cslfOptionTable.h"
#include "PathTracing/RadianceCache/cslfCacheKeeper.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfDescription.h"
#include "cslfJSON.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkCSLFEncoder);
vtkCxxSetObjectMacro(vtkCSLFEncoder, Controller, vtkMultiProcessController);
namespace options = cslf::options;

namespace
{
/// The progress of writing when filters that bake have made their first output.
constexpr double InputProgress = 0.25;

/// The quality that a filter bakes in, if it bakes.
std::optional<int> GetBakeQuality(vtkAlgorithm* filter)
{
  return filter->GetNumberOfOutputPorts() > 0
    ? cslf::GetBakeQuality(filter->GetOutputInformation(0))
    : std::nullopt;
}

/// The scene of a connection's field, or null.
const cslf::TracedScene* FindScene(vtkAlgorithmOutput* connection)
{
  for (const auto& producer : cslf::FindProducers(connection))
  {
    const cslf::TracedScene* scene = producer->GetNumberOfOutputPorts() > 0
      ? cslf::FindScene(producer->GetOutputInformation(0))
      : nullptr;
    if (scene)
    {
      return scene;
    }
  }
  return nullptr;
}

/// The hash of a field's scene. Empty if it is not recorded.
std::string GetSceneHash(const cslf::Description& field)
{
  const auto sampling = nlohmann::json::parse(field.Sampling, nullptr, false);
  const auto scene = sampling.find("scene");
  return scene != sampling.end() && scene->is_string() ? scene->get<std::string>() : std::string();
}

/// Lends a keeper to the filters that bake and feed a connection while this object exists. They
/// execute at the next update, so that all ranks meet.
class CacheKeeping
{
public:
  CacheKeeping(vtkAlgorithmOutput* connection, cslf::CacheKeeper* keeper)
    : Filters(cslf::FindProducers(connection))
  {
    this->Filters.erase(std::remove_if(this->Filters.begin(), this->Filters.end(),
                          [](vtkAlgorithm* filter) { return !GetBakeQuality(filter); }),
      this->Filters.end());
    for (const auto& filter : this->Filters)
    {
      cslf::LendCacheKeeper(filter->GetOutputInformation(0), keeper);
      filter->Modified();
    }
  }
  ~CacheKeeping()
  {
    for (const auto& filter : this->Filters)
    {
      cslf::LendCacheKeeper(filter->GetOutputInformation(0), nullptr);
    }
  }
  CacheKeeping(const CacheKeeping&) = delete;
  CacheKeeping& operator=(const CacheKeeping&) = delete;

private:
  std::vector<vtkSmartPointer<vtkAlgorithm>> Filters;
};
}

class vtkCSLFEncoder::PartList
{
public:
  std::vector<cslf::FilePart> Parts;
};

vtkCSLFEncoder::vtkCSLFEncoder()
  : RateControl(vtkSmartPointer<vtkCSLFRateControl>::New())
  , Parts(new PartList)
  , GroupLength(options::GroupLength.Default)
  , Lossless(options::Lossless.Default)
  , DepthFromGeometry(options::DepthFromGeometry.Default)
  , Certificate(options::Certificate.Default)
  , Restart(options::Restart.Default)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(0);
  this->SetPreset(options::Preset.Default);
  this->SetCodec(options::Codec.Default);
  this->SetPixelFormat(options::PixelFormat.Default);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkCSLFEncoder::~vtkCSLFEncoder()
{
  this->SetFileName(nullptr);
  this->SetCodec(nullptr);
  this->SetPreset(nullptr);
  this->SetPixelFormat(nullptr);
  this->SetController(nullptr);
}

vtkMTimeType vtkCSLFEncoder::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->RateControl->GetMTime());
}

void vtkCSLFEncoder::SetRateControl(vtkCSLFRateControl* rateControl)
{
  cslf::SetOptions(this, this->RateControl, rateControl);
}

vtkCSLFRateControl* vtkCSLFEncoder::GetRateControl()
{
  return this->RateControl;
}

cslfSetOptionMacro(vtkCSLFEncoder, GroupLength, GroupLength);

int vtkCSLFEncoder::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkPolyData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

void vtkCSLFEncoder::SetGeometryData(vtkPolyData* geometry)
{
  this->SetInputDataInternal(1, geometry);
}

void vtkCSLFEncoder::SetInputData(vtkImageData* input)
{
  this->SetInputDataInternal(0, input);
}

vtkImageData* vtkCSLFEncoder::GetInput()
{
  return this->GetNumberOfInputConnections(0) > 0
    ? vtkImageData::SafeDownCast(this->GetInputDataObject(0, 0))
    : nullptr;
}

cslf::EncodeError vtkCSLFEncoder::FindError()
{
  vtkCSLFRateControl* rate = this->RateControl;
  const double targets[] = { rate->GetTargetRatio(), rate->GetTargetSize(), rate->GetTargetPSNR() };
  if (std::count(std::begin(targets), std::end(targets), 0.0) < 2)
  {
    return { vtkErrorCode::UserError, "Only one target of ratio, size and PSNR can be met." };
  }
  return {};
}

std::string vtkCSLFEncoder::GetUsedPreset()
{
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->UpdateInformation();
  }
  return this->FindPreset();
}

// The preset in use, by the information of the inputs.
std::string vtkCSLFEncoder::FindPreset()
{
  std::optional<int> quality;
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    for (const auto& producer : cslf::FindProducers(this->GetInputConnection(0, 0)))
    {
      quality = quality ? quality : GetBakeQuality(producer);
    }
  }
  return cslf::ChoosePreset(this->Preset, quality.value_or(options::Quality.Default));
}

cslf::EncodeSettings vtkCSLFEncoder::FindSettings()
{
  vtkCSLFRateControl* rate = this->RateControl;
  return { this->FindPreset(), this->PixelFormat ? this->PixelFormat : "", rate->GetCRF(),
    rate->GetCoverageCRF(), rate->GetDepthCRF(), this->GroupLength, this->Lossless,
    this->DepthFromGeometry,
    cslf::MakeRateTarget(rate->GetTargetRatio(), rate->GetTargetSize(), rate->GetTargetPSNR()),
    rate->GetKeyViewStep(), rate->GetTargetNovelViewPSNR(), this->Codec ? this->Codec : "" };
}

std::string vtkCSLFEncoder::MakeRecord()
{
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->UpdateInformation();
  }
  nlohmann::json record = cslf::DescribeSettings(this->FindSettings());
  record["depth_from_geometry"] = this->DepthFromGeometry;
  record["key_view_step"] = this->RateControl->GetKeyViewStep();
  record["novel_psnr"] = this->RateControl->GetTargetNovelViewPSNR();
  record["certificate"] = this->Certificate;
  record["has_geometry"] = this->GetNumberOfInputConnections(1) > 0;
  for (const cslf::FilePart& part : this->Parts->Parts)
  {
    record["parts"].push_back({ part.Type, part.Name, part.Bytes });
  }
  return record.dump();
}

cslf::EncodeJob vtkCSLFEncoder::MakeJob()
{
  cslf::EncodeJob job;
  job.FileName = this->FileName ? this->FileName : "";
  job.Settings = this->FindSettings();
  job.Parts = this->Parts->Parts;
  job.Restart = this->Restart;
  job.Overwrite = this->Overwrite;
  job.Controller = this->Controller;
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    job.Connection = this->GetInputConnection(0, 0);
    job.Input = this->GetInputInformation(0, 0);
  }
  job.GetGeometry = [this](
                      const cslf::Description& field, const std::vector<cslf::FilePart>& others)
  {
    auto* geometry = this->GetNumberOfInputConnections(1) > 0
      ? vtkPolyData::SafeDownCast(this->GetInputDataObject(1, 0))
      : nullptr;
    return geometry && geometry->GetNumberOfCells() > 0 ? this->MakePart(geometry, field, others)
                                                        : std::nullopt;
  };
  if (this->Certificate && FindScene(job.Connection))
  {
    job.Certify = [this](const std::string& fileName) { return this->Certify(fileName); };
  }
  job.Reporter = this;
  this->NumberOfGroups = 0;
  this->ResumedGroups = 0;
  job.Resume = [this](int resumed, int all)
  {
    this->ResumedGroups = resumed;
    this->NumberOfGroups = all;
  };
  job.Warn = [this](const std::string& text) { vtkWarningMacro(<< text); };
  return job;
}

std::optional<cslf::FilePart> vtkCSLFEncoder::MakePart(
  vtkPolyData* geometry, const cslf::Description& field, const std::vector<cslf::FilePart>& others)
{
  std::string fault;
  cslf::FilePart part{ cslf::GeometryPartType, cslf::GeometryPartName,
    cslf::EncodeGeometry(geometry, field.Box, field.Grid.GetResolution(), fault) };
  if (fault.empty())
  {
    fault = cslf::FindError(others, part);
  }
  if (!fault.empty())
  {
    vtkWarningMacro("The file is written without the geometry: " << fault);
    return std::nullopt;
  }
  return part;
}

// Measures a finished file. Nothing if it is not of the scene of the sampler that feeds the
// encoder.
std::optional<cslf::Certificate> vtkCSLFEncoder::Certify(const std::string& fileName)
{
  const cslf::TracedScene* scene = FindScene(this->GetInputConnection(0, 0));
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  decoder->Update(1);
  std::string error;
  const auto field = cslf::Description::FromText(decoder->GetDescription(), error);
  if (!scene || !field || GetSceneHash(*field) != scene->GetHash())
  {
    return std::nullopt;
  }
  cslf::Phase phase(this, "Comparing the file with the scene", cslf::FileAssembler::MeasuredShare);
  const auto report = [&phase](double share) { return phase.Report(share); };
  cslf::Certificate certificate;
  const auto measure = [&]
  {
    return cslf::MeasureCertificate(decoder->GetOutputPort(0), decoder->GetGeometry(), scene->Trace,
      {}, report, certificate, error);
  };
  if (!cslf::Guard(measure, error))
  {
    // The file is as good without it.
    if (!error.empty())
    {
      vtkWarningMacro("The file has no certificate: " << error);
    }
    return std::nullopt;
  }
  certificate.Scene = scene->GetHash();
  return certificate;
}

bool vtkCSLFEncoder::AddPart(const char* type, vtkUnsignedCharArray* bytes, const char* name)
{
  return cslf::GuardMethod(
    this, "The part cannot be added", [&] { return this->CopyPart(type, bytes, name); });
}

bool vtkCSLFEncoder::CopyPart(const char* type, vtkUnsignedCharArray* bytes, const char* name)
{
  cslf::FilePart part{ type ? type : "", name ? name : "", {} };
  if (bytes && bytes->GetNumberOfValues() > 0)
  {
    part.Bytes.assign(bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues());
  }
  const std::string fault = part.Type == cslf::GeometryPartType
    ? "The geometry is no part to be added: connect it to input port 1."
    : cslf::FindError(this->Parts->Parts, part);
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
    return false;
  }
  this->Parts->Parts.push_back(std::move(part));
  this->Modified();
  return true;
}

int vtkCSLFEncoder::GetNumberOfParts() const
{
  return static_cast<int>(this->Parts->Parts.size());
}

void vtkCSLFEncoder::RemoveAllParts()
{
  if (!this->Parts->Parts.empty())
  {
    this->Parts->Parts.clear();
    this->Modified();
  }
}

bool vtkCSLFEncoder::CanEncode(const char* codec)
{
  const auto found = cslf::CodecOfName(codec ? codec : "");
  return found && cslf::HasEncoder(*found);
}

bool vtkCSLFEncoder::Report(const cslf::EncodeSession& session)
{
  const cslf::EncodeError& fault = session.GetError();
  const cslf::EncodeOutcome& outcome = session.GetOutcome();
  this->ActualCRF = outcome.CRF;
  this->ActualSize = outcome.Bytes;
  this->ActualRatio = outcome.Ratio;
  this->ActualPSNR = outcome.PSNR;
  this->ActualKeyViewStep = outcome.KeyViewStep;
  this->ActualNovelViewPSNR = outcome.NovelViewPSNR;
  this->ActualDepthFromGeometry = outcome.ComputesDepth;
  this->ActualGeometryLoss = outcome.GeometryLoss;
  this->ActualColorFromGeometry = outcome.ColorShare;
  this->SetErrorCode(fault.Code);
  // The interpreter's user knows why it ended.
  if (!fault.Text.empty() && !cslf::IsInterrupted())
  {
    vtkErrorMacro(<< fault.Text);
  }
  return fault.Code == vtkErrorCode::NoError;
}

int vtkCSLFEncoder::Write()
{
  const std::string name = this->FileName ? this->FileName : "The file";
  this->SetErrorCode(vtkErrorCode::UnknownError);
  cslf::ResetAbort(this);
  return cslf::GuardMethod(this, name + " was not written", [this] { return this->WriteInput(); });
}

int vtkCSLFEncoder::WriteInput()
{
  cslf::EncodeError fault = this->FindError();
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    fault = { vtkErrorCode::UnknownError, "There is no input to write." };
  }
  else if (!this->GetInputAlgorithm()->GetExecutive()->UpdateInformation())
  {
    fault = { vtkErrorCode::UnknownError, "The input could not provide its information." };
  }
  std::optional<cslf::CacheKeeper> keeper;
  cslf::EncodeJob job = this->MakeJob();
  const cslf::KeptRequests requests(job.Connection);
  job.Synchronize = [&keeper](bool hasSucceeded) { return keeper->Synchronize(hasSucceeded); };
  cslf::EncodeSession session(job);
  if (session.Check(fault))
  {
    keeper.emplace(this->Controller, session.GetCacheFile(), job.Warn);
    // A filter that bakes executes to use the keeper, so what is there would be sampled again.
    std::optional<CacheKeeping> keeping;
    if (!cslf::IsWholeThere(job.Connection))
    {
      keeping.emplace(job.Connection, &*keeper);
    }
    // Write always writes, even if nothing changed. The input may fail with an exception.
    this->Modified();
    this->Session = &session;
    this->UpdateProgress(0.0);
    std::string problem;
    cslf::Guard([this] { return this->UpdateInputs(); }, problem);
    this->SetProgressShiftScale(0.0, 1.0);
    this->Session = nullptr;
    if (!session.HasWritten())
    {
      session.Write(false, problem);
    }
    this->SetProgressText(nullptr);
  }
  return this->Report(session) ? 1 : 0;
}

// Updates the inputs and then this filter. Those that bake take a share of the progress for what
// they make at first: the scene, the cache, one viewpoint and the geometry.
bool vtkCSLFEncoder::UpdateInputs()
{
  const auto inputs = cslf::FindInputs(this);
  const auto report = [this](vtkAlgorithm* input)
  {
    if (this->Session->HasWritten())
    {
      return true;
    }
    // What follows begins here. The executive also reports 0 before it.
    const double share = std::max(
      this->GetProgress(), GetBakeQuality(input) ? InputProgress * input->GetProgress() : 0.0);
    this->SetProgressShiftScale(share, 1.0 - share);
    this->SetProgressText(input->GetProgressText());
    this->UpdateProgress(0.0);
    if (cslf::IsAborted(this))
    {
      this->Session->Stop();
    }
    return !this->Session->IsToStop();
  };
  const cslf::PipelineWatch watch(inputs, report);
  return this->GetExecutive()->Update() != 0;
}

vtkTypeBool vtkCSLFEncoder::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    // One viewpoint is enough at first: the session requests what it needs.
    vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
    int extent[6];
    inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
    extent[5] = extent[4];
    cslf::RequestFirstPart(inInfo, extent);
    return 1;
  }
  return cslf::GuardRequest(this, request, outputVector,
    [&]
    {
      if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
      {
        this->WriteRequested();
        return 1;
      }
      return this->Superclass::ProcessRequest(request, inputVector, outputVector);
    });
}

// Failures are in the error code: a failed request would only add the executive's message.
void vtkCSLFEncoder::WriteRequested()
{
  if (this->Session)
  {
    this->Session->Write(true);
    return;
  }
  const cslf::KeptRequests requests(this->GetInputConnection(0, 0));
  cslf::EncodeSession session(this->MakeJob());
  if (session.Check(this->FindError()))
  {
    session.Write(true);
  }
  this->Report(session);
}

void vtkCSLFEncoder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Codec: " << (this->Codec ? this->Codec : "(none)") << "\n";
  os << indent << "RateControl:\n";
  this->RateControl->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Preset: " << (this->Preset ? this->Preset : "(none)") << "\n";
  os << indent << "PixelFormat: " << (this->PixelFormat ? this->PixelFormat : "(none)") << "\n";
  os << indent << "GroupLength: " << this->GroupLength << "\n";
  os << indent << "Lossless: " << (this->Lossless ? "On" : "Off") << "\n";
  os << indent << "DepthFromGeometry: " << (this->DepthFromGeometry ? "On" : "Off") << "\n";
  os << indent << "Certificate: " << (this->Certificate ? "On" : "Off") << "\n";
  os << indent << "NumberOfParts: " << this->GetNumberOfParts() << "\n";
  os << indent << "Restart: " << (this->Restart ? "On" : "Off") << "\n";
  os << indent << "Overwrite: " << (this->Overwrite ? "On" : "Off") << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "ActualCRF: " << this->ActualCRF << "\n";
  os << indent << "ActualSize: " << this->ActualSize << "\n";
  os << indent << "ActualRatio: " << this->ActualRatio << "\n";
  os << indent << "ActualPSNR: " << this->ActualPSNR << "\n";
  os << indent << "ActualKeyViewStep: " << this->ActualKeyViewStep << "\n";
  os << indent << "ActualNovelViewPSNR: " << this->ActualNovelViewPSNR << "\n";
  os << indent << "ActualDepthFromGeometry: " << (this->ActualDepthFromGeometry ? "yes" : "no")
     << "\n";
  os << indent << "ActualGeometryLoss: " << this->ActualGeometryLoss << "\n";
  os << indent << "ActualColorFromGeometry: " << this->ActualColorFromGeometry << "\n";
}
