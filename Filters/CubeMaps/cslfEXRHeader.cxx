// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEXRHeader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace cslf
{
namespace
{
/// Reads the bytes of a file in order. Bytes beyond its end are zeros, and set the failure flag.
class ByteReader
{
public:
  ByteReader(const unsigned char* begin, std::size_t size)
    : Place(begin)
    , End(begin + size)
  {
  }

  bool HasFailed() const { return this->Failed; }
  bool IsAtEnd() const { return this->Place == this->End; }

  std::uint32_t TakeInteger()
  {
    const ByteReader bytes = this->Take(4);
    std::uint32_t value = 0;
    for (const unsigned char* byte = bytes.End; byte != bytes.Place;)
    {
      value = value << 8 | *--byte;
    }
    return value;
  }

  /// Up to and including a zero.
  std::string TakeText()
  {
    const unsigned char* zero = std::find(this->Place, this->End, 0);
    std::string text(this->Place, zero);
    this->Take(static_cast<std::size_t>(zero - this->Place) + 1);
    return text;
  }

  ByteReader Take(std::size_t count)
  {
    this->Failed = this->Failed || count > static_cast<std::size_t>(this->End - this->Place);
    if (this->Failed)
    {
      return { this->End, 0 };
    }
    this->Place += count;
    return { this->Place - count, count };
  }

private:
  const unsigned char* Place;
  const unsigned char* End;
  bool Failed = false;
};

/// Whether the value of a window, [xMin, yMin, xMax, yMax], has that size.
bool IsOfSize(ByteReader window, int width, int height)
{
  std::int64_t corners[4];
  for (std::int64_t& corner : corners)
  {
    corner = static_cast<std::int32_t>(window.TakeInteger());
  }
  return corners[2] - corners[0] + 1 == width && corners[3] - corners[1] + 1 == height;
}

/// Whether a list of channels ends where its bytes do. OpenEXR reads up to the empty name that ends
/// the list, and takes what follows for the next attribute.
bool IsWholeChannelList(ByteReader list)
{
  // A channel has its name, its type, four bytes, and its two sampling rates.
  constexpr std::size_t channelSize = 16;
  while (!list.HasFailed() && !list.TakeText().empty())
  {
    list.Take(channelSize);
  }
  return !list.HasFailed() && list.IsAtEnd();
}

/// Whether OpenEXR reads as many bytes of an attribute's value as the file states. For most types,
/// it uses a fixed size and ignores that of the file.
bool IsWholeValue(const std::string& type, const ByteReader& value, std::size_t size)
{
  static const std::map<std::string, std::size_t> sizes = { { "box2f", 16 }, { "box2i", 16 },
    { "chromaticities", 32 }, { "compression", 1 }, { "double", 8 }, { "envmap", 1 },
    { "float", 4 }, { "int", 4 }, { "keycode", 28 }, { "lineOrder", 1 }, { "m33d", 72 },
    { "m33f", 36 }, { "m44d", 128 }, { "m44f", 64 }, { "rational", 8 }, { "timecode", 8 },
    { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 }, { "v3f", 12 }, { "v3i", 12 } };
  if (type == "chlist")
  {
    return IsWholeChannelList(value);
  }
  const auto known = sizes.find(type);
  return type == "string" || (known != sizes.end() && known->second == size);
}
}

bool IsSoundEXR(const std::vector<unsigned char>& content, int width, int height)
{
  constexpr std::uint32_t magic = 20000630;
  constexpr std::uint32_t versionAndLongNames = 0x4ff;
  ByteReader header(content.data(), content.size());
  if (header.TakeInteger() != magic || (header.TakeInteger() & ~versionAndLongNames) != 0)
  {
    return false;
  }
  bool isOfSize = false;
  // An attribute has its name, its type, the size of its value, and the value. An empty name ends
  // the list.
  for (std::string name = header.TakeText(); !name.empty(); name = header.TakeText())
  {
    const std::string type = header.TakeText();
    const std::size_t size = header.TakeInteger();
    const ByteReader value = header.Take(size);
    const bool isWindow = name == "dataWindow";
    if (header.HasFailed() || !IsWholeValue(type, value, size) ||
      (isWindow && (type != "box2i" || !IsOfSize(value, width, height))))
    {
      return false;
    }
    isOfSize = isOfSize || isWindow;
  }
  return isOfSize && !header.HasFailed();
}
}
