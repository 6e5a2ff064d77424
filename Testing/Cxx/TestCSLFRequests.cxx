// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// What consumers leave requested: whoever pulls a field in parts, writes it, compares it or makes
// something of it, its producer's next Update() makes what it would have made before, also after a
// failure or an abort. Whoever needs the whole field gets it, whatever was requested before.
#include "cslfCodecTesting.h"
#include "cslfFieldSource.h"
#include "cslfTesting.h"
#include "vtkCSLFBakeEstimator.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFFieldQuality.h"
#include "vtkCSLFFieldReference.h"
#include "vtkCSLFGeometryFilter.h"
#include "vtkCSLFImageWriter.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFResample.h"
#include "vtkCSLFSampler.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkImageAppend.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <iostream>
#include <string>

namespace
{
using cslf::testing::FieldSource;
using cslf::testing::MakeSource;

constexpr int Viewpoints = 5;
constexpr int Slices = 6 * Viewpoints * Viewpoints;

vtkSmartPointer<vtkImageData> GetField()
{
  static const auto field = cslf::testing::MakeByteField(Viewpoints, 16);
  return field;
}

/// Whether the producer makes just those slices at its next Update().
void CheckNextUpdate(vtkAlgorithm* producer, int first, int last, const char* consumer)
{
  producer->Update();
  const int* extent = vtkImageData::SafeDownCast(producer->GetOutputDataObject(0))->GetExtent();
  if (extent[4] != first || extent[5] != last)
  {
    std::cerr << "After " << consumer << ", Update() makes z " << extent[4] << ".." << extent[5]
              << "\n";
    CSLF_CHECK(false);
  }
}

/// After a consumer has done its work with a source, the source has made nothing since the last
/// pull, and makes all slices at its next Update().
void CheckSource(FieldSource* source, const char* consumer)
{
  source->FailingSlice = -1;
  const int made = source->Slices;
  CheckNextUpdate(source, 0, Slices - 1, consumer);
  CSLF_CHECK(source->Slices == made + Slices || source->Slices == made);
}

vtkSmartPointer<vtkCSLFEncoder> MakeEncoder(vtkAlgorithm* input, const std::string& folder)
{
  auto encoder = vtkSmartPointer<vtkCSLFEncoder>::New();
  encoder->SetInputConnection(input->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName((folder + "/field.mkv").c_str());
  return encoder;
}

vtkSmartPointer<vtkCSLFImageWriter> MakeImageWriter(vtkAlgorithm* input, const std::string& folder)
{
  auto writer = vtkSmartPointer<vtkCSLFImageWriter>::New();
  writer->SetInputConnection(input->GetOutputPort());
  writer->SetFileName((folder + "/images").c_str());
  return writer;
}

void StopEarly(vtkAlgorithm* algorithm)
{
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* running = static_cast<vtkAlgorithm*>(caller);
      running->SetAbortExecute(running->GetProgress() > 0.1 ? 1 : 0);
    });
  algorithm->AddObserver(vtkCommand::ProgressEvent, stop);
}

void TestWriters(const std::string& folder)
{
  {
    const auto source = MakeSource(GetField());
    CSLF_CHECK(MakeEncoder(source, folder)->Write() == 1);
    CheckSource(source, "Write() of an encoder");
  }
  {
    const auto source = MakeSource(GetField());
    MakeEncoder(source, folder)->Update();
    CheckSource(source, "Update() of an encoder");
  }
  {
    const auto source = MakeSource(GetField());
    CSLF_CHECK(MakeImageWriter(source, folder)->Write() == 1);
    CheckSource(source, "Write() of an image writer");
  }
}

void TestFailures(const std::string& folder, int failingSlice)
{
  const auto source = MakeSource(GetField());
  const cslf::testing::Observed sourceObserved(source);
  const auto encoder = MakeEncoder(source, folder);
  const cslf::testing::Observed encoderObserved(encoder);
  source->FailingSlice = failingSlice;
  CSLF_CHECK(encoder->Write() == 0);
  CheckSource(source, "a failed encoder");

  source->Modified();
  source->FailingSlice = failingSlice;
  const auto writer = MakeImageWriter(source, folder);
  const cslf::testing::Observed writerObserved(writer);
  CSLF_CHECK(writer->Write() == 0);
  CheckSource(source, "a failed image writer");
}

void TestAborts(const std::string& folder)
{
  const auto source = MakeSource(GetField());
  const auto encoder = MakeEncoder(source, folder);
  const cslf::testing::Observed encoderObserved(encoder);
  StopEarly(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CheckSource(source, "an aborted encoder");

  source->Modified();
  const auto writer = MakeImageWriter(source, folder);
  const cslf::testing::Observed writerObserved(writer);
  StopEarly(writer);
  CSLF_CHECK(writer->Write() == 0);
  CheckSource(source, "an aborted image writer");
}

/// The user's own request is made again, not the whole.
void TestOwnRequest(const std::string& folder)
{
  const auto source = MakeSource(GetField());
  int part[6];
  std::copy_n(GetField()->GetExtent(), 6, part);
  part[4] = 7;
  part[5] = 9;
  source->UpdateExtent(part);
  CSLF_CHECK(MakeEncoder(source, folder)->Write() == 1);
  CheckNextUpdate(source, 7, 9, "an encoder");
  CSLF_CHECK(MakeImageWriter(source, folder)->Write() == 1);
  CheckNextUpdate(source, 7, 9, "an image writer");
}

void TestResample(const std::string& folder)
{
  const auto source = MakeSource(GetField());
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(source->GetOutputPort());
  resample->SetViewpointStride(2);
  resample->Update();
  CSLF_CHECK(source->Slices < Slices);
  CheckSource(source, "a resampling filter");

  // Both filters before the writer are restored.
  source->Modified();
  CSLF_CHECK(MakeImageWriter(resample, folder)->Write() == 1);
  CheckNextUpdate(resample, 0, 6 * 3 * 3 - 1, "an image writer");
  CheckSource(source, "a resampling filter before an image writer");
  source->Modified();
  CSLF_CHECK(MakeEncoder(resample, folder)->Write() == 1);
  CheckSource(source, "a resampling filter before an encoder");

  source->Modified();
  source->FailingSlice = Slices - 1;
  const cslf::testing::Observed sourceObserved(source);
  const cslf::testing::Observed observed(resample);
  resample->Update();
  CheckSource(source, "a failed resampling filter");
}

/// A filter that pulls parts does not change what another consumer of the same producer gets.
void TestTwoConsumers()
{
  const auto source = MakeSource(GetField());
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(source->GetOutputPort());
  resample->SetResolutionDivisor(1);
  resample->SetViewpointStride(1);
  vtkNew<vtkImageAppend> append;
  append->SetAppendAxis(1);
  append->AddInputConnection(resample->GetOutputPort());
  append->AddInputConnection(source->GetOutputPort());
  append->Update();
  int size[3];
  append->GetOutput()->GetDimensions(size);
  CSLF_CHECK(size[1] == 2 * 16 && size[2] == Slices);
}

/// Several ranks request pieces of a filter that pulls.
void TestPieces()
{
  vtkNew<vtkCSLFResample> resample;
  const auto source = MakeSource(GetField());
  resample->SetInputConnection(source->GetOutputPort());
  resample->SetViewpointStride(2);
  const cslf::testing::Observed observed(resample);
  int slices = 0;
  for (int piece = 0; piece < 2; ++piece)
  {
    resample->UpdatePiece(piece, 2, 0);
    int size[3];
    resample->GetOutput()->GetDimensions(size);
    slices += size[2];
  }
  CSLF_CHECK(observed.GetErrors() == 0);
  // Neighbouring pieces share a slice.
  CSLF_CHECK(slices == 6 * 3 * 3 + 1);
}

void TestGeometryAndQuality()
{
  {
    // A filter that is asked for a geometry, but makes none, has requested its first viewpoint.
    const auto source = MakeSource(GetField());
    vtkNew<vtkCSLFGeometryFilter> none;
    none->SetInputConnection(source->GetOutputPort());
    none->SetGeometryTriangles(0);
    none->Update(1);
    CheckSource(source, "a filter without a geometry");
  }
  const auto source = MakeSource(GetField());
  vtkNew<vtkCSLFGeometryFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetGeometryTriangles(500);
  filter->Update(1);
  CSLF_CHECK(filter->GetGeometry()->GetNumberOfCells() > 0);
  CheckSource(source, "a geometry filter");

  source->Modified();
  const auto other = MakeSource(GetField());
  vtkNew<vtkCSLFFieldQuality> quality;
  quality->SetInputConnection(0, source->GetOutputPort());
  quality->SetInputConnection(1, other->GetOutputPort());
  CSLF_CHECK(quality->Measure() == 1);
  CheckSource(source, "a comparison");
  CheckSource(other, "a comparison");
}

void SetScene(vtkCSLFPathTracer* tracer)
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  tracer->SetInputConnection(box->GetOutputPort());
  tracer->SetIntegratorToPathTracing();
  tracer->SetMaximumDepth(1);
  tracer->SetSamples(1);
}

void TestReference()
{
  const auto source = MakeSource(GetField());
  vtkNew<vtkCSLFFieldReference> reference;
  SetScene(reference);
  reference->SetInputConnection(1, source->GetOutputPort());
  reference->SetTexels(4);
  reference->Update();
  CSLF_CHECK(reference->GetNumberOfTexels() == 4);
  CheckSource(source, "a reference");
}

void TestEstimator()
{
  vtkNew<vtkCSLFSampler> sampler;
  SetScene(sampler);
  sampler->SetViewpoints(2);
  sampler->SetResolution(16);
  sampler->SetGeometryTriangles(0);
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  for (int format : { vtkCSLFBakeEstimator::Video, vtkCSLFBakeEstimator::ImageData,
         vtkCSLFBakeEstimator::ImageFolder })
  {
    estimator->SetFormat(format);
    CSLF_CHECK(estimator->Estimate() == 1);
    CheckNextUpdate(sampler, 0, 6 * 2 * 2 - 1, "an estimate");
  }
}

/// A mapper draws the whole field, from the port that it is connected to.
void TestMapper()
{
  const auto source = MakeSource(GetField());
  int part[6];
  std::copy_n(GetField()->GetExtent(), 6, part);
  part[4] = part[5] = 3;
  source->UpdateExtent(part);
  vtkNew<vtkCSLFMapper> mapper;
  const cslf::testing::Observed observed(mapper);
  mapper->SetInputConnection(source->GetOutputPort());
  double bounds[6];
  mapper->GetBounds(bounds);
  CSLF_CHECK(observed.GetErrors() == 0);
  CSLF_CHECK(bounds[0] == -1.0 && bounds[1] == 1.0);
  const int made = source->Slices;
  mapper->GetBounds(bounds);
  CSLF_CHECK(source->Slices == made);
}
}

int TestCSLFRequests(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "Requests");
  TestWriters(folder);
  TestFailures(folder, 0);
  TestFailures(folder, Slices - 1);
  TestAborts(folder);
  TestOwnRequest(folder);
  TestResample(folder);
  TestTwoConsumers();
  TestPieces();
  TestGeometryAndQuality();
  TestReference();
  TestEstimator();
  TestMapper();
  return cslf::testing::Result();
}
