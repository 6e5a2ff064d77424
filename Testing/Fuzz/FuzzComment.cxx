// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The comment of a coded file.
#include "Coding/cslfFileHeader.h"
#include "cslfFuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  bool isOurs = false;
  std::string error;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto header = cslf::FileHeader::FromText(text, isOurs, error);
  cslf::fuzzing::Require(header || !error.empty());
  if (header)
  {
    const auto again = cslf::FileHeader::FromText(header->ToText(), isOurs, error);
    cslf::fuzzing::Require(again && again->Slices == header->Slices);
  }
  return 0;
}
