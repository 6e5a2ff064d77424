// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A coded file, MP4 or Matroska, all of it decoded.
#include "Coding/Reading/cslfFieldReader.h"
#include "cslfFuzzing.h"
#include "vtkCSLFDecoder.h"

#include <vtkImageData.h>
#include <vtkNew.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string name = cslf::fuzzing::Folder::Get().Write("input", data, size);
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(name.c_str());
  decoder->Update();
  const vtkIdType missing = decoder->GetNumberOfMissingViewpoints();
  cslf::fuzzing::Require(
    decoder->GetNumberOfTracks() == 0 || decoder->FindMissingViewpoints() >= missing);
  vtkNew<vtkImageData> image;
  decoder->GetViewpoint(0, image);
  decoder->GetTrackBytes(0);
  return 0;
}
