// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The meaning of values in image files, by format and by the names of colour spaces in all versions
// of OpenImageIO.
#include "Images/cslfImageFiles.h"
#include "PathTracing/Lights/cslfEnvironment.h"
#include "cslfTesting.h"

#include <vtkTestUtilities.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace
{
// The linear values of 0.5 by sRGB's curve, by the power of 2.2, and unchanged.
constexpr double HalfOfSRGB = 0.214041;
const double HalfOfGamma = std::pow(0.5, 2.2);

void TestNames()
{
  const auto half = [](const char* name, bool isFloat)
  { return cslf::ImageCurve(name, isFloat).ToLinear(0.5); };
  for (const bool isFloat : { false, true })
  {
    for (const char* name : { "sRGB", "srgb", "srgb_rec709_scene", "srgb_rec709_display", "srgb_tx",
           "sRGB - Texture", "Rec709" })
    {
      CSLF_CHECK_NEAR(half(name, isFloat), HalfOfSRGB, 1e-5);
    }
    for (const char* name : { "Linear", "linear", "lin_srgb", "lin_rec709", "lin_rec709_scene",
           "scene_linear", "lin_ap1_scene", "ACEScg", "raw", "data" })
    {
      CSLF_CHECK(half(name, isFloat) == 0.5);
    }
    for (const char* name : { "Gamma2.2", "GammaCorrected2.2", "g22_rec709_scene", "g22_rec709" })
    {
      const bool isTold = std::string(name) != "GammaCorrected2.2";
      CSLF_CHECK_NEAR(
        half(name, isFloat), isTold ? HalfOfGamma : (isFloat ? 0.5 : HalfOfSRGB), 1e-5);
    }
  }
  CSLF_CHECK_NEAR(half("g18_rec709_scene", false), std::pow(0.5, 1.8), 1e-9);
  CSLF_CHECK_NEAR(half("Gamma1.8", false), std::pow(0.5, 1.8), 1e-9);
  for (const char* name : { "", "unknown", "green_space", "g2", "Gamma" })
  {
    CSLF_CHECK_NEAR(half(name, false), HalfOfSRGB, 1e-5);
    CSLF_CHECK(half(name, true) == 0.5);
  }
}

/// The linear value of an image of 0.5, in a file.
double ReadHalf(const std::string& fileName, const char* colorSpace = nullptr)
{
  cslf::ImageHeader header;
  header.Width = 8;
  header.Height = 4;
  header.Channels = 3;
  header.Type = cslf::PixelType::Floats;
  if (colorSpace)
  {
    header.Attributes[cslf::ColorSpaceAttribute] = colorSpace;
  }
  const std::vector<float> pixels(96, 0.5f);
  std::vector<unsigned char> bytes;
  std::string error;
  const cslf::ImageLibrary* library = cslf::GetImageLibrary(error);
  CSLF_CHECK(library && library->Encode(fileName, header, pixels.data(), bytes, error));
  std::ofstream(fileName, std::ios::binary)
    .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  cslf::EnvironmentImage image;
  CSLF_CHECK(cslf::ReadEnvironmentImage(fileName, image, error));
  CSLF_CHECK(image.Width == 8 && image.Height == 4);
  return image.Pixels.empty() ? 0.0 : image.Pixels[13].y;
}

void TestFiles(const std::string& folder)
{
  const std::string name = folder + "/TestCSLFEnvironmentImage";
  for (const char* format : { ".png", ".jpg", ".tif" })
  {
    // Of these, only TIFF stores floats.
    const bool isFloat = std::string(format) == ".tif";
    CSLF_CHECK_NEAR(ReadHalf(name + format), isFloat ? 0.5 : HalfOfSRGB, 0.005);
  }
  CSLF_CHECK_NEAR(ReadHalf(name + "SRGB.png", "sRGB"), HalfOfSRGB, 0.005);
  for (const char* format : { ".exr", ".hdr" })
  {
    CSLF_CHECK_NEAR(ReadHalf(name + format), 0.5, 0.005);
  }
}

/// A small file that says to be a huge image takes no memory for it.
void TestHuge(const std::string& folder)
{
  const std::string name = folder + "/TestCSLFEnvironmentImageHuge.pfm";
  std::ofstream(name, std::ios::binary) << "PF\n20000 20000\n-1.0\n" << std::string(64, '\0');
  cslf::EnvironmentImage image;
  std::string error;
  CSLF_CHECK(!cslf::ReadEnvironmentImage(name, image, error));
  // Some versions of OpenImageIO refuse it first.
  CSLF_CHECK(!error.empty());
}
}

int TestCSLFEnvironmentImage(int argc, char* argv[])
{
  char* folder =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  TestNames();
  TestFiles(folder);
  TestHuge(folder);
  delete[] folder;
  return cslf::testing::Result();
}
