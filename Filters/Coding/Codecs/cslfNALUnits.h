// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What H.264 and HEVC have in common: their data are NAL units (ITU-T H.264 and H.265, section
 * 7.3.1). Checksums are over these units, without start codes or length prefixes.
 */
#ifndef cslfNALUnits_h
#define cslfNALUnits_h

#include "cslfCodec.h"

#include <functional>

namespace cslf
{
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
  std::size_t LeastRecordSize = 0;
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

  /// Visits the unit after its size at `position`, and moves `position` behind it.
  bool VisitUnit(const std::uint8_t* data, std::size_t size, int lengthSize, std::size_t& position,
    const Visitor& visit) const;
  bool VisitPrefixed(
    const std::uint8_t* data, std::size_t size, int lengthSize, const Visitor& visit) const;
  bool VisitStartCoded(const std::uint8_t* data, std::size_t size, const Visitor& visit) const;

  NALSyntax Syntax;
};
}

#endif
