// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The command line options for exposure and tone mapping.
 */
#ifndef cslfToneOptions_h
#define cslfToneOptions_h

#include "cslfToneMapping.h"

#include <string>

class vtkCSLFMapper;

namespace CLI
{
class App;
}

namespace cslf
{
namespace tool
{
class ToneOptions
{
public:
  /// Adds --view-exposure and --tone-mapping.
  void AddTo(CLI::App& command);

  ToneMapping Get() const;

private:
  double Exposure = 1.0;
  std::string Curve = "clamp";
};

/// Sets these options of a mapper.
void SetToneMapping(vtkCSLFMapper* mapper, const ToneMapping& toneMapping);

/// A pixel of linear radiance, associated with its coverage `alpha`, as displayed over black.
void EncodeShown(
  const ToneMapping& toneMapping, const glm::dvec3& radiance, double alpha, unsigned char color[3]);
}
}

#endif
