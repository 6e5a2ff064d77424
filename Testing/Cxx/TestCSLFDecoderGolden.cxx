// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files of every version, codec, pixel format and container that were ever written are read, with
// the texels that they had: Testing/Data/Golden/README.md.
#include "cslfDescription.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTestErrorObserver.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;

/// How far texels may be from what they were.
struct Tolerance
{
  double Most = 0.0; ///< of one number
  double RMS = 0.0;  ///< of all
};

/// All texels are as they were, but for what version 0.1 left to FFmpeg's scaler or rounded less
/// exactly: sparse chroma at edges of colour, 12 bits, and float arithmetic.
Tolerance GetTolerance(const std::string& pixelFormat, bool isFloat)
{
  const bool isSubsampled = pixelFormat.find("444") == std::string::npos && pixelFormat != "gbrp";
  if (isFloat)
  {
    return { 1e-4, 1e-5 };
  }
  return isSubsampled              ? Tolerance{ 12.0, 0.7 }
    : pixelFormat == "yuv444p12le" ? Tolerance{ 1.0, 0.35 }
                                   : Tolerance();
}

std::vector<unsigned char> ReadTexels(const fs::path& fileName)
{
  std::vector<unsigned char> bytes;
  gzFile file = gzopen(fileName.string().c_str(), "rb");
  unsigned char block[1 << 14];
  for (int count = 0; file && (count = gzread(file, block, sizeof(block))) > 0;)
  {
    bytes.insert(bytes.end(), block, block + count);
  }
  gzclose(file);
  return bytes;
}

/// Compares every so many slices of an array with the bytes from `place` on, and moves that.
void Compare(vtkDataArray* array, vtkIdType slice, const std::vector<unsigned char>& bytes,
  std::size_t& place, const Tolerance& tolerance)
{
  // The larger fields have a texel file of fewer slices.
  const vtkIdType step = slice < 5 * 64 * 64 ? 5 : 12;
  const auto kept = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  kept->SetNumberOfComponents(array->GetNumberOfComponents());
  kept->SetNumberOfTuples(slice);
  const auto size =
    static_cast<std::size_t>(slice) * kept->GetNumberOfComponents() * kept->GetDataTypeSize();
  double most = 0.0;
  double squares = 0.0;
  vtkIdType count = 0;
  for (vtkIdType first = 0; first < array->GetNumberOfTuples(); first += step * slice)
  {
    CSLF_CHECK(place + size <= bytes.size());
    if (place + size > bytes.size())
    {
      return;
    }
    std::memcpy(kept->GetVoidPointer(0), bytes.data() + place, size);
    place += size;
    for (vtkIdType texel = 0; texel < slice; ++texel)
    {
      for (int k = 0; k < kept->GetNumberOfComponents(); ++k, ++count)
      {
        const double error =
          std::abs(array->GetComponent(first + texel, k) - kept->GetComponent(texel, k));
        most = std::max(most, error);
        squares += error * error;
      }
    }
  }
  CSLF_CHECK_NEAR(most, 0.0, tolerance.Most);
  CSLF_CHECK_NEAR(std::sqrt(squares / static_cast<double>(count)), 0.0, tolerance.RMS);
}

void TestFile(const fs::path& fileName)
{
  vtkNew<vtkCSLFDecoder> decoder;
  vtkNew<vtkTest::ErrorObserver> observer;
  decoder->AddObserver(vtkCommand::ErrorEvent, observer);
  decoder->AddObserver(vtkCommand::WarningEvent, observer);
  decoder->SetFileName(fileName.string().c_str());
  decoder->Update();
  CSLF_CHECK(!observer->GetError() && !observer->GetWarning());
  CSLF_CHECK(decoder->FindMissingViewpoints() == 0);
  vtkPointData* data = decoder->GetOutput()->GetPointData();
  vtkDataArray* color = data->GetArray(cslf::ColorName);
  vtkDataArray* depth = data->GetArray(cslf::DepthName);
  CSLF_CHECK(color && depth);
  if (!color || !depth)
  {
    return;
  }
  const int* size = decoder->GetOutput()->GetDimensions();
  const vtkIdType slice = static_cast<vtkIdType>(size[0]) * size[1];
  const auto bytes = ReadTexels(fs::path(fileName).replace_extension(".texels.gz"));
  const bool isFloat = color->GetDataType() == VTK_FLOAT;
  std::size_t place = 0;
  Compare(color, slice, bytes, place, GetTolerance(decoder->GetPixelFormat(), isFloat));
  Compare(depth, slice, bytes, place, Tolerance());
  CSLF_CHECK(place == bytes.size());
}
}

int TestCSLFDecoderGolden(int, char*[])
{
  int files = 0;
  for (const auto& entry : fs::directory_iterator(CSLF_TEST_DATA "/Golden"))
  {
    const std::string extension = entry.path().extension().string();
    if (extension == ".mp4" || extension == ".mkv")
    {
      const int before = cslf::testing::Failures();
      TestFile(entry.path());
      ++files;
      if (cslf::testing::Failures() > before)
      {
        std::cerr << "in " << entry.path().filename() << "\n";
      }
    }
  }
  CSLF_CHECK(files >= 23);
  return cslf::testing::Result();
}
