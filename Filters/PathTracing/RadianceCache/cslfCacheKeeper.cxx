// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCacheKeeper.h"

#include "Files/cslfFileSystem.h"
#include "Parallel/cslfRanks.h"
#include "cslfRadianceCache.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace cslf
{
class RadianceCache;

namespace
{
// A finished radiance cache in a file with a checksum. Only machines of the same kind can read it.

/// The result of reading a cache.
enum class CacheFileState
{
  Missing, ///< there is no file, or it belongs to another cache
  Damaged, ///< the file is damaged
  Read
};

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

/// Writes a cache. The key contains everything that the cache depends on. False on failure; the
/// file is then unusable.
bool WriteCacheFile(const std::string& fileName, const std::string& key, RadianceCache& cache)
{
  FileWriter writer(fileName);
  writer.Value(Magic);
  writer.Array(std::vector<char>(key.begin(), key.end()));
  cache.Exchange(writer);
  return writer.Finish();
}

/// Reads a cache that was written with the same key. Unless the result is that it was read, the
/// cache must be made again.
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

/// Sends rank 0's values to all others.
class Broadcaster
{
public:
  explicit Broadcaster(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  template <typename T>
  void Value(T& value)
  {
    this->Send(&value, sizeof(value));
  }

  template <typename T>
  void Array(std::vector<T>& values)
  {
    std::uint64_t count = values.size();
    this->Value(count);
    values.resize(count);
    this->Send(values.data(), count * sizeof(T));
  }

private:
  void Send(void* bytes, std::size_t count) { BroadcastBytes(this->Controller, bytes, count, 0); }

  vtkMultiProcessController* Controller;
};
}

CacheKeeper::CacheKeeper(vtkMultiProcessController* controller, PersistentFile file,
  std::function<void(const std::string&)> warn)
  : Controller(controller)
  , File(std::move(file))
  , Warn(std::move(warn))
{
}

int CacheKeeper::GetRank() const
{
  return this->Controller ? this->Controller->GetLocalProcessId() : 0;
}

int CacheKeeper::GetCount() const
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
}

bool CacheKeeper::Agree(bool isFor)
{
  const int mine = isFor ? 1 : 0;
  int all = mine;
  if (this->GetCount() > 1)
  {
    this->Controller->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  }
  return all == 1;
}

std::uint64_t CacheKeeper::Sum(std::uint64_t mine)
{
  const auto part = static_cast<unsigned long long>(mine);
  unsigned long long sum = part;
  if (this->GetCount() > 1)
  {
    this->Controller->AllReduce(&part, &sum, 1, vtkCommunicator::SUM_OP);
  }
  return sum;
}

void CacheKeeper::Gather(const void* mine, const std::vector<std::size_t>& sizes, void* all)
{
  char* place = static_cast<char*>(all);
  for (int rank = 0; rank < static_cast<int>(sizes.size()); ++rank)
  {
    if (rank == this->GetRank())
    {
      std::copy_n(static_cast<const char*>(mine), sizes[rank], place);
    }
    BroadcastBytes(this->Controller, place, sizes[rank], rank);
    place += sizes[rank];
  }
}

CacheKeeper::Arrival CacheKeeper::Meet(Arrival mine)
{
  this->HasMet = true;
  const int own = mine;
  int worst = own;
  if (this->GetCount() > 1)
  {
    this->Controller->AllReduce(&own, &worst, 1, vtkCommunicator::MIN_OP);
  }
  this->IsBroken = worst == Failed;
  return static_cast<Arrival>(worst);
}

bool CacheKeeper::IsOfAll(const std::string& text)
{
  if (this->GetCount() == 1)
  {
    return true;
  }
  std::string first = text;
  BroadcastText(this->Controller, first, 0);
  return this->Agree(first == text);
}

CacheKeeper::Plan CacheKeeper::Join(const std::string& key, const std::string& shared, bool isThere)
{
  if (this->HasMet)
  {
    return Plan::Alone;
  }
  const Arrival worst = this->Meet(isThere ? Having : Needing);
  if (worst == Failed)
  {
    return Plan::Break;
  }
  this->AllHave = worst == Having;
  this->Key = key;
  return worst != Absent && this->IsOfAll(shared) ? Plan::Together : Plan::Alone;
}

bool CacheKeeper::Synchronize(bool hasSucceeded)
{
  if (!this->HasMet)
  {
    this->Meet(hasSucceeded ? Absent : Failed);
  }
  return !this->IsBroken;
}

bool CacheKeeper::Read(RadianceCache& cache)
{
  auto state = CacheFileState::Missing;
  if (!this->File.Final.empty())
  {
    state = ReadCacheFile(this->File.Final, this->Key, cache);
  }
  if (state == CacheFileState::Damaged)
  {
    this->Warn("The radiance cache of the interrupted run is damaged and is computed again.");
  }
  int isRead = state == CacheFileState::Read ? 1 : 0;
  if (this->GetCount() > 1)
  {
    this->Controller->Broadcast(&isRead, 1, 0);
    if (isRead)
    {
      Broadcaster broadcaster(this->Controller);
      cache.Exchange(broadcaster);
    }
  }
  return isRead != 0;
}

bool CacheKeeper::Write(RadianceCache& cache) const
{
  std::string ignored;
  if (WriteCacheFile(this->File.Unfinished, this->Key, cache) &&
    PublishFile(this->File.Unfinished, this->File.Final, ignored))
  {
    return true;
  }
  RemoveFile(this->File.Unfinished);
  return false;
}

bool CacheKeeper::Make(RadianceCache& cache, const std::function<bool()>& fill)
{
  if (!this->AllHave && this->Read(cache))
  {
    return true;
  }
  if (!this->AllHave && !fill())
  {
    return false;
  }
  if (!this->File.Final.empty() && !this->Write(cache))
  {
    this->Warn("The radiance cache could not be stored in " + this->File.Final +
      ": a rerun would have to compute it again.");
  }
  return true;
}
}
