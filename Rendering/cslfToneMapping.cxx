// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfToneMapping.h"

#include "vtkCSLFMapper.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cslf
{
glm::dvec3 ToneMapping::MapTone(const glm::dvec3& radiance) const
{
  const glm::dvec3 exposed = this->Exposure * glm::max(radiance, 0.0);
  switch (this->Curve)
  {
    case vtkCSLFMapper::REINHARD:
      return exposed / (1.0 + glm::dot(exposed, glm::dvec3(0.2126, 0.7152, 0.0722)));
    case vtkCSLFMapper::ACES:
      return exposed * (2.51 * exposed + 0.03) / (exposed * (2.43 * exposed + 0.59) + 0.14);
    default:
      return exposed;
  }
}
}
