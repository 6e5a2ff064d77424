// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBitstreams.h"
#include "cslfCodec.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <functional>

namespace cslf
{
bool FindCarried(const std::uint8_t* data, std::size_t size, std::size_t place, std::size_t& end)
{
  end = size;
  while (end > place && data[end - 1] == 0)
  {
    --end;
  }
  if (end < place + CarrierMark.size() + 1 || data[end - 1] != TrailingBit ||
    !std::equal(CarrierMark.begin(), CarrierMark.end(), data + place))
  {
    return false;
  }
  --end;
  return true;
}

namespace
{
// What H.264 and HEVC have in common: their data are NAL units (ITU-T H.264 and H.265, section
// 7.3.1). Checksums are over these units, without start codes or length prefixes.

/// A NAL unit in memory, with its header.
struct NALUnit
{
  const std::uint8_t* Data = nullptr;
  std::size_t Size = 0;
};

/// How units and the decoder configuration records (ISO/IEC 14496-15) of a codec begin.
struct NALSyntax
{
  std::size_t HeaderSize = 1; ///< of units, in bytes
  ///@{
  /// The byte of a unit that contains its type.
  int TypeShift = 0;
  int TypeMask = 0;
  ///@}
  ///@{
  /// The types of units with coded picture data.
  int FirstSlice = 0;
  int LastSlice = 0;
  ///@}
  ///@{
  /// The types of parameter sets, all of which a configuration has.
  int FirstParameterSet = 0;
  int LastParameterSet = 0;
  ///@}
  ///@{
  /// The types of units that decoders skip.
  int Delimiter = 0; ///< of access units
  int Filler = 0;
  ///@}
  std::vector<std::uint8_t> Supplement; ///< the header of supplemental enhancement information
  std::size_t MinimumRecordSize = 0;
  std::size_t RecordLengthSizeOffset = 0; ///< of the byte with the size of length prefixes
};

class NALBitstream : public Bitstream
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

protected:
  using Visitor = std::function<void(const NALUnit&)>;

  explicit NALBitstream(const NALSyntax& syntax)
    : Syntax(syntax)
  {
  }

  /// Visits the units of a record of at least the minimum size. False if it is truncated.
  virtual bool VisitRecord(
    const std::uint8_t* data, std::size_t size, const Visitor& visit) const = 0;

  /// Visits `count` units, each after its size in two bytes, and moves `position` behind them.
  /// Records consist of such arrays.
  bool VisitArray(const std::uint8_t* data, std::size_t size, std::size_t count,
    std::size_t& position, const Visitor& visit) const;

private:
  int GetType(const NALUnit& unit) const;
  bool IsSlice(const NALUnit& unit) const;
  bool IsParameterSet(const NALUnit& unit) const;
  bool IsSkipped(const NALUnit& unit) const;

  /// Appends what a unit carries for CSLF. False if it is another one.
  bool Take(const NALUnit& unit, std::vector<unsigned char>& bytes) const;

  /// Visits all units of a packet. False if some are incomplete.
  bool VisitPacket(
    const std::uint8_t* data, std::size_t size, const Framing& framing, const Visitor& visit) const;

  /// Visits the unit after its size at `position`, and moves `position` behind it.
  bool VisitUnit(const std::uint8_t* data, std::size_t size, int lengthSize, std::size_t& position,
    const Visitor& visit) const;
  bool VisitPrefixed(
    const std::uint8_t* data, std::size_t size, int lengthSize, const Visitor& visit) const;
  bool VisitStartCoded(const std::uint8_t* data, std::size_t size, const Visitor& visit) const;

  NALSyntax Syntax;
};

/// A big-endian number.
std::size_t ReadNumber(const std::uint8_t* data, int bytes)
{
  std::size_t number = 0;
  for (int k = 0; k < bytes; ++k)
  {
    number = number << 8 | data[k];
  }
  return number;
}

/// The offset of the next start code, 00 00 01, or `size`.
std::size_t FindStartCode(const std::uint8_t* data, std::size_t size, std::size_t from)
{
  for (std::size_t k = from; k + 3 <= size; ++k)
  {
    if (data[k] == 0 && data[k + 1] == 0 && data[k + 2] == 1)
    {
      return k;
    }
  }
  return size;
}

std::uint32_t AddTo(std::uint32_t crc, const NALUnit& unit)
{
  return static_cast<std::uint32_t>(::crc32(crc, unit.Data, static_cast<uInt>(unit.Size)));
}

int NALBitstream::GetType(const NALUnit& unit) const
{
  return unit.Data[0] >> this->Syntax.TypeShift & this->Syntax.TypeMask;
}

bool NALBitstream::IsSlice(const NALUnit& unit) const
{
  const int type = this->GetType(unit);
  return type >= this->Syntax.FirstSlice && type <= this->Syntax.LastSlice;
}

bool NALBitstream::IsParameterSet(const NALUnit& unit) const
{
  const int type = this->GetType(unit);
  return type >= this->Syntax.FirstParameterSet && type <= this->Syntax.LastParameterSet;
}

bool NALBitstream::IsSkipped(const NALUnit& unit) const
{
  const int type = this->GetType(unit);
  return type == this->Syntax.Delimiter || type == this->Syntax.Filler;
}

bool NALBitstream::VisitUnit(const std::uint8_t* data, std::size_t size, int lengthSize,
  std::size_t& position, const Visitor& visit) const
{
  if (size - position < static_cast<std::size_t>(lengthSize))
  {
    return false;
  }
  const std::size_t length = ReadNumber(data + position, lengthSize);
  position += lengthSize;
  if (length < this->Syntax.HeaderSize || length > size - position)
  {
    return false;
  }
  visit({ data + position, length });
  position += length;
  return true;
}

bool NALBitstream::VisitPrefixed(
  const std::uint8_t* data, std::size_t size, int lengthSize, const Visitor& visit) const
{
  std::size_t position = 0;
  while (position < size)
  {
    if (!this->VisitUnit(data, size, lengthSize, position, visit))
    {
      return false;
    }
  }
  return true;
}

bool NALBitstream::VisitStartCoded(
  const std::uint8_t* data, std::size_t size, const Visitor& visit) const
{
  std::size_t start = FindStartCode(data, size, 0);
  while (start < size)
  {
    start += 3;
    const std::size_t next = FindStartCode(data, size, start);
    // Zeros before a start code belong to it: no NAL unit ends with a zero.
    std::size_t end = next;
    while (end > start && data[end - 1] == 0)
    {
      --end;
    }
    if (end - start < this->Syntax.HeaderSize)
    {
      return false;
    }
    visit({ data + start, end - start });
    start = next;
  }
  return true;
}

bool NALBitstream::VisitArray(const std::uint8_t* data, std::size_t size, std::size_t count,
  std::size_t& position, const Visitor& visit) const
{
  constexpr int lengthSize = 2;
  for (std::size_t k = 0; k < count; ++k)
  {
    if (!this->VisitUnit(data, size, lengthSize, position, visit))
    {
      return false;
    }
  }
  return true;
}

bool NALBitstream::ReadConfiguration(
  const std::uint8_t* data, std::size_t size, Framing& framing) const
{
  framing = {};
  int found = 0;
  const auto add = [&](const NALUnit& unit)
  {
    if (this->IsParameterSet(unit))
    {
      found |= 1 << (this->GetType(unit) - this->Syntax.FirstParameterSet);
      framing.ParameterSetsCRC = AddTo(framing.ParameterSetsCRC, unit);
      framing.ParameterSetCRCs.push_back(AddTo(0, unit));
    }
  };
  const bool isRecord = size >= this->Syntax.MinimumRecordSize && data[0] == 1;
  if (!isRecord && !(size > 3 && data[0] == 0 && data[1] == 0))
  {
    return false;
  }
  framing.LengthSize = isRecord ? (data[this->Syntax.RecordLengthSizeOffset] & 3) + 1 : 0;
  const bool isWhole =
    isRecord ? this->VisitRecord(data, size, add) : this->VisitStartCoded(data, size, add);
  const int all = (1 << (this->Syntax.LastParameterSet - this->Syntax.FirstParameterSet + 1)) - 1;
  return isWhole && found == all;
}

bool NALBitstream::AddToCRC(
  const std::uint8_t* data, std::size_t size, const Framing& framing, std::uint32_t& crc) const
{
  bool isOfTrack = true;
  std::vector<unsigned char> ignored;
  const auto add = [&](const NALUnit& unit)
  {
    if (this->IsSlice(unit))
    {
      crc = AddTo(crc, unit);
    }
    else
    {
      isOfTrack = isOfTrack &&
        (this->IsSkipped(unit) ||
          (this->IsParameterSet(unit) && framing.HasParameterSet(AddTo(0, unit))) ||
          this->Take(unit, ignored));
    }
  };
  return this->VisitPacket(data, size, framing, add) && isOfTrack;
}

bool NALBitstream::VisitPacket(
  const std::uint8_t* data, std::size_t size, const Framing& framing, const Visitor& visit) const
{
  return framing.LengthSize == 0 ? this->VisitStartCoded(data, size, visit)
                                 : this->VisitPrefixed(data, size, framing.LengthSize, visit);
}

/// The type of a message whose meaning is private: user_data_unregistered (ITU-T H.265, section
/// D.2.7; H.264, section D.1.7).
constexpr std::uint8_t PrivateMessage = 5;

/// A byte of a message's size that says that another one follows.
constexpr std::uint8_t MoreSize = 255;

std::vector<std::uint8_t> NALBitstream::Load(
  const std::vector<std::uint8_t>& packet, const std::vector<unsigned char>& bytes) const
{
  std::vector<std::uint8_t> message = { PrivateMessage };
  const std::size_t size = CarrierMark.size() + bytes.size();
  message.insert(message.end(), size / MoreSize, MoreSize);
  message.push_back(static_cast<std::uint8_t>(size % MoreSize));
  message.insert(message.end(), CarrierMark.begin(), CarrierMark.end());
  message.insert(message.end(), bytes.begin(), bytes.end());
  message.push_back(TrailingBit);
  std::vector<std::uint8_t> loaded = { 0, 0, 0, 1 };
  loaded.insert(loaded.end(), this->Syntax.Supplement.begin(), this->Syntax.Supplement.end());
  int zeros = 0;
  for (const std::uint8_t byte : message)
  {
    // Two zeros are followed by a 3 where a start code might begin (section 7.4.2; H.264, 7.4.1).
    if (zeros >= 2 && byte <= 3)
    {
      loaded.push_back(3);
      zeros = 0;
    }
    loaded.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
  loaded.insert(loaded.end(), packet.begin(), packet.end());
  return loaded;
}

bool NALBitstream::Take(const NALUnit& unit, std::vector<unsigned char>& bytes) const
{
  const std::vector<std::uint8_t>& header = this->Syntax.Supplement;
  if (unit.Size < header.size() || !std::equal(header.begin(), header.end(), unit.Data))
  {
    return false;
  }
  std::vector<std::uint8_t> message;
  message.reserve(unit.Size);
  int zeros = 0;
  for (std::size_t k = header.size(); k < unit.Size; ++k)
  {
    const std::uint8_t byte = unit.Data[k];
    if (zeros >= 2 && byte == 3)
    {
      zeros = 0;
      continue;
    }
    message.push_back(byte);
    zeros = byte == 0 ? zeros + 1 : 0;
  }
  std::size_t place = 1;
  std::size_t size = 0;
  while (place < message.size() && message[place] == MoreSize)
  {
    size += message[place++];
  }
  if (message.empty() || message[0] != PrivateMessage || place == message.size())
  {
    return false;
  }
  size += message[place++];
  std::size_t end = 0;
  // There is nothing else in the unit.
  if (!FindCarried(message.data(), message.size(), place, end) || end - place != size)
  {
    return false;
  }
  const auto begin = message.begin();
  bytes.insert(bytes.end(), begin + static_cast<std::ptrdiff_t>(place + CarrierMark.size()),
    begin + static_cast<std::ptrdiff_t>(end));
  return true;
}

std::vector<unsigned char> NALBitstream::Unload(
  const std::uint8_t* data, std::size_t size, const Framing& framing) const
{
  std::vector<unsigned char> bytes;
  const auto take = [&](const NALUnit& unit) { this->Take(unit, bytes); };
  return this->VisitPacket(data, size, framing, take) ? bytes : std::vector<unsigned char>();
}

std::vector<std::uint8_t> NALBitstream::Trim(const std::uint8_t* data, std::size_t size) const
{
  std::vector<std::uint8_t> slices;
  slices.reserve(size);
  const auto add = [&](const NALUnit& unit)
  {
    if (this->IsSlice(unit))
    {
      slices.insert(slices.end(), { 0, 0, 0, 1 });
      slices.insert(slices.end(), unit.Data, unit.Data + unit.Size);
    }
  };
  return this->VisitStartCoded(data, size, add) ? slices : std::vector<std::uint8_t>();
}

NALSyntax MakeH264Syntax()
{
  NALSyntax syntax;
  syntax.HeaderSize = 1;
  syntax.TypeShift = 0;
  syntax.TypeMask = 0x1f;
  syntax.FirstSlice = 1;
  syntax.LastSlice = 5;
  syntax.FirstParameterSet = 7; // of a sequence
  syntax.LastParameterSet = 8;  // of a picture
  syntax.Delimiter = 9;
  syntax.Filler = 12;
  syntax.Supplement = { 6 };
  syntax.MinimumRecordSize = 7;
  syntax.RecordLengthSizeOffset = 4;
  return syntax;
}

class H264Bitstream : public NALBitstream
{
public:
  H264Bitstream()
    : NALBitstream(MakeH264Syntax())
  {
  }

protected:
  bool VisitRecord(const std::uint8_t* data, std::size_t size, const Visitor& visit) const override
  {
    // An AVCDecoderConfigurationRecord contains the sequence parameter sets after a byte with their
    // count in its low bits, then the picture parameter sets after a byte with theirs.
    constexpr std::size_t countOffset = 5;
    std::size_t position = countOffset + 1;
    if (!this->VisitArray(data, size, data[countOffset] & 0x1f, position, visit) ||
      position >= size)
    {
      return false;
    }
    const std::size_t count = data[position];
    ++position;
    return this->VisitArray(data, size, count, position, visit);
  }
};
}

const Bitstream& GetH264Bitstream()
{
  static const H264Bitstream bitstream;
  return bitstream;
}

namespace
{
NALSyntax MakeHEVCSyntax()
{
  NALSyntax syntax;
  syntax.HeaderSize = 2;
  syntax.TypeShift = 1;
  syntax.TypeMask = 0x3f;
  syntax.FirstSlice = 0;
  syntax.LastSlice = 31;
  syntax.FirstParameterSet = 32; // of a video
  syntax.LastParameterSet = 34;  // of a picture
  syntax.Delimiter = 35;
  syntax.Filler = 38;
  syntax.Supplement = { 39 << 1, 1 };
  syntax.MinimumRecordSize = 23;
  syntax.RecordLengthSizeOffset = 21;
  return syntax;
}

class HEVCBitstream : public NALBitstream
{
public:
  HEVCBitstream()
    : NALBitstream(MakeHEVCSyntax())
  {
  }

protected:
  bool VisitRecord(const std::uint8_t* data, std::size_t size, const Visitor& visit) const override
  {
    // The fixed part of an HEVCDecoderConfigurationRecord ends with the number of arrays that
    // follow. Each array is a type, a count in two bytes, and the units.
    std::size_t position = MakeHEVCSyntax().MinimumRecordSize;
    for (int array = data[position - 1]; array > 0; --array)
    {
      if (size - position < 3)
      {
        return false;
      }
      const std::size_t count = data[position + 1] << 8 | data[position + 2];
      position += 3;
      if (!this->VisitArray(data, size, count, position, visit))
      {
        return false;
      }
    }
    return true;
  }
};
}

const Bitstream& GetHEVCBitstream()
{
  static const HEVCBitstream bitstream;
  return bitstream;
}
}
