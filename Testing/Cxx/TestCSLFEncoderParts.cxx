// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A file's parts besides the light field are read back, also after FFmpeg has remuxed the file.
#include "cslfCodecTesting.h"
#include "cslfRemux.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <string>

namespace
{
vtkSmartPointer<vtkUnsignedCharArray> MakeBytes(vtkIdType count, int seed)
{
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetNumberOfValues(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    bytes->SetValue(k, static_cast<unsigned char>((k * k + seed) >> 3));
  }
  return bytes;
}

void CheckParts(const std::string& fileName)
{
  vtkNew<vtkCSLFDecoder> decoder;
  const cslf::testing::Observed observed(decoder);
  decoder->SetFileName(fileName.c_str());
  decoder->UpdateInformation();
  CSLF_CHECK(observed.GetErrors() == 0 && observed.GetWarnings() == 0);
  CSLF_CHECK(decoder->GetNumberOfParts() == 2);
  for (int part = 0; part < decoder->GetNumberOfParts(); ++part)
  {
    const auto expected = MakeBytes(part == 0 ? 2000000 : 7, part);
    vtkUnsignedCharArray* bytes = decoder->GetPart(part);
    CSLF_CHECK(std::string(decoder->GetPartType(part)) == (part == 0 ? "text/csv" : "text/plain"));
    CSLF_CHECK(std::string(decoder->GetPartName(part)) == (part == 0 ? "Größen" : ""));
    CSLF_CHECK(bytes->GetNumberOfValues() == expected->GetNumberOfValues());
    CSLF_CHECK(std::equal(bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues(),
      expected->GetPointer(0)));
  }
}

/// The array of a part stays as it is when others are requested, and when the decoder opens the
/// file again: views of its memory, such as those of NumPy, remain valid.
void CheckKept(const std::string& fileName)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  decoder->UpdateInformation();
  const vtkSmartPointer<vtkUnsignedCharArray> first = decoder->GetPart(1);
  const unsigned char* memory = first->GetPointer(0);
  const vtkMTimeType time = first->GetMTime();
  const auto isSame = [&]
  {
    const auto expected = MakeBytes(7, 1);
    return first->GetNumberOfValues() == 7 && first->GetPointer(0) == memory &&
      first->GetMTime() == time && std::equal(memory, memory + 7, expected->GetPointer(0));
  };
  CSLF_CHECK(decoder->GetPart(0) != first && decoder->GetPart(0)->GetNumberOfValues() == 2000000);
  CSLF_CHECK(isSame());
  CSLF_CHECK(decoder->GetPart(1) == first);
  decoder->Modified();
  decoder->UpdateInformation();
  CSLF_CHECK(decoder->GetPart(0)->GetNumberOfValues() == 2000000);
  CSLF_CHECK(decoder->GetPart(1)->GetNumberOfValues() == 7);
  CSLF_CHECK(isSame());
}

void CheckRefused(vtkCSLFEncoder* encoder, const char* type, vtkUnsignedCharArray* bytes,
  const char* name, const char* message)
{
  const cslf::testing::Observed observed(encoder);
  const int parts = encoder->GetNumberOfParts();
  CSLF_CHECK(!encoder->AddPart(type, bytes, name));
  CSLF_CHECK(observed.HasError(message));
  CSLF_CHECK(encoder->GetNumberOfParts() == parts);
}
}

int TestCSLFEncoderParts(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderParts");
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  CSLF_CHECK(encoder->AddPart("a/b", MakeBytes(3, 0)));
  encoder->RemoveAllParts();
  CSLF_CHECK(encoder->AddPart("text/csv", MakeBytes(2000000, 0), "Größen"));
  CSLF_CHECK(encoder->AddPart("text/plain", MakeBytes(7, 1)));
  CheckRefused(encoder, nullptr, MakeBytes(3, 0), "", "needs a type");
  CheckRefused(encoder, "text\n", MakeBytes(3, 0), "", "control characters");
  CheckRefused(encoder, "text", MakeBytes(3, 0), "\xff", "UTF-8");
  CheckRefused(encoder, "text", MakeBytes(3, 0), std::string(101, 'a').c_str(), "at most 100");
  CheckRefused(encoder, "text", MakeBytes(11000000, 0), "", "12 MiB");
  CheckRefused(encoder, "text/plain", MakeBytes(7, 1), "", "same type and name");
  CheckRefused(encoder, "model/vnd.cslf.geometry", MakeBytes(7, 1), "other", "input port 1");

  const auto field = cslf::testing::MakeByteField(2, 16);
  CSLF_CHECK(cslf::testing::Encode(encoder, field, folder + "/a.mp4"));
  CheckKept(folder + "/a.mp4");
  CheckParts(folder + "/a.mp4");
  CSLF_CHECK(cslf::testing::Encode(encoder, field, folder + "/b.mkv"));
  CheckParts(folder + "/b.mkv");
  const char* const copies[][2] = { { "/a.mp4", "/c.mkv" }, { "/c.mkv", "/d.mp4" },
    { "/b.mkv", "/e.mp4" }, { "/e.mp4", "/f.mkv" } };
  for (const auto& copy : copies)
  {
    CSLF_CHECK(cslf::testing::Remux(folder + copy[0], folder + copy[1]));
    CheckParts(folder + copy[1]);
  }
  return cslf::testing::Result();
}
