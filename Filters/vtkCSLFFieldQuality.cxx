// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFFieldQuality.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfParallelFor.h"

#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "Quality/cslfDisplayCurve.h"
#include "cslfColor.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace
{
/// The error of a range of components of one channel.
struct Figure
{
  std::string Name;
  std::string Channel;
  int Layer = 0;
  int FirstComponent = 0;
  int Components = 1;
  bool WhereCovered = false;
  double ViewExposure = 0.0; // above 0: compared as displayed at this multiple of the exposure
  double Peak = 1.0;
  double Squares = 0.0;
  double Values = 0.0;
};

double PeakOf(int type)
{
  switch (type)
  {
    case VTK_UNSIGNED_CHAR:
      return VTK_UNSIGNED_CHAR_MAX;
    case VTK_UNSIGNED_SHORT:
      return VTK_UNSIGNED_SHORT_MAX;
    default:
      return 1.0;
  }
}

/// The results for float colours as displayed.
void AddDisplayed(const cslf::Channel& channel, std::vector<Figure>& figures)
{
  if (channel.Type != VTK_FLOAT)
  {
    return;
  }
  Figure figure;
  figure.Channel = channel.Name;
  figure.Components = 3;
  figure.Peak = VTK_UNSIGNED_CHAR_MAX;
  for (double exposure : cslf::GetViewExposures(true))
  {
    std::ostringstream name;
    name << channel.Name << " at " << (exposure < 1.0 ? "1/" : "")
         << (exposure < 1.0 ? 1.0 / exposure : exposure);
    figure.Name = name.str();
    figure.ViewExposure = exposure;
    figures.push_back(figure);
  }
}

/// The channels of two fields of the same grid that can be compared.
std::vector<Figure> MakeFigures(const cslf::Description& first, const cslf::Description& second)
{
  std::vector<Figure> figures;
  for (const cslf::Channel& channel : first.Channels)
  {
    const cslf::Channel* other = second.FindChannel(channel.Name);
    if (!other || other->Type != channel.Type || other->Components != channel.Components)
    {
      continue;
    }
    Figure figure;
    figure.Name = figure.Channel = channel.Name;
    figure.Components = channel.Components;
    figure.Peak = PeakOf(channel.Type);
    const auto id = cslf::FindKnownChannel(channel.Name);
    const bool isColor = id && id->Known == cslf::KnownChannel::Color && channel.Components == 4;
    figure.Components -= isColor ? 1 : 0;
    figure.WhereCovered = id && id->Known == cslf::KnownChannel::Depth;
    figure.Layer = id ? id->Layer : 0;
    figures.push_back(figure);
    if (isColor)
    {
      figure.Name = figure.Layer == 0 ? "Coverage" : "Coverage" + std::to_string(figure.Layer + 1);
      figure.FirstComponent = 3;
      figure.Components = 1;
      figures.push_back(figure);
      AddDisplayed(channel, figures);
    }
  }
  return figures;
}

/// The start of a slab in an array of an image that may contain more.
template <typename T>
const T* GetBegin(vtkImageData* image, vtkDataArray* array, const cslf::Slab& slab)
{
  const int* size = image->GetDimensions();
  const vtkIdType texel =
    (slab.First - image->GetExtent()[4]) * static_cast<vtkIdType>(size[0]) * size[1];
  return static_cast<const T*>(array->GetVoidPointer(0)) + texel * array->GetNumberOfComponents();
}

template <typename T>
void ClearUncovered(const T* colors, std::vector<char>& isCounted)
{
  for (std::size_t texel = 0; texel < isCounted.size(); ++texel)
  {
    isCounted[texel] &= colors[4 * texel + 3] > T(0) ? 1 : 0;
  }
}

/// The texels of a slab that count: all, or those that are covered in both images.
std::vector<char> FindCounted(vtkImageData* images[2], const cslf::Slab& slab, const Figure& figure)
{
  const int* size = images[0]->GetDimensions();
  std::vector<char> isCounted(
    static_cast<std::size_t>(size[0]) * size[1] * slab.GetCount(), static_cast<char>(1));
  vtkDataArray* colors[2];
  for (int k = 0; k < 2; ++k)
  {
    colors[k] = images[k]->GetPointData()->GetArray(
      cslf::NameOf({ cslf::KnownChannel::Color, figure.Layer }));
  }
  if (figure.WhereCovered && colors[0] && colors[1] && colors[0]->GetNumberOfComponents() == 4 &&
    colors[1]->GetNumberOfComponents() == 4)
  {
    for (int k = 0; k < 2; ++k)
    {
      switch (colors[k]->GetDataType())
      {
        vtkTemplateMacro(ClearUncovered(GetBegin<VTK_TT>(images[k], colors[k], slab), isCounted));
      }
    }
  }
  return isCounted;
}

template <typename T>
void AddErrors(
  const T* first, const T* second, int stride, const std::vector<char>& isCounted, Figure& figure)
{
  first += figure.FirstComponent;
  second += figure.FirstComponent;
  double squares = figure.Squares;
  const int components = figure.Components;
  for (std::size_t texel = 0; texel < isCounted.size(); ++texel, first += stride, second += stride)
  {
    for (int k = 0; isCounted[texel] && k < components; ++k)
    {
      const double difference = static_cast<double>(first[k]) - static_cast<double>(second[k]);
      squares += difference * difference;
    }
  }
  figure.Squares = squares;
  figure.Values +=
    static_cast<double>(components) * std::count(isCounted.begin(), isCounted.end(), 1);
}

/// Adds the errors of colours as displayed. They are integers, so that their sum does not depend on
/// the threads.
void AddDisplayedErrors(const float* first, const float* second, vtkIdType texels, Figure& figure)
{
  std::atomic<std::int64_t> squares(0);
  cslf::ParallelFor(0, texels, 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::int64_t sum = 0;
      for (vtkIdType texel = begin; texel < end; ++texel)
      {
        unsigned char colors[2][4];
        const float* values[] = { first + 4 * texel, second + 4 * texel };
        for (int k = 0; k < 2; ++k)
        {
          const glm::dvec3 radiance(values[k][0], values[k][1], values[k][2]);
          cslf::EncodeColor(figure.ViewExposure * radiance, values[k][3], colors[k]);
        }
        for (int c = 0; c < 3; ++c)
        {
          const int difference = colors[0][c] - colors[1][c];
          sum += difference * difference;
        }
      }
      squares += sum;
    });
  figure.Squares += static_cast<double>(squares);
  figure.Values += 3.0 * static_cast<double>(texels);
}

/// Adds the errors of the viewpoints of a slab. The arrays have the same type.
void AddSlab(vtkImageData* images[2], const cslf::Slab& slab, Figure& figure)
{
  vtkDataArray* values[2];
  for (int k = 0; k < 2; ++k)
  {
    values[k] = images[k]->GetPointData()->GetArray(figure.Channel.c_str());
  }
  if (figure.ViewExposure > 0.0)
  {
    const int* size = images[0]->GetDimensions();
    AddDisplayedErrors(GetBegin<float>(images[0], values[0], slab),
      GetBegin<float>(images[1], values[1], slab),
      static_cast<vtkIdType>(size[0]) * size[1] * slab.GetCount(), figure);
    return;
  }
  const std::vector<char> isCounted = FindCounted(images, slab, figure);
  switch (values[0]->GetDataType())
  {
    vtkTemplateMacro(AddErrors(GetBegin<VTK_TT>(images[0], values[0], slab),
      GetBegin<VTK_TT>(images[1], values[1], slab), values[0]->GetNumberOfComponents(), isCounted,
      figure));
  }
}

/// The slices of `whole` in an order that suits the field that is a video, or the first one if both
/// are.
std::vector<cslf::Slab> PlanSlabs(cslf::FieldStream streams[2], const cslf::Slab& whole)
{
  const auto isWanted = [&whole](int slice) { return slice >= whole.First && slice <= whole.Last; };
  const int chosen = !streams[0].IsOrdered() && streams[1].IsOrdered() ? 1 : 0;
  std::vector<cslf::Slab> slabs = streams[chosen].PlanSlabs(isWanted);
  streams[0].Announce(slabs);
  streams[1].Announce(slabs);
  return slabs;
}

/// Compares the fields. On failure returns the reason, which is empty if it was reported already.
bool Compare(cslf::FieldStream streams[2], vtkAlgorithm* progress, std::vector<Figure>& figures,
  std::string& error)
{
  cslf::Slab whole;
  if (streams[0].Open() && streams[1].Open())
  {
    const cslf::Slab& a = streams[0].GetWhole();
    const cslf::Slab& b = streams[1].GetWhole();
    whole = { std::max(a.First, b.First), std::min(a.Last, b.Last) };
    error = whole.GetCount() < 1 ? "The fields have no viewpoint in common." : "";
  }
  std::vector<cslf::Slab> slabs;
  if (whole.GetCount() > 0)
  {
    slabs = PlanSlabs(streams, whole);
  }
  for (std::size_t k = 0; k < slabs.size(); ++k)
  {
    const cslf::Slab& slab = slabs[k];
    if (!streams[0].Read(slab) || !streams[1].Read(slab))
    {
      break;
    }
    const cslf::Description& a = streams[0].GetDescription();
    const cslf::Description& b = streams[1].GetDescription();
    if (k == 0)
    {
      figures = MakeFigures(a, b);
    }
    if (a.Grid != b.Grid || figures.empty())
    {
      error = a.Grid != b.Grid ? "The fields differ in their viewpoints or their resolution."
                               : "The fields have no channel of the same type in common.";
      return false;
    }
    vtkImageData* images[2] = { streams[0].GetImage(), streams[1].GetImage() };
    for (Figure& figure : figures)
    {
      AddSlab(images, slab, figure);
    }
    progress->UpdateProgress((k + 1.0) / static_cast<double>(slabs.size()));
    if (cslf::IsAborted(progress))
    {
      return false;
    }
    if (k + 1 == slabs.size())
    {
      return true;
    }
  }
  for (int k = 0; k < 2 && error.empty(); ++k)
  {
    error = streams[k].GetError();
  }
  return false;
}
}

struct vtkCSLFFieldQuality::Internal
{
  std::vector<Figure> Figures;
};

vtkStandardNewMacro(vtkCSLFFieldQuality);

vtkCSLFFieldQuality::vtkCSLFFieldQuality()
  : Internals(new Internal)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(0);
}

vtkCSLFFieldQuality::~vtkCSLFFieldQuality() = default;

int vtkCSLFFieldQuality::Measure()
{
  this->Internals->Figures.clear();
  this->AbortExecute = 0;
  if (this->GetNumberOfInputConnections(0) == 0 || this->GetNumberOfInputConnections(1) == 0)
  {
    vtkErrorMacro("Two fields must be given.");
    return 0;
  }
  cslf::FieldStream streams[2] = { cslf::FieldStream(this->GetInputConnection(0, 0)),
    cslf::FieldStream(this->GetInputConnection(1, 0)) };
  std::string error;
  this->InvokeEvent(vtkCommand::StartEvent);
  std::string problem;
  const bool isDone =
    cslf::Guard([&] { return Compare(streams, this, this->Internals->Figures, error); }, problem);
  error = problem.empty() ? error : "Cannot compare: " + problem + ".";
  this->InvokeEvent(vtkCommand::EndEvent);
  if (!isDone)
  {
    this->Internals->Figures.clear();
    if (!error.empty())
    {
      vtkErrorMacro(<< error);
    }
  }
  return isDone ? 1 : 0;
}

int vtkCSLFFieldQuality::GetNumberOfFigures()
{
  return static_cast<int>(this->Internals->Figures.size());
}

const char* vtkCSLFFieldQuality::GetFigureName(int index)
{
  const bool isInside = index >= 0 && index < this->GetNumberOfFigures();
  return isInside ? this->Internals->Figures[index].Name.c_str() : nullptr;
}

double vtkCSLFFieldQuality::GetPSNR(int index)
{
  if (index < 0 || index >= this->GetNumberOfFigures())
  {
    return 0.0;
  }
  const Figure& figure = this->Internals->Figures[index];
  const double meanSquare = figure.Values > 0.0 ? figure.Squares / figure.Values : 0.0;
  return cslf::PSNR(meanSquare, figure.Peak, this->MaximumPSNR);
}

bool vtkCSLFFieldQuality::GetIsEqual(int index)
{
  return index >= 0 && index < this->GetNumberOfFigures() &&
    this->Internals->Figures[index].Squares == 0.0;
}

void vtkCSLFFieldQuality::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumPSNR: " << this->MaximumPSNR << "\n";
  for (int index = 0; index < this->GetNumberOfFigures(); ++index)
  {
    os << indent << this->GetFigureName(index) << ": " << this->GetPSNR(index) << " dB\n";
  }
}
