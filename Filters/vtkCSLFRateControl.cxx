// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFRateControl.h"

#include "Options/cslfOptionTable.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkCSLFRateControl);

namespace options = cslf::options;

vtkCSLFRateControl::vtkCSLFRateControl()
  : CRF(options::CRF.Default)
  , CoverageCRF(options::CoverageCRF.Default)
  , DepthCRF(options::DepthCRF.Default)
  , TargetRatio(options::TargetRatio.Default)
  , TargetSize(options::TargetSize.Default)
  , TargetPSNR(options::TargetPSNR.Default)
  , KeyViewStep(options::KeyViewStep.Default)
  , TargetNovelViewPSNR(options::TargetNovelViewPSNR.Default)
{
}

void vtkCSLFRateControl::SetCRF(double factor)
{
  cslf::SetClamped(this, this->CRF, factor, options::CRF);
}

void vtkCSLFRateControl::SetCoverageCRF(double factor)
{
  cslf::SetClamped(this, this->CoverageCRF, factor, options::CoverageCRF);
}

void vtkCSLFRateControl::SetDepthCRF(double factor)
{
  cslf::SetClamped(this, this->DepthCRF, factor, options::DepthCRF);
}

void vtkCSLFRateControl::SetTargetRatio(double ratio)
{
  cslf::SetClamped(this, this->TargetRatio, ratio, options::TargetRatio);
}

void vtkCSLFRateControl::SetTargetSize(double bytes)
{
  cslf::SetClamped(this, this->TargetSize, bytes, options::TargetSize);
}

void vtkCSLFRateControl::SetTargetPSNR(double psnr)
{
  cslf::SetClamped(this, this->TargetPSNR, psnr, options::TargetPSNR);
}

void vtkCSLFRateControl::SetKeyViewStep(int step)
{
  cslf::SetClamped(this, this->KeyViewStep, step, options::KeyViewStep);
}

void vtkCSLFRateControl::SetTargetNovelViewPSNR(double psnr)
{
  cslf::SetClamped(this, this->TargetNovelViewPSNR, psnr, options::TargetNovelViewPSNR);
}

void vtkCSLFRateControl::DeepCopy(vtkCSLFRateControl* source)
{
  if (source)
  {
    this->SetCRF(source->CRF);
    this->SetCoverageCRF(source->CoverageCRF);
    this->SetDepthCRF(source->DepthCRF);
    this->SetTargetRatio(source->TargetRatio);
    this->SetTargetSize(source->TargetSize);
    this->SetTargetPSNR(source->TargetPSNR);
    this->SetKeyViewStep(source->KeyViewStep);
    this->SetTargetNovelViewPSNR(source->TargetNovelViewPSNR);
  }
}

void vtkCSLFRateControl::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CRF: " << this->CRF << "\n";
  os << indent << "CoverageCRF: " << this->CoverageCRF << "\n";
  os << indent << "DepthCRF: " << this->DepthCRF << "\n";
  os << indent << "TargetRatio: " << this->TargetRatio << "\n";
  os << indent << "TargetSize: " << this->TargetSize << "\n";
  os << indent << "TargetPSNR: " << this->TargetPSNR << "\n";
  os << indent << "KeyViewStep: " << this->KeyViewStep << "\n";
  os << indent << "TargetNovelViewPSNR: " << this->TargetNovelViewPSNR << "\n";
}
