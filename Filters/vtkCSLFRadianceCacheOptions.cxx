// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFRadianceCacheOptions.h"

#include "Options/cslfOptionTable.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkCSLFRadianceCacheOptions);

namespace options = cslf::options;

vtkCSLFRadianceCacheOptions::vtkCSLFRadianceCacheOptions()
  : Tolerance(options::CacheTolerance.Default)
  , Spacing(options::CacheSpacing.Default)
  , Samples(options::CacheSamples.Default)
  , Check(options::CheckCache.Default)
{
}

cslfSetOptionMacro(vtkCSLFRadianceCacheOptions, Tolerance, CacheTolerance);
cslfSetOptionMacro(vtkCSLFRadianceCacheOptions, Spacing, CacheSpacing);
cslfSetOptionMacro(vtkCSLFRadianceCacheOptions, Samples, CacheSamples);

void vtkCSLFRadianceCacheOptions::DeepCopy(vtkCSLFRadianceCacheOptions* source)
{
  if (source)
  {
    this->SetTolerance(source->Tolerance);
    this->SetSpacing(source->Spacing);
    this->SetSamples(source->Samples);
    this->SetCheck(source->Check);
  }
}

void vtkCSLFRadianceCacheOptions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "Check: " << (this->Check ? "On" : "Off") << "\n";
}
