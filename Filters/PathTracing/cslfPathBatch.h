// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Paths that are followed together, so that each step is taken for many at once.
 */
#ifndef cslfPathBatch_h
#define cslfPathBatch_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfPathPacket.h"
#include "cslfScene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace cslf
{
/**
 * Filled by Add, followed by PathIntegrator::Follow, then read and cleared. Which paths are in one
 * batch decides which rays share a packet, and thereby the last bits of what they find: what has to
 * be told alike again and again must put the same paths into the same batches. One thread at a
 * time.
 */
class VTKCSLF_EXPORT PathBatch
{
public:
  /// The most paths: enough for several packets to each octant after some reflections, which bins
  /// keep together, and few enough to stay in a core's cache.
  static constexpr int Capacity = 4096;

  /// How a path begins.
  struct Start
  {
    Ray First;
    std::uint64_t Hash = 0;  ///< of its texel, for its random numbers
    std::uint32_t Index = 0; ///< of the texel's samples
    float Pdf =
      std::numeric_limits<float>::infinity(); ///< of the first direction; infinite if given
    glm::vec3 Normal{ 0.0f }; ///< of the LightReceiver that it starts from, unless it is given
  };

  /// Paths begin after `depth` reflections.
  explicit PathBatch(int depth = 0)
    : Depth(depth)
  {
  }

  int GetSize() const { return this->Size; }
  int GetDepth() const { return this->Depth; }

  void Clear() { this->Size = 0; }

  /// Adds a path whose first ray is known to hit or miss, or one whose first ray is to be traced,
  /// and counted, too: all of a batch must be alike in that. Paths are numbered from 0; there must
  /// be no more than Capacity.
  void Add(const Start& start, const Hit& seen)
  {
    const int path = this->Size;
    this->Add(start);
    this->Seen[path / LaneCount].Set(path % LaneCount, seen);
    this->AreSeen = true;
  }
  void Add(const Start& start);

  /// What each path's first ray hits; once it is followed, at the latest.
  Hit GetSeen(int path) const { return this->Seen[path / LaneCount].Get(path % LaneCount); }

  /// The radiance that comes along each path's first ray, once it is followed.
  const glm::vec3& GetRadiance(int path) const { return this->Radiances[path]; }

  ///@{
  /// Of those who follow the paths: packets of the paths that go on, and what they find.
  void Begin();
  int GetNumberOfPackets() const { return (this->Living + LaneCount - 1) / LaneCount; }
  PathPacket& GetPacket(int packet) { return this->Packets[packet]; }
  glm::vec3* GetRadiances() { return this->Radiances.data(); }
  ///@}

  /// What the first rays of a packet hit, to be set where it is not known.
  HitLanes& GetFirstHits(int packet) { return this->Seen[packet]; }
  bool AreFirstHitsKnown() const { return this->AreSeen; }

  /// Gathers the paths that go on anew, those of the same bin side by side.
  void GoOn();

private:
  int Depth;
  int Size = 0;
  int Living = 0;             // the paths that go on, in the first packets
  bool AreSeen = false;       // whether first rays were traced before
  std::vector<HitLanes> Seen; // by packets of all paths
  std::vector<glm::vec3> Radiances;
  std::vector<PathPacket> Packets;
  std::vector<PathPacket> Next;
  std::vector<int> Order; // the places of paths in the packets, as they are gathered anew
};
}

#endif
