// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The check of radiance caching: it reports no difference where there is none, and warns of an
// existing one.
#include "cslfTesting.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkSphereSource.h>
#include <vtkStringArray.h>
#include <vtkTestErrorObserver.h>

#include <cmath>
#include <string>

namespace
{
std::string GetDescription(vtkCSLFSampler* sampler)
{
  auto* text =
    vtkStringArray::SafeDownCast(sampler->GetOutput()->GetFieldData()->GetAbstractArray("CSLF"));
  return text ? text->GetValue(0) : std::string();
}

void TestSampler()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  vtkNew<vtkTest::ErrorObserver> observer;
  sampler->AddObserver(vtkCommand::WarningEvent, observer);
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(2);
  sampler->SetResolution(16);
  sampler->GetEnvironment()->SetModeToNone();
  sampler->GetCacheOptions()->SetSpacing(0.02);
  CSLF_CHECK(sampler->GetCacheOptions()->GetCheck());
  sampler->Update();

  // No difference.
  CSLF_CHECK(!observer->GetWarning());
  CSLF_CHECK(sampler->GetCheckedTexels() > 900 && sampler->GetCheckedTexels() <= 1024);
  CSLF_CHECK(sampler->GetCacheMeanDifferenceError() > 0.0);
  CSLF_CHECK(sampler->GetCacheMeanDifferenceError() < 0.01);
  CSLF_CHECK(std::abs(sampler->GetCacheMeanDifference()) <
    0.02 + 3.0 * sampler->GetCacheMeanDifferenceError());
  CSLF_CHECK(sampler->GetCacheRMSDifference() < 0.01 + 3.0 * sampler->GetCacheRMSDifferenceError());
  CSLF_CHECK_NEAR(sampler->GetUsedCacheSpacing(), 0.02, 1e-6);
  const std::string description = GetDescription(sampler);
  CSLF_CHECK(description.find("\"check\"") != std::string::npos);

  // The same cache, and the same results.
  const double mean = sampler->GetCacheMeanDifference();
  sampler->SetSamples(16);
  sampler->Update();
  CSLF_CHECK(sampler->GetNumberOfCacheRays() == 0);
  CSLF_CHECK(sampler->GetCacheMeanDifference() == mean);
  sampler->GetCacheOptions()->SetTolerance(0.01);
  sampler->GetCacheOptions()->SetTolerance(0.0);
  sampler->SetSeed(1);
  sampler->Update();
  CSLF_CHECK(sampler->GetCacheMeanDifference() != mean);
  sampler->SetSeed(0);
  sampler->SetSamples(0);
  sampler->Update();
  CSLF_CHECK(sampler->GetCacheMeanDifference() == mean);
  CSLF_CHECK(GetDescription(sampler) == description);

  // Switched off.
  sampler->GetCacheOptions()->CheckOff();
  sampler->SetSeed(2);
  sampler->Update();
  CSLF_CHECK(sampler->GetCheckedTexels() == 0 && sampler->GetCacheMeanDifference() == 0.0);
  CSLF_CHECK(GetDescription(sampler).find("\"check\"") == std::string::npos);
}

/// The check detects a cache that is much too coarse.
void TestWarning()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.4, 0.2, 4.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewAngle(40.0);
  vtkNew<vtkCSLFViewTracer> tracer;
  vtkNew<vtkTest::ErrorObserver> observer;
  tracer->AddObserver(vtkCommand::WarningEvent, observer);
  tracer->SetInputConnection(box->GetOutputPort());
  tracer->SetCamera(camera);
  tracer->SetSize(64, 64);
  tracer->GetEnvironment()->SetModeToNone();
  tracer->Update();
  CSLF_CHECK(tracer->GetCheckedTexels() == 0 && tracer->GetUsedCacheSpacing() == 0.0);

  tracer->SetIntegratorToRadianceCaching();
  tracer->GetCacheOptions()->SetSpacing(0.02);
  tracer->Update();
  CSLF_CHECK(!observer->GetWarning());
  CSLF_CHECK(tracer->GetCheckedTexels() > 0);

  tracer->GetCacheOptions()->SetSpacing(1.0);
  tracer->Update();
  CSLF_CHECK(observer->GetWarning());
  CSLF_CHECK(observer->GetWarningMessage().find("differs from path tracing") != std::string::npos);
  CSLF_CHECK(std::abs(tracer->GetCacheMeanDifference()) > 0.02);
  observer->Clear();

  // It is reported once.
  tracer->SetSamples(16);
  tracer->Update();
  CSLF_CHECK(!observer->GetWarning());
}

/// Without visible surfaces there is no comparison.
void TestNothing()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 0.0, 4.0);
  camera->SetFocalPoint(0.0, 0.0, 8.0);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputConnection(sphere->GetOutputPort());
  tracer->SetCamera(camera);
  tracer->SetSize(16, 16);
  tracer->SetIntegratorToRadianceCaching();
  tracer->Update();
  CSLF_CHECK(tracer->GetCheckedTexels() == 0);
}
}

int TestCSLFCacheCheck(int, char*[])
{
  TestSampler();
  TestWarning();
  TestNothing();
  return cslf::testing::Result();
}
