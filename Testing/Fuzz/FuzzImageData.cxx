// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A field as VTK's image data in XML.
#include "Fields/cslfSceneChecks.h"
#include "cslfDescription.h"
#include "cslfFuzzing.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include <exception>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string name = cslf::fuzzing::Folder::Get().Write("input.vti", data, size);
  try
  {
    cslf::tool::CheckVTKXML(name);
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(name.c_str());
    reader->Update();
    std::string error;
    const auto field = cslf::Description::ReadFrom(reader->GetOutput(), error);
    cslf::fuzzing::Require(field || !error.empty());
  }
  catch (const std::exception&)
  {
    // The tool reports errors in one line.
  }
  return 0;
}
