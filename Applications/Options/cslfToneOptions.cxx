// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfToneOptions.h"

#include "cslfColor.h"
#include "cslfTableOptions.h"

#include <CLI/CLI.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace cslf::tool
{
void ToneOptions::AddTo(CLI::App& command)
{
  using Mapping = vtkCSLFToneMapping;
  Mapping* tone = this->Tone;
  AddOption(command, options::ViewExposure, tone, &Mapping::SetExposure, Positive());
  AddOption(command, options::ToneMapping, tone, &Mapping::SetCurve);
}

void EncodeShown(
  vtkCSLFToneMapping* toneMapping, const glm::dvec3& radiance, double alpha, unsigned char color[3])
{
  unsigned char encoded[4] = { 0, 0, 0, 0 };
  if (alpha > 0.0)
  {
    glm::dvec3 shown = radiance / alpha;
    toneMapping->MapTone(glm::value_ptr(shown), glm::value_ptr(shown));
    EncodeColor(alpha * shown, alpha, encoded);
  }
  std::copy_n(encoded, 3, color);
}
}
