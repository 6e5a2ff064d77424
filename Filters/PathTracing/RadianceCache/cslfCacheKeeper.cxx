// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCacheKeeper.h"

#include "Files/cslfFileSystem.h"
#include "Parallel/cslfBroadcast.h"
#include "cslfCacheFile.h"
#include "cslfRadianceCache.h"

#include <vtkCommunicator.h>
#include <vtkMultiProcessController.h>

#include <algorithm>
#include <utility>

namespace cslf
{
namespace
{
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

bool CacheKeeper::Synchronize(bool isWell)
{
  if (!this->HasMet)
  {
    this->Meet(isWell ? Absent : Failed);
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
