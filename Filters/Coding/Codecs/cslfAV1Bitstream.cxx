// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBitstreams.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
namespace
{
/// The types of units that are used here (AV1 bitstream specification, section 6.2.2).
enum UnitType
{
  SequenceHeader = 1,
  TemporalDelimiter = 2,
  FrameHeader = 3,
  TileGroup = 4,
  Metadata = 5,
  Frame = 6,
  Padding = 15
};

/// A unit in memory.
struct Unit
{
  int Type = 0;
  const std::uint8_t* Data = nullptr; ///< with its header
  std::size_t Size = 0;
  const std::uint8_t* Payload = nullptr;
  std::size_t PayloadSize = 0;

  bool IsPicture() const
  {
    return this->Type == FrameHeader || this->Type == TileGroup || this->Type == Frame;
  }
  std::uint32_t AddTo(std::uint32_t crc) const
  {
    return static_cast<std::uint32_t>(
      ::crc32(crc, this->Payload, static_cast<uInt>(this->PayloadSize)));
  }
};

/// Reads a number of up to 8 bytes with 7 bits each (leb128) and moves `position` behind it.
bool ReadSize(
  const std::uint8_t* data, std::size_t size, std::size_t& position, std::size_t& number)
{
  number = 0;
  for (int k = 0; k < 8 && position < size; ++k)
  {
    const std::uint8_t byte = data[position++];
    number |= static_cast<std::size_t>(byte & 0x7f) << (7 * k);
    if ((byte & 0x80) == 0)
    {
      return true;
    }
  }
  return false;
}

template <typename Visit>
bool VisitUnits(const std::uint8_t* data, std::size_t size, Visit visit)
{
  constexpr int forbidden = 0x80;
  constexpr int hasExtension = 0x04;
  constexpr int hasSize = 0x02;
  std::size_t position = 0;
  while (position < size)
  {
    const std::size_t start = position;
    const std::uint8_t header = data[position];
    position += (header & hasExtension) != 0 ? 2 : 1;
    if ((header & forbidden) != 0 || position > size)
    {
      return false;
    }
    std::size_t payload = size - position;
    if ((header & hasSize) != 0 && !ReadSize(data, size, position, payload))
    {
      return false;
    }
    if (payload > size - position)
    {
      return false;
    }
    const int type = (header >> 3) & 0x0f;
    visit(Unit{ type, data + start, position + payload - start, data + position, payload });
    position += payload;
  }
  return true;
}

/// How metadata for CSLF begin: those of ITU-T T.35, with a code of no country and of no extension
/// (sections 6.7.1 and 6.7.2). FFmpeg's filters know no private metadata.
constexpr std::array<std::uint8_t, 3> MetadataStart = { 4, 0xff, 0xff };

/// The first byte of a unit of metadata that states its size.
constexpr std::uint8_t MetadataHeader = Metadata << 3 | 2;

/// What a unit carries for CSLF. False if it is another one.
bool FindBytes(const Unit& unit, std::size_t& begin, std::size_t& end)
{
  begin = MetadataStart.size() + CarrierMark.size();
  return unit.Type == Metadata && unit.PayloadSize > begin &&
    std::equal(MetadataStart.begin(), MetadataStart.end(), unit.Payload) &&
    FindCarried(unit.Payload, unit.PayloadSize, MetadataStart.size(), end);
}

class AV1Bitstream : public Bitstream
{
public:
  bool ReadConfiguration(
    const std::uint8_t* data, std::size_t size, Framing& framing) const override;
  bool AddToCRC(const std::uint8_t* data, std::size_t size, const Framing& framing,
    std::uint32_t& crc) const override;
  std::vector<std::uint8_t> Trim(const std::uint8_t* data, std::size_t size) const override;
  std::vector<std::uint8_t> Load(const std::vector<std::uint8_t>& packet,
    const std::vector<unsigned char>& bytes) const override;
  std::vector<unsigned char> Unload(
    const std::uint8_t* data, std::size_t size, const Framing& framing) const override;

  /// The sequence header, which the first packet of each group contains.
  std::vector<std::uint8_t> FindParameterSets(const std::vector<std::uint8_t>& configuration,
    const std::vector<std::uint8_t>& packet) const override;
};

bool AV1Bitstream::ReadConfiguration(
  const std::uint8_t* data, std::size_t size, Framing& framing) const
{
  // An AV1CodecConfigurationRecord has four bytes before its units; the first is a marker.
  constexpr std::size_t recordHeaderSize = 4;
  constexpr std::uint8_t recordMarker = 0x81;
  framing = {};
  if (size > recordHeaderSize && data[0] == recordMarker)
  {
    data += recordHeaderSize;
    size -= recordHeaderSize;
  }
  int found = 0;
  const auto add = [&](const Unit& unit)
  {
    if (unit.Type == SequenceHeader)
    {
      framing.ParameterSetsCRC = unit.AddTo(0);
      framing.ParameterSetCRCs.push_back(framing.ParameterSetsCRC);
      ++found;
    }
  };
  return VisitUnits(data, size, add) && found == 1;
}

bool AV1Bitstream::AddToCRC(
  const std::uint8_t* data, std::size_t size, const Framing& framing, std::uint32_t& crc) const
{
  bool isOfTrack = true;
  std::size_t begin = 0;
  std::size_t end = 0;
  const auto add = [&](const Unit& unit)
  {
    if (unit.IsPicture())
    {
      crc = unit.AddTo(crc);
    }
    else
    {
      isOfTrack = isOfTrack &&
        (unit.Type == TemporalDelimiter || unit.Type == Padding ||
          (unit.Type == SequenceHeader && framing.HasParameterSet(unit.AddTo(0))) ||
          FindBytes(unit, begin, end));
    }
  };
  return VisitUnits(data, size, add) && isOfTrack;
}

std::vector<std::uint8_t> AV1Bitstream::Trim(const std::uint8_t* data, std::size_t size) const
{
  std::vector<std::uint8_t> needed;
  needed.reserve(size);
  const auto add = [&](const Unit& unit)
  {
    if (unit.Type == SequenceHeader || unit.IsPicture())
    {
      needed.insert(needed.end(), unit.Data, unit.Data + unit.Size);
    }
  };
  return VisitUnits(data, size, add) ? needed : std::vector<std::uint8_t>();
}

std::vector<std::uint8_t> AV1Bitstream::Load(
  const std::vector<std::uint8_t>& packet, const std::vector<unsigned char>& bytes) const
{
  std::vector<std::uint8_t> payload(MetadataStart.begin(), MetadataStart.end());
  payload.insert(payload.end(), CarrierMark.begin(), CarrierMark.end());
  payload.insert(payload.end(), bytes.begin(), bytes.end());
  payload.push_back(TrailingBit);
  std::vector<std::uint8_t> unit = { MetadataHeader };
  std::size_t size = payload.size();
  for (; size > 0x7f; size >>= 7)
  {
    unit.push_back(static_cast<std::uint8_t>(0x80 | (size & 0x7f)));
  }
  unit.push_back(static_cast<std::uint8_t>(size));
  unit.insert(unit.end(), payload.begin(), payload.end());
  // After the sequence header, with which the first packet of a group begins.
  const std::size_t start = this->FindParameterSets({}, packet).size();
  std::vector<std::uint8_t> loaded = packet;
  loaded.insert(loaded.begin() + static_cast<std::ptrdiff_t>(start), unit.begin(), unit.end());
  return loaded;
}

std::vector<unsigned char> AV1Bitstream::Unload(
  const std::uint8_t* data, std::size_t size, const Framing&) const
{
  std::vector<unsigned char> bytes;
  const auto take = [&](const Unit& unit)
  {
    std::size_t begin = 0;
    std::size_t end = 0;
    if (FindBytes(unit, begin, end))
    {
      bytes.insert(bytes.end(), unit.Payload + begin, unit.Payload + end);
    }
  };
  return VisitUnits(data, size, take) ? bytes : std::vector<unsigned char>();
}

std::vector<std::uint8_t> AV1Bitstream::FindParameterSets(
  const std::vector<std::uint8_t>&, const std::vector<std::uint8_t>& packet) const
{
  std::vector<std::uint8_t> header;
  const auto take = [&](const Unit& unit)
  {
    if (unit.Type == SequenceHeader && header.empty())
    {
      header.assign(unit.Data, unit.Data + unit.Size);
    }
  };
  VisitUnits(packet.data(), packet.size(), take);
  return header;
}
}

const Bitstream& GetAV1Bitstream()
{
  static const AV1Bitstream bitstream;
  return bitstream;
}
}
