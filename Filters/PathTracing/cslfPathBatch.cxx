// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPathBatch.h"

#include <algorithm>

namespace cslf
{
namespace
{
void Put(const PathBatch::Start& start, int path, int lane, PathPacket& packet)
{
  packet.Rays.Active[lane] = -1;
  packet.Rays.Origin.Set(lane, start.First.Origin);
  packet.Rays.Direction.Set(lane, start.First.Direction);
  packet.Beta.Set(lane, glm::vec3(1.0f));
  packet.Pdf[lane] = start.Pdf;
  packet.Compression[lane] = 1.0f;
  packet.Streams.Hash[lane] = start.Hash;
  packet.Streams.Index[lane] = start.Index;
  packet.Path[lane] = path;
}

/// Leaves the last packet's lanes after the last path empty.
void Close(std::vector<PathPacket>& packets, int paths)
{
  for (int lane = paths % LaneCount; lane > 0 && lane < LaneCount; ++lane)
  {
    PathPacket& packet = packets[paths / LaneCount];
    packet.Take(lane, packet, 0);
    packet.Rays.Active[lane] = 0;
  }
}
}

void PathBatch::Begin()
{
  const int size = this->GetSize();
  this->Living = size;
  this->AreSeen = !this->Seen.empty();
  this->Seen.resize(size);
  this->Radiances.assign(size, glm::vec3(0.0f));
  this->Packets.resize(std::max(std::size_t(this->GetNumberOfPackets()), this->Packets.size()));
  this->Next.resize(this->Packets.size());
  for (int path = 0; path < size; ++path)
  {
    Put(this->Starts[path], path, path % LaneCount, this->Packets[path / LaneCount]);
  }
  Close(this->Packets, size);
}

bool PathBatch::FindSeen(int packet, HitLanes& hits) const
{
  if (!this->AreSeen)
  {
    return false;
  }
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const int path = packet * LaneCount + lane;
    hits.Set(lane, path < this->GetSize() ? this->Seen[path] : Hit());
  }
  return true;
}

void PathBatch::SetSeen(int packet, const HitLanes& hits)
{
  const int end = std::min(LaneCount, this->GetSize() - packet * LaneCount);
  for (int lane = 0; lane < end; ++lane)
  {
    this->Seen[packet * LaneCount + lane] = hits.Get(lane);
  }
}

void PathBatch::GoOn()
{
  // Count the paths to each octant.
  const int packets = this->GetNumberOfPackets();
  int ends[OctantCount] = {};
  for (int i = 0; i < packets; ++i)
  {
    const PathPacket& from = this->Packets[i];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      ends[from.Octant[lane]] -= from.Rays.Active[lane];
    }
  }
  this->Living = 0;
  for (int& end : ends)
  {
    const int size = end;
    end = this->Living;
    this->Living += size;
  }

  // Put each at the end of its octant.
  for (int i = 0; i < packets; ++i)
  {
    const PathPacket& from = this->Packets[i];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      if (from.Rays.Active[lane] != 0)
      {
        const int place = ends[from.Octant[lane]]++;
        this->Next[place / LaneCount].Take(place % LaneCount, from, lane);
      }
    }
  }
  Close(this->Next, this->Living);
  this->Packets.swap(this->Next);
}
}
