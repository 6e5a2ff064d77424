// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointCache.h"

#include <utility>

namespace cslf
{
void ViewpointCache::SetCapacity(std::size_t capacity)
{
  this->Capacity = capacity;
  this->Shrink();
}

std::optional<ViewpointSamples> ViewpointCache::Find(int slice)
{
  const auto found = this->Places.find(slice);
  if (found == this->Places.end())
  {
    return std::nullopt;
  }
  this->Entries.splice(this->Entries.begin(), this->Entries, found->second);
  return found->second->Content;
}

void ViewpointCache::Insert(int slice, ViewpointSamples viewpoint)
{
  if (this->Find(slice))
  {
    this->Entries.front().Content = std::move(viewpoint);
    return;
  }
  this->Entries.push_front({ slice, std::move(viewpoint) });
  this->Places[slice] = this->Entries.begin();
  this->Shrink();
}

void ViewpointCache::Shrink()
{
  while (this->Entries.size() > this->Capacity)
  {
    this->Places.erase(this->Entries.back().Slice);
    this->Entries.pop_back();
  }
}
}
