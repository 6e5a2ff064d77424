// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// In a program whose language has a decimal comma, texts in files and options of encoders mean the
// same as in any other.
#include "PathTracing/Lights/cslfEnvironment.h"
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace
{
constexpr int Skipped = 125;

/// Selects a language with a decimal comma, which localedef compiles if the system has none.
bool SelectComma(const std::string& folder)
{
  const std::string made = folder + "/de_DE.UTF-8";
  for (const char* name : { "de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8" })
  {
    if (std::setlocale(LC_NUMERIC, name))
    {
      return true;
    }
  }
#ifdef _WIN32
  return false;
#else
  const std::string command = "localedef -i de_DE -f UTF-8 \"" + made + "\" 2>&1 > /dev/null";
  const bool isMade = std::system(command.c_str()) == 0;
  ::setenv("LOCPATH", folder.c_str(), 1);
  return isMade && std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
#endif
}

/// The first value of a Radiance image of 0.5, whose header gives an exponent of 1.8.
double ReadHalf(const std::string& folder)
{
  const std::string name = folder + "/gamma.hdr";
  std::ofstream file(name, std::ios::binary);
  file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nGAMMA=1.8\n\n-Y 4 +X 8\n";
  for (int i = 0; i < 32; ++i)
  {
    file << "\x80\x80\x80\x80";
  }
  file.close();
  cslf::EnvironmentImage image;
  std::string error;
  CSLF_CHECK(cslf::ReadEnvironmentImage(name, image, error));
  return image.Pixels.empty() ? 0.0 : image.Pixels[0].x;
}

/// The bytes of a video with a rate factor that is no whole number.
std::vector<char> Encode(const char* codec, const std::string& fileName)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetCodec(codec);
  encoder->SetPreset("ultrafast");
  encoder->GetRateControl()->SetCRF(23.7);
  const auto field = cslf::testing::MakeByteField(2, 16);
  CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
  return cslf::testing::ReadBytes(fileName);
}
}

int TestCSLFDecimalComma(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "DecimalComma");
  const double half = ReadHalf(folder);
  std::map<std::string, std::vector<char>> videos;
  for (const char* codec : { "hevc", "h264", "av1" })
  {
    if (vtkCSLFEncoder::CanEncode(codec))
    {
      videos[codec] = Encode(codec, folder + "/point-" + codec + ".mp4");
    }
  }

  if (!SelectComma(folder))
  {
    std::cout << "There is no language with a decimal comma.\n";
    return Skipped;
  }
  char text[8];
  std::snprintf(text, sizeof(text), "%.1f", 0.5);
  CSLF_CHECK(std::string(text) == "0,5");
  CSLF_CHECK_NEAR(cslf::ImageCurve("Gamma1.8", false).ToLinear(0.5), std::pow(0.5, 1.8), 1e-9);
  CSLF_CHECK_NEAR(
    cslf::ImageCurve("g22_rec709_scene", true).ToLinear(0.5), std::pow(0.5, 2.2), 1e-9);
  CSLF_CHECK_NEAR(ReadHalf(folder), half, 1e-6);
  for (const auto& [codec, bytes] : videos)
  {
    CSLF_CHECK(Encode(codec.c_str(), folder + "/comma-" + codec + ".mp4") == bytes);
  }
  // The language is the program's again.
  std::snprintf(text, sizeof(text), "%.1f", 0.5);
  CSLF_CHECK(std::string(text) == "0,5");
  std::setlocale(LC_NUMERIC, "C");
  return cslf::testing::Result();
}
