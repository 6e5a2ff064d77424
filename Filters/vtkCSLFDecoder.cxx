// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFDecoder.h"

#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Coding/Reading/cslfFieldReader.h"
#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfFieldStore.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfJoin.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkCSLFDecoder);

namespace
{
/// The progress when it is known which viewpoints can be decoded.
constexpr double CheckedProgress = 0.1;
}

class vtkCSLFDecoder::Internals
{
public:
  std::optional<cslf::FieldView> View;   ///< of the file that is open
  std::weak_ptr<cslf::FieldStore> Store; ///< of the view, while somebody uses it
  std::string FileName;                  ///< that is open, or could not be opened
  std::string Description;
  std::string PixelFormat;
  vtkNew<vtkFieldData> Field;                               ///< of every output
  std::vector<std::int64_t> TrackBytes;                     ///< empty until requested
  std::vector<vtkSmartPointer<vtkUnsignedCharArray>> Parts; ///< null until requested
  std::vector<int> Damage; ///< the file's missing viewpoints, after the first was found

  /// Those of the last update. Never changed, because callers keep it.
  vtkSmartPointer<vtkIdTypeArray> Missing = vtkSmartPointer<vtkIdTypeArray>::New();

  void SetFile(std::shared_ptr<cslf::FieldReader> file)
  {
    this->View.reset();
    this->Store.reset();
    this->Parts.clear();
    this->Description.clear();
    this->PixelFormat.clear();
    this->Field->Initialize();
    this->TrackBytes.clear();
    this->Damage.clear();
    if (file)
    {
      constexpr int time = 0;
      this->View.emplace(std::move(file), time);
      const cslf::FileHeader& header = this->View->GetHeader();
      this->Parts.resize(header.Parts.size());
      header.Field.WriteTo(this->Field);
      this->Description = header.Field.ToText();
      this->PixelFormat = cslf::NameOfFormat(header.Tracks.front().Kind.Format);
    }
  }

  std::optional<cslf::ViewpointSamples> GetViewpoint(vtkCSLFDecoder* self, vtkIdType z);

  /// The part with the geometry, or null.
  const cslf::FilePart* FindGeometry() const
  {
    return this->View ? this->View->GetHeader().FindGeometry() : nullptr;
  }

  bool HasViewpoint(vtkIdType z) const
  {
    return this->View && z >= 0 && z < this->View->GetHeader().Field.Grid.GetSlices();
  }

  /// The extent of the whole field except z.
  void GetExtent(vtkIdType first, vtkIdType last, int extent[6]) const
  {
    this->View->GetHeader().Field.Grid.GetWholeExtent(extent);
    extent[4] = static_cast<int>(first);
    extent[5] = static_cast<int>(last);
  }

  void SetMissing(const std::vector<int>& slices)
  {
    this->Missing = vtkSmartPointer<vtkIdTypeArray>::New();
    this->Missing->SetNumberOfValues(static_cast<vtkIdType>(slices.size()));
    std::copy(slices.begin(), slices.end(), this->Missing->GetPointer(0));
  }
};

vtkCSLFDecoder::vtkCSLFDecoder()
  : AllowMissing(cslf::options::AllowMissing.Default)
  , Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
}

vtkCSLFDecoder::~vtkCSLFDecoder()
{
  this->SetFileName(nullptr);
}

int vtkCSLFDecoder::CanReadFile(const char* fileName)
{
  const cslf::AVLogSilence silence;
  cslf::OpenError ignored;
  constexpr int certainly = 3;
  try
  {
    return fileName && cslf::ContainerReader::Open(fileName, ignored) ? certainly : 0;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

const char* vtkCSLFDecoder::GetDescription() const
{
  return this->Internal->Description.c_str();
}

const char* vtkCSLFDecoder::GetCodecName() const
{
  const auto& view = this->Internal->View;
  return view ? cslf::NameOfCodec(view->GetHeader().Tracks.front().Kind.Coding) : "";
}

const char* vtkCSLFDecoder::GetPixelFormat() const
{
  return this->Internal->PixelFormat.c_str();
}

int vtkCSLFDecoder::GetNumberOfTracks() const
{
  const auto& view = this->Internal->View;
  return view ? static_cast<int>(view->GetHeader().Tracks.size()) : 0;
}

const char* vtkCSLFDecoder::GetTrackName(int track) const
{
  return track >= 0 && track < this->GetNumberOfTracks()
    ? cslf::NameOfRole(this->Internal->View->GetHeader().Tracks[track].Kind.Role)
    : nullptr;
}

int vtkCSLFDecoder::GetNumberOfParts() const
{
  const auto& view = this->Internal->View;
  return view ? static_cast<int>(view->GetHeader().Parts.size()) : 0;
}

const char* vtkCSLFDecoder::GetPartType(int part) const
{
  return part >= 0 && part < this->GetNumberOfParts()
    ? this->Internal->View->GetHeader().Parts[part].Type.c_str()
    : nullptr;
}

const char* vtkCSLFDecoder::GetPartName(int part) const
{
  return part >= 0 && part < this->GetNumberOfParts()
    ? this->Internal->View->GetHeader().Parts[part].Name.c_str()
    : nullptr;
}

bool vtkCSLFDecoder::HasGeometry() const
{
  return this->Internal->FindGeometry() != nullptr;
}

vtkPolyData* vtkCSLFDecoder::GetGeometry()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkUnsignedCharArray* vtkCSLFDecoder::GetPart(int part)
{
  if (part < 0 || part >= this->GetNumberOfParts())
  {
    return nullptr;
  }
  vtkSmartPointer<vtkUnsignedCharArray>& array = this->Internal->Parts[part];
  if (!array)
  {
    const auto& bytes = this->Internal->View->GetHeader().Parts[part].Bytes;
    array = vtkSmartPointer<vtkUnsignedCharArray>::New();
    array->SetNumberOfValues(static_cast<vtkIdType>(bytes.size()));
    std::copy(bytes.begin(), bytes.end(), array->GetPointer(0));
  }
  return array;
}

vtkTypeInt64 vtkCSLFDecoder::GetTrackBytes(int track)
{
  if (track < 0 || track >= this->GetNumberOfTracks())
  {
    return 0;
  }
  if (this->Internal->TrackBytes.empty())
  {
    const bool isCounted = this->Guard(
      [this]
      {
        this->Internal->TrackBytes = this->Internal->View->GetFile().CountBytes();
        return true;
      });
    if (!isCounted)
    {
      return 0;
    }
  }
  return this->Internal->TrackBytes[track];
}

vtkIdType vtkCSLFDecoder::GetNumberOfMissingViewpoints() const
{
  return this->Internal->Missing->GetNumberOfValues();
}

vtkIdTypeArray* vtkCSLFDecoder::GetMissingViewpoints() const
{
  return this->Internal->Missing;
}

// Does work that may run out of memory. No exception leaves VTK's methods: it becomes one error.
bool vtkCSLFDecoder::Guard(const std::function<bool()>& work)
{
  const cslf::AVLogSilence silence;
  std::string problem;
  const bool isDone = cslf::Guard(work, problem);
  return problem.empty() ? isDone : this->Fail(vtkErrorCode::UnknownError, problem);
}

bool vtkCSLFDecoder::Fail(unsigned long code, const std::string& problem)
{
  this->SetErrorCode(code);
  vtkErrorMacro("Cannot read " << this->Internal->FileName << ": " << problem << ".");
  return false;
}

int vtkCSLFDecoder::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->Internal->SetFile(nullptr);
  this->Internal->SetMissing({});
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  cslf::LendStore(outInfo, [this] { return this->GetStore(); });
  this->Internal->FileName = this->ChooseFile(outInfo);
  if (this->Internal->FileName.empty())
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("There is no file name.");
    return 0;
  }
  if (!this->Guard([this] { return this->OpenFile(); }))
  {
    return 0;
  }
  int extent[6];
  this->Internal->View->GetHeader().Field.Grid.GetWholeExtent(extent);
  cslf::SetFieldInformation(outInfo, extent);
  const cslf::Description& field = this->Internal->View->GetHeader().Field;
  vtkDataObject::SetPointDataActiveScalarInfo(
    outInfo, field.FindChannel(cslf::KnownChannel::Color)->Type, 4);
  return 1;
}

int vtkCSLFDecoder::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

vtkTypeBool vtkCSLFDecoder::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    cslf::ChoosePorts(
      request, outputVector, cslf::IsWholeRequested(outputVector->GetInformationObject(0)));
    return 1;
  }
  return cslf::GuardRequest(this, request, outputVector,
    [&] { return this->Superclass::ProcessRequest(request, inputVector, outputVector); });
}

int vtkCSLFDecoder::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->Internal->View)
  {
    return 0;
  }
  if (cslf::IsPortWanted(outputVector, 1))
  {
    this->ReadGeometry(vtkPolyData::GetData(outputVector, 1));
  }
  return cslf::IsPortWanted(outputVector, 0) ? this->ReadField(outputVector) : 1;
}

void vtkCSLFDecoder::ReadGeometry(vtkPolyData* output)
{
  const cslf::FilePart* part = this->Internal->FindGeometry();
  if (!part)
  {
    return;
  }
  std::string error;
  vtkSmartPointer<vtkPolyData> geometry;
  // The field can be read without it.
  std::string problem;
  cslf::Guard(
    [&]
    {
      geometry =
        cslf::DecodeGeometry(part->Bytes, this->Internal->View->GetHeader().Field.Box, error);
      return true;
    },
    problem);
  error = problem.empty() ? error : "its geometry cannot: " + problem;
  if (geometry)
  {
    output->ShallowCopy(geometry);
  }
  else
  {
    vtkWarningMacro(<< this->Internal->FileName << " can be read, but " << error << ".");
  }
}

int vtkCSLFDecoder::ReadField(vtkInformationVector* outputVector)
{
  this->Internal->SetMissing({});
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  int asked[6];
  outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), asked);
  const bool isRead = this->Guard(
    [&]
    {
      if (!this->CheckRange(asked[4], asked[5]))
      {
        return false;
      }
      this->ReadRange(asked[4], asked[5], output);
      return this->ReportDamage();
    });
  const bool isAborted = cslf::IsAborted(this);
  if (!isRead || isAborted)
  {
    output->Initialize();
  }
  return isRead || isAborted ? 1 : 0;
}

void vtkCSLFDecoder::WarnOfHeader()
{
  const std::string all = cslf::Join(this->Internal->View->GetHeader().Warnings, "; ");
  if (!all.empty())
  {
    vtkWarningMacro(<< this->Internal->FileName << " can be read, but " << all << ".");
  }
}

bool vtkCSLFDecoder::OpenFile()
{
  cslf::OpenError failure;
  this->Internal->SetFile(cslf::FieldReader::Open(this->Internal->FileName, failure));
  if (!this->Internal->View)
  {
    return this->Fail(failure.Code, failure.Text);
  }
  this->WarnOfHeader();
  this->Internal->View->GetFile().GetViewpoints().SetSize(this->CacheSize);
  return true;
}

// Finds which slices of a range exist, before memory is allocated for all of it.
bool vtkCSLFDecoder::CheckRange(int first, int last)
{
  cslf::Phase phase(this, "Checking viewpoints", CheckedProgress);
  this->Internal->SetMissing(this->Internal->View->FindMissing(
    first, last, [&phase](double share) { return phase.Report(share); }));
  if (!this->ReportDamage())
  {
    return false;
  }
  const int count = last - first + 1;
  const vtkIdType there = count - this->GetNumberOfMissingViewpoints();
  if (!cslf::AreEnough(this->Internal->View->GetHeader().Field, there, count))
  {
    std::ostringstream text;
    text << "only " << there << " of the " << count << " requested viewpoints can be read";
    return this->Fail(vtkErrorCode::PrematureEndOfFileError, text.str());
  }
  return true;
}

void vtkCSLFDecoder::ReadRange(int first, int last, vtkImageData* output)
{
  if (cslf::IsAborted(this))
  {
    return;
  }
  cslf::AllocateSlices(this->Internal->View->GetHeader().Field, first, last, output);
  output->GetFieldData()->PassData(this->Internal->Field);
  cslf::Phase phase(this, "Decoding viewpoints");
  this->Internal->SetMissing(this->Internal->View->Read(first, last, cslf::ViewpointSamples(output),
    [&phase](double share) { return phase.Report(share); }));
  cslf::SetMissing(this->Internal->Missing, output);
}

// Reports the missing slices of the last range. Returns whether the others can be returned.
bool vtkCSLFDecoder::ReportDamage()
{
  if (this->GetNumberOfMissingViewpoints() == 0 || cslf::IsAborted(this))
  {
    return true;
  }
  cslf::Phase phase(this, "Checking all viewpoints");
  return this->ReportFileDamage([&phase](double share) { return phase.Report(share); });
}

// Reports all missing slices of the file: warns, unless that was done before, or fails.
bool vtkCSLFDecoder::ReportFileDamage(const std::function<bool(double)>& progress)
{
  const std::size_t known = this->Internal->Damage.size();
  const std::vector<int> missing = this->Internal->View->FindMissing(progress);
  if (cslf::IsAborted(this))
  {
    return false;
  }
  this->Internal->Damage = missing;
  const auto [state, text] = this->Internal->View->DescribeMissing(missing, this->AllowMissing);
  if (state.empty())
  {
    return this->Fail(vtkErrorCode::FileFormatError, text);
  }
  if (!this->AllowMissing)
  {
    return this->Fail(vtkErrorCode::PrematureEndOfFileError, "it is " + state + ", " + text);
  }
  if (missing.size() > known)
  {
    vtkWarningMacro(<< this->Internal->FileName << " is " << state << ": " << text << ".");
  }
  return true;
}

bool vtkCSLFDecoder::IsUnfinished() const
{
  return this->Internal->View && !this->Internal->View->GetUnwritten().empty();
}

void vtkCSLFDecoder::GetUnwrittenViewpoints(vtkIdTypeArray* viewpoints)
{
  viewpoints->Reset();
  if (this->UpdateReader())
  {
    for (int slice : this->Internal->View->GetUnwritten())
    {
      viewpoints->InsertNextValue(slice);
    }
  }
}

bool vtkCSLFDecoder::UpdateReader()
{
  this->UpdateInformation();
  return this->Internal->View.has_value();
}

vtkIdType vtkCSLFDecoder::FindMissingViewpoints()
{
  if (!this->UpdateReader())
  {
    return -1;
  }
  cslf::ResetAbort(this);
  this->UpdateProgress(0.0);
  const bool isChecked = this->Guard(
    [this]
    {
      cslf::Phase phase(this, "Checking viewpoints");
      this->Internal->SetMissing(
        this->Internal->View->FindMissing([&phase](double share) { return phase.Report(share); }));
      return !cslf::IsAborted(this);
    });
  return isChecked ? this->GetNumberOfMissingViewpoints() : -1;
}

void vtkCSLFDecoder::SetCacheSize(vtkTypeInt64 bytes)
{
  this->CacheSize =
    cslf::Clamp<vtkTypeInt64>(this, "CacheSize", bytes, 0, VTK_TYPE_INT64_MAX, this->CacheSize);
  if (this->Internal->View)
  {
    this->Internal->View->GetFile().GetViewpoints().SetSize(this->CacheSize);
  }
}

bool vtkCSLFDecoder::RequireViewpoint(vtkIdType z)
{
  if (!this->UpdateReader())
  {
    return false;
  }
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->Internal->HasViewpoint(z))
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("There is no viewpoint " << z << " in " << this->Internal->FileName << ".");
    return false;
  }
  return true;
}

// A viewpoint from the cache, decoded now if necessary. Null if there is not enough memory.
std::optional<cslf::ViewpointSamples> vtkCSLFDecoder::Internals::GetViewpoint(
  vtkCSLFDecoder* self, vtkIdType z)
{
  std::optional<cslf::ViewpointSamples> viewpoint;
  self->Guard(
    [&]
    {
      viewpoint = this->View->Get(static_cast<int>(z));
      return true;
    });
  return viewpoint;
}

bool vtkCSLFDecoder::IsViewpointDamaged(vtkIdType z)
{
  if (!this->RequireViewpoint(z))
  {
    return true;
  }
  const auto viewpoint = this->Internal->GetViewpoint(this, z);
  const bool isMissing = viewpoint && viewpoint->IsEmpty();
  if (isMissing)
  {
    this->RequireDamageAllowed();
  }
  return !viewpoint || isMissing;
}

// After a viewpoint was found missing: reports an error if none may be, once for the whole file.
void vtkCSLFDecoder::RequireDamageAllowed()
{
  if (!this->AllowMissing && this->Internal->Damage.empty())
  {
    this->Guard(
      [this] { return this->ReportFileDamage([this](double) { return !cslf::IsAborted(this); }); });
  }
}

bool vtkCSLFDecoder::GetViewpoint(vtkIdType z, vtkImageData* image)
{
  image->Initialize();
  if (!this->RequireViewpoint(z))
  {
    return false;
  }
  const auto viewpoint = this->Internal->GetViewpoint(this, z);
  if (!viewpoint)
  {
    return false;
  }
  if (viewpoint->IsEmpty())
  {
    const std::vector<int>& unwritten = this->Internal->View->GetUnwritten();
    const bool isUnwritten =
      std::binary_search(unwritten.begin(), unwritten.end(), static_cast<int>(z));
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro("Viewpoint " << z << " of " << this->Internal->FileName << " is "
                               << (isUnwritten ? "not written yet." : "damaged."));
    return false;
  }
  int extent[6];
  this->Internal->GetExtent(z, z, extent);
  image->SetExtent(extent);
  viewpoint->AddTo(image);
  image->GetFieldData()->PassData(this->Internal->Field);
  return true;
}

void vtkCSLFDecoder::Prefetch(vtkIdTypeArray* viewpoints)
{
  if (!this->UpdateReader())
  {
    return;
  }
  std::vector<int> slices;
  for (vtkIdType k = 0; viewpoints && k < viewpoints->GetNumberOfValues(); ++k)
  {
    const vtkIdType z = viewpoints->GetValue(k);
    if (this->Internal->HasViewpoint(z))
    {
      slices.push_back(static_cast<int>(z));
    }
  }
  this->Guard(
    [&]
    {
      this->Internal->View->Prefetch(slices);
      return true;
    });
}

bool vtkCSLFDecoder::IsViewpointReady(vtkIdType z)
{
  return this->Internal->HasViewpoint(z) && this->Internal->View->Has(static_cast<int>(z));
}

void vtkCSLFDecoder::WaitForPrefetch()
{
  if (this->Internal->View)
  {
    this->Internal->View->GetFile().GetViewpoints().Wait();
  }
}

void vtkCSLFDecoder::GetViewpointsInFileOrder(vtkIdTypeArray* viewpoints)
{
  viewpoints->Reset();
  if (this->UpdateReader())
  {
    for (int slice : this->Internal->View->GetOrder())
    {
      viewpoints->InsertNextValue(slice);
    }
  }
}

// The viewpoints of the file that is open; null if none is. They stay those of that file, which
// remains open for them, also after this filter has opened another one. They keep up to CacheSize
// bytes each, report what is damaged as this filter does, and keep it alive.
std::shared_ptr<cslf::FieldStore> vtkCSLFDecoder::GetStore()
{
  std::shared_ptr<cslf::FieldStore> store = this->Internal->Store.lock();
  if (!store && this->Internal->View)
  {
    const vtkSmartPointer<vtkCSLFDecoder> self = this;
    const cslf::FieldReader* file = &this->Internal->View->GetFile();
    store = cslf::MakeStore(
      *this->Internal->View,
      [self](const std::function<bool()>& work) { return self->Guard(work); },
      [self, file]
      {
        if (self->Internal->View && file == &self->Internal->View->GetFile())
        {
          self->RequireDamageAllowed();
        }
      });
    this->Internal->Store = store;
  }
  return store;
}

void vtkCSLFDecoder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "CacheSize: " << this->CacheSize << "\n";
  os << indent << "AllowMissing: " << this->AllowMissing << "\n";
  os << indent << "Description: " << this->GetDescription() << "\n";
  os << indent << "MissingViewpoints: " << this->GetNumberOfMissingViewpoints() << "\n";
}
