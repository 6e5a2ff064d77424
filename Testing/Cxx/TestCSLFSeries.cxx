// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A scene that changes over time becomes a file for each step, with one cube and one range of
// colours, and an index. The next run keeps what is finished. The reader and the mapper show the
// time that is requested.
#include "Files/cslfFileSeries.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfCodecTesting.h"
#include "cslfDescription.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneLook.h"
#include "vtkCSLFSeriesReader.h"
#include "vtkCSLFSeriesWriter.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
using cslf::testing::Observed;

const std::vector<double> Times = { 0.0, 1.0, 4.0 };

/// A square at the height of the time, of two triangles, and of one at time 1. Its scalars are the
/// time at two corners, and one more at the others.
class vtkRisingSquare : public vtkPolyDataAlgorithm
{
public:
  static vtkRisingSquare* New();
  vtkTypeMacro(vtkRisingSquare, vtkPolyDataAlgorithm);

protected:
  vtkRisingSquare() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* output = outputs->GetInformationObject(0);
    const double range[2] = { Times.front(), Times.back() };
    output->Set(Pipeline::TIME_STEPS(), Times.data(), static_cast<int>(Times.size()));
    output->Set(Pipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* output = outputs->GetInformationObject(0);
    const double time =
      output->Has(Pipeline::UPDATE_TIME_STEP()) ? output->Get(Pipeline::UPDATE_TIME_STEP()) : 0.0;
    vtkNew<vtkPoints> points;
    vtkNew<vtkDoubleArray> heat;
    heat->SetName("Heat");
    for (int i = 0; i < 4; ++i)
    {
      points->InsertNextPoint(i % 2, i / 2, time);
      heat->InsertNextValue(time + i % 2);
    }
    vtkNew<vtkCellArray> triangles;
    triangles->InsertNextCell({ 0, 1, 2 });
    if (time != 1.0)
    {
      triangles->InsertNextCell({ 1, 3, 2 });
    }
    auto* square = vtkPolyData::GetData(output);
    square->SetPoints(points);
    square->SetPolys(triangles);
    square->GetPointData()->SetScalars(heat);
    square->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(vtkRisingSquare);

/// What bakes the square.
struct Bake
{
  vtkNew<vtkRisingSquare> Source;
  vtkNew<vtkCSLFSceneLook> Look;
  vtkNew<vtkCSLFSampler> Sampler;
  vtkNew<vtkCSLFEncoder> Encoder;
  vtkNew<vtkCSLFSeriesWriter> Writer;

  explicit Bake(const std::string& fileName)
  {
    this->Look->SetInputConnection(this->Source->GetOutputPort());
    this->Sampler->SetInputConnection(this->Look->GetOutputPort());
    this->Sampler->SetQualityToPreview();
    this->Sampler->SetViewpoints(2);
    this->Sampler->SetResolution(16);
    this->Encoder->SetInputConnection(0, this->Sampler->GetOutputPort(0));
    this->Encoder->SetInputConnection(1, this->Sampler->GetOutputPort(1));
    this->Encoder->SetFileName(fileName.c_str());
    this->Writer->SetSampler(this->Sampler);
    this->Writer->SetEncoder(this->Encoder);
    this->Writer->SetLook(this->Look);
  }

  /// Writes, and checks how many steps an earlier run had left.
  void Write(int kept)
  {
    CSLF_CHECK(this->Writer->Write() == 1);
    CSLF_CHECK(this->Writer->GetNumberOfSteps() == 3 && this->Writer->GetDoneSteps() == 3);
    CSLF_CHECK_NEAR(this->Writer->GetKeptSteps(), kept, 0);
  }
};

std::string ReadText(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

cslf::Description ReadDescription(vtkCSLFDecoder* decoder)
{
  std::string error;
  return *cslf::Description::FromText(decoder->GetDescription(), error);
}

/// Whether two fields have the same samples.
bool AreEqual(vtkImageData* a, vtkImageData* b)
{
  if (!std::equal(a->GetExtent(), a->GetExtent() + 6, b->GetExtent()) ||
    a->GetNumberOfPoints() == 0)
  {
    return false;
  }
  vtkDataArray* ours = a->GetPointData()->GetArray("Color");
  vtkDataArray* theirs = b->GetPointData()->GetArray("Color");
  const auto bytes = static_cast<std::ptrdiff_t>(ours->GetNumberOfValues());
  const auto* values = static_cast<const unsigned char*>(ours->GetVoidPointer(0));
  return std::equal(
    values, values + bytes, static_cast<const unsigned char*>(theirs->GetVoidPointer(0)));
}

std::string StepName(const std::string& folder, int step)
{
  return folder + "/rise_000" + std::to_string(step) + ".mp4";
}

/// The files of all steps and the index, one after the other.
std::string ReadAll(const std::string& folder)
{
  std::string all = ReadText(folder + "/rise.mp4.series");
  for (int step = 0; step < 3; ++step)
  {
    all += ReadText(StepName(folder, step));
  }
  return all;
}

void CheckFiles(const std::string& folder)
{
  std::string error;
  const auto series = cslf::FileSeries::Read(folder + "/rise.mp4.series", error);
  CSLF_CHECK(series && series->GetTimes() == Times);
  for (int step = 0; step < 3; ++step)
  {
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(StepName(folder, step).c_str());
    decoder->Update(1);
    const cslf::Description field = ReadDescription(decoder);
    // The square rises by 4, with a margin of 0.05 on each side.
    CSLF_CHECK_NEAR(field.Box.Center.z, 2.0, 1e-6);
    CSLF_CHECK_NEAR(field.Box.Edges.x, 4.4, 1e-6);
    vtkPolyData* geometry = decoder->GetGeometry();
    CSLF_CHECK_NEAR(geometry->GetBounds()[4], Times[step], 1e-3);
    const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
    CSLF_CHECK(points.Maps.size() == 1);
    CSLF_CHECK_NEAR(points.Maps.front().Range[0], 0.0, 1e-12);
    CSLF_CHECK_NEAR(points.Maps.front().Range[1], 5.0, 1e-12);
  }
}

/// Runs that were interrupted end with the bytes of others.
void CheckResume(const std::string& folder)
{
  namespace fs = std::filesystem;
  const std::string all = ReadAll(folder);
  Bake(folder + "/rise.mp4").Write(3);
  CSLF_CHECK(ReadAll(folder) == all);

  // A file that is damaged or of another scene is written again.
  fs::resize_file(StepName(folder, 1), fs::file_size(StepName(folder, 1)) / 2);
  fs::copy_file(StepName(folder, 0), StepName(folder, 2), fs::copy_options::overwrite_existing);
  Bake(folder + "/rise.mp4").Write(1);
  CSLF_CHECK(ReadAll(folder) == all);

  // A run of some of the steps, whose cube is smaller, replaces them. Its index names only these.
  Bake some(folder + "/rise.mp4");
  some.Writer->SetTimeStepRange(1, 2);
  CSLF_CHECK(some.Writer->Write() == 1 && some.Writer->GetKeptSteps() == 0);
  std::string error;
  const auto series = cslf::FileSeries::Read(folder + "/rise.mp4.series", error);
  CSLF_CHECK(series && series->GetTimes() == std::vector<double>({ 1.0, 4.0 }));

  Bake(folder + "/rise.mp4").Write(0);
  CSLF_CHECK(ReadAll(folder) == all);

  // A run that fails in its second step keeps the first, and makes no index.
  fs::remove(folder + "/rise.mp4.series");
  fs::remove(StepName(folder, 0));
  fs::remove(StepName(folder, 1));
  fs::create_directory(StepName(folder, 1));
  {
    Bake failing(folder + "/rise.mp4");
    const Observed observed(failing.Encoder);
    CSLF_CHECK(failing.Writer->Write() == 0 && failing.Writer->GetDoneSteps() == 1);
    CSLF_CHECK(observed.HasError("is a folder"));
    CSLF_CHECK(!fs::exists(folder + "/rise.mp4.series"));
    CSLF_CHECK(std::string(failing.Encoder->GetFileName()) == folder + "/rise.mp4");
  }
  fs::remove(StepName(folder, 1));
  Bake(folder + "/rise.mp4").Write(1);
  CSLF_CHECK(ReadAll(folder) == all);
  CSLF_CHECK(!fs::exists(folder + "/rise.mp4.series.partial"));

  // Other settings.
  Bake other(folder + "/rise.mp4");
  other.Encoder->SetPreset("veryfast");
  other.Write(0);
}

void CheckReader(const std::string& folder)
{
  vtkNew<vtkCSLFSeriesReader> reader;
  CSLF_CHECK(reader->CanReadFile((folder + "/rise.mp4.series").c_str()) == 3);
  reader->SetFileName((folder + "/rise.mp4.series").c_str());
  reader->UpdateInformation();
  vtkInformation* output = reader->GetOutputInformation(0);
  CSLF_CHECK(output->Length(Pipeline::TIME_STEPS()) == 3);
  CSLF_CHECK(output->Get(Pipeline::TIME_STEPS())[2] == 4.0);
  CSLF_CHECK(output->Get(Pipeline::TIME_RANGE())[1] == 4.0);
  CSLF_CHECK(reader->GetNumberOfTimeSteps() == 3 && reader->GetTimeStep(1) == 1.0);
  CSLF_CHECK(reader->GetOpenStep() == 0);

  // Before the first, at, between and after the times: the last one that is not later.
  const double asked[] = { -1.0, 0.0, 1.0, 3.9, 4.0, 100.0, 0.5 };
  const int steps[] = { 0, 0, 1, 1, 2, 2, 0 };
  for (int i = 0; i < 7; ++i)
  {
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(StepName(folder, steps[i]).c_str());
    decoder->Update();
    reader->UpdateTimeStep(asked[i]);
    CSLF_CHECK(reader->GetOpenStep() == steps[i]);
    CSLF_CHECK(AreEqual(reader->GetOutput(), decoder->GetOutput()));
    CSLF_CHECK_NEAR(reader->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()),
      Times[steps[i]], 0.0);
    CSLF_CHECK_NEAR(reader->GetGeometry()->GetBounds()[4], Times[steps[i]], 1e-3);
  }

  // One output, then the other: neither is left from another time.
  reader->SetTime(4.0);
  reader->Update(1);
  CSLF_CHECK_NEAR(reader->GetGeometry()->GetBounds()[4], 4.0, 1e-3);
  vtkNew<vtkCSLFDecoder> last;
  last->SetFileName(StepName(folder, 2).c_str());
  last->Update();
  reader->Update(0);
  CSLF_CHECK(AreEqual(reader->GetOutput(), last->GetOutput()));

  // A video is a series without times.
  reader->SetFileName(StepName(folder, 1).c_str());
  reader->Update();
  CSLF_CHECK(reader->GetNumberOfTimeSteps() == 0 && reader->GetOpenStep() == -1);
  CSLF_CHECK(!output->Has(Pipeline::TIME_STEPS()));
  CSLF_CHECK_NEAR(reader->GetGeometry()->GetBounds()[4], 1.0, 1e-3);
}

void Connect(vtkCSLFMapper* mapper, vtkAlgorithm* reader)
{
  mapper->SetInputConnection(0, reader->GetOutputPort(0));
  mapper->SetInputConnection(1, reader->GetOutputPort(1));
}

/// The mapper draws the time that is requested of its reader, by its geometry and by viewpoints.
void CheckMapper(const std::string& folder, int lookup)
{
  vtkNew<vtkCSLFSeriesReader> reader;
  reader->SetFileName((folder + "/rise.mp4.series").c_str());
  vtkNew<vtkCSLFMapper> mapper;
  Connect(mapper, reader);
  mapper->SetLookup(lookup);
  cslf::testing::View view(64);
  view.Add(mapper);
  view.GetCamera()->SetFocalPoint(0.5, 0.5, 2.0);
  view.GetCamera()->SetPosition(5.0, 3.0, 8.0);
  view.GetCamera()->SetClippingRange(1.0, 20.0);
  cslf::testing::Picture previous;
  for (const int step : { 0, 2, 1, 0 })
  {
    reader->SetTime(Times[step]);
    const cslf::testing::Picture shown = view.Render();
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(StepName(folder, step).c_str());
    vtkNew<vtkCSLFMapper> other;
    Connect(other, decoder);
    other->SetLookup(lookup);
    cslf::testing::View single(64);
    single.Add(other);
    single.GetCamera()->DeepCopy(view.GetCamera());
    CSLF_CHECK(shown.GetMean() > 1.0);
    CSLF_CHECK(previous.Colors.empty() || ComparePictures(shown, previous) < 40.0);
    previous = shown;
    CSLF_CHECK_NEAR(ComparePictures(shown, single.Render()), 99.0, 0.0);
  }
}

void CheckInvalid(const std::string& folder)
{
  const std::string name = folder + "/bad.mp4.series";
  const char* const texts[] = { "", "[]", "{\"files\": []}", "{\"files\": [{\"time\": 1}]}",
    "{\"files\": [{\"name\": \"a.mp4\", \"time\": \"now\"}]}",
    "{\"files\": [{\"name\": \"a.mp4\", \"time\": 1}, {\"name\": \"b.mp4\", \"time\": 1}]}",
    "{\"files\": [{\"name\": \"missing.mp4\", \"time\": 1}]}" };
  for (const char* text : texts)
  {
    std::ofstream(name) << text;
    vtkNew<vtkCSLFSeriesReader> reader;
    const Observed observed(reader);
    CSLF_CHECK(reader->CanReadFile(name.c_str()) == 0);
    CSLF_CHECK(observed.GetErrors() == 0);
    reader->SetFileName(name.c_str());
    reader->Update();
    CSLF_CHECK(observed.GetErrors() == 1 && observed.HasError("Cannot read"));
    CSLF_CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  }
}
}

int TestCSLFSeries(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "Series");
  Bake(folder + "/rise.mp4").Write(0);
  CheckFiles(folder);
  CheckReader(folder);
  CheckMapper(folder, vtkCSLFMapper::GEOMETRY);
  CheckMapper(folder, vtkCSLFMapper::DEPTH);
  CheckInvalid(folder);
  CheckResume(folder);
  return cslf::testing::Result();
}
