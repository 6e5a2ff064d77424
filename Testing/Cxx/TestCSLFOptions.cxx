// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The options of path tracers, fields and mappers: defaults and ranges are those of the table of
// options, and a change of an option object executes the filters that use it again.
#include "Options/cslfOptionTable.h"
#include "cslfOptionChecks.h"
#include "cslfTesting.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFResample.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFToneMapping.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <functional>
#include <string>

namespace
{
namespace options = cslf::options;
using cslf::testing::CheckOption;
using cslf::testing::CheckVector;

void TestPathTracer()
{
  using Tracer = vtkCSLFPathTracer;
  vtkNew<vtkCSLFSampler> sampler;
  Tracer* tracer = sampler;
  CheckOption(options::Quality, tracer, &Tracer::SetQuality, &Tracer::GetQuality);
  CheckOption(options::Samples, tracer, &Tracer::SetSamples, &Tracer::GetSamples);
  CheckOption(options::NoiseTarget, tracer, &Tracer::SetNoiseTarget, &Tracer::GetNoiseTarget);
  CheckOption(options::MaximumDepth, tracer, &Tracer::SetMaximumDepth, &Tracer::GetMaximumDepth);
  CheckOption(options::Seed, tracer, &Tracer::SetSeed, &Tracer::GetSeed);
  CheckOption(options::Exposure, tracer, &Tracer::SetExposure, &Tracer::GetExposure);
}

/// The quality determines what is automatic, and nothing else.
void TestQuality()
{
  vtkNew<vtkCSLFSampler> sampler;
  vtkCSLFRadianceCacheOptions* cache = sampler->GetCacheOptions();
  CSLF_CHECK(sampler->GetQuality() == vtkCSLFPathTracer::Good);
  CSLF_CHECK(sampler->GetUsedSamples() == 32 && sampler->GetUsedNoiseTarget() == 0.004);
  CSLF_CHECK(sampler->GetUsedCacheTolerance() == 1.0 / 64.0);
  CSLF_CHECK(sampler->GetUsedCacheSamples() == 512);
  sampler->SetNoiseTarget(0.0);
  cache->SetTolerance(0.01);
  sampler->SetQualityToPreview();
  CSLF_CHECK(sampler->GetUsedSamples() == 4 && sampler->GetUsedNoiseTarget() == 0.0);
  CSLF_CHECK(sampler->GetUsedCacheTolerance() == 0.01 && sampler->GetUsedCacheSamples() == 32);
  sampler->SetSamples(7);
  cache->SetSamples(100);
  sampler->SetQualityToBest();
  CSLF_CHECK(sampler->GetUsedSamples() == 7 && sampler->GetUsedCacheSamples() == 100);
  sampler->SetSamples(0);
  CSLF_CHECK(sampler->GetUsedSamples() == 256);

  // The quality is recorded.
  vtkNew<vtkCSLFCornellBoxSource> box;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(2);
  sampler->SetResolution(2);
  sampler->SetQualityToPreview();
  sampler->Update();
  vtkFieldData* data = sampler->GetOutput()->GetFieldData();
  auto* description = vtkStringArray::SafeDownCast(data->GetAbstractArray("CSLF"));
  CSLF_CHECK(description->GetValue(0).find("\"preview\"") != std::string::npos);
}

void TestEnvironment()
{
  using Environment = vtkCSLFEnvironment;
  vtkNew<Environment> light;
  CheckOption(options::EnvironmentMode, light.Get(), &Environment::SetMode, &Environment::GetMode);
  CheckOption(options::EnvironmentIntensity, light.Get(), &Environment::SetIntensity,
    &Environment::GetIntensity);
  CheckOption(options::ShowEnvironment, light.Get(), &Environment::SetShow, &Environment::GetShow);
  CheckVector(options::EnvironmentColor, light->GetColor());
  CheckVector(options::EnvironmentBottomColor, light->GetBottomColor());
  CheckVector(options::EnvironmentUp, light->GetUp());
  CSLF_CHECK(light->GetFileName() == nullptr);

  light->SetModeToGradient();
  light->SetColor(0.1, 0.2, 0.3);
  light->SetBottomColor(0.4, 0.5, 0.6);
  light->SetIntensity(2.0);
  light->SetFileName("sky.exr");
  light->SetUp(0.0, 0.0, 1.0);
  light->ShowOn();
  vtkNew<Environment> copy;
  copy->DeepCopy(light);
  CSLF_CHECK(copy->GetMode() == Environment::GradientEnvironment && copy->GetShow());
  CSLF_CHECK(copy->GetColor()[1] == 0.2 && copy->GetBottomColor()[2] == 0.6);
  CSLF_CHECK(copy->GetIntensity() == 2.0 && copy->GetUp()[2] == 1.0);
  CSLF_CHECK(std::string(copy->GetFileName()) == "sky.exr");
}

void TestCacheOptions()
{
  using Cache = vtkCSLFRadianceCacheOptions;
  vtkNew<Cache> cache;
  CheckOption(options::CacheTolerance, cache.Get(), &Cache::SetTolerance, &Cache::GetTolerance);
  CheckOption(options::CacheSpacing, cache.Get(), &Cache::SetSpacing, &Cache::GetSpacing);
  CheckOption(options::CacheSamples, cache.Get(), &Cache::SetSamples, &Cache::GetSamples);
  CheckOption(options::CheckCache, cache.Get(), &Cache::SetCheck, &Cache::GetCheck);
  cache->SetTolerance(0.5);
  cache->SetSamples(100);
  vtkNew<Cache> copy;
  copy->DeepCopy(cache);
  CSLF_CHECK(copy->GetTolerance() == 0.5 && copy->GetSamples() == 100 && copy->GetCheck());
}

void TestFieldOptions()
{
  using Sampler = vtkCSLFSampler;
  using Resample = vtkCSLFResample;
  vtkNew<Sampler> sampler;
  Sampler* s = sampler;
  CheckOption(options::Viewpoints, s, &Sampler::SetViewpoints, &Sampler::GetViewpoints);
  CheckOption(options::Resolution, s, &Sampler::SetResolution, &Sampler::GetResolution);
  CheckOption(options::Offset, s, &Sampler::SetOffset, &Sampler::GetOffset);
  CheckOption(options::AutomaticCube, s, &Sampler::SetAutomaticCube, &Sampler::GetAutomaticCube);
  CheckOption(options::GenerateDepth, s, &Sampler::SetGenerateDepth, &Sampler::GetGenerateDepth);
  CSLF_CHECK(sampler->GetIntegrator() == options::Integrator.Default);
  vtkNew<Resample> resample;
  CheckOption(options::ResolutionDivisor, resample.Get(), &Resample::SetResolutionDivisor,
    &Resample::GetResolutionDivisor);
  CheckOption(options::ViewpointStride, resample.Get(), &Resample::SetViewpointStride,
    &Resample::GetViewpointStride);
}

void TestMapper()
{
  using Mapper = vtkCSLFMapper;
  using ToneMapping = vtkCSLFToneMapping;
  vtkNew<Mapper> mapper;
  Mapper* m = mapper;
  CheckOption(options::Lookup, m, &Mapper::SetLookup, &Mapper::GetLookup);
  CheckOption(options::PixelSamples, m, &Mapper::SetPixelSamples, &Mapper::GetPixelSamples);
  CheckVector(options::FocalPoint, mapper->GetFocalPoint());
  CSLF_CHECK(mapper->GetTextureMemoryLimit() == vtkTypeInt64(2) << 30);
  ToneMapping* tone = mapper->GetToneMapping();
  CheckOption(options::ViewExposure, tone, &ToneMapping::SetExposure, &ToneMapping::GetExposure);
  CheckOption(options::ToneMapping, tone, &ToneMapping::SetCurve, &ToneMapping::GetCurve);
}

void TestExecution()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(2);
  sampler->SetResolution(4);
  sampler->SetSamples(1);
  sampler->GetCacheOptions()->SetSpacing(0.1);
  sampler->GetCacheOptions()->CheckOff();
  cslf::testing::ExecutionCounter counter(sampler);
  vtkNew<vtkCSLFEnvironment> environment;
  vtkNew<vtkCSLFRadianceCacheOptions> cacheOptions;
  cacheOptions->DeepCopy(sampler->GetCacheOptions());
  const std::function<void()> changes[] = { [] {},
    [&] { sampler->GetEnvironment()->SetModeToNone(); },
    [&] { sampler->GetEnvironment()->SetUp(1.0, 0.0, 0.0); },
    [&] { sampler->GetCacheOptions()->SetTolerance(0.1); },
    [&] { sampler->SetEnvironment(environment); }, [&] { environment->SetIntensity(2.0); },
    [&] { sampler->SetCacheOptions(cacheOptions); }, [&] { cacheOptions->SetSamples(64); } };
  for (const auto& change : changes)
  {
    change();
    sampler->Update();
    CSLF_CHECK(counter.Take() == 1);
    sampler->Update();
    CSLF_CHECK(counter.Take() == 0);
  }

  // Null selects the defaults.
  sampler->SetEnvironment(nullptr);
  sampler->SetCacheOptions(nullptr);
  CSLF_CHECK(sampler->GetEnvironment() && sampler->GetEnvironment() != environment);
  CSLF_CHECK(sampler->GetEnvironment()->GetIntensity() == options::EnvironmentIntensity.Default);
  CSLF_CHECK(sampler->GetCacheOptions() && sampler->GetCacheOptions() != cacheOptions);
  CSLF_CHECK(sampler->GetCacheOptions()->GetSamples() == options::CacheSamples.Default);
}
}

int TestCSLFOptions(int, char*[])
{
  TestPathTracer();
  TestQuality();
  TestEnvironment();
  TestCacheOptions();
  TestFieldOptions();
  TestMapper();
  TestExecution();
  return cslf::testing::Result();
}
