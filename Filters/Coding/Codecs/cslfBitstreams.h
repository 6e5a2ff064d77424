// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The bitstream of each codec.
 */
#ifndef cslfBitstreams_h
#define cslfBitstreams_h

#include "cslfCodec.h"

namespace cslf
{
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
