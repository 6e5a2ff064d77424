// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What H.264 and HEVC have in common: their data are NAL units (ITU-T H.264 and H.265, section
 * 7.3.1). Checksums are over these units, without start codes or length prefixes.
 */
#ifndef cslfNALUnits_h
#define cslfNALUnits_h

#include "Coding/cslfCodec.h"

#include <functional>

namespace cslf
{
/// A NAL unit in memory, with its header.
struct NALUnit
{
  const std::uint8_t* Data = nullptr;
  std::size_t Size = 0;
};

class NALBitstream : public Bitstream
{
public:
  bool ReadConfiguration(
    const std::uint8_t* data, std::size_t size, Framing& framing) const override;
  bool AddToCRC(const std::uint8_t* data, std::size_t size, const Framing& framing,
    std::uint32_t& crc) const override;
  std::vector<std::uint8_t> Trim(const std::uint8_t* data, std::size_t size) const override;

protected:
  using Visitor = std::function<void(const NALUnit&)>;

  /// The types of the parameter sets are those from `firstParameterSet` to `lastParameterSet`.
  NALBitstream(std::size_t headerSize, int firstParameterSet, int lastParameterSet)
    : HeaderSize(headerSize)
    , FirstParameterSet(firstParameterSet)
    , LastParameterSet(lastParameterSet)
  {
  }

  virtual int GetType(const NALUnit& unit) const = 0;
  virtual bool IsSlice(int type) const = 0;

  /// Whether the data are a decoder configuration record (ISO/IEC 14496-15), not annex B.
  virtual bool IsRecord(const std::uint8_t* data, std::size_t size) const = 0;

  /// Visits the units of a record. False if it is cut short.
  virtual bool VisitRecord(
    const std::uint8_t* data, std::size_t size, int& lengthSize, const Visitor& visit) const = 0;

  /// Visits `count` units that each follow their size in two bytes, and moves `position` behind
  /// them: records are made of such arrays.
  bool VisitArray(const std::uint8_t* data, std::size_t size, std::size_t count,
    std::size_t& position, const Visitor& visit) const;

private:
  bool VisitPrefixed(
    const std::uint8_t* data, std::size_t size, int lengthSize, const Visitor& visit) const;
  bool VisitStartCoded(const std::uint8_t* data, std::size_t size, const Visitor& visit) const;

  std::size_t HeaderSize;
  int FirstParameterSet;
  int LastParameterSet;
};
}

#endif
