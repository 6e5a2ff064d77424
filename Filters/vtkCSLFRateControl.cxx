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

cslfSetOptionMacro(vtkCSLFRateControl, CRF, CRF);
cslfSetOptionMacro(vtkCSLFRateControl, CoverageCRF, CoverageCRF);
cslfSetOptionMacro(vtkCSLFRateControl, DepthCRF, DepthCRF);
cslfSetOptionMacro(vtkCSLFRateControl, TargetRatio, TargetRatio);
cslfSetOptionMacro(vtkCSLFRateControl, TargetSize, TargetSize);
cslfSetOptionMacro(vtkCSLFRateControl, TargetPSNR, TargetPSNR);
cslfSetOptionMacro(vtkCSLFRateControl, KeyViewStep, KeyViewStep);
cslfSetOptionMacro(vtkCSLFRateControl, TargetNovelViewPSNR, TargetNovelViewPSNR);

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
