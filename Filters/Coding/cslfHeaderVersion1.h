// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The header of files of version 1: a bare JSON text whose checksum is over a canonical form of it,
 * in the container's comment only.
 */
#ifndef cslfHeaderVersion1_h
#define cslfHeaderVersion1_h

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace cslf
{
/// The header as one of version 2 would be. `isOurs` tells whether the text was meant to be one. On
/// bad input returns nothing and says why, in one line; may throw what JSON's functions throw.
std::optional<nlohmann::json> ReadVersion1(
  const std::string& text, bool& isOurs, std::string& error);
}

#endif
