// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares a field with path-traced texels: the effect of noise, the cap, slabs, threads, errors.
#include "Quality/cslfTexelChoice.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFFieldQuality.h"
#include "vtkCSLFFieldReference.h"
#include "vtkCSLFSampler.h"

#include "cslfFieldSource.h"
#include "cslfTesting.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTestErrorObserver.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

namespace
{
constexpr int FieldSamples = 16;

/// Light and materials that every tracer of this test shares.
void SetScene(vtkCSLFPathTracer* tracer)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(32);
  sphere->SetPhiResolution(32);
  sphere->Update();
  tracer->AddInputData(sphere->GetOutput());
  tracer->GetEnvironment()->SetModeToGradient();
  tracer->SetMaximumDepth(2);
  tracer->SetIntegratorToPathTracing();
}

vtkSmartPointer<vtkImageData> MakeField(int seed, int type = VTK_UNSIGNED_CHAR)
{
  vtkNew<vtkCSLFSampler> sampler;
  SetScene(sampler);
  sampler->SetViewpoints(2);
  sampler->SetResolution(12);
  sampler->SetSamples(FieldSamples);
  sampler->SetSeed(seed);
  sampler->SetColorType(type);
  sampler->Update();
  return sampler->GetOutput();
}

vtkSmartPointer<vtkCSLFFieldReference> MakeReference(vtkImageData* field, int samples, int texels)
{
  auto reference = vtkSmartPointer<vtkCSLFFieldReference>::New();
  SetScene(reference);
  reference->SetInputData(1, field);
  reference->SetSamples(samples);
  reference->SetTexels(texels);
  return reference;
}

std::string GetBytes(vtkCSLFFieldReference* reference, const char* name)
{
  vtkDataArray* array = reference->GetOutput()->GetPointData()->GetArray(name);
  CSLF_CHECK(array);
  return array ? std::string(static_cast<const char*>(array->GetVoidPointer(0)),
                   array->GetNumberOfValues() * array->GetDataTypeSize())
               : std::string();
}

void TestChoice()
{
  constexpr std::uint64_t total = 1003;
  for (const std::uint64_t count : { 1u, 10u, 1000u, 1003u, 5000u })
  {
    const cslf::TexelChoice choice(total, count, 7);
    CSLF_CHECK(choice.GetCount() == std::min(count, total));
    std::set<std::uint64_t> chosen;
    for (std::uint64_t k = 0; k < choice.GetCount(); ++k)
    {
      CSLF_CHECK(chosen.empty() || choice[k] > *chosen.rbegin());
      chosen.insert(choice[k]);
    }
    CSLF_CHECK(chosen.size() == choice.GetCount() && *chosen.rbegin() < total);
  }
  int different = 0;
  for (std::uint64_t k = 0; k < 10; ++k)
  {
    different += cslf::TexelChoice(total, 10, 1)[k] != cslf::TexelChoice(total, 10, 2)[k];
  }
  CSLF_CHECK(different > 5);
}

/// Two fields with different seeds differ by twice the variance of one. A field and a reference
/// without noise differ by the variance itself.
void TestNoise()
{
  const auto field = MakeField(1);
  vtkNew<vtkCSLFFieldQuality> seeds;
  seeds->SetInputData(0, field);
  seeds->SetInputData(1, MakeField(2));
  CSLF_CHECK(seeds->Measure() == 1);
  const double expected = seeds->GetPSNR(0) + 10.0 * std::log10(2.0);

  const auto converged = MakeReference(field, 1024, VTK_INT_MAX);
  converged->Update();
  CSLF_CHECK(converged->GetNumberOfTexels() == field->GetNumberOfPoints());
  CSLF_CHECK_NEAR(converged->GetPSNR(), expected, 0.5);
  CSLF_CHECK(converged->GetNoiseFloor() > converged->GetPSNR() + 10.0);

  // A subset of them gives nearly the same.
  const auto some = MakeReference(field, 1024, 3000);
  some->Update();
  CSLF_CHECK(some->GetNumberOfTexels() == 3000);
  CSLF_CHECK_NEAR(some->GetPSNR(), converged->GetPSNR(), 1.0);

  // A float field means the same.
  const auto floats = MakeReference(MakeField(1, VTK_FLOAT), 1024, 3000);
  floats->Update();
  CSLF_CHECK_NEAR(floats->GetPSNR(), some->GetPSNR(), 1e-9);

  // It may be shown at other exposures. Noise is most visible where little is clipped.
  CSLF_CHECK(some->GetNumberOfViewExposures() == 1 && some->GetViewExposure(0) == 1.0);
  CSLF_CHECK(some->GetPSNR(0) == some->GetPSNR());
  CSLF_CHECK(floats->GetNumberOfViewExposures() == 5);
  CSLF_CHECK(floats->GetViewExposure(2) == 1.0 && floats->GetPSNR(2) == floats->GetPSNR());
  CSLF_CHECK(floats->GetNoiseFloor(2) == floats->GetNoiseFloor());
  CSLF_CHECK(floats->GetViewExposure(0) == 1.0 / 16 && floats->GetViewExposure(4) == 16.0);
  CSLF_CHECK(floats->GetPSNR(0) > floats->GetPSNR() + 6.0);
  CSLF_CHECK(floats->GetNoiseFloor(0) > floats->GetNoiseFloor() + 6.0);
  CSLF_CHECK(floats->GetPSNR(5) == 0.0 && floats->GetViewExposure(-1) == 0.0);

  // A reference with few samples reports its noise: two of them differ by that much.
  const auto first = MakeReference(field, 32, VTK_INT_MAX);
  const auto second = MakeReference(field, 32, VTK_INT_MAX);
  second->SetSeed(1);
  first->Update();
  second->Update();
  vtkDataArray* a = first->GetOutput()->GetPointData()->GetArray("Reference");
  vtkDataArray* b = second->GetOutput()->GetPointData()->GetArray("Reference");
  double squares = 0.0;
  for (vtkIdType texel = 0; texel < a->GetNumberOfTuples(); ++texel)
  {
    for (int i = 0; i < 3; ++i)
    {
      squares += std::pow(a->GetComponent(texel, i) - b->GetComponent(texel, i), 2);
    }
  }
  const double variance = squares / 2.0 / a->GetNumberOfValues() - 1.0 / 12.0; // minus rounding
  CSLF_CHECK_NEAR(first->GetNoiseFloor(), 10.0 * std::log10(255.0 * 255.0 / variance), 0.5);
}

/// A field with the same samples as the reference is as good as possible.
void TestEqual()
{
  const auto field = MakeField(1);
  const auto reference = MakeReference(field, 64, 500);
  reference->Update();
  CSLF_CHECK(reference->GetPSNR() < reference->GetMaximumPSNR());
  vtkPointData* found = reference->GetOutput()->GetPointData();
  vtkNew<vtkImageData> copy;
  copy->DeepCopy(field);
  vtkDataArray* colors = copy->GetPointData()->GetArray("Color");
  for (vtkIdType k = 0; k < found->GetArray("Texel")->GetNumberOfTuples(); ++k)
  {
    const auto texel = static_cast<vtkIdType>(found->GetArray("Texel")->GetComponent(k, 0));
    for (int i = 0; i < 3; ++i)
    {
      CSLF_CHECK(found->GetArray("Field")->GetComponent(k, i) == colors->GetComponent(texel, i));
      colors->SetComponent(texel, i, found->GetArray("Reference")->GetComponent(k, i));
    }
  }
  reference->SetInputData(1, copy);
  reference->Update();
  CSLF_CHECK(reference->GetPSNR() == 60.0);
  reference->SetMaximumPSNR(48.0);
  reference->Update();
  CSLF_CHECK(reference->GetPSNR() == 48.0);
}

/// The figures do not depend on threads and slabs; no slice is pulled twice.
void TestSlabsAndThreads()
{
  const auto field = MakeField(1);
  const int slices = field->GetDimensions()[2];
  const auto whole = MakeReference(field, 32, 700);
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 2 }, [&]() { whole->Update(); });
  const auto parts = MakeReference(field, 32, 700);
  const auto source = cslf::testing::MakeSource(field);
  parts->SetInputConnection(1, source->GetOutputPort());
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1 }, [&]() { parts->Update(); });
  CSLF_CHECK(source->MaximumRequest == 1 && source->Slices <= slices + 1);
  CSLF_CHECK(parts->GetPSNR() == whole->GetPSNR());
  CSLF_CHECK(parts->GetNoiseFloor() == whole->GetNoiseFloor());
  for (const char* name : { "Reference", "Field", "Texel" })
  {
    CSLF_CHECK(GetBytes(parts, name) == GetBytes(whole, name));
  }

  // Viewpoints without a chosen texel are not pulled.
  const auto few = MakeReference(field, 32, 5);
  source->Slices = 0;
  source->Modified();
  few->SetInputConnection(1, source->GetOutputPort());
  few->Update();
  CSLF_CHECK(few->GetNumberOfTexels() == 5 && source->Slices <= 6);
}

void CheckFails(vtkCSLFFieldReference* reference, const char* message)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  reference->AddObserver(vtkCommand::ErrorEvent, observer);
  reference->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reference->Update();
  CSLF_CHECK(observer->GetErrorMessage().find(message) != std::string::npos);
  CSLF_CHECK(reference->GetNumberOfTexels() == 0);
}

void TestBad()
{
  const auto missing = MakeReference(nullptr, 32, 10);
  missing->SetInputConnection(1, nullptr);
  CheckFails(missing, "port");
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(4, 4, 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  CheckFails(MakeReference(picture, 32, 10), "");
  vtkNew<vtkCSLFFieldReference> empty;
  empty->SetInputData(1, MakeField(1));
  CheckFails(empty, "neither an input nor a renderer");

  // Another scene is measured, with a warning.
  vtkNew<vtkCSLFCornellBoxSource> box;
  const auto other = MakeReference(MakeField(1), 32, 10);
  other->SetInputConnection(0, box->GetOutputPort());
  vtkNew<vtkTest::ErrorObserver> observer;
  other->AddObserver(vtkCommand::WarningEvent, observer);
  other->Update();
  CSLF_CHECK(observer->GetWarningMessage().find("another scene") != std::string::npos);
  CSLF_CHECK(other->GetNumberOfTexels() == 10);
}
}

int TestCSLFFieldReference(int, char*[])
{
  TestChoice();
  TestNoise();
  TestEqual();
  TestSlabsAndThreads();
  TestBad();
  return cslf::testing::Result();
}
