// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Single viewpoints are always the same: decoded alone, ahead in the background, or from the cache.
#include "cslfCodecTesting.h"
#include "cslfProgressWatch.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <random>
#include <vector>

namespace
{
constexpr int Viewpoints = 4;
constexpr int Resolution = 32;
constexpr vtkIdType Slices = 6 * Viewpoints * Viewpoints;

/// Of one viewpoint with depth.
constexpr vtkTypeInt64 ViewpointBytes = 6 * 5 * Resolution * Resolution;

vtkSmartPointer<vtkCSLFDecoder> MakeDecoder(const std::string& fileName)
{
  auto decoder = vtkSmartPointer<vtkCSLFDecoder>::New();
  decoder->SetFileName(fileName.c_str());
  return decoder;
}

vtkSmartPointer<vtkIdTypeArray> MakeList(const std::vector<vtkIdType>& values)
{
  auto list = vtkSmartPointer<vtkIdTypeArray>::New();
  for (vtkIdType value : values)
  {
    list->InsertNextValue(value);
  }
  return list;
}

vtkSmartPointer<vtkIdTypeArray> MakeRange(vtkIdType first, vtkIdType last)
{
  auto list = vtkSmartPointer<vtkIdTypeArray>::New();
  for (vtkIdType z = first; z <= last; ++z)
  {
    list->InsertNextValue(z);
  }
  return list;
}

int CountReady(vtkCSLFDecoder* decoder)
{
  int count = 0;
  for (vtkIdType z = 0; z < Slices; ++z)
  {
    count += decoder->IsViewpointReady(z) ? 1 : 0;
  }
  return count;
}

void CheckViewpoint(vtkCSLFDecoder* decoder, vtkIdType z, vtkImageData* whole)
{
  vtkNew<vtkImageData> image;
  CSLF_CHECK(decoder->GetViewpoint(z, image));
  CSLF_CHECK(image->GetExtent()[4] == z && image->GetExtent()[5] == z);
  CSLF_CHECK(cslf::testing::HasEqualSlices(image, whole));
  std::string error;
  CSLF_CHECK(cslf::Description::ReadFrom(image, error).has_value());
}

void UpdateSlices(vtkCSLFDecoder* decoder, int first, int last)
{
  int extent[6];
  decoder->UpdateInformation();
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(decoder->GetOutputInformation(0), extent);
  extent[4] = first;
  extent[5] = last;
  decoder->UpdateExtent(extent);
}

/// In any order, decoded separately or from the cache.
void TestSingle(const std::string& fileName, vtkImageData* whole)
{
  std::vector<vtkIdType> order(Slices);
  for (vtkIdType z = 0; z < Slices; ++z)
  {
    order[z] = z;
  }
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  for (const vtkTypeInt64 size : { vtkTypeInt64(0), 7 * ViewpointBytes, Slices * ViewpointBytes })
  {
    const auto decoder = MakeDecoder(fileName);
    decoder->SetCacheSize(size);
    for (vtkIdType z : order)
    {
      CheckViewpoint(decoder, z, whole);
    }
    CSLF_CHECK(CountReady(decoder) == size / ViewpointBytes);
    CheckViewpoint(decoder, order.back(), whole);
  }
}

void TestPrefetch(const std::string& fileName, vtkImageData* whole)
{
  const auto decoder = MakeDecoder(fileName);
  decoder->Prefetch(MakeRange(0, Slices - 1));
  decoder->WaitForPrefetch();
  CSLF_CHECK(CountReady(decoder) == Slices);
  for (vtkIdType z = 0; z < Slices; ++z)
  {
    CheckViewpoint(decoder, z, whole);
  }
  // Kept viewpoints are shared, not copied.
  vtkNew<vtkImageData> first;
  vtkNew<vtkImageData> second;
  CSLF_CHECK(decoder->GetViewpoint(5, first) && decoder->GetViewpoint(5, second));
  CSLF_CHECK(first->GetPointData()->GetScalars() == second->GetPointData()->GetScalars());

  // The budget holds the first ones.
  const auto small = MakeDecoder(fileName);
  small->SetCacheSize(5 * ViewpointBytes + ViewpointBytes / 2);
  small->Prefetch(MakeList({ 90, 3, 3, -1, 50, Slices, 17, 4, 60, 61 }));
  small->WaitForPrefetch();
  CSLF_CHECK(CountReady(small) == 5);
  for (vtkIdType z : { 90, 3, 50, 17, 4 })
  {
    CSLF_CHECK(small->IsViewpointReady(z));
  }
  // A viewpoint that is requested again stays, and another one is dropped.
  small->Prefetch(MakeList({ 60, 4, 90 }));
  small->WaitForPrefetch();
  CSLF_CHECK(small->IsViewpointReady(60) && small->IsViewpointReady(4));
  CSLF_CHECK(small->IsViewpointReady(90) && CountReady(small) == 5);
  small->SetCacheSize(0);
  CSLF_CHECK(CountReady(small) == 0);
  small->Prefetch(MakeRange(0, 9));
  small->WaitForPrefetch();
  CSLF_CHECK(CountReady(small) == 0);
}

/// The pipeline uses kept viewpoints, and keeps the rest of the groups that it reads.
void TestPipeline(const std::string& fileName, vtkImageData* whole)
{
  const auto decoder = MakeDecoder(fileName);
  UpdateSlices(decoder, 10, 12);
  CSLF_CHECK(cslf::testing::HasEqualSlices(decoder->GetOutput(), whole));
  CSLF_CHECK(CountReady(decoder) > 0 && !decoder->IsViewpointReady(11));
  decoder->Prefetch(MakeRange(20, 40));
  UpdateSlices(decoder, 30, 50);
  CSLF_CHECK(cslf::testing::HasEqualSlices(decoder->GetOutput(), whole));

  // The number of threads does not matter.
  const auto alone = MakeDecoder(fileName);
  vtkSMPTools::LocalScope(vtkSMPTools::Config(1), [&] { UpdateSlices(alone, 0, Slices - 1); });
  CSLF_CHECK(cslf::testing::HasEqualSlices(alone->GetOutput(), whole));

  // If everything is kept, the video is not needed any more.
  const std::string copy = fileName + ".copy.mp4";
  const std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
  cslf::testing::WriteBytes(copy, bytes);
  const auto kept = MakeDecoder(copy);
  kept->Prefetch(MakeRange(0, Slices - 1));
  kept->WaitForPrefetch();
  cslf::testing::WriteBytes(copy, std::vector<char>(bytes.size(), 0));
  UpdateSlices(kept, 0, Slices - 1);
  CSLF_CHECK(kept->GetNumberOfMissingViewpoints() == 0);
  CSLF_CHECK(cslf::testing::HasEqualSlices(kept->GetOutput(), whole));
}

void TestFileOrder(const std::string& fileName)
{
  const auto decoder = MakeDecoder(fileName);
  vtkNew<vtkIdTypeArray> order;
  decoder->GetViewpointsInFileOrder(order);
  std::vector<bool> seen(Slices, false);
  for (vtkIdType k = 0; k < order->GetNumberOfValues(); ++k)
  {
    seen[order->GetValue(k)] = true;
  }
  CSLF_CHECK(order->GetNumberOfValues() == Slices);
  CSLF_CHECK(std::count(seen.begin(), seen.end(), true) == Slices);
}

void Abort(vtkObject* caller, unsigned long, void*, void*)
{
  static_cast<vtkAlgorithm*>(caller)->AbortExecuteOn();
}

/// Nothing else changes, whatever happens while viewpoints are decoded in the background.
void TestInterrupted(const std::string& fileName, const std::string& other, vtkImageData* whole)
{
  for (int time = 0; time < 40; ++time)
  {
    const auto decoder = MakeDecoder(fileName);
    decoder->Prefetch(MakeRange(time, Slices - 1));
    switch (time % 5)
    {
      case 0: // destroyed at once
        break;
      case 1: // another file
        decoder->SetFileName(other.c_str());
        CheckViewpoint(decoder, Slices - 1, whole);
        break;
      case 2: // another request
        decoder->Prefetch(MakeRange(0, 9));
        CheckViewpoint(decoder, 11, whole);
        decoder->Prefetch(nullptr);
        decoder->WaitForPrefetch();
        break;
      case 3: // an update that is aborted
      {
        vtkNew<vtkCallbackCommand> abort;
        abort->SetCallback(Abort);
        decoder->AddObserver(vtkCommand::ProgressEvent, abort);
        UpdateSlices(decoder, 0, Slices - 1);
        CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
        break;
      }
      default: // no more space
        decoder->SetCacheSize(0);
        CheckViewpoint(decoder, 40, whole);
    }
  }
}

void TestErrors(const std::string& fileName)
{
  const auto decoder = MakeDecoder(fileName);
  const cslf::testing::Observed observed(decoder);
  vtkNew<vtkImageData> image;
  CSLF_CHECK(!decoder->GetViewpoint(Slices, image));
  CSLF_CHECK(observed.HasError("There is no viewpoint 96"));
  CSLF_CHECK(image->GetNumberOfPoints() == 0);
  CSLF_CHECK(!decoder->IsViewpointReady(-1) && !decoder->IsViewpointReady(Slices));

  const auto none = MakeDecoder(fileName + ".none.mp4");
  const cslf::testing::Observed observedToo(none);
  CSLF_CHECK(!none->GetViewpoint(0, image));
  CSLF_CHECK(observedToo.HasError("there is no such file"));
  none->WaitForPrefetch();
}

// Phases have names and can be stopped.
void TestPhases(const std::string& fileName)
{
  const auto decoder = MakeDecoder(fileName);
  const cslf::testing::Observed observed(decoder);
  for (const char* phase : { "Checking viewpoints", "Decoding viewpoints" })
  {
    const cslf::testing::ProgressWatch watch(decoder, phase, 2);
    decoder->Update();
    watch.CheckAborted();
    CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
    decoder->SetAbortExecute(0);
  }
  CSLF_CHECK(observed.GetErrors() == 0);
  const cslf::testing::ProgressWatch watch(decoder);
  decoder->Update();
  watch.CheckWhole({ "Checking viewpoints", "Decoding viewpoints" });
  CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() > 0);
}
}

int TestCSLFDecoderAccess(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "DecoderAccess");
  const auto field = cslf::testing::MakeByteField(Viewpoints, Resolution);
  const std::string names[] = { folder + "/field.mp4", folder + "/field.mkv" };
  for (const std::string& name : names)
  {
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetPreset("ultrafast");
    CSLF_CHECK(cslf::testing::Encode(encoder, field, name));
    const auto whole = cslf::testing::Decode(name);
    CSLF_CHECK(whole != nullptr);
    if (!whole)
    {
      return cslf::testing::Result();
    }
    TestSingle(name, whole);
    TestPrefetch(name, whole);
    TestFileOrder(name);
    TestErrors(name);
  }
  for (const char* codec : { "av1", "h264" })
  {
    if (vtkCSLFEncoder::CanEncode(codec))
    {
      vtkNew<vtkCSLFEncoder> encoder;
      encoder->SetCodec(codec);
      encoder->SetPreset("ultrafast");
      const std::string name = folder + "/" + codec + ".mp4";
      CSLF_CHECK(cslf::testing::Encode(encoder, field, name));
      TestSingle(name, cslf::testing::Decode(name));
    }
  }
  const auto whole = cslf::testing::Decode(names[0]);
  TestPipeline(names[0], whole);
  TestPhases(names[0]);
  TestInterrupted(names[0], names[1], whole);
  return cslf::testing::Result();
}
