// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Damaged, truncated and foreign files: one clear line or a correct part, never a crash.
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"

#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <random>

namespace
{
void TestRefused(const std::string& fileName, const std::string& message)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  CSLF_CHECK(decoder->CanReadFile(fileName.c_str()) == 0);
  const cslf::testing::Observed observed(decoder);
  decoder->Update();
  CSLF_CHECK(decoder->GetErrorCode() != vtkErrorCode::NoError);
  CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
  CSLF_CHECK(std::string(decoder->GetDescription()).empty());
  if (!observed.HasError(message))
  {
    std::cerr << fileName << ": expected one error \"" << message << "\"\n";
    CSLF_CHECK(false);
  }
}

void TestNotOurs(const std::string& folder)
{
  TestRefused(folder + "/missing.mp4", "there is no such file");
  TestRefused(folder, "there is no such file");
  cslf::testing::WriteBytes(folder + "/text.mp4", std::vector<char>(5000, 'x'));
  TestRefused(folder + "/text.mp4", "not an MP4 or Matroska file");
  cslf::testing::WriteBytes(folder + "/empty.mp4", {});
  TestRefused(folder + "/empty.mp4", "not an MP4 or Matroska file");

  vtkNew<vtkCSLFDecoder> decoder;
  const cslf::testing::Observed observed(decoder);
  decoder->Update();
  CSLF_CHECK(observed.HasError("no file name"));
}

enum class Outcome
{
  Refused, // an error
  Partial, // a warning, and every slice is right or reported
  Whole    // no message, and every slice is right
};

/// Reads a damaged file and checks that its slices are right or reported.
Outcome Read(const std::string& fileName, vtkImageData* whole)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  const cslf::testing::Observed observed(decoder);
  decoder->Update();
  vtkImageData* output = decoder->GetOutput();
  if (observed.GetErrors() > 0)
  {
    CSLF_CHECK(observed.GetErrors() == 1);
    CSLF_CHECK(output->GetNumberOfPoints() == 0);
    return Outcome::Refused;
  }
  const vtkIdType missing = decoder->GetNumberOfMissingViewpoints();
  // Damage to one copy of the description is reported, but loses nothing.
  const int ofHeader = observed.CountWarnings("can be read, but one of the two copies");
  CSLF_CHECK(ofHeader <= 1 && observed.GetWarnings() - ofHeader == (missing > 0 ? 1 : 0));
  CSLF_CHECK(output->GetNumberOfPoints() == whole->GetNumberOfPoints());
  if (output->GetNumberOfPoints() != whole->GetNumberOfPoints())
  {
    return Outcome::Refused;
  }

  // Clear the slices in the reference that are reported as missing.
  vtkNew<vtkImageData> expected;
  expected->DeepCopy(whole);
  const vtkIdType texels = whole->GetNumberOfPoints() / (whole->GetExtent()[5] + 1);
  auto* color =
    vtkUnsignedCharArray::SafeDownCast(expected->GetPointData()->GetArray(cslf::ColorName));
  auto* depth =
    vtkUnsignedShortArray::SafeDownCast(expected->GetPointData()->GetArray(cslf::DepthName));
  for (vtkIdType k = 0; k < missing; ++k)
  {
    const vtkIdType first = texels * decoder->GetMissingViewpoints()->GetValue(k);
    std::fill_n(color->GetPointer(4 * first), 4 * texels, static_cast<unsigned char>(0));
    std::fill_n(depth->GetPointer(first), texels, static_cast<unsigned short>(65535));
  }
  CSLF_CHECK(cslf::testing::HasEqualSlices(output, expected));
  CSLF_CHECK(decoder->FindMissingViewpoints() == missing);
  return missing > 0 ? Outcome::Partial : Outcome::Whole;
}

/// One viewpoint by itself: right, or an error.
void ReadOne(const std::string& fileName, vtkIdType z, vtkImageData* whole)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  const cslf::testing::Observed observed(decoder);
  vtkNew<vtkImageData> image;
  if (decoder->GetViewpoint(z, image))
  {
    CSLF_CHECK(observed.GetErrors() == 0);
    CSLF_CHECK(cslf::testing::HasEqualSlices(image, whole));
  }
  else
  {
    CSLF_CHECK(observed.GetErrors() == 1);
    CSLF_CHECK(image->GetNumberOfPoints() == 0);
  }
}

/// The whole of a damaged file, pulled one viewpoint after the other as writers do: the results and
/// messages are the same as for the whole file.
void ReadInParts(const std::string& fileName)
{
  vtkNew<vtkCSLFDecoder> whole;
  whole->SetFileName(fileName.c_str());
  const cslf::testing::Observed observedWhole(whole);
  whole->Update();
  vtkNew<vtkCSLFDecoder> parts;
  parts->SetFileName(fileName.c_str());
  const cslf::testing::Observed observed(parts);
  int extent[6];
  whole->GetOutput()->GetExtent(extent);
  if (observedWhole.GetErrors() > 0)
  {
    parts->Update();
    CSLF_CHECK(observed.GetErrors() == 1);
    return;
  }
  vtkIdType missing = 0;
  for (int z = 0, last = extent[5]; z <= last; ++z)
  {
    extent[4] = extent[5] = z;
    CSLF_CHECK(parts->UpdateExtent(extent));
    CSLF_CHECK(cslf::testing::HasEqualSlices(parts->GetOutput(), whole->GetOutput()));
    missing += parts->GetNumberOfMissingViewpoints();
  }
  CSLF_CHECK(missing == whole->GetNumberOfMissingViewpoints());
  CSLF_CHECK(observed.GetErrors() == 0);
  CSLF_CHECK(observed.GetWarnings() == observedWhole.GetWarnings());
}

/// The number of times of each outcome.
struct Counts
{
  int Of[3] = { 0, 0, 0 };

  void Add(Outcome outcome) { ++this->Of[static_cast<int>(outcome)]; }
  void Print(const std::string& fileName, const char* damage) const
  {
    std::cout << fileName << " " << damage << ": " << this->Of[0] << " refused, " << this->Of[1]
              << " partial, " << this->Of[2] << " whole\n";
  }
};

/// Truncated to `count` different lengths, spread evenly.
void TestTruncated(const std::string& fileName, vtkImageData* whole, int count)
{
  const std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
  const std::string cut = fileName + ".cut.mp4";
  std::mt19937 random(11);
  Counts counts;
  for (int place = 0; place < count; ++place)
  {
    const std::size_t begin = bytes.size() * place / count;
    const std::size_t end = bytes.size() * (place + 1) / count;
    const auto size = static_cast<std::ptrdiff_t>(begin + random() % (end - begin));
    cslf::testing::WriteBytes(cut, { bytes.begin(), bytes.begin() + size });
    counts.Add(Read(cut, whole));
    ReadOne(cut, random() % (whole->GetExtent()[5] + 1), whole);
    if (place % 5 == 0)
    {
      ReadInParts(cut);
    }
  }
  counts.Print(fileName, "cut");
  // Matroska's index comes last, so nothing is lost if only it is cut.
  const int most = fileName.find(".mkv") != std::string::npos ? 1 : 0;
  CSLF_CHECK(counts.Of[0] > 0 && counts.Of[1] > 0 && counts.Of[2] <= most);
}

/// Any byte replaced by any other one.
void TestFlipped(const std::string& fileName, vtkImageData* whole, int count)
{
  const std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
  const std::string damaged = fileName + ".damaged.mp4";
  std::mt19937 random(7);
  Counts counts;
  for (int flip = 0; flip < count; ++flip)
  {
    std::vector<char> flipped = bytes;
    const std::size_t place = random() % flipped.size();
    flipped[place] = static_cast<char>(flipped[place] ^ (1 + random() % 255));
    cslf::testing::WriteBytes(damaged, flipped);
    counts.Add(Read(damaged, whole));
    ReadOne(damaged, random() % (whole->GetExtent()[5] + 1), whole);
  }
  counts.Print(fileName, "flipped");
  CSLF_CHECK(counts.Of[0] > 0 && counts.Of[1] > 0);
}

/// A changed digit of the description: the checksum detects it. In one of the two copies, nothing
/// is lost.
void TestDescription(const std::string& fileName, vtkImageData* whole)
{
  const std::string changed = fileName + ".digit.mp4";
  std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
  const std::string key = "\"center\":[0";
  auto found = bytes.begin();
  for (int copy = 0; copy < 2; ++copy)
  {
    found = std::search(found, bytes.end(), key.begin(), key.end());
    CSLF_CHECK(found != bytes.end());
    if (found == bytes.end())
    {
      return;
    }
    found += static_cast<std::ptrdiff_t>(key.size()) - 1;
    *found = '1';
    cslf::testing::WriteBytes(changed, bytes);
    CSLF_CHECK(copy == 1 || Read(changed, whole) == Outcome::Whole);
  }
  TestRefused(changed, "description is damaged");
}
}

int TestCSLFDecoderDamage(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "DecoderDamage");
  TestNotOurs(folder);
  const auto field = cslf::testing::MakeByteField(2, 16);
  struct Case
  {
    const char* Name;
    int Cuts;
    int Flips;
  };
  for (const Case& files : { Case{ "/field.mp4", 150, 1500 }, Case{ "/field.mkv", 50, 500 } })
  {
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetPreset("ultrafast");
    encoder->SetGroupLength(7);
    const std::string fileName = folder + files.Name;
    CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
    const auto whole = cslf::testing::Decode(fileName);
    CSLF_CHECK(whole != nullptr);
    if (whole)
    {
      CSLF_CHECK(Read(fileName, whole) == Outcome::Whole);
      TestTruncated(fileName, whole, files.Cuts);
      TestFlipped(fileName, whole, files.Flips);
      TestDescription(fileName, whole);
    }
  }
  return cslf::testing::Result();
}
