// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Old files of every version, codec, pixel format and container are read, with their original
// texels: Testing/Data/Golden/README.md.
#include "cslfDescription.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"

#include <vtkByteSwap.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTestErrorObserver.h>

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;

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

/// Whether depths are equal. If they are computed, a few may be rounded differently.
bool AreEqualDepths(const unsigned short* found, const unsigned short* expected, std::size_t count)
{
  std::size_t rounded = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const int difference = std::abs(found[k] - expected[k]);
    if (difference > 1)
    {
      return false;
    }
    rounded += difference;
  }
  return rounded <= count / 1000;
}

/// Compares regularly spaced slices of an array with the bytes from `place` on, and advances
/// `place`.
void Compare(vtkDataArray* array, vtkIdType slice, bool isComputed,
  const std::vector<unsigned char>& bytes, std::size_t& place)
{
  // The larger fields have a texel file of fewer slices.
  const vtkIdType step = slice < 5 * 64 * 64 ? 5 : 12;
  const int width = array->GetDataTypeSize();
  const std::size_t size = static_cast<std::size_t>(slice) * array->GetNumberOfComponents() * width;
  const auto* texels = static_cast<const unsigned char*>(array->GetVoidPointer(0));
  for (vtkIdType first = 0; first < array->GetNumberOfTuples(); first += step * slice)
  {
    CSLF_CHECK(place + size <= bytes.size());
    if (place + size > bytes.size())
    {
      return;
    }
    std::vector<unsigned char> expected(bytes.begin() + place, bytes.begin() + place + size);
    if (width == 2)
    {
      vtkByteSwap::Swap2LERange(expected.data(), size / 2);
    }
    else if (width == 4)
    {
      vtkByteSwap::Swap4LERange(expected.data(), size / 4);
    }
    const unsigned char* found = texels + size / slice * first;
    const bool isEqual = isComputed
      ? AreEqualDepths(reinterpret_cast<const unsigned short*>(found),
          reinterpret_cast<const unsigned short*>(expected.data()), size / 2)
      : std::equal(expected.begin(), expected.end(), found);
    CSLF_CHECK(isEqual);
    place += size;
  }
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
  std::size_t place = 0;
  Compare(color, slice, false, bytes, place);
  Compare(depth, slice, decoder->HasGeometry(), bytes, place);
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
  CSLF_CHECK(files >= 54);
  return cslf::testing::Result();
}
