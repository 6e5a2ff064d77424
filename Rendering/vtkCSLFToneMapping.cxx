// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFToneMapping.h"

#include "Options/cslfOptionTable.h"

#include <vtkObjectFactory.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

vtkStandardNewMacro(vtkCSLFToneMapping);
cslfSetOptionMacro(vtkCSLFToneMapping, Exposure, ViewExposure);
cslfSetOptionMacro(vtkCSLFToneMapping, Curve, ToneMapping);

namespace options = cslf::options;

vtkCSLFToneMapping::vtkCSLFToneMapping()
  : Exposure(options::ViewExposure.Default)
  , Curve(options::ToneMapping.Default)
{
}

const char* vtkCSLFToneMapping::GetCurveAsString()
{
  return options::ToneMapping.Names[this->Curve];
}

// The function MapTone of cslfToneMapping.glsl has the same results.
void vtkCSLFToneMapping::MapTone(const double radiance[3], double display[3]) const
{
  glm::dvec3 mapped = this->Exposure * glm::max(glm::make_vec3(radiance), 0.0);
  if (this->Curve == Reinhard)
  {
    mapped /= 1.0 + glm::dot(mapped, glm::dvec3(0.2126, 0.7152, 0.0722));
  }
  else if (this->Curve == ACES)
  {
    mapped = mapped * (2.51 * mapped + 0.03) / (mapped * (2.43 * mapped + 0.59) + 0.14);
  }
  std::copy_n(glm::value_ptr(mapped), 3, display);
}

void vtkCSLFToneMapping::DeepCopy(vtkCSLFToneMapping* source)
{
  if (source)
  {
    this->SetExposure(source->Exposure);
    this->SetCurve(source->Curve);
  }
}

void vtkCSLFToneMapping::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "Curve: " << this->GetCurveAsString() << "\n";
}
