// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The quality of each channel with the default settings, both containers, all pixel formats, and
// parts.
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <iostream>

namespace
{
void Report(const std::string& what, const std::string& fileName, vtkImageData* field,
  const cslf::testing::FieldPSNR& psnr)
{
  const double bytes = static_cast<double>(cslf::testing::ReadBytes(fileName).size());
  std::cout << what << ": " << bytes << " bytes, " << 3.0 * field->GetNumberOfPoints() / bytes
            << ":1, PSNR colour " << psnr.Color << " dB, coverage " << psnr.Coverage
            << " dB, depth " << psnr.Depth << " dB\n";
}

/// A finer coverage than by default.
void TestCoverage(vtkImageData* field, const std::string& fileName)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->GetRateControl()->SetCoverageCRF(16.0);
  const std::string fine = fileName + ".fine" + fileName.substr(fileName.size() - 4);
  CSLF_CHECK(cslf::testing::Encode(encoder, field, fine));
  const auto whole = cslf::testing::Decode(fine);
  CSLF_CHECK(whole && cslf::testing::Compare(whole, field).Coverage > 45.0);
}

void TestDefaults(vtkImageData* field, const std::string& fileName)
{
  vtkNew<vtkCSLFEncoder> encoder;
  CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
  const auto whole = cslf::testing::Decode(fileName);
  CSLF_CHECK(whole != nullptr);
  if (!whole)
  {
    return;
  }
  const auto psnr = cslf::testing::Compare(whole, field);
  Report(fileName, fileName, field, psnr);
  CSLF_CHECK(psnr.Color > 35.0);
  CSLF_CHECK(psnr.Coverage > 41.0);
  CSLF_CHECK(psnr.Depth > 45.0);
  TestCoverage(field, fileName);

  // Any part equals the same part of the whole.
  const int last = field->GetExtent()[5];
  for (const auto& range : { std::pair<int, int>(0, 0), std::pair<int, int>(last, last),
         std::pair<int, int>(7, 40), std::pair<int, int>(last / 2, last / 2) })
  {
    const auto part = cslf::testing::Decode(fileName, range.first, range.second);
    CSLF_CHECK(part && part->GetExtent()[4] == range.first);
    CSLF_CHECK(part && part->GetExtent()[5] == range.second);
    CSLF_CHECK(part && cslf::testing::HasEqualSlices(part, whole));
  }
}

void TestPixelFormats(vtkImageData* field, const std::string& folder)
{
  for (const char* format : { "yuv444p10le", "yuv422p", "yuv420p", "yuv420p10le", "gbrp" })
  {
    const std::string fileName = folder + "/" + format + ".mp4";
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetPixelFormat(format);
    encoder->SetPreset("ultrafast");
    encoder->GetRateControl()->SetCRF(18);
    encoder->SetGroupLength(5);
    CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(fileName.c_str());
    decoder->Update();
    CSLF_CHECK(std::string(decoder->GetPixelFormat()) == format);
    CSLF_CHECK(std::string(decoder->GetCodecName()) == "hevc");
    CSLF_CHECK(decoder->FindMissingViewpoints() == 0);
    const auto psnr = cslf::testing::Compare(decoder->GetOutput(), field);
    Report(format, fileName, field, psnr);
    CSLF_CHECK(psnr.Color > 28.0);
  }
}

/// Without gaps there is no coverage track, and none to be decoded.
void TestFullCoverage(vtkImageData* field, const std::string& folder)
{
  vtkNew<vtkImageData> full;
  full->DeepCopy(field);
  full->GetPointData()->GetArray(cslf::ColorName)->FillComponent(3, 255);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  CSLF_CHECK(cslf::testing::Encode(encoder, full, folder + "/full.mp4"));
  const auto decoded = cslf::testing::Decode(folder + "/full.mp4");
  CSLF_CHECK(decoded != nullptr);
  CSLF_CHECK(decoded && cslf::testing::Compare(decoded, full).Coverage == 200.0);
  const std::vector<char> bytes = cslf::testing::ReadBytes(folder + "/full.mp4");
  CSLF_CHECK(std::string(bytes.begin(), bytes.end()).find("\"coverage\"") == std::string::npos);
}
}

int TestCSLFEncoderRoundTrip(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderRoundTrip");
  TestDefaults(cslf::testing::MakeByteField(3, 64), folder + "/defaults.mp4");
  TestDefaults(cslf::testing::MakeByteField(3, 36), folder + "/defaults.mkv");
  const auto small = cslf::testing::MakeByteField(2, 32);
  TestPixelFormats(small, folder);
  TestFullCoverage(small, folder);
  return cslf::testing::Result();
}
