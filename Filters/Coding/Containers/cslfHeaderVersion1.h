// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The header of files of version 1: a bare JSON text whose checksum is over a canonical form of it,
 * in the container's comment only.
 */
#ifndef cslfHeaderVersion1_h
#define cslfHeaderVersion1_h

#include "cslfJSONForward.h"

#include <optional>
#include <string>

namespace cslf
{
/// Converts the header to version 2. `isOurs` tells whether the text was meant to be a header. On
/// bad input returns nothing and gives the reason in one line. May throw what JSON's functions
/// throw.
std::optional<nlohmann::json> ReadVersion1(
  const std::string& text, bool& isOurs, std::string& error);
}

#endif
