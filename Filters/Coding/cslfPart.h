// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A coded group as bytes, sealed by a checksum, for files of unfinished fields and for messages
 * between ranks. The layout is private to machines of one kind.
 */
#ifndef cslfPart_h
#define cslfPart_h

#include "Coding/cslfGroupCodec.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/// Numbers and bytes one after the other.
class ByteBuffer
{
public:
  ByteBuffer() = default;
  explicit ByteBuffer(std::vector<std::uint8_t> bytes)
    : Bytes(std::move(bytes))
  {
  }

  void Put(std::uint32_t number);
  void Put(double number);
  void Put(const std::vector<std::uint8_t>& data);

  ///@{
  /// Reads what was put next. False where the bytes end before.
  bool Take(std::uint32_t& number);
  bool Take(double& number);
  bool Take(std::vector<std::uint8_t>& data);
  ///@}

  const std::vector<std::uint8_t>& GetBytes() const { return this->Bytes; }

  /// The CRC-32 of the first `size` bytes.
  std::uint32_t GetChecksum(std::size_t size) const;

private:
  template <typename Number>
  void PutNumber(Number number);
  template <typename Number>
  bool TakeNumber(Number& number);

  std::vector<std::uint8_t> Bytes;
  std::size_t Position = 0;
};

std::vector<std::uint8_t> PackPart(const CodedGroup& part);

/// False where the bytes are not what PackPart made.
bool UnpackPart(std::vector<std::uint8_t> bytes, CodedGroup& part);
}

#endif
