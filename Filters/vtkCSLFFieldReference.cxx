// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFFieldReference.h"

#include "Options/cslfOptionTable.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "Quality/cslfDisplayCurve.h"
#include "Quality/cslfTexelChoice.h"
#include "cslfColor.h"
#include "cslfJSON.h"
#include "vtkCSLFEnvironment.h"

#include <vtkAlgorithmOutput.h>
#include <vtkDataObject.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

vtkStandardNewMacro(vtkCSLFFieldReference);
cslfSetClampMacro(vtkCSLFFieldReference, Texels, 1, 100000000);

namespace
{
/// Each side of a texel that is a mean is divided into this many parts. Each ray of a packet
/// samples one of the smaller texels.
constexpr int CellsOfMean = 4;
constexpr int Halves = 2;

/// The number of texels traced at once: enough to keep many threads busy.
constexpr vtkIdType ChunkTexels = 8192;

/// The estimated share of reading the field in the progress.
constexpr double ReadingShare = 0.1;

constexpr double BestNoiseFloor = 100.0;

/// Makes the reference's random numbers differ from those of a field with the same seed.
constexpr std::uint64_t ReferenceSalt = 0x5265666572656e63u;

cslf::Slab GetSlices(vtkInformation* field)
{
  int extent[6];
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(field, extent);
  return { extent[4], extent[5] };
}

std::uint64_t CountSliceTexels(vtkInformation* field)
{
  int extent[6];
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(field, extent);
  return (extent[1] - extent[0] + std::uint64_t(1)) * (extent[3] - extent[2] + std::uint64_t(1));
}

/// A half of a reference texel.
struct Half
{
  glm::dvec3 Radiance{ 0.0 };
  double Alpha = 0.0;

  Half(const float* cells, int count)
  {
    for (int cell = 0; cell < count; ++cell, cells += 4)
    {
      this->Radiance += glm::dvec3(cells[0], cells[1], cells[2]) / static_cast<double>(count);
      this->Alpha += static_cast<double>(cells[3]) / count;
    }
  }
};

vtkSmartPointer<vtkUnsignedCharArray> MakeColors(const char* name, vtkIdType texels)
{
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName(name);
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(texels);
  return colors;
}
}

/// One run of the filter. Methods that return false have reported the reason.
class vtkCSLFFieldReference::Measurement
{
public:
  Measurement(vtkCSLFFieldReference* self, vtkInformation* fieldInformation)
    : Self(self)
    , First(GetSlices(fieldInformation).First)
    , SliceTexels(CountSliceTexels(fieldInformation))
    , Chosen(this->SliceTexels * GetSlices(fieldInformation).GetCount(),
        static_cast<std::uint64_t>(self->Texels), static_cast<std::uint32_t>(self->GetSeed()))
    , Reference(MakeColors("Reference", this->GetCount()))
    , Field(MakeColors("Field", this->GetCount()))
  {
    this->Indices->SetName("Texel");
    this->Indices->SetNumberOfTuples(this->GetCount());
    for (vtkIdType k = 0; k < this->GetCount(); ++k)
    {
      this->Indices->SetValue(
        k, static_cast<vtkIdType>(this->First * this->SliceTexels + this->Chosen[k]));
    }
  }

  vtkIdType GetCount() const { return static_cast<vtkIdType>(this->Chosen.GetCount()); }

  /// Takes the chosen texels' colours from the field.
  bool Read(vtkAlgorithmOutput* connection)
  {
    cslf::FieldStream stream(connection);
    bool isRead = stream.Open();
    std::vector<cslf::Slab> slabs;
    if (isRead)
    {
      slabs = stream.PlanSlabs(
        [this](int slice) { return this->FindFirst(slice) < this->FindFirst(slice + 1); });
      stream.Announce(slabs);
    }
    for (std::size_t k = 0; isRead && k < slabs.size() && !cslf::IsAborted(this->Self); ++k)
    {
      isRead = stream.Read(slabs[k]) && this->Check(stream.GetDescription());
      const vtkIdType end = this->FindFirst(slabs[k].Last + 1);
      for (vtkIdType texel = this->FindFirst(slabs[k].First); isRead && texel < end; ++texel)
      {
        this->TakeColor(stream, texel);
      }
      this->Self->UpdateProgress(ReadingShare * static_cast<double>(k) / slabs.size());
    }
    if (!isRead && !stream.GetError().empty())
    {
      vtkErrorWithObjectMacro(this->Self, << stream.GetError());
    }
    this->Description = stream.GetDescription();
    for (double exposure : cslf::GetViewExposures(!this->Radiance.empty()))
    {
      this->Sums.push_back({ exposure });
    }
    return isRead;
  }

  /// Traces the chosen texels and compares them. Also false if aborted.
  bool Trace(const cslf::BuiltScene& scene)
  {
    this->WarnOfOtherScene(scene);
    for (vtkIdType first = 0; first < this->GetCount(); first += ChunkTexels)
    {
      if (!this->TraceChunk(scene, first, std::min(first + ChunkTexels, this->GetCount())))
      {
        return false;
      }
    }
    return true;
  }

  std::vector<Figures> GetFigures(double cap) const
  {
    const double values = 3.0 * static_cast<double>(this->GetCount());
    std::vector<Figures> figures;
    for (const ErrorSum& sum : this->Sums)
    {
      figures.push_back({ sum.ViewExposure, cslf::PSNR(sum.Errors / values, 255.0, cap),
        cslf::PSNR(sum.Noise / values, 1.0, BestNoiseFloor) });
    }
    return figures;
  }

  void Write(vtkImageData* output) const
  {
    output->SetDimensions(static_cast<int>(this->GetCount()), 1, 1);
    output->GetPointData()->SetScalars(this->Reference);
    output->GetPointData()->AddArray(this->Field);
    output->GetPointData()->AddArray(this->Indices);
  }

private:
  int GetSlice(vtkIdType k) const
  {
    return this->First + static_cast<int>(this->Chosen[k] / this->SliceTexels);
  }

  /// The first of the chosen texels in that slice or after it.
  vtkIdType FindFirst(int slice) const
  {
    vtkIdType first = 0;
    for (vtkIdType last = this->GetCount(); first < last;)
    {
      const vtkIdType middle = first + (last - first) / 2;
      (this->GetSlice(middle) < slice ? first : last) =
        this->GetSlice(middle) < slice ? middle + 1 : middle;
    }
    return first;
  }

  bool Check(const cslf::Description& description)
  {
    const cslf::Channel* color = description.FindChannel(cslf::KnownChannel::Color);
    if (!color || color->Components != 4)
    {
      vtkErrorWithObjectMacro(this->Self, "The field has no colours.");
      return false;
    }
    return true;
  }

  void TakeColor(const cslf::FieldStream& stream, vtkIdType k)
  {
    const cslf::Channel& channel = *stream.GetDescription().FindChannel(cslf::KnownChannel::Color);
    const unsigned char* texel = stream.GetSlice(channel, this->GetSlice(k)) +
      this->Chosen[k] % this->SliceTexels * channel.GetTexelBytes();
    unsigned char color[4];
    if (channel.Type == VTK_FLOAT)
    {
      const auto* values = reinterpret_cast<const float*>(texel);
      this->Radiance.resize(this->GetCount());
      this->Radiance[k] = { values[0], values[1], values[2], values[3] };
      cslf::EncodeColor({ values[0], values[1], values[2] }, values[3], color);
      texel = color;
    }
    this->Field->SetTypedTuple(k, texel);
  }

  void WarnOfOtherScene(const cslf::BuiltScene& scene)
  {
    const auto sampling = nlohmann::json::parse(this->Description.Sampling, nullptr, false);
    const auto remembered = sampling.find("scene");
    if (remembered != sampling.end() && *remembered != scene.Fingerprint)
    {
      vtkWarningWithObjectMacro(
        this->Self, "The field was sampled from another scene, or with other materials or lights.");
    }
  }

  bool TraceChunk(const cslf::BuiltScene& scene, vtkIdType first, vtkIdType last)
  {
    // A slice is a half of a texel. Its number determines its random numbers.
    const int side = this->GetCellSide();
    const int cells = side * side;
    const vtkIdType count = cells * Halves * (last - first);
    cslf::ViewpointSamples output;
    output.SetArray(cslf::KnownChannel::Color,
      cslf::MakeArray(cslf::MakeChannel(cslf::KnownChannel::Color, VTK_FLOAT), count));
    const cslf::PictureLayout layout{ side, side, 1, static_cast<int>(Halves * first),
      static_cast<int>(Halves * (last - first)) };
    const auto grids = [&](int slice, int) { return this->MakeRays(scene.Frame, slice / Halves); };
    const cslf::TexelRenderer renderer(*scene.World, layout, this->GetSettings(), grids, output);
    const bool isDone = renderer.Render(
      [&](double progress)
      {
        const double done = (first + progress * (last - first)) / this->GetCount();
        this->Self->UpdateProgress(ReadingShare + (1.0 - ReadingShare) * done);
        return !cslf::IsAborted(this->Self);
      });
    for (vtkIdType k = first; isDone && k < last; ++k)
    {
      const float* halves =
        output.Get<float>(cslf::KnownChannel::Color) + 4 * cells * Halves * (k - first);
      this->Compare(k, Half(halves, cells), Half(halves + 4 * cells, cells));
    }
    return isDone;
  }

  int GetCellSide() const { return this->Description.HasSurfaceTexels() ? 1 : CellsOfMean; }

  cslf::RenderSettings GetSettings() const
  {
    const int parts = Halves * this->GetCellSide() * this->GetCellSide();
    cslf::RenderSettings settings;
    settings.SurfaceTexels = this->Description.HasSurfaceTexels();
    const int samples = this->Self->GetUsedSamples();
    settings.Samples = samples / parts + (samples % parts != 0);
    settings.Seed = static_cast<std::uint32_t>(
      cslf::MixBits(ReferenceSalt, static_cast<std::uint32_t>(this->Self->GetSeed())));
    settings.Exposure = this->Self->GetUsedExposure();
    settings.ShowEnvironment = this->Self->GetEnvironment()->GetShow();
    settings.Paths.MaximumDepth = this->Self->GetUsedMaximumDepth();
    return settings;
  }

  cslf::RayGrid MakeRays(const cslf::SceneFrame& frame, vtkIdType k) const
  {
    const cslf::Layout& grid = this->Description.Grid;
    const std::uint64_t texel = this->Chosen[k] % this->SliceTexels;
    const int side = grid.GetResolution();
    const auto x = static_cast<int>(texel % grid.GetStripWidth());
    const auto y = static_cast<int>(texel / grid.GetStripWidth());
    const cslf::RayGrid tile =
      cslf::MakeFieldRays(grid, this->Description.Box, frame, this->GetSlice(k), x / side);
    return cslf::MakeTexelRays(tile, x % side, y, this->GetCellSide());
  }

  void Compare(vtkIdType k, const Half& first, const Half& second)
  {
    const glm::dvec3 mean = 0.5 * (first.Radiance + second.Radiance);
    const double alpha = 0.5 * (first.Alpha + second.Alpha);
    for (ErrorSum& sum : this->Sums)
    {
      const double exposure = sum.ViewExposure;
      unsigned char reference[4];
      cslf::EncodeColor(exposure * mean, alpha, reference);
      unsigned char field[4];
      if (this->Radiance.empty())
      {
        this->Field->GetTypedTuple(k, field);
      }
      else
      {
        const glm::dvec4& radiance = this->Radiance[k];
        cslf::EncodeColor(exposure * glm::dvec3(radiance), radiance.w, field);
      }
      for (int i = 0; i < 3; ++i)
      {
        const double error = static_cast<double>(field[i]) - reference[i];
        sum.Errors += error * error;
      }
      const glm::dvec3 noise = 0.5 *
        (cslf::EncodeRadiance(exposure * first.Radiance, first.Alpha) -
          cslf::EncodeRadiance(exposure * second.Radiance, second.Alpha));
      sum.Noise += glm::dot(noise, noise);
      if (exposure == 1.0)
      {
        this->Reference->SetTypedTuple(k, reference);
      }
    }
  }

  /// Errors at one exposure.
  struct ErrorSum
  {
    double ViewExposure;
    double Errors = 0.0; ///< sum of squares, of 255 levels
    double Noise = 0.0;  ///< sum of squares, of the encoded mean
  };

  vtkCSLFFieldReference* Self;
  int First; ///< slice in the field
  std::uint64_t SliceTexels;
  cslf::TexelChoice Chosen;
  vtkSmartPointer<vtkUnsignedCharArray> Reference;
  vtkSmartPointer<vtkUnsignedCharArray> Field;
  vtkNew<vtkIdTypeArray> Indices;
  cslf::Description Description;
  std::vector<glm::dvec4> Radiance; ///< of the field's chosen texels, if it has float colour
  std::vector<ErrorSum> Sums;
};

vtkCSLFFieldReference::vtkCSLFFieldReference()
{
  this->SetNumberOfInputPorts(2);
  this->SetSamples(4096);
}

int vtkCSLFFieldReference::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port != 1)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkCSLFFieldReference::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* field = inputVector[1]->GetInformationObject(0);
  const cslf::Slab slices = GetSlices(field);
  if (slices.GetCount() < 1 || CountSliceTexels(field) < 1)
  {
    vtkErrorMacro("The field is empty.");
    return 0;
  }
  const double texels = static_cast<double>(CountSliceTexels(field)) * slices.GetCount();
  const int count = static_cast<int>(std::min<double>(this->Texels, texels));
  const int extent[6] = { 0, count - 1, 0, 0, 0, 0 };
  vtkInformation* info = outputVector->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  info->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_UNSIGNED_CHAR, 3);
  return 1;
}

int vtkCSLFFieldReference::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // The field is pulled slab by slab later. Until then, as little as possible is requested.
  vtkInformation* field = inputVector[1]->GetInformationObject(0);
  int extent[6];
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(field, extent);
  extent[5] = extent[4];
  cslf::RequestFirstPart(field, extent);
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

int vtkCSLFFieldReference::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->PSNR = 0.0;
  this->NoiseFloor = 0.0;
  this->NumberOfTexels = 0;
  const cslf::KeptRequests requests(this->GetInputConnection(1, 0));
  const cslf::BuiltScene* scene = this->UpdateScene(inputVector);
  if (!scene)
  {
    return 0;
  }
  Measurement measurement(this, inputVector[1]->GetInformationObject(0));
  if (!measurement.Read(this->GetInputConnection(1, 0)))
  {
    return 0;
  }
  if (!measurement.Trace(*scene))
  {
    return 1;
  }
  this->AllFigures = measurement.GetFigures(this->MaximumPSNR);
  for (const Figures& figures : this->AllFigures)
  {
    if (figures.ViewExposure == 1.0)
    {
      this->PSNR = figures.PSNR;
      this->NoiseFloor = figures.NoiseFloor;
    }
  }
  this->NumberOfTexels = measurement.GetCount();
  measurement.Write(vtkImageData::GetData(outputVector));
  return 1;
}

int vtkCSLFFieldReference::GetNumberOfViewExposures()
{
  return static_cast<int>(this->AllFigures.size());
}

double vtkCSLFFieldReference::GetViewExposure(int index)
{
  const bool isThere = index >= 0 && index < this->GetNumberOfViewExposures();
  return isThere ? this->AllFigures[index].ViewExposure : 0.0;
}

double vtkCSLFFieldReference::GetPSNR(int index)
{
  const bool isThere = index >= 0 && index < this->GetNumberOfViewExposures();
  return isThere ? this->AllFigures[index].PSNR : 0.0;
}

double vtkCSLFFieldReference::GetNoiseFloor(int index)
{
  const bool isThere = index >= 0 && index < this->GetNumberOfViewExposures();
  return isThere ? this->AllFigures[index].NoiseFloor : 0.0;
}

void vtkCSLFFieldReference::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Texels: " << this->Texels << "\n";
  os << indent << "MaximumPSNR: " << this->MaximumPSNR << "\n";
  os << indent << "PSNR: " << this->PSNR << "\n";
  os << indent << "NoiseFloor: " << this->NoiseFloor << "\n";
  os << indent << "NumberOfTexels: " << this->NumberOfTexels << "\n";
}
