// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The cameras that take turns in drawing a light field.
 */
#ifndef cslfViewFrustums_h
#define cslfViewFrustums_h

#include "cslfViewFrustum.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace cslf
{
/// The views of all viewers of a field in one window: its renderers, and both eyes in stereo.
/// Viewers that stop drawing are removed after a while.
class ViewFrustums
{
public:
  /// A viewer: a renderer, which is only compared, and an eye.
  using Viewer = std::pair<const void*, int>;

  void Update(const Viewer& viewer, const ViewFrustum& frustum)
  {
    this->Entries[viewer] = { frustum, ++this->Count };
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      entry =
        entry->second.Time + Patience < this->Count ? this->Entries.erase(entry) : std::next(entry);
    }
  }

  std::vector<ViewFrustum> GetFrustums() const
  {
    std::vector<ViewFrustum> frustums;
    for (const auto& entry : this->Entries)
    {
      frustums.push_back(entry.second.Frustum);
    }
    return frustums;
  }

private:
  struct Entry
  {
    ViewFrustum Frustum;
    std::int64_t Time = 0;
  };

  /// In updates: several passes for several viewers.
  static constexpr std::int64_t Patience = 64;

  std::map<Viewer, Entry> Entries;
  std::int64_t Count = 0;
};
}

#endif
