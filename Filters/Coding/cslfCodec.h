// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The video codecs that tracks are coded with, and what is the same about their data whatever
 * container they lie in.
 */
#ifndef cslfCodec_h
#define cslfCodec_h

#include "Coding/cslfAV.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
enum class Codec
{
  HEVC, ///< ITU-T H.265
  AV1,  ///< of the Alliance for Open Media
  H264  ///< ITU-T H.264
};

/// All of them, the default first.
const std::vector<Codec>& GetCodecs();

/// The names that files and users have for them, FFmpeg's: "hevc", "av1", "h264".
const char* NameOfCodec(Codec codec);
std::optional<Codec> CodecOfName(const std::string& name);

/// FFmpeg's number.
AVCodecID IDOfCodec(Codec codec);

/// FFmpeg's decoder of a codec, or null if this FFmpeg has none that works without hardware.
const AVCodec* FindDecoder(AVCodecID codec);

/// What the decoder configuration of a track says about its packets.
struct Framing
{
  /// H.264 and HEVC: bytes of each NAL unit's length prefix, 1 to 4; 0 for start codes (annex B).
  int LengthSize = 0;
  /// The CRC-32 of the parameter sets.
  std::uint32_t ParameterSetsCRC = 0;
  /// That of each one.
  std::vector<std::uint32_t> ParameterSetCRCs;

  bool HasParameterSet(std::uint32_t crc) const
  {
    return std::find(this->ParameterSetCRCs.begin(), this->ParameterSetCRCs.end(), crc) !=
      this->ParameterSetCRCs.end();
  }
};

/// How a codec's data are taken apart. Checksums are CRC-32 (zlib's) and leave out all that
/// containers may change.
class Bitstream
{
public:
  virtual ~Bitstream() = default;

  /// Reads a decoder configuration ("extradata"), in whichever form a container or an encoder has
  /// it. False if it is not this codec's, or cut short.
  virtual bool ReadConfiguration(
    const std::uint8_t* data, std::size_t size, Framing& framing) const = 0;

  /// Continues a CRC-32, begun as 0, with the coded picture data of a packet. False if the packet
  /// is not made of whole units, or has others than coded pictures, the track's parameter sets, and
  /// units that decoders skip: they could change what is decoded, and no checksum covers them.
  virtual bool AddToCRC(const std::uint8_t* data, std::size_t size, const Framing& framing,
    std::uint32_t& crc) const = 0;

  /// A packet as an encoder gives it, less all that a decoder does not need. Empty if the packet is
  /// not made of whole units.
  virtual std::vector<std::uint8_t> Trim(const std::uint8_t* data, std::size_t size) const = 0;

  /// The parameter sets that an encoder has given with its configuration or its first packet, in
  /// the form that containers' writers take.
  virtual std::vector<std::uint8_t> FindParameterSets(
    const std::vector<std::uint8_t>& configuration, const std::vector<std::uint8_t>& packet) const
  {
    (void)packet;
    return configuration;
  }
};

const Bitstream& GetBitstream(Codec codec);
}

#endif
