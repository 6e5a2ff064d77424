// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCacheFile.h"

#include "Files/cslfFileSystem.h"
#include "cslfRadianceCache.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <type_traits>
#include <vector>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;

/// The first bytes, with the version of the layout.
constexpr std::uint64_t Magic = 0x3445484341434643;

/// The number of bytes read at once to check a file.
constexpr std::size_t PieceSize = std::size_t(1) << 20;

std::uint32_t UpdateChecksum(std::uint32_t checksum, const void* bytes, std::size_t count)
{
  // zlib starts a new checksum if it is given no bytes.
  return count == 0
    ? checksum
    : static_cast<std::uint32_t>(::crc32_z(checksum, static_cast<const Bytef*>(bytes), count));
}

class FileWriter
{
public:
  explicit FileWriter(const std::string& fileName)
    : Stream(ToPath(fileName), std::ios::binary | std::ios::trunc)
  {
  }

  template <typename T>
  void Value(const T& value)
  {
    static_assert(std::is_trivially_copyable<T>::value, "it is written as bytes");
    this->Put(&value, sizeof(value));
  }

  template <typename T>
  void Array(const std::vector<T>& values)
  {
    static_assert(std::is_trivially_copyable<T>::value, "it is written as bytes");
    this->Value(static_cast<std::uint64_t>(values.size()));
    this->Put(values.data(), values.size() * sizeof(T));
  }

  bool Finish()
  {
    const std::uint32_t checksum = this->Checksum;
    this->Value(checksum);
    this->Stream.close();
    return this->Stream.good();
  }

private:
  void Put(const void* bytes, std::size_t count)
  {
    this->Checksum = UpdateChecksum(this->Checksum, bytes, count);
    this->Stream.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  }

  std::ofstream Stream;
  std::uint32_t Checksum = 0;
};

/// Reads a file that is known to be undamaged.
class FileReader
{
public:
  explicit FileReader(const std::string& fileName)
    : Stream(ToPath(fileName), std::ios::binary)
  {
  }

  template <typename T>
  void Value(T& value)
  {
    this->Take(&value, sizeof(value));
  }

  template <typename T>
  void Array(std::vector<T>& values)
  {
    std::uint64_t count = 0;
    this->Value(count);
    values.resize(count);
    this->Take(values.data(), count * sizeof(T));
  }

private:
  void Take(void* bytes, std::size_t count)
  {
    this->Stream.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count));
  }

  std::ifstream Stream;
};

/// Whether a file begins and ends like that of a cache.
bool IsWhole(const std::string& fileName)
{
  std::ifstream stream(ToPath(fileName), std::ios::binary | std::ios::ate);
  constexpr std::size_t checksumSize = sizeof(std::uint32_t);
  const auto size = static_cast<std::size_t>(std::max<std::streamoff>(stream.tellg(), 0));
  std::uint64_t magic = 0;
  if (size < sizeof(magic) + checksumSize)
  {
    return false;
  }
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(&magic), sizeof(magic));
  stream.seekg(0);
  std::uint32_t checksum = 0;
  std::vector<char> piece;
  for (std::size_t left = size - checksumSize; stream && left > 0; left -= piece.size())
  {
    piece.resize(std::min(left, PieceSize));
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    checksum = UpdateChecksum(checksum, piece.data(), piece.size());
  }
  std::uint32_t expected = 0;
  stream.read(reinterpret_cast<char*>(&expected), checksumSize);
  return stream && magic == Magic && checksum == expected;
}
}

bool WriteCacheFile(const std::string& fileName, const std::string& key, RadianceCache& cache)
{
  FileWriter writer(fileName);
  writer.Value(Magic);
  writer.Array(std::vector<char>(key.begin(), key.end()));
  cache.Exchange(writer);
  return writer.Finish();
}

CacheFileState ReadCacheFile(
  const std::string& fileName, const std::string& key, RadianceCache& cache)
{
  std::error_code ignored;
  if (!fs::exists(ToPath(fileName), ignored))
  {
    return CacheFileState::Missing;
  }
  if (!IsWhole(fileName))
  {
    return CacheFileState::Damaged;
  }
  FileReader reader(fileName);
  std::uint64_t magic = 0;
  std::vector<char> theirs;
  reader.Value(magic);
  reader.Array(theirs);
  if (key != std::string(theirs.begin(), theirs.end()))
  {
    return CacheFileState::Missing;
  }
  cache.Exchange(reader);
  return CacheFileState::Read;
}
}
