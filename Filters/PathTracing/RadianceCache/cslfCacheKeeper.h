// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Makes a radiance cache once for all ranks, and keeps it in a file for a restart.
 *
 * The ranks synchronise once: the first filter that needs a cache joins. If a rank has none,
 * Synchronize informs the others. So no rank waits forever for one whose input failed.
 */
#ifndef cslfCacheKeeper_h
#define cslfCacheKeeper_h

#include "Files/cslfWorkFolder.h"
#include "cslfCacheShare.h"

#include <functional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace cslf
{
class RadianceCache;

class CacheKeeper : private CacheShare
{
public:
  /// What to do about a rank's cache.
  enum class Plan
  {
    Alone,    ///< the rank makes its own
    Together, ///< all ranks call Make
    Break     ///< another rank has failed: none is needed
  };

  /// The controller may be null. The file is rank 0's. An empty name means no file.
  CacheKeeper(vtkMultiProcessController* controller, PersistentFile file,
    std::function<void(const std::string&)> warn);

  /// A rank needs the cache of this key. `isThere` says whether it has it already. Ranks make it
  /// together if `shared`, which identifies the cache and its use, is the same on all.
  Plan Join(const std::string& key, const std::string& shared, bool isThere);

  /// A rank needs no more cache, because its work is done or failed. `hasSucceeded` says whether
  /// there was no error. False if there was an error on a rank that did not join.
  bool Synchronize(bool hasSucceeded);

  /// Whether all joined ranks had the cache.
  bool IsEverywhere() const { return this->AllHave; }

  /// The ranks that fill the cache together; null for this one alone.
  CacheShare* GetShare() { return this->GetCount() > 1 ? this : nullptr; }

  /// Reads the cache from rank 0's file, or fills it with `fill`, and keeps it in the file. If all
  /// ranks have it, only keeps it. False if `fill` has failed.
  bool Make(RadianceCache& cache, const std::function<bool()>& fill);

private:
  /// A rank's state when it joins, worst first.
  enum Arrival
  {
    Failed,
    Absent, ///< no error, but it needs no cache
    Needing,
    Having
  };

  int GetRank() const override;
  int GetCount() const override;
  bool Agree(bool isFor) override;
  std::uint64_t Sum(std::uint64_t mine) override;
  void Gather(const void* mine, const std::vector<std::size_t>& sizes, void* all) override;

  Arrival Meet(Arrival mine);
  bool IsOfAll(const std::string& text);
  bool Read(RadianceCache& cache);
  bool Write(RadianceCache& cache) const;

  vtkMultiProcessController* Controller;
  PersistentFile File;
  std::function<void(const std::string&)> Warn;
  std::string Key;
  bool HasMet = false;
  bool IsBroken = false;
  bool AllHave = false;
};
}

#endif
