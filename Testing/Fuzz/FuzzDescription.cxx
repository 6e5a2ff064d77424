// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The description of a field, as stored in field data.
#include "cslfDescription.h"
#include "cslfFuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::string error;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto description = cslf::Description::FromText(text, error);
  cslf::fuzzing::Require(description || !error.empty());
  if (description)
  {
    // A description that was read can be written, and read again as the same.
    const auto again = cslf::Description::FromText(description->ToText(), error);
    cslf::fuzzing::Require(again && again->ToText() == description->ToText());
  }
  return 0;
}
