// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Makes a radiance cache once for all ranks, and keeps it in a file for a run that is started
 * again.
 *
 * The ranks meet once: the first filter that needs a cache joins, and where none did, Settle tells
 * the others. So no rank waits in vain for one whose input failed.
 */
#ifndef cslfCacheKeeper_h
#define cslfCacheKeeper_h

#include "Files/cslfWorkFolder.h"
#include "PathTracing/RadianceCache/cslfCacheShare.h"

#include <functional>
#include <string>

class vtkMultiProcessController;

namespace cslf
{
class RadianceCache;

class CacheKeeper : private CacheShare
{
public:
  /// What is to be done about a rank's cache.
  enum class Plan
  {
    Alone,    ///< the rank makes its own
    Together, ///< all ranks call Make
    Break     ///< another rank has failed: none is needed
  };

  /// The controller may be null. The file is rank 0's; empty names stand for none.
  CacheKeeper(vtkMultiProcessController* controller, KeptFile file,
    std::function<void(const std::string&)> warn);

  /// A rank needs the cache of this key. `isThere` says whether it has it. Ranks make it together
  /// if `shared`, which names the cache and what is done with it, is the same on all of them.
  Plan Join(const std::string& key, const std::string& shared, bool isThere);

  /// A rank needs no cache any more: it has or it will not get what it wanted one for. `isWell`
  /// tells that nothing went wrong. False where something did on a rank that did not join.
  bool Settle(bool isWell);

  /// Whether all ranks that joined had the cache.
  bool IsEverywhere() const { return this->AllHave; }

  /// The ranks that the cache is to be filled by; null for this one alone.
  CacheShare* GetShare() { return this->GetCount() > 1 ? this : nullptr; }

  /// Gets the cache from the file of rank 0, or by filling it, which `fill` does, and keeps it in
  /// the file. A cache that is everywhere is only kept. False where `fill` has failed.
  bool Make(RadianceCache& cache, const std::function<bool()>& fill);

private:
  /// How a rank comes to the meeting, worst first.
  enum Arrival
  {
    Failed,
    Absent, ///< all is well, but it needs no cache
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
  KeptFile File;
  std::function<void(const std::string&)> Warn;
  std::string Key;
  bool HasMet = false;
  bool IsBroken = false;
  bool AllHave = false;
};
}

#endif
