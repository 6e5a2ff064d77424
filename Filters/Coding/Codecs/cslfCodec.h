// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The video codecs of tracks, and the properties of their data that do not depend on the container.
 */
#ifndef cslfCodec_h
#define cslfCodec_h

#include "cslfAV.h"

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

/// The names in files and options, which are FFmpeg's: "hevc", "av1", "h264".
const char* NameOfCodec(Codec codec);
std::optional<Codec> CodecOfName(const std::string& name);

/// FFmpeg's number of a codec.
AVCodecID IDOfCodec(Codec codec);

/// FFmpeg's decoder of a codec, or null if this FFmpeg has none that works without hardware.
const AVCodec* FindDecoder(AVCodecID codec);

/// The information about packets in the decoder configuration of a track.
struct Framing
{
  /// H.264 and HEVC: bytes of each NAL unit's length prefix, 1 to 4; 0 for start codes (annex B).
  int LengthSize = 0;
  /// The CRC-32 of the parameter sets.
  std::uint32_t ParameterSetsCRC = 0;
  /// The CRC-32 of each parameter set.
  std::vector<std::uint32_t> ParameterSetCRCs;

  bool HasParameterSet(std::uint32_t crc) const
  {
    return std::find(this->ParameterSetCRCs.begin(), this->ParameterSetCRCs.end(), crc) !=
      this->ParameterSetCRCs.end();
  }
};

/// Parses a codec's data. Checksums are CRC-32 (zlib's) and leave out everything that containers
/// may change.
class Bitstream
{
public:
  virtual ~Bitstream() = default;

  /// Reads a decoder configuration ("extradata"), in the form of any container or encoder. False if
  /// it belongs to another codec or is truncated.
  virtual bool ReadConfiguration(
    const std::uint8_t* data, std::size_t size, Framing& framing) const = 0;

  /// Continues a CRC-32, begun as 0, with the coded picture data of a packet. False if the packet
  /// has incomplete units, or units other than coded pictures, the track's parameter sets, units
  /// that carry bytes for CSLF and units that decoders skip. Others could change the decoded
  /// picture, and no checksum covers them.
  virtual bool AddToCRC(const std::uint8_t* data, std::size_t size, const Framing& framing,
    std::uint32_t& crc) const = 0;

  /// A packet of an encoder without the units that decoders do not need. Empty if the packet has
  /// incomplete units.
  virtual std::vector<std::uint8_t> Trim(const std::uint8_t* data, std::size_t size) const = 0;

  /// An encoder's packet, after Trim, with a unit that carries bytes and that decoders ignore.
  virtual std::vector<std::uint8_t> Load(
    const std::vector<std::uint8_t>& packet, const std::vector<unsigned char>& bytes) const = 0;

  /// The bytes that the units of a packet carry. None if the packet has incomplete units.
  virtual std::vector<unsigned char> Unload(
    const std::uint8_t* data, std::size_t size, const Framing& framing) const = 0;

  /// The parameter sets in an encoder's configuration or first packet, in the form for writers of
  /// containers.
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
