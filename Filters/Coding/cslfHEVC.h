// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checksums of HEVC data that stay the same whatever container it lies in: CRC-32 (zlib's) over the
 * bytes of NAL units (ITU-T H.265, section 7.3.1), without start codes or length prefixes.
 */
#ifndef cslfHEVC_h
#define cslfHEVC_h

#include <cstddef>
#include <cstdint>

namespace cslf
{
/// How NAL units are told apart.
struct NALFraming
{
  /// Bytes of each length prefix, 1 to 4, as in MP4 and Matroska; 0 for start codes (annex B).
  int LengthSize = 0;
};

/// The framing that a track's extradata calls for; false if the extradata is not HEVC's.
bool FindFraming(const std::uint8_t* extradata, std::size_t size, NALFraming& framing);

/// Continues a CRC-32, begun as 0, with the coded slices (NAL unit types below 32) of a packet.
/// False if the packet is not made of whole NAL units.
bool AddSlicesToCRC(
  const std::uint8_t* data, std::size_t size, const NALFraming& framing, std::uint32_t& crc);

/// The CRC-32 of the video, sequence and picture parameter sets of a track's extradata, annex B or
/// decoder configuration record (ISO/IEC 14496-15). False if there are none or they are cut short.
bool ComputeParameterSetsCRC(const std::uint8_t* extradata, std::size_t size, std::uint32_t& crc);
}

#endif
