// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A folder of cube maps: the first byte tells whether the others are its description or an image.
#include "cslfFuzzing.h"
#include "vtkCSLFImageReader.h"

#include <vtkImageData.h>
#include <vtkNew.h>

namespace
{
void Write(const std::string& file, const std::string& text)
{
  cslf::fuzzing::Folder::Get().Write(
    file, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

std::string Describe(const std::string& type, const std::string& encoding)
{
  return R"({"format":"cube surface light field","version":1,"base_nodes":2,"nodes":[0,1],)"
         R"("resolution":1,"center":[0,0,0],"edges":[2,2,2],"sampling":{},"slices":[0,0],)"
         R"("channels":[{"name":"Color","type":")" +
    type + R"(","components":4,"encoding":")" + encoding + R"("}]})";
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const cslf::fuzzing::Folder& folder = cslf::fuzzing::Folder::Get();
  const int kind = size > 0 ? data[0] % 3 : 0;
  size -= size > 0 ? 1 : 0;
  if (kind == 0)
  {
    folder.Write("description.json", data + 1, size);
  }
  else
  {
    const bool isFloat = kind == 2;
    folder.Write(isFloat ? "000000.Color.exr" : "000000.Color.png", data + 1, size);
    Write("description.json",
      isFloat ? Describe("float32", "linear-associated-alpha")
              : Describe("uint8", "srgb-associated-alpha"));
  }
  vtkNew<vtkCSLFImageReader> reader;
  reader->SetFileName(folder.GetName().c_str());
  reader->Update();
  reader->FindMissingViewpoints();
  return 0;
}
