// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFEnvironment.h"

#include "Options/cslfOptionTable.h"

#include <vtkObjectFactory.h>

#include <algorithm>

vtkStandardNewMacro(vtkCSLFEnvironment);

namespace options = cslf::options;

vtkCSLFEnvironment::vtkCSLFEnvironment()
  : Mode(options::EnvironmentMode.Default)
  , Intensity(options::EnvironmentIntensity.Default)
  , Show(options::ShowEnvironment.Default)
{
  std::copy_n(options::EnvironmentColor.Default.begin(), 3, this->Color);
  std::copy_n(options::EnvironmentBottomColor.Default.begin(), 3, this->BottomColor);
  std::copy_n(options::EnvironmentUp.Default.begin(), 3, this->Up);
}

vtkCSLFEnvironment::~vtkCSLFEnvironment()
{
  this->SetFileName(nullptr);
}

cslfSetOptionMacro(vtkCSLFEnvironment, Mode, EnvironmentMode);
cslfSetOptionMacro(vtkCSLFEnvironment, Intensity, EnvironmentIntensity);

void vtkCSLFEnvironment::DeepCopy(vtkCSLFEnvironment* source)
{
  if (source)
  {
    this->SetMode(source->Mode);
    this->SetColor(source->Color);
    this->SetBottomColor(source->BottomColor);
    this->SetIntensity(source->Intensity);
    this->SetFileName(source->FileName);
    this->SetUp(source->Up);
    this->SetShow(source->Show);
  }
}

void vtkCSLFEnvironment::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << this->Mode << "\n";
  os << indent << "Color: " << this->Color[0] << " " << this->Color[1] << " " << this->Color[2]
     << "\n";
  os << indent << "BottomColor: " << this->BottomColor[0] << " " << this->BottomColor[1] << " "
     << this->BottomColor[2] << "\n";
  os << indent << "Intensity: " << this->Intensity << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Up: " << this->Up[0] << " " << this->Up[1] << " " << this->Up[2] << "\n";
  os << indent << "Show: " << (this->Show ? "On" : "Off") << "\n";
}
