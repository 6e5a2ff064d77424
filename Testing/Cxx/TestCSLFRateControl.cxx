// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The options of the encoder: defaults and ranges are those of the table of options, and a change
// of the rate control writes the file again.
#include "Options/cslfOptionTable.h"
#include "cslfCodecTesting.h"
#include "cslfOptionChecks.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <string>

namespace
{
namespace options = cslf::options;
using cslf::testing::CheckOption;

void TestRanges()
{
  using Rate = vtkCSLFRateControl;
  vtkNew<Rate> rate;
  Rate* r = rate;
  CheckOption(options::CRF, r, &Rate::SetCRF, &Rate::GetCRF);
  CheckOption(options::CoverageCRF, r, &Rate::SetCoverageCRF, &Rate::GetCoverageCRF);
  CheckOption(options::DepthCRF, r, &Rate::SetDepthCRF, &Rate::GetDepthCRF);
  CheckOption(options::TargetRatio, r, &Rate::SetTargetRatio, &Rate::GetTargetRatio);
  CheckOption(options::TargetSize, r, &Rate::SetTargetSize, &Rate::GetTargetSize);
  CheckOption(options::TargetPSNR, r, &Rate::SetTargetPSNR, &Rate::GetTargetPSNR);
  CheckOption(options::KeyViewStep, r, &Rate::SetKeyViewStep, &Rate::GetKeyViewStep);
  CheckOption(
    options::TargetNovelViewPSNR, r, &Rate::SetTargetNovelViewPSNR, &Rate::GetTargetNovelViewPSNR);
  rate->SetKeyViewStepToAutomatic();
  rate->SetCRF(30.0);
  vtkNew<Rate> copy;
  copy->DeepCopy(rate);
  CSLF_CHECK(copy->GetKeyViewStep() == Rate::AutomaticKeyViews && copy->GetCRF() == 30.0);

  using Encoder = vtkCSLFEncoder;
  vtkNew<Encoder> encoder;
  CheckOption(
    options::GroupLength, encoder.Get(), &Encoder::SetGroupLength, &Encoder::GetGroupLength);
  CheckOption(options::Lossless, encoder.Get(), &Encoder::SetLossless, &Encoder::GetLossless);
  CheckOption(options::Restart, encoder.Get(), &Encoder::SetRestart, &Encoder::GetRestart);
  CSLF_CHECK(std::string(encoder->GetCodec()) == options::Codec.Default);
  CSLF_CHECK(std::string(encoder->GetPreset()) == options::Preset.Default);
  CSLF_CHECK(std::string(encoder->GetPixelFormat()) == options::PixelFormat.Default);
}

void TestExecution(const std::string& fileName)
{
  const auto field = cslf::testing::MakeByteField(2, 16);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  encoder->SetFileName(fileName.c_str());
  encoder->SetPreset("ultrafast");
  encoder->Update();
  CSLF_CHECK(encoder->GetActualCRF() == options::CRF.Default);
  encoder->GetRateControl()->SetCRF(30.0);
  encoder->Update();
  CSLF_CHECK(encoder->GetActualCRF() == 30.0);
  vtkNew<vtkCSLFRateControl> rate;
  rate->SetCRF(40.0);
  encoder->SetRateControl(rate);
  encoder->Update();
  CSLF_CHECK(encoder->GetActualCRF() == 40.0);
  encoder->SetRateControl(nullptr);
  CSLF_CHECK(encoder->GetRateControl() && encoder->GetRateControl() != rate);
}
}

int TestCSLFRateControl(int argc, char* argv[])
{
  TestRanges();
  TestExecution(cslf::testing::MakeFolder(argc, argv, "RateControl") + "/rate.mp4");
  return cslf::testing::Result();
}
