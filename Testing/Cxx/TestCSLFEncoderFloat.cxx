// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Float colour: the transfer curve, quality over five decades of radiance, clipping, and refusals.
#include "Coding/Frames/cslfColorFrames.h"
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

namespace
{
using cslf::PQToRadiance;
using cslf::RadianceToPQ;

/// Values of SMPTE ST 2084 as ITU-R BT.2408 tabulates them, to three digits.
void TestCurve()
{
  CSLF_CHECK_NEAR(RadianceToPQ(1.0), 0.581, 0.0005);
  CSLF_CHECK_NEAR(RadianceToPQ(100.0 / 203.0), 0.508, 0.0005);
  CSLF_CHECK_NEAR(RadianceToPQ(1000.0 / 203.0), 0.752, 0.0005);
  CSLF_CHECK_NEAR(RadianceToPQ(cslf::MaximumRadiance), 1.0, 1e-12);
  CSLF_CHECK_NEAR(RadianceToPQ(-1.0), RadianceToPQ(0.0), 0.0);
  CSLF_CHECK_NEAR(RadianceToPQ(NAN), RadianceToPQ(0.0), 0.0);
  CSLF_CHECK_NEAR(RadianceToPQ(1e9), 1.0, 1e-12);
  CSLF_CHECK_NEAR(PQToRadiance(0.0), 0.0, 1e-12);
  for (double radiance = 1e-4; radiance < cslf::MaximumRadiance; radiance *= 1.7)
  {
    CSLF_CHECK_NEAR(PQToRadiance(RadianceToPQ(radiance)) / radiance, 1.0, 1e-8);
  }
}

/// The closed-form field's coverage and depth, with float colours that rise smoothly from 1e-4 to
/// 10 across each strip.
vtkSmartPointer<vtkImageData> MakeField(int resolution)
{
  const cslf::Cube box{ { 0, 0, 0 }, { 2, 2, 2 } };
  auto field =
    cslf::testing::MakeTestField(cslf::Layout(2, resolution), box, VTK_FLOAT, VTK_UNSIGNED_SHORT);
  vtkDataArray* colors = field->GetPointData()->GetArray(cslf::ColorName);
  const int* size = field->GetDimensions();
  for (vtkIdType texel = 0; texel < colors->GetNumberOfTuples(); ++texel)
  {
    const double radiance =
      std::pow(10.0, -4.0 + 5.0 * static_cast<double>(texel % size[0]) / (size[0] - 1.0));
    const auto row = static_cast<double>(texel / size[0]);
    for (int k = 0; k < 3; ++k)
    {
      const double tint = 0.75 + 0.25 * std::cos(0.1 * row + 2.0 * k);
      colors->SetComponent(texel, k, colors->GetComponent(texel, 3) * tint * radiance);
    }
  }
  return field;
}

/// The median and the 99th percentile of the relative errors of luminance of covered texels, in
/// each decade of luminance.
std::array<std::array<double, 2>, 5> FindErrors(vtkImageData* decoded, vtkImageData* field)
{
  vtkDataArray* found = decoded->GetPointData()->GetArray(cslf::ColorName);
  vtkDataArray* expected = field->GetPointData()->GetArray(cslf::ColorName);
  const auto luminance = [](vtkDataArray* colors, vtkIdType texel)
  {
    return 0.2126 * colors->GetComponent(texel, 0) + 0.7152 * colors->GetComponent(texel, 1) +
      0.0722 * colors->GetComponent(texel, 2);
  };
  std::array<std::vector<double>, 5> errors;
  for (vtkIdType texel = 0; texel < expected->GetNumberOfTuples(); ++texel)
  {
    const double truth = luminance(expected, texel);
    const int decade = static_cast<int>(std::floor(std::log10(std::max(truth, 1e-9)))) + 4;
    if (expected->GetComponent(texel, 3) == 1.0 && decade >= 0 && decade < 5)
    {
      errors[decade].push_back(std::abs(luminance(found, texel) - truth) / truth);
    }
  }
  std::array<std::array<double, 2>, 5> summary{};
  for (int decade = 0; decade < 5; ++decade)
  {
    std::vector<double>& list = errors[decade];
    CSLF_CHECK(list.size() > 100);
    std::sort(list.begin(), list.end());
    summary[decade] = { list[list.size() / 2], list[list.size() * 99 / 100] };
  }
  return summary;
}

void TestRoundTrip(const std::string& folder, const std::string& codec,
  const std::string& expectedFormat, double crf, double median)
{
  const auto field = MakeField(32);
  const std::string fileName = folder + "/" + codec + std::to_string(int(crf)) + ".mp4";
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetCodec(codec.c_str());
  encoder->GetRateControl()->SetCRF(crf);
  encoder->SetPreset("fast");
  CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  decoder->Update();
  vtkImageData* decoded = decoder->GetOutput();
  std::string error;
  const auto description = cslf::Description::ReadFrom(decoded, error);
  CSLF_CHECK(description.has_value());
  const cslf::Channel* color = description ? description->FindChannel(cslf::ColorName) : nullptr;
  CSLF_CHECK(color && color->Type == VTK_FLOAT && color->Encoding == cslf::LinearEncoding);
  CSLF_CHECK(decoder->GetPixelFormat() == expectedFormat);
  if (!color)
  {
    return;
  }
  std::cout << fileName << ": " << cslf::testing::ReadBytes(fileName).size()
            << " bytes; relative errors of luminance, median and 99 %, from 1e-4 on:";
  for (const auto& decade : FindErrors(decoded, field))
  {
    std::cout << "  " << decade[0] << " " << decade[1];
    CSLF_CHECK(decade[0] < median);
    CSLF_CHECK(decade[1] < 20.0 * median);
  }
  std::cout << "\n";
  const auto part = cslf::testing::Decode(fileName, 5, 9);
  CSLF_CHECK(part && cslf::testing::HasEqualSlices(part, decoded));
  CSLF_CHECK(cslf::testing::Compare(decoded, field).Depth > 42.0);
}

/// Radiance without a signal becomes the nearest one that has a signal, with one warning.
void TestClipping(const std::string& folder)
{
  const auto field = MakeField(16);
  vtkDataArray* colors = field->GetPointData()->GetArray(cslf::ColorName);
  colors->FillComponent(3, 1.0);
  for (int k = 0; k < 3; ++k)
  {
    colors->FillComponent(k, 1000.0);
  }
  colors->SetComponent(3, 1, -1.0);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(cslf::testing::Encode(encoder, field, folder + "/clipped.mp4"));
  CSLF_CHECK(observed.HasWarning("clipped"));
  const auto decoded = cslf::testing::Decode(folder + "/clipped.mp4");
  CSLF_CHECK(decoded != nullptr);
  if (decoded)
  {
    vtkDataArray* found = decoded->GetPointData()->GetArray(cslf::ColorName);
    const vtkIdType last = found->GetNumberOfTuples() - 1;
    CSLF_CHECK_NEAR(found->GetComponent(last, 0), cslf::MaximumRadiance, 1.0);
    CSLF_CHECK(found->GetComponent(last, 3) == 1.0);
  }
}

void TestRefused(const std::string& folder)
{
  const auto field = MakeField(16);
  for (const bool isLossless : { true, false })
  {
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetInputData(field);
    encoder->SetLossless(isLossless);
    encoder->SetPixelFormat("yuv444p");
    encoder->SetFileName((folder + "/refused.mp4").c_str());
    const cslf::testing::Observed observed(encoder);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(observed.HasError(isLossless ? "without loss" : "10 or 12 bits"));
    CSLF_CHECK(!cslf::testing::Exists(folder + "/refused.mp4"));
    CSLF_CHECK(!cslf::testing::Exists(folder + "/refused.mp4.partial"));
  }
}
}

int TestCSLFEncoderFloat(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderFloat");
  TestCurve();
  const struct
  {
    const char* Codec;
    const char* Format;
    double CRF;
    double Median;
  } cases[] = { { "hevc", "yuv444p12le", 2.0, 0.05 }, { "hevc", "yuv444p12le", 22.0, 0.25 },
    { "h264", "yuv444p10le", 2.0, 0.04 }, { "av1", "yuv444p12le", 2.0, 0.03 } };
  for (const auto& item : cases)
  {
    if (vtkCSLFEncoder::CanEncode(item.Codec))
    {
      TestRoundTrip(folder, item.Codec, item.Format, item.CRF, item.Median);
    }
    else
    {
      std::cout << "This FFmpeg cannot encode " << item.Codec << ": skipped.\n";
    }
  }
  TestClipping(folder);
  TestRefused(folder);
  return cslf::testing::Result();
}
