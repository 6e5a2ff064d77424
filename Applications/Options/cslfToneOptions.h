// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The command line options for exposure and tone mapping.
 */
#ifndef cslfToneOptions_h
#define cslfToneOptions_h

#include "vtkCSLFToneMapping.h"

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

namespace CLI
{
class App;
}

namespace cslf::tool
{
class ToneOptions
{
public:
  /// Adds --view-exposure and --tone-mapping.
  void AddTo(CLI::App& command);

  vtkCSLFToneMapping* Get() const { return this->Tone; }

private:
  vtkSmartPointer<vtkCSLFToneMapping> Tone = vtkSmartPointer<vtkCSLFToneMapping>::New();
};

/// A pixel of linear radiance, associated with its coverage `alpha`, as displayed over black.
void EncodeShown(vtkCSLFToneMapping* toneMapping, const glm::dvec3& radiance, double alpha,
  unsigned char color[3]);
}

#endif
