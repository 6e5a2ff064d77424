// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Compares radiance caching with path tracing.
 */
#ifndef cslfIntegratorComparison_h
#define cslfIntegratorComparison_h

#include "vtkCSLFImageQuality.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkNew.h>

namespace cslf
{
namespace testing
{
/// The picture of a scene by either integrator.
class IntegratorComparison
{
public:
  IntegratorComparison(vtkDataObject* scene, double x, double y, double z)
  {
    vtkNew<vtkCamera> camera;
    camera->SetPosition(x, y, z);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewAngle(40.0);
    for (vtkCSLFViewTracer* tracer : { this->Reference.Get(), this->Cached.Get() })
    {
      tracer->AddInputDataObject(0, scene);
      tracer->SetCamera(camera);
      tracer->SetSize(32, 32);
      tracer->SetSamples(256);
    }
    this->Cached->SetIntegratorToRadianceCaching();
    this->Cached->GetCacheOptions()->SetSpacing(0.02);
    this->Cached->GetCacheOptions()->SetTolerance(0.02);
    this->Cached->SetSamples(64);
  }

  double GetPSNR()
  {
    this->Reference->Update();
    this->Cached->Update();
    vtkNew<vtkCSLFImageQuality> quality;
    quality->SetInputData(0, this->Reference->GetOutput());
    quality->SetInputData(1, this->Cached->GetOutput());
    quality->Update();
    return quality->GetPSNR();
  }

  vtkNew<vtkCSLFViewTracer> Reference;
  vtkNew<vtkCSLFViewTracer> Cached;
};
}
}

#endif
