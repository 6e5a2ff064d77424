// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The header of a coded file, as a tag and as JSON text.
#include "Coding/Containers/cslfFileHeader.h"
#include "cslfFuzzing.h"

namespace
{
void Read(const cslf::HeaderTags& tags)
{
  bool isOurs = false;
  std::string error;
  const auto header = cslf::FileHeader::FromTags(tags, isOurs, error);
  cslf::fuzzing::Require(header || !error.empty());
  if (header)
  {
    const auto again = cslf::FileHeader::FromTags(header->ToTags(), isOurs, error);
    cslf::fuzzing::Require(again && again->Slices == header->Slices);
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  Read({ { "comment", text } });
  Read({ { "comment", cslf::SealHeader(text) }, { "synopsis", text } });
  return 0;
}
