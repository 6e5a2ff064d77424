// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFFieldCertifier.h"

#include "Certificate/cslfCertifier.h"
#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfCertificate.h"
#include "cslfDescription.h"
#include "cslfJSON.h"

#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <string>
#include <vector>

vtkStandardNewMacro(vtkCSLFFieldCertifier);
cslfSetClampMacro(vtkCSLFFieldCertifier, Rays, 2, 10000000);
cslfSetClampMacro(vtkCSLFFieldCertifier, RaySamples, 1, 1 << 20);

vtkCSLFFieldCertifier::vtkCSLFFieldCertifier()
  : Rays(cslf::CertificateSettings().Rays)
  , RaySamples(cslf::CertificateSettings().Samples)
  , Result(std::make_unique<cslf::Certificate>())
{
  this->SetNumberOfInputPorts(3);
}

vtkCSLFFieldCertifier::~vtkCSLFFieldCertifier() = default;

int vtkCSLFFieldCertifier::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 1 ? "vtkImageData" : "vtkPolyData");
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

// The output is one empty pixel: the results are figures.
int vtkCSLFFieldCertifier::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const int extent[6] = { 0, 0, 0, 0, 0, 0 };
  vtkInformation* info = outputVector->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  info->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  return 1;
}

int vtkCSLFFieldCertifier::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // What is needed of the field is pulled later.
  vtkInformation* field = inputVector[1]->GetInformationObject(0);
  int extent[6];
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(field, extent);
  extent[5] = extent[4];
  cslf::RequestFirstPart(field, extent);
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

// Says that the field was sampled from another scene. Empty if it was not, or if that is unknown.
std::string vtkCSLFFieldCertifier::FindOtherScene()
{
  std::string error;
  const auto field =
    cslf::Description::ReadFrom(vtkImageData::SafeDownCast(this->GetInputDataObject(1, 0)), error);
  if (!field)
  {
    return error;
  }
  const auto sampling = nlohmann::json::parse(field->Sampling, nullptr, false);
  const auto scene = sampling.find("scene");
  return scene == sampling.end() || *scene == this->GetSceneHash()
    ? std::string()
    : "The field was sampled from another scene, or with other materials or lights: the hash of "
      "its scene is " +
      scene->dump() + ", that of this scene \"" + this->GetSceneHash() + "\".";
}

int vtkCSLFFieldCertifier::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  const cslf::KeptRequests requests(this->GetInputConnection(1, 0));
  if (!this->UpdateScene(inputVector))
  {
    return cslf::IsAborted(this) ? 1 : 0;
  }
  std::string error = this->FindOtherScene();
  cslf::Phase phase(this, "Comparing the field with the scene");
  cslf::Certificate result;
  const auto trace = [this](const std::vector<cslf::PixelBeam>& beams, int samples, int seed,
                       const cslf::Progress& progress, std::vector<cslf::TracedPixel>& pixels)
  { return this->TracePixels(beams, samples, seed, progress, pixels); };
  const bool isMeasured = error.empty() &&
    cslf::MeasureCertificate(
      this->GetInputConnection(1, 0), vtkPolyData::GetData(inputVector[2]), trace,
      { this->Rays, this->RaySamples, this->GetSeed() },
      [&phase](double share) { return phase.Report(share); }, result, error);
  if (isMeasured)
  {
    result.Scene = this->GetSceneHash();
    *this->Result = result;
  }
  else if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
  return isMeasured || error.empty() ? 1 : 0;
}

int vtkCSLFFieldCertifier::Measure()
{
  return cslf::GuardMethod(this, "The field was not measured",
    [this]
    {
      *this->Result = cslf::Certificate();
      this->Modified();
      this->Update();
      return this->Result->Rays > 0 ? 1 : 0;
    });
}

double vtkCSLFFieldCertifier::GetMeanDifference()
{
  return this->Result->Mean;
}

double vtkCSLFFieldCertifier::GetMeanDifferenceError()
{
  return this->Result->MeanError;
}

double vtkCSLFFieldCertifier::GetMeanSquare()
{
  return this->Result->Square;
}

double vtkCSLFFieldCertifier::GetMeanSquareError()
{
  return this->Result->SquareError;
}

double vtkCSLFFieldCertifier::GetRMS()
{
  return this->Result->GetRMS();
}

double vtkCSLFFieldCertifier::GetPSNR()
{
  return this->Result->Rays > 0 ? this->Result->GetPSNR() : 0.0;
}

double vtkCSLFFieldCertifier::GetSeenShare()
{
  return this->Result->Seen;
}

std::string vtkCSLFFieldCertifier::GetCertificate()
{
  return this->Result->Rays > 0 ? this->Result->ToJSON().dump() : std::string();
}

void vtkCSLFFieldCertifier::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Rays: " << this->Rays << "\n";
  os << indent << "RaySamples: " << this->RaySamples << "\n";
  os << indent << "Certificate: " << this->GetCertificate() << "\n";
}
