// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// While a file is written, the folder of its parts has a preview: a file with the viewpoints so
// far, which the decoder reads and the mapper draws without complaint.
#include "Pipeline/cslfFieldArrays.h"
#include "cslfCodecTesting.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>
#include <vtkTrivialProducer.h>

#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace
{
using cslf::testing::Observed;

constexpr int Viewpoints = 9;
constexpr int Resolution = 32;

/// The progress when writing is aborted.
constexpr double Aborted = 0.6;

/// Keeps the first preview under another name, and may abort.
struct Watch
{
  std::string Preview;
  std::string First;
  bool Aborts = false;

  static void Look(vtkObject* caller, unsigned long, void* data, void* progress)
  {
    const auto* watch = static_cast<Watch*>(data);
    if (fs::exists(watch->Preview) && !fs::exists(watch->First))
    {
      fs::copy_file(watch->Preview, watch->First);
    }
    if (watch->Aborts && *static_cast<double*>(progress) > Aborted)
    {
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  }
};

/// Whether the file was written.
bool Write(vtkImageData* field, const std::string& fileName, Watch& watch)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&watch);
  command->SetCallback(Watch::Look);
  encoder->AddObserver(vtkCommand::ProgressEvent, command);
  const Observed observed(encoder);
  bool isWritten = false;
  // Small steps, so that there is a preview before everything is done.
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1 }, [&]() { isWritten = encoder->Write() == 1; });
  CSLF_CHECK(observed.GetWarnings() == 0 && observed.GetErrors() == (isWritten ? 0 : 1));
  return isWritten;
}

std::vector<vtkIdType> GetUnwritten(vtkCSLFDecoder* decoder)
{
  vtkNew<vtkIdTypeArray> viewpoints;
  decoder->GetUnwrittenViewpoints(viewpoints);
  return { viewpoints->GetPointer(0), viewpoints->GetPointer(viewpoints->GetNumberOfValues()) };
}

std::vector<vtkIdType> ToVector(vtkDataArray* array)
{
  std::vector<vtkIdType> values;
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    values.push_back(static_cast<vtkIdType>(array->GetComponent(k, 0)));
  }
  return values;
}

/// The decoder lists what is not there, and the rest is that of the whole file.
void TestDecoder(const std::string& preview, vtkImageData* whole)
{
  vtkNew<vtkCSLFDecoder> decoder;
  const Observed observed(decoder);
  CSLF_CHECK(!decoder->IsUnfinished());
  decoder->SetFileName(preview.c_str());
  CSLF_CHECK(decoder->CanReadFile(preview.c_str()) == 3);
  decoder->UpdateInformation();
  CSLF_CHECK(decoder->IsUnfinished());
  const std::vector<vtkIdType> unwritten = GetUnwritten(decoder);
  const int slices = 6 * Viewpoints * Viewpoints;
  CSLF_CHECK(!unwritten.empty() && static_cast<int>(unwritten.size()) < slices);
  CSLF_CHECK(decoder->FindMissingViewpoints() == static_cast<vtkIdType>(unwritten.size()));
  CSLF_CHECK(ToVector(decoder->GetMissingViewpoints()) == unwritten);

  std::vector<bool> isWritten(slices, true);
  for (vtkIdType z : unwritten)
  {
    isWritten[z] = false;
  }
  vtkNew<vtkIdTypeArray> order;
  decoder->GetViewpointsInFileOrder(order);
  CSLF_CHECK(isWritten[order->GetValue(0)]);
  for (int z = 0; z < slices; ++z)
  {
    CSLF_CHECK(decoder->IsViewpointDamaged(z) == !isWritten[z]);
    vtkNew<vtkImageData> viewpoint;
    if (isWritten[z])
    {
      CSLF_CHECK(decoder->GetViewpoint(z, viewpoint));
      CSLF_CHECK(cslf::testing::HasEqualSlices(viewpoint, whole));
    }
  }
  CSLF_CHECK(observed.GetErrors() == 0 && observed.GetWarnings() == 0);

  decoder->Update();
  CSLF_CHECK(observed.HasWarning("is unfinished"));
  vtkDataArray* listed =
    decoder->GetOutput()->GetFieldData()->GetArray(cslf::MissingViewpointsName);
  CSLF_CHECK(ToVector(listed) == unwritten);
}

void TestRefused(const std::string& preview)
{
  vtkNew<vtkCSLFDecoder> decoder;
  const Observed observed(decoder);
  decoder->SetFileName(preview.c_str());
  decoder->AllowMissingOff();
  decoder->Update();
  CSLF_CHECK(decoder->GetErrorCode() == vtkErrorCode::PrematureEndOfFileError);
  CSLF_CHECK(observed.HasError("it is unfinished"));
}

cslf::testing::Picture Draw(vtkAlgorithm* reader)
{
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(reader->GetOutputPort());
  mapper->SetPixelSamples(1);
  const Observed observed(mapper);
  cslf::testing::View view;
  view.Add(mapper);
  view.GetCamera()->SetPosition(2.5, 2.0, 3.5);
  cslf::testing::Picture picture = view.Render();
  CSLF_CHECK(observed.GetWarnings() == 0 && observed.GetErrors() == 0);
  return picture;
}

/// The list of missing viewpoints travels with image data, so the picture from it is the same.
void TestMapper(const std::string& preview, const std::string& complete)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(preview.c_str());
  const auto early = Draw(decoder);
  const auto image = cslf::testing::Decode(preview);
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(image);
  CSLF_CHECK(cslf::testing::ComparePictures(Draw(source), early) > 60.0);
  decoder->SetFileName(complete.c_str());
  const double psnr = cslf::testing::ComparePictures(early, Draw(decoder));
  std::cout << "the first preview: " << psnr << " dB\n";
  CSLF_CHECK(psnr > 20.0);
  CSLF_CHECK(!decoder->IsUnfinished() && GetUnwritten(decoder).empty());
}
}

int TestCSLFEncoderPreview(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "TestCSLFEncoderPreview");
  const auto field = cslf::testing::MakeByteField(Viewpoints, Resolution);
  for (const std::string& extension : { std::string(".mp4"), std::string(".mkv") })
  {
    const std::string fileName = folder + "/field" + extension;
    const std::string partial = fileName + ".partial";
    Watch watch{ partial + "/preview" + extension, folder + "/first" + extension };
    CSLF_CHECK(Write(field, fileName, watch));
    CSLF_CHECK(!fs::exists(partial));
    const std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
    TestDecoder(watch.First, cslf::testing::Decode(fileName));
    TestRefused(watch.First);
    TestMapper(watch.First, fileName);

    // What an interrupted run leaves can be seen as well. The file's bytes stay the same.
    fs::remove(fileName);
    watch.Aborts = true;
    CSLF_CHECK(!Write(field, fileName, watch));
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(watch.Preview.c_str());
    decoder->UpdateInformation();
    CSLF_CHECK(decoder->IsUnfinished());
    watch.Aborts = false;
    CSLF_CHECK(Write(field, fileName, watch));
    CSLF_CHECK(!fs::exists(partial) && cslf::testing::ReadBytes(fileName) == bytes);
  }
  return 0;
}
