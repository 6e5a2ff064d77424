// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lossless coding keeps colour, coverage and 16-bit depth bit for bit.
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace
{
void TestRoundTrip(vtkImageData* field, const std::string& fileName)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->LosslessOn();
  encoder->SetPreset("ultrafast");
  CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
  const auto decoded = cslf::testing::Decode(fileName);
  CSLF_CHECK(decoded != nullptr);
  CSLF_CHECK(decoded && decoded->GetNumberOfPoints() == field->GetNumberOfPoints());
  CSLF_CHECK(decoded && cslf::testing::HasEqualSlices(decoded, field));
}
}

int TestCSLFEncoderLossless(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderLossless");
  TestRoundTrip(cslf::testing::MakeByteField(3, 16), folder + "/odd.mp4");
  TestRoundTrip(cslf::testing::MakeByteField(2, 16), folder + "/least.mkv");
  TestRoundTrip(cslf::testing::MakeByteField(2, 17, false), folder + "/colour.mp4");
  TestRoundTrip(cslf::testing::MakeByteField(5, 16), folder + "/more.mkv");
  TestRoundTrip(cslf::testing::MakeByteField(2, 100), folder + "/larger.mkv");
  return cslf::testing::Result();
}
