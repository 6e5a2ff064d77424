// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFSampler.h"

#include "Options/cslfOptionTable.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "PathTracing/Texels/cslfFieldRays.h"
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfSlabs.h"
#include "cslfDescription.h"
#include "vtkCSLFEnvironment.h"

#include <vtkDataArraySelection.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCSLFSampler);
cslfSetOptionMacro(vtkCSLFSampler, Viewpoints, Viewpoints);
cslfSetOptionMacro(vtkCSLFSampler, Resolution, Resolution);
cslfSetOptionMacro(vtkCSLFSampler, Offset, Offset);

namespace options = cslf::options;

vtkCSLFSampler::vtkCSLFSampler()
  : Viewpoints(options::Viewpoints.Default)
  , Resolution(options::Resolution.Default)
  , AutomaticCube(options::AutomaticCube.Default)
  , Offset(options::Offset.Default)
{
  this->SetIntegrator(options::Integrator.Default);
  for (const cslf::KnownChannel id : cslf::TexelSums::ListChannels())
  {
    if (id != cslf::KnownChannel::Color)
    {
      this->ChannelSelection->AddArray(cslf::NameOf(id), false);
    }
  }
  this->SetGenerateDepth(options::GenerateDepth.Default);
}

// Here, because subclasses need not know the type of the selection.
vtkCSLFSampler::~vtkCSLFSampler() = default;

vtkDataArraySelection* vtkCSLFSampler::GetChannelSelection()
{
  return this->ChannelSelection;
}

void vtkCSLFSampler::SetGenerateDepth(bool generate)
{
  this->ChannelSelection->SetArraySetting(cslf::DepthName, generate);
}

bool vtkCSLFSampler::GetGenerateDepth()
{
  return this->ChannelSelection->ArrayIsEnabled(cslf::DepthName) != 0;
}

vtkMTimeType vtkCSLFSampler::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ChannelSelection->GetMTime());
}

bool vtkCSLFSampler::CheckParameters()
{
  if (this->ColorType != VTK_UNSIGNED_CHAR && this->ColorType != VTK_FLOAT)
  {
    vtkErrorMacro("ColorType must be VTK_UNSIGNED_CHAR or VTK_FLOAT.");
    return false;
  }
  const bool proper = std::all_of(this->CubeEdges, this->CubeEdges + 3,
                        [](double edge) { return edge > 0.0 && std::isfinite(edge); }) &&
    std::all_of(this->CubeCenter, this->CubeCenter + 3, [](double x) { return std::isfinite(x); });
  if (!this->AutomaticCube && !proper)
  {
    vtkErrorMacro("CubeCenter and CubeEdges must be finite, and the edges above 0.");
    return false;
  }
  return true;
}

int vtkCSLFSampler::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->CheckParameters())
  {
    return 0;
  }
  int extent[6];
  cslf::Layout(this->Viewpoints, this->Resolution).GetWholeExtent(extent);
  const double spacing[3] = { 1.0, 1.0, 1.0 };
  const double origin[3] = { 0.0, 0.0, 0.0 };
  vtkInformation* info = outputVector->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), spacing, 3);
  info->Set(vtkDataObject::ORIGIN(), origin, 3);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  cslf::SplitAlongZ(info);
  vtkDataObject::SetPointDataActiveScalarInfo(info, this->ColorType, 4);
  return 1;
}

int vtkCSLFSampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(info);
  const cslf::BuiltScene* scene = this->UpdateScene(inputVector);
  if (!scene)
  {
    return 0;
  }

  // Describe the field.
  cslf::Description description;
  description.Grid = cslf::Layout(this->Viewpoints, this->Resolution);
  description.Box = cslf::Cube::FromBounds(scene->Bounds, this->Offset);
  if (!this->AutomaticCube)
  {
    description.Box = { { this->CubeCenter[0], this->CubeCenter[1], this->CubeCenter[2] },
      { this->CubeEdges[0], this->CubeEdges[1], this->CubeEdges[2] } };
  }
  if (!description.Box.Contains(scene->Bounds))
  {
    vtkErrorMacro("The cube must strictly contain the scene.");
    return 0;
  }
  if (!this->GetEnvironment()->GetShow())
  {
    description.SceneBounds.emplace();
    std::copy_n(scene->Bounds, 6, description.SceneBounds->begin());
  }
  for (const cslf::KnownChannel id : cslf::TexelSums::ListChannels())
  {
    if (id == cslf::KnownChannel::Color)
    {
      description.Channels.push_back(cslf::MakeChannel(id, this->ColorType));
    }
    else if (this->ChannelSelection->ArrayIsEnabled(cslf::NameOf(id)))
    {
      description.Channels.push_back(cslf::MakeChannel(id));
    }
  }
  const std::string fault = description.FindFault();
  if (!fault.empty())
  {
    vtkErrorMacro("The light field cannot be sampled: " << fault << ".");
    return 0;
  }

  // Allocate the requested slices.
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  cslf::AllocateSlices(description, extent[4], extent[5], output);

  // Render them.
  const int side = this->Resolution;
  const cslf::PictureLayout layout{ side, side, cslf::TileCount, extent[4],
    extent[5] - extent[4] + 1 };
  const auto makeRays = [&](int slice, int tile)
  { return cslf::MakeFieldRays(description.Grid, description.Box, scene->Frame, slice, tile); };
  if (!this->Render(layout, description.Grid.GetSlices(), makeRays, cslf::ViewpointSamples(output)))
  {
    output->Initialize();
    return 1;
  }
  description.Sampling = this->DescribeSampling();
  description.WriteTo(output->GetFieldData());
  return 1;
}

void vtkCSLFSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Viewpoints: " << this->Viewpoints << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "AutomaticCube: " << this->AutomaticCube << "\n";
  os << indent << "Offset: " << this->Offset << "\n";
  os << indent << "CubeCenter: " << this->CubeCenter[0] << " " << this->CubeCenter[1] << " "
     << this->CubeCenter[2] << "\n";
  os << indent << "CubeEdges: " << this->CubeEdges[0] << " " << this->CubeEdges[1] << " "
     << this->CubeEdges[2] << "\n";
  os << indent << "ColorType: " << this->ColorType << "\n";
  os << indent << "GenerateDepth: " << this->GetGenerateDepth() << "\n";
  os << indent << "ChannelSelection:\n";
  this->ChannelSelection->PrintSelf(os, indent.GetNextIndent());
}
