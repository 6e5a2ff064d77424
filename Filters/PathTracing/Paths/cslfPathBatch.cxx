// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPathBatch.h"

#include "PathTracing/Rays/cslfRayPacket.h"

namespace cslf
{
namespace
{
/// Leaves lanes of the last packet empty after the last path.
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

void PathBatch::Add(const Start& start)
{
  const int lane = this->Size % LaneCount;
  const std::size_t packets = this->Size / LaneCount + 1;
  if (this->Packets.size() < packets)
  {
    this->Packets.resize(packets);
    this->Seen.resize(packets);
  }
  this->AreSeen = this->AreSeen && this->Size > 0;
  PathPacket& packet = this->Packets[packets - 1];
  packet.Rays.Active[lane] = -1;
  packet.Rays.Origin.Set(lane, start.First.Origin);
  packet.Rays.Direction.Set(lane, start.First.Direction);
  packet.Beta.Set(lane, glm::vec3(1.0f));
  packet.Pdf[lane] = start.Pdf;
  packet.Normal.Set(lane, start.Normal);
  packet.Compression[lane] = 1.0f;
  packet.Streams.Hash[lane] = start.Hash;
  packet.Streams.Index[lane] = start.Index;
  packet.Path[lane] = this->Size++;
}

void PathBatch::Begin()
{
  this->ActiveCount = this->Size;
  this->Next.resize(this->Packets.size());
  this->Order.resize(this->Packets.size() * LaneCount);
  this->Radiances.assign(this->Size, glm::vec3(0.0f));
  this->Coverages.assign(this->Size, 1.0f);
  Close(this->Packets, this->Size);
  for (int path = this->Size; this->AreSeen && path % LaneCount != 0; ++path)
  {
    this->Seen[path / LaneCount].Set(path % LaneCount, Hit());
  }
}

void PathBatch::Compact()
{
  // Count the paths of each bin.
  const int packets = this->GetNumberOfPackets();
  int ends[RayBinCount] = {};
  for (int i = 0; i < packets; ++i)
  {
    const PathPacket& from = this->Packets[i];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      ends[from.Bin[lane]] -= from.Rays.Active[lane];
    }
  }
  this->ActiveCount = 0;
  for (int& end : ends)
  {
    const int size = end;
    end = this->ActiveCount;
    this->ActiveCount += size;
  }

  // Put each at the end of its bin.
  for (int i = 0; i < packets; ++i)
  {
    const PathPacket& from = this->Packets[i];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      if (from.Rays.Active[lane] != 0)
      {
        this->Order[ends[from.Bin[lane]]++] = i * LaneCount + lane;
      }
    }
  }
  for (int place = 0; place < this->ActiveCount; ++place)
  {
    const int path = this->Order[place];
    this->Next[place / LaneCount].Take(
      place % LaneCount, this->Packets[path / LaneCount], path % LaneCount);
  }
  Close(this->Next, this->ActiveCount);
  this->Packets.swap(this->Next);
}
}
