// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A coded group as bytes, sealed by a checksum, for files of unfinished fields and for messages
 * between ranks. Only machines of the same kind can read it.
 */
#ifndef cslfGroupBytes_h
#define cslfGroupBytes_h

#include "Coding/Groups/cslfGroupCodec.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cslf
{
/// Numbers and bytes in sequence.
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
  /// Reads the next item. False if the bytes end before it does.
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

/// The number of a manifest, which is its CRC-32. A manifest is a text of all that groups depend
/// on.
std::uint32_t NumberManifest(const std::string& text);

/// A group with the number of the manifest that it was made under.
std::vector<std::uint8_t> PackGroup(const CodedGroup& coded, std::uint32_t manifest);

/// False if the bytes are not a result of PackGroup under that manifest.
bool UnpackGroup(std::vector<std::uint8_t> bytes, std::uint32_t manifest, CodedGroup& coded);

/// Whether bytes begin like those of PackGroup, and the number of their manifest.
bool ReadManifest(const std::vector<std::uint8_t>& bytes, std::uint32_t& manifest);

/// The number of bytes that this takes.
constexpr std::size_t GroupHeadSize = 8;
}

#endif
