// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Every codec that this FFmpeg can encode: quality, both containers, parts, reproducible bytes,
// detection of damage, and copies to another container and back.
#include "cslfCodecTesting.h"
#include "cslfRemux.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <iostream>

namespace
{
using cslf::testing::Decode;
using cslf::testing::ReadBytes;

struct Case
{
  const char* Codec;
  const char* PixelFormat;
  const char* ExpectedFormat;
  const char* Extension;
  int Resolution;
  double MinimumPSNR;
};

std::string Encode(
  const Case& item, vtkImageData* field, const std::string& folder, const std::string& suffix = "")
{
  std::string fileName = folder + "/" + item.Codec + "-" + item.ExpectedFormat + "-" +
    std::to_string(item.Resolution) + suffix + item.Extension;
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetCodec(item.Codec);
  encoder->GetRateControl()->SetCoverageCRF(16);
  encoder->SetPixelFormat(item.PixelFormat);
  encoder->SetPreset("fast");
  CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
  return fileName;
}

/// Changing a byte in the middle of the file makes viewpoints missing; the others stay.
void TestDamage(const std::string& fileName, vtkImageData* whole)
{
  std::vector<char> bytes = ReadBytes(fileName);
  bytes[bytes.size() / 2] ^= 0x10;
  const std::string damaged =
    fileName.substr(0, fileName.size() - 4) + "-damaged" + fileName.substr(fileName.size() - 4);
  cslf::testing::WriteBytes(damaged, bytes);
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(damaged.c_str());
  const cslf::testing::Observed observed(decoder);
  const vtkIdType missing = decoder->FindMissingViewpoints();
  CSLF_CHECK(missing > 0 && missing <= 16);
  decoder->Update();
  CSLF_CHECK(observed.HasWarning("is damaged"));
  CSLF_CHECK(decoder->GetNumberOfMissingViewpoints() == missing);
  CSLF_CHECK(!cslf::testing::HasEqualSlices(decoder->GetOutput(), whole));
}

void TestRoundTrip(const Case& item, const std::string& folder)
{
  const auto field = cslf::testing::MakeByteField(2, item.Resolution);
  const std::string fileName = Encode(item, field, folder);
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  decoder->Update();
  vtkImageData* whole = decoder->GetOutput();
  CSLF_CHECK(std::string(decoder->GetCodecName()) == item.Codec);
  CSLF_CHECK(std::string(decoder->GetPixelFormat()) == item.ExpectedFormat);
  CSLF_CHECK(decoder->GetNumberOfTracks() == 3);
  const auto psnr = cslf::testing::Compare(whole, field);
  std::cout << fileName << ": " << ReadBytes(fileName).size() << " bytes (";
  for (int track = 0; track < decoder->GetNumberOfTracks(); ++track)
  {
    std::cout << decoder->GetTrackName(track) << " " << decoder->GetTrackBytes(track) << " ";
    CSLF_CHECK(decoder->GetTrackBytes(track) > 0);
  }
  std::cout << "), PSNR colour " << psnr.Color << " dB, coverage " << psnr.Coverage << " dB, depth "
            << psnr.Depth << " dB\n";
  CSLF_CHECK(psnr.Color > item.MinimumPSNR);
  CSLF_CHECK(psnr.Coverage > 39.0);
  // Rims, of which small tiles have many, are moved back before coding.
  CSLF_CHECK(psnr.Depth > 40.0);

  const auto part = Decode(fileName, 5, 9);
  CSLF_CHECK(part && cslf::testing::HasEqualSlices(part, whole));
  CSLF_CHECK(ReadBytes(Encode(item, field, folder, "-again")) == ReadBytes(fileName));
  TestDamage(fileName, whole);

  const bool isMP4 = std::string(item.Extension) == ".mp4";
  const std::string other = fileName + (isMP4 ? ".mkv" : ".mp4");
  const std::string back = fileName + (isMP4 ? ".back.mp4" : ".back.mkv");
  CSLF_CHECK(cslf::testing::Remux(fileName, other) && cslf::testing::Remux(other, back));
  for (const std::string& copy : { other, back })
  {
    const auto decoded = Decode(copy);
    CSLF_CHECK(decoded && cslf::testing::HasEqualSlices(decoded, whole));
  }
}

void TestRefused(const std::string& codec, const std::string& format, bool isLossless,
  const std::string& folder, const std::string& message)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetCodec(codec.c_str());
  encoder->SetPixelFormat(format.c_str());
  encoder->SetLossless(isLossless);
  encoder->SetInputData(cslf::testing::MakeByteField(2, 16));
  encoder->SetFileName((folder + "/refused.mp4").c_str());
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(observed.HasError(message));
}
}

int TestCSLFEncoderCodecs(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderCodecs");
  const Case cases[] = {
    { "hevc", "auto", "yuv444p", ".mp4", 32, 33.0 },
    { "hevc", "yuv420p10le", "yuv420p10le", ".mkv", 32, 27.0 },
    { "h264", "auto", "yuv444p", ".mp4", 32, 32.0 },
    { "h264", "yuv444p10le", "yuv444p10le", ".mkv", 17, 31.0 },
    { "h264", "yuv420p", "yuv420p", ".mp4", 32, 26.0 },
    { "av1", "auto", "yuv420p10le", ".mp4", 64, 28.0 },
    { "av1", "yuv420p", "yuv420p", ".mkv", 64, 28.0 },
    { "av1", "yuv444p", "yuv444p", ".mp4", 32, 34.0 },
    { "av1", "auto", "yuv420p10le", ".mkv", 16, 24.0 },
  };
  for (const Case& item : cases)
  {
    if (vtkCSLFEncoder::CanEncode(item.Codec))
    {
      TestRoundTrip(item, folder);
    }
    else
    {
      std::cout << "This FFmpeg cannot encode " << item.Codec << ": skipped.\n";
    }
  }
  CSLF_CHECK(!vtkCSLFEncoder::CanEncode("none"));
  TestRefused("none", "auto", false, folder, "is none of hevc, av1, h264");
  if (vtkCSLFEncoder::CanEncode("h264"))
  {
    TestRefused("h264", "gbrp", false, folder, "can code gbrp");
    TestRefused("h264", "auto", true, folder, "without loss");
  }
  return cslf::testing::Result();
}
