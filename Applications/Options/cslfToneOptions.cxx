// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfToneOptions.h"

#include "cslfColor.h"
#include "cslfNumberChecks.h"

#include "vtkCSLFMapper.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace cslf
{
namespace tool
{
void ToneOptions::AddTo(CLI::App& command)
{
  command
    .add_option("--view-exposure", this->Exposure,
      "factor of the displayed radiance; values below 1 reveal details brighter than white in "
      "float fields")
    ->check(Positive())
    ->capture_default_str();
  command.add_option("--tone-mapping", this->Curve, "curve for values above white")
    ->check(CLI::IsMember({ "clamp", "reinhard", "aces" }))
    ->capture_default_str();
}

ToneMapping ToneOptions::Get() const
{
  return { this->Exposure,
    this->Curve == "clamp"        ? vtkCSLFMapper::CLAMP
      : this->Curve == "reinhard" ? vtkCSLFMapper::REINHARD
                                  : vtkCSLFMapper::ACES };
}

void SetToneMapping(vtkCSLFMapper* mapper, const ToneMapping& toneMapping)
{
  mapper->SetExposure(toneMapping.Exposure);
  mapper->SetToneMapping(toneMapping.Curve);
}

void EncodeShown(
  const ToneMapping& toneMapping, const glm::dvec3& radiance, double alpha, unsigned char color[3])
{
  unsigned char encoded[4] = { 0, 0, 0, 0 };
  if (alpha > 0.0)
  {
    EncodeColor(alpha * toneMapping.MapTone(radiance / alpha), alpha, encoded);
  }
  std::copy_n(encoded, 3, color);
}
}
}
