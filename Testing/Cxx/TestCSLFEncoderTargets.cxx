// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files of a wanted size, ratio or quality: met within 3 % or 0.3 dB, with the same bytes for any
// number of threads, without requesting any viewpoint more than twice; and targets that cannot be
// reached.
#include "Coding/RateControl/cslfRateControl.h"
#include "cslfCodecTesting.h"
#include "cslfFieldSource.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>

#include <filesystem>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace
{
using Change = std::function<void(vtkCSLFEncoder*)>;

double CountRawBytes(vtkImageData* field)
{
  return 3.0 * static_cast<double>(field->GetNumberOfPoints());
}

/// Writes a field with one target, and checks what the encoder reports about the file.
struct Outcome
{
  double Bytes = 0.0;
  double PSNR = 0.0;
  int Slices = 0; ///< pulled
};

Outcome Write(vtkImageData* field, const std::string& fileName, const Change& change)
{
  const auto source = cslf::testing::MakeSource(field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  change(encoder);
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(!cslf::testing::Exists(fileName + ".partial"));
  const auto decoded = cslf::testing::Decode(fileName);
  if (!decoded)
  {
    CSLF_CHECK(false);
    return {};
  }
  const double bytes = static_cast<double>(std::filesystem::file_size(fileName));
  const double psnr = cslf::testing::Compare(decoded, field).Color;
  CSLF_CHECK(encoder->GetActualSize() == bytes);
  CSLF_CHECK_NEAR(encoder->GetActualRatio(), CountRawBytes(field) / bytes, 1e-6);
  CSLF_CHECK_NEAR(encoder->GetActualPSNR(), psnr, 1e-6);
  CSLF_CHECK(encoder->GetActualCRF() > 0.0 && encoder->GetActualCRF() < 51.0);
  std::cout << fileName << ": " << bytes << " bytes, " << psnr << " dB, factor "
            << encoder->GetActualCRF() << ", " << source->Slices << " slices\n";
  return { bytes, psnr, source->Slices };
}

/// Each kind of target, low and high. A few groups are all tried, many are sampled.
void TestTargets(
  vtkImageData* field, const std::string& folder, int groupLength, const std::vector<double>& psnrs)
{
  const std::string name = folder + "/targets-" + std::to_string(groupLength);
  const int slices = field->GetExtent()[5] + 1;
  const double raw = CountRawBytes(field);
  const Outcome scaled = Write(field, name + ".mp4",
    [&](vtkCSLFEncoder* encoder)
    {
      encoder->SetGroupLength(groupLength);
      encoder->GetRateControl()->SetTargetRatio(12.0);
    });
  CSLF_CHECK_NEAR(raw / scaled.Bytes / 12.0, 1.0, 0.03);
  CSLF_CHECK(scaled.Slices <= 2 * slices);
  const Outcome sized = Write(field, name + ".mkv",
    [&](vtkCSLFEncoder* encoder)
    {
      encoder->SetGroupLength(groupLength);
      encoder->GetRateControl()->SetTargetSize(raw / 25.0);
    });
  CSLF_CHECK_NEAR(sized.Bytes * 25.0 / raw, 1.0, 0.03);
  for (double psnr : psnrs)
  {
    const Outcome outcome = Write(field, name + ".mp4",
      [&](vtkCSLFEncoder* encoder)
      {
        encoder->SetGroupLength(groupLength);
        encoder->GetRateControl()->SetTargetPSNR(psnr);
      });
    CSLF_CHECK_NEAR(outcome.PSNR, psnr, 0.3);
    CSLF_CHECK(outcome.Slices <= 2 * slices);
  }
}

void TestThreads(vtkImageData* field, const std::string& folder)
{
  std::vector<char> bytes[2];
  for (int threads : { 1, 2 })
  {
    const std::string name = folder + "/threads.mp4";
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads },
      [&]()
      {
        Write(field, name,
          [](vtkCSLFEncoder* encoder)
          {
            encoder->SetGroupLength(4);
            encoder->GetRateControl()->SetTargetRatio(20.0);
          });
      });
    bytes[threads - 1] = cslf::testing::ReadBytes(name);
  }
  CSLF_CHECK(!bytes[0].empty() && bytes[0] == bytes[1]);
}

void TestRefused(
  vtkImageData* field, const std::string& folder, const std::string& message, const Change& change)
{
  const auto source = cslf::testing::MakeSource(field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName((folder + "/refused.mp4").c_str());
  change(encoder);
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(encoder->GetErrorCode() != vtkErrorCode::NoError);
  CSLF_CHECK(encoder->GetActualSize() == 0.0);
  if (!observed.HasError(message))
  {
    std::cerr << "expected one error \"" << message << "\"\n";
    CSLF_CHECK(false);
  }
  CSLF_CHECK(!cslf::testing::Exists(folder + "/refused.mp4"));
  CSLF_CHECK(!cslf::testing::Exists(folder + "/refused.mp4.partial"));
}

/// A size is the most: the best quality may take less.
void TestLargeSize(vtkImageData* field, const std::string& folder)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  encoder->SetPreset("ultrafast");
  encoder->SetFileName((folder + "/large.mp4").c_str());
  encoder->GetRateControl()->SetTargetSize(1e9);
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(encoder->GetActualCRF() == 0.0 && encoder->GetActualSize() < 1e8);
}

void TestOutOfReach(vtkImageData* field, const std::string& folder)
{
  TestRefused(field, folder, "at a rate factor of 51 it is about",
    [](vtkCSLFEncoder* encoder) { encoder->GetRateControl()->SetTargetSize(100.0); });
  TestRefused(field, folder, "cannot be met",
    [](vtkCSLFEncoder* encoder) { encoder->GetRateControl()->SetTargetRatio(1e6); });
  TestRefused(field, folder, "a PSNR of 99 dB cannot be met",
    [](vtkCSLFEncoder* encoder) { encoder->GetRateControl()->SetTargetPSNR(99.0); });
  TestRefused(field, folder, "Only one target",
    [](vtkCSLFEncoder* encoder)
    {
      encoder->GetRateControl()->SetTargetPSNR(30.0);
      encoder->GetRateControl()->SetTargetRatio(30.0);
    });
  TestRefused(field, folder, "lossless",
    [](vtkCSLFEncoder* encoder)
    {
      encoder->GetRateControl()->SetTargetPSNR(30.0);
      encoder->LosslessOn();
    });
}

/// Every group is in one stage, and later stages fill the gaps evenly.
void TestStages()
{
  for (int count : { 1, 23, 47, 48, 96, 200, 384, 1000 })
  {
    const cslf::GroupStages stages(count);
    std::set<int> seen;
    for (int stage = 0; stage < stages.GetStageCount(); ++stage)
    {
      const std::vector<int> groups = stages.GetGroups(stage);
      CSLF_CHECK(!groups.empty());
      for (int group : groups)
      {
        CSLF_CHECK(seen.insert(group).second);
      }
    }
    CSLF_CHECK(static_cast<int>(seen.size()) == count);
    const int sample = static_cast<int>(stages.GetGroups(0).size());
    CSLF_CHECK(sample >= std::min(count, 24) && (sample < 48 || sample <= count / 16 + 1));
  }
}
}

int TestCSLFEncoderTargets(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderTargets");
  TestStages();
  const auto field = cslf::testing::MakeByteField(6, 24);
  TestTargets(field, folder, 16, { 26.0, 42.0 });
  TestTargets(field, folder, 2, { 33.0 });
  TestThreads(field, folder);
  TestOutOfReach(cslf::testing::MakeByteField(4, 16), folder);
  TestLargeSize(cslf::testing::MakeByteField(4, 16), folder);
  return cslf::testing::Result();
}
