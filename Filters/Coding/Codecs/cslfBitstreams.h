// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The bitstream of each codec.
 */
#ifndef cslfBitstreams_h
#define cslfBitstreams_h

#include "cslfCodec.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cslf
{
/// Marks units with bytes for CSLF among those of other programs: a UUID (RFC 4122, version 4).
constexpr std::array<std::uint8_t, 16> CarrierMark = { 0x0d, 0x5f, 0x9a, 0x6e, 0x5b, 0x1c, 0x4e,
  0x27, 0x9c, 0x83, 0x6a, 0x1f, 0xd2, 0x40, 0xb7, 0x35 };

/// Ends the contents of units, before zeros.
constexpr std::uint8_t TrailingBit = 0x80;

/// Whether there is a mark at a place of a unit. Then finds the end of the bytes after it.
bool FindCarried(const std::uint8_t* data, std::size_t size, std::size_t place, std::size_t& end);

/// HEVC: NAL units (ITU-T H.265).
const Bitstream& GetHEVCBitstream();

/// H.264: NAL units (ITU-T H.264).
const Bitstream& GetH264Bitstream();

/// AV1: open bitstream units (AV1 bitstream specification, section 5.3). Containers may change
/// whether a unit states its size, and may drop temporal delimiters, padding and repeated sequence
/// headers. So checksums cover only the payloads of the other units.
const Bitstream& GetAV1Bitstream();
}

#endif
