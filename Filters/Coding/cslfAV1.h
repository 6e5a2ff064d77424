// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * AV1's data: open bitstream units (AV1 bitstream specification, section 5.3). Containers may
 * change whether a unit tells its size, and leave out temporal delimiters, padding and repeated
 * sequence headers, so checksums are over the payloads of the other units alone.
 */
#ifndef cslfAV1_h
#define cslfAV1_h

#include "Coding/cslfCodec.h"

namespace cslf
{
class AV1Bitstream : public Bitstream
{
public:
  bool ReadConfiguration(
    const std::uint8_t* data, std::size_t size, Framing& framing) const override;
  bool AddToCRC(const std::uint8_t* data, std::size_t size, const Framing& framing,
    std::uint32_t& crc) const override;
  std::vector<std::uint8_t> Trim(const std::uint8_t* data, std::size_t size) const override;

  /// The sequence header, which every group's first packet holds.
  std::vector<std::uint8_t> FindParameterSets(const std::vector<std::uint8_t>& configuration,
    const std::vector<std::uint8_t>& packet) const override;
};
}

#endif
