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
  /// The most paths: enough for several packets to each octant after some reflections, and few
  /// enough to stay in a core's cache.
  static constexpr int Capacity = 4096;

  /// How a path begins.
  struct Start
  {
    Ray First;
    std::uint64_t Hash = 0;  ///< of its texel, for its random numbers
    std::uint32_t Index = 0; ///< of the texel's samples
    float Pdf =
      std::numeric_limits<float>::infinity(); ///< of the first direction; infinite if given
  };

  /// Paths begin after `depth` reflections.
  explicit PathBatch(int depth = 0)
    : Depth(depth)
  {
    this->Starts.reserve(Capacity);
    this->Seen.reserve(Capacity);
  }

  int GetSize() const { return static_cast<int>(this->Starts.size()); }
  int GetDepth() const { return this->Depth; }

  void Clear()
  {
    this->Starts.clear();
    this->Seen.clear();
    this->Radiances.clear();
  }

  /// Adds a path whose first ray is known to hit or miss, or one whose first ray is to be traced,
  /// and counted, too: all of a batch must be alike in that. Paths are numbered from 0.
  void Add(const Start& start, const Hit& seen)
  {
    this->Starts.push_back(start);
    this->Seen.push_back(seen);
  }
  void Add(const Start& start) { this->Starts.push_back(start); }

  /// What each path's first ray hits; once it is followed, at the latest.
  const Hit& GetSeen(int path) const { return this->Seen[path]; }

  /// The radiance that comes along each path's first ray, once it is followed.
  const glm::vec3& GetRadiance(int path) const { return this->Radiances[path]; }

  ///@{
  /// Of those who follow the paths: packets of the paths that go on, and what they find.
  void Begin();
  int GetNumberOfPackets() const { return (this->Living + LaneCount - 1) / LaneCount; }
  PathPacket& GetPacket(int packet) { return this->Packets[packet]; }
  glm::vec3* GetRadiances() { return this->Radiances.data(); }
  ///@}

  /// Gives what the first rays of a packet hit. False where that is not known.
  bool FindSeen(int packet, HitLanes& hits) const;
  void SetSeen(int packet, const HitLanes& hits);

  /// Gathers the paths that go on anew, those whose rays run to the same octant side by side.
  void GoOn();

private:
  int Depth;
  std::vector<Start> Starts;
  std::vector<Hit> Seen;
  std::vector<glm::vec3> Radiances;
  bool AreSeen = false; // whether first rays were traced before
  int Living = 0;       // the paths that go on, in the first packets
  std::vector<PathPacket> Packets;
  std::vector<PathPacket> Next;
};
}

#endif
