// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads the header of a PLY file and the numbers after it.
 */
#ifndef cslfPLYHeader_h
#define cslfPLYHeader_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cslf::tool
{
struct PLYType
{
  std::size_t Size = 0; ///< in bytes
  bool IsSigned = false;
  bool IsFloat = false;
};

struct PLYProperty
{
  std::string Name;
  PLYType Type;
  bool IsList = false;
  PLYType CountType; ///< of a list
};

struct PLYElement
{
  std::string Name;
  std::size_t Count = 0;
  std::vector<PLYProperty> Properties;

  /// The index of a property, list or not; -1 if there is none.
  int Find(const std::string& name, bool isList) const;
};

struct PLYHeader
{
  enum class Formats
  {
    ASCII,
    LittleEndian,
    BigEndian
  };

  Formats Format = Formats::ASCII;
  std::vector<PLYElement> Elements;
  std::size_t Size = 0; ///< in bytes; the numbers follow
};

/// Reads the header of a file's bytes. Throws a Failure if it is broken or declares more elements
/// than the file can hold.
PLYHeader ReadPLYHeader(const std::string& bytes);

/// Reads numbers one after another. Throws a Failure at the end of the file.
class PLYNumbers
{
public:
  /// The bytes must outlive it.
  PLYNumbers(const std::string& bytes, const PLYHeader& header);

  double Read(const PLYType& type);

  /// The number of elements of a list that the rest of the file can contain.
  std::size_t ReadCount(const PLYProperty& list);

private:
  double ReadWord();
  double ReadBinary(const PLYType& type);

  const std::string& Bytes;
  PLYHeader::Formats Format;
  std::size_t Offset;
};
}

#endif
