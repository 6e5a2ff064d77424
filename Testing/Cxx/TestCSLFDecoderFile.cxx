// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A file that was coded long ago is still readable, and needs no encoder.
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <cmath>
#include <string>

int TestCSLFDecoderFile(int, char*[])
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(CSLF_TEST_DATA "/field.mp4");
  decoder->Update();
  CSLF_CHECK(std::string(decoder->GetCodecName()) == "hevc");
  CSLF_CHECK(std::string(decoder->GetPixelFormat()) == "yuv444p");
  CSLF_CHECK(decoder->GetNumberOfTracks() == 3);
  CSLF_CHECK(decoder->FindMissingViewpoints() == 0);

  std::string error;
  const auto description = cslf::Description::ReadFrom(decoder->GetOutput(), error);
  const cslf::Layout grid(2, 32);
  CSLF_CHECK(description && description->Grid == grid);
  if (!description)
  {
    return cslf::testing::Result();
  }
  const auto field = cslf::testing::MakeTestField(
    grid, cslf::Cube{ { 0, 0, 0 }, { 2, 2, 2 } }, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  const double mostErrors[] = { 12.0, 700.0 };
  const char* const names[] = { cslf::ColorName, cslf::DepthName };
  for (int channel = 0; channel < 2; ++channel)
  {
    vtkDataArray* found = decoder->GetOutput()->GetPointData()->GetArray(names[channel]);
    vtkDataArray* expected = field->GetPointData()->GetArray(names[channel]);
    vtkDataArray* colors = field->GetPointData()->GetArray(cslf::ColorName);
    double squares = 0.0;
    double count = 0.0;
    for (vtkIdType texel = 0; texel < expected->GetNumberOfTuples(); ++texel)
    {
      for (int k = 0; colors->GetComponent(texel, 3) > 0 && k < expected->GetNumberOfComponents();
           ++k)
      {
        squares += std::pow(found->GetComponent(texel, k) - expected->GetComponent(texel, k), 2);
        count += 1.0;
      }
    }
    CSLF_CHECK_NEAR(std::sqrt(squares / count), 0.0, mostErrors[channel]);
  }
  return cslf::testing::Result();
}
