// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A part of an unfinished file.
#include "Coding/Writing/cslfGroupStore.h"
#include "cslfFuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::vector<std::uint8_t> bytes(data, data + size);
  std::uint32_t manifest = 0;
  cslf::CodedGroup part;
  if (cslf::ReadManifest(bytes, manifest) && cslf::UnpackGroup(bytes, manifest, part))
  {
    cslf::CodedGroup again;
    cslf::fuzzing::Require(cslf::UnpackGroup(cslf::PackGroup(part, manifest), manifest, again));
    cslf::fuzzing::Require(again.Frames.size() == part.Frames.size());
  }
  return 0;
}
