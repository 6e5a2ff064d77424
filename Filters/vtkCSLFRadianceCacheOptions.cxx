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

void vtkCSLFRadianceCacheOptions::SetTolerance(double tolerance)
{
  cslf::SetClamped(this, this->Tolerance, tolerance, options::CacheTolerance);
}

void vtkCSLFRadianceCacheOptions::SetSpacing(double spacing)
{
  cslf::SetClamped(this, this->Spacing, spacing, options::CacheSpacing);
}

void vtkCSLFRadianceCacheOptions::SetSamples(int samples)
{
  cslf::SetClamped(this, this->Samples, samples, options::CacheSamples);
}

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
