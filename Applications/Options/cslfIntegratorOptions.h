// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The integrator's options on the command line, and its cost.
 */
#ifndef cslfIntegratorOptions_h
#define cslfIntegratorOptions_h

#include "Options/cslfOptionTable.h"
#include "cslfJSON.h"

#include "vtkCSLFRadianceCacheOptions.h"

#include <vtkSmartPointer.h>

class vtkCSLFPathTracer;

namespace CLI
{
class App;
}

namespace cslf::tool
{
class IntegratorOptions
{
public:
  /// `integrator` is the default, of vtkCSLFPathTracer::Integrators.
  explicit IntegratorOptions(int integrator)
    : Integrator(integrator)
  {
  }

  void AddTo(CLI::App& command);
  void Apply(vtkCSLFPathTracer* tracer) const;

  /// The cost of the tracer's last update.
  static nlohmann::json GetCost(vtkCSLFPathTracer* tracer);

private:
  int Integrator;
  int Interreflection = options::Interreflection.Default;
  int Quality = options::Quality.Default;
  int Samples = options::Samples.Default;
  double NoiseTarget = options::NoiseTarget.Default;
  int Seed = options::Seed.Default;
  vtkSmartPointer<vtkCSLFRadianceCacheOptions> Cache =
    vtkSmartPointer<vtkCSLFRadianceCacheOptions>::New();
};
}

#endif
