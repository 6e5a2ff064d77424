// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// No exception leaves VTK's methods: fields and pictures that do not fit memory, and inputs that
// throw, give one clear error, and the objects can be used again.
#include "cslfCodecTesting.h"
#include "cslfDescription.h"
#include "cslfFieldSource.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFFieldQuality.h"
#include "vtkCSLFGeometryFilter.h"
#include "vtkCSLFImageWriter.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFResample.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace
{
using cslf::testing::Observed;
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr const char* MemoryError = "there is not enough memory";

/// A source that throws when it is asked for a slice.
class ThrowingSource : public cslf::testing::FieldSource
{
public:
  static ThrowingSource* New();
  vtkTypeMacro(ThrowingSource, cslf::testing::FieldSource);

  int ThrowingSlice = 0;

protected:
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    const int* extent = outputs->GetInformationObject(0)->Get(Pipeline::UPDATE_EXTENT());
    if (extent[4] <= this->ThrowingSlice && this->ThrowingSlice <= extent[5])
    {
      throw std::bad_alloc();
    }
    return this->Superclass::RequestData(request, inputs, outputs);
  }
};
vtkStandardNewMacro(ThrowingSource);

class ThrowingGeometry : public vtkPolyDataAlgorithm
{
public:
  static ThrowingGeometry* New();
  vtkTypeMacro(ThrowingGeometry, vtkPolyDataAlgorithm);

protected:
  ThrowingGeometry() { this->SetNumberOfInputPorts(0); }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    throw std::length_error("vector");
  }
};
vtkStandardNewMacro(ThrowingGeometry);

/// A field of many viewpoints, of which it makes black ones as they are requested.
class LargeSource : public vtkImageAlgorithm
{
public:
  static LargeSource* New();
  vtkTypeMacro(LargeSource, vtkImageAlgorithm);

protected:
  LargeSource()
  {
    this->SetNumberOfInputPorts(0);
    this->Field.Grid = cslf::Layout(1024, 512);
    this->Field.Channels = { cslf::MakeChannel(cslf::KnownChannel::Color, VTK_UNSIGNED_CHAR) };
  }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    int extent[6];
    this->Field.Grid.GetWholeExtent(extent);
    outputs->GetInformationObject(0)->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkImageData* output = vtkImageData::GetData(outputs);
    output->SetExtent(outputs->GetInformationObject(0)->Get(Pipeline::UPDATE_EXTENT()));
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName(cslf::ColorName);
    colors->SetNumberOfComponents(4);
    colors->SetNumberOfTuples(output->GetNumberOfPoints());
    colors->Fill(0);
    output->GetPointData()->SetScalars(colors);
    this->Field.WriteTo(output->GetFieldData());
    return 1;
  }

private:
  cslf::Description Field;
};
vtkStandardNewMacro(LargeSource);

vtkSmartPointer<ThrowingSource> MakeThrowing(int slice)
{
  auto source = vtkSmartPointer<ThrowingSource>::New();
  source->Field = cslf::testing::MakeByteField(4, 16);
  source->ThrowingSlice = slice;
  return source;
}

void SetScene(vtkCSLFPathTracer* tracer)
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  tracer->SetInputConnection(box->GetOutputPort());
  tracer->SetIntegratorToPathTracing();
  tracer->SetMaximumDepth(1);
  tracer->SetSamples(1);
}

void TestSampler()
{
  vtkNew<vtkCSLFSampler> sampler;
  SetScene(sampler);
  sampler->SetGeometryTriangles(0);
  sampler->SetViewpoints(400);
  sampler->SetResolution(4096);
  {
    const Observed observed(sampler);
    sampler->Update();
    CSLF_CHECK(observed.HasError(MemoryError));
    CSLF_CHECK(sampler->GetOutput()->GetNumberOfPoints() == 0);
  }
  sampler->SetViewpoints(2);
  sampler->SetResolution(4);
  sampler->Update();
  CSLF_CHECK(sampler->GetOutput()->GetNumberOfPoints() == 5 * 4 * 4 * 6 * 2 * 2);
}

void TestViewTracer()
{
  vtkNew<vtkCamera> camera;
  vtkNew<vtkCSLFViewTracer> tracer;
  SetScene(tracer);
  tracer->SetCamera(camera);
  // The bytes of the latter are more than 64 bits can count.
  for (int size : { 1 << 24, std::numeric_limits<int>::max() })
  {
    tracer->SetSize(size, size);
    const Observed observed(tracer);
    tracer->Update();
    CSLF_CHECK(observed.HasError(MemoryError));
    CSLF_CHECK(tracer->GetOutput()->GetNumberOfPoints() == 0);
  }
  tracer->SetSize(8, 8);
  tracer->Update();
  CSLF_CHECK(tracer->GetOutput()->GetNumberOfPoints() == 64);
}

void TestResample()
{
  vtkNew<LargeSource> source;
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(source->GetOutputPort());
  const Observed observed(resample);
  resample->Update();
  CSLF_CHECK(observed.HasError(MemoryError));
  CSLF_CHECK(resample->GetOutput()->GetNumberOfPoints() == 0);
}

/// Slices of the first pull throw within the encoder's own update, later ones within its session.
void TestEncoder(const std::string& folder, int slice)
{
  const auto source = MakeThrowing(slice);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName((folder + "/field.mkv").c_str());
  const Observed observed(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(observed.HasError(MemoryError));
  CSLF_CHECK(encoder->GetErrorCode() != 0);
  CSLF_CHECK(!cslf::testing::Exists(folder + "/field.mkv"));
  encoder->SetInputDataObject(0, cslf::testing::MakeByteField(4, 16));
  CSLF_CHECK(encoder->Write() == 1);
  std::filesystem::remove(folder + "/field.mkv");
}

void TestImageWriter(const std::string& folder, int slice)
{
  const auto source = MakeThrowing(slice);
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputConnection(source->GetOutputPort());
  writer->SetFileName((folder + "/images").c_str());
  const Observed observed(writer);
  CSLF_CHECK(writer->Write() == 0);
  CSLF_CHECK(observed.HasError(MemoryError));
  CSLF_CHECK(!cslf::testing::Exists(folder + "/images"));
}

void TestFilters()
{
  {
    const auto source = MakeThrowing(95);
    vtkNew<vtkCSLFGeometryFilter> filter;
    filter->SetInputConnection(source->GetOutputPort());
    const Observed observed(filter);
    filter->Update(1);
    CSLF_CHECK(observed.HasError(MemoryError));
    CSLF_CHECK(filter->GetGeometry()->GetNumberOfCells() == 0);
  }
  {
    const auto source = MakeThrowing(95);
    vtkNew<vtkCSLFFieldQuality> quality;
    quality->SetInputConnection(0, source->GetOutputPort());
    quality->SetInputData(1, source->Field);
    const Observed observed(quality);
    CSLF_CHECK(quality->Measure() == 0);
    CSLF_CHECK(observed.HasError(MemoryError));
  }
}

void TestMapper()
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkCSLFMapper> mapper;
  mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  cslf::testing::View view(16);
  view.Add(mapper);
  mapper->SetInputDataObject(0, cslf::testing::MakeByteField(4, 16));
  vtkNew<ThrowingGeometry> geometry;
  mapper->SetInputConnection(1, geometry->GetOutputPort());
  mapper->SetLookupToGeometry();
  view.Render();
  CSLF_CHECK(errors->GetErrorMessage().find("The light field cannot be drawn: there is not enough "
                                            "memory.") != std::string::npos);
  errors->Clear();
  view.Render();
  CSLF_CHECK(!errors->GetError());

  const auto source = MakeThrowing(0);
  mapper->SetInputConnection(0, source->GetOutputPort());
  double bounds[6];
  mapper->GetBounds(bounds);
  CSLF_CHECK(errors->GetErrorMessage().find(MemoryError) != std::string::npos);
  CSLF_CHECK(bounds[0] > bounds[1]);
}
}

int TestCSLFGuards(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "Guards");
  TestSampler();
  TestViewTracer();
  TestResample();
  for (int slice : { 0, 95 })
  {
    TestEncoder(folder, slice);
    TestImageWriter(folder, slice);
  }
  TestFilters();
  TestMapper();
  return cslf::testing::Result();
}
