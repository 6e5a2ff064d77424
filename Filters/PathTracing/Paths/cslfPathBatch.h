// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Paths that are followed together, so that each step is taken for many at once.
 */
#ifndef cslfPathBatch_h
#define cslfPathBatch_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Rays/cslfRayLanes.h"
#include "PathTracing/Scene/cslfScene.h"
#include "RandomNumbers/cslfSampleStream.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace cslf
{
struct PathPacket
{
  RayLanes Rays;            ///< lanes of continuing paths are active
  Vec3Lanes Beta;           ///< the weight of the light it finds
  Lanes<float> Pdf;         ///< of the ray's direction, per solid angle; infinite for a given ray
  Vec3Lanes Normal;         ///< of the LightReceiver where the ray starts
  Lanes<float> Compression; ///< the factor of the weight that is undone on leaving glass
  StreamLanes Streams;
  Lanes<std::int32_t> Path;  ///< its number in the batch
  Lanes<std::int32_t> Bin{}; ///< of the ray, see GetRayBin; not copied

  /// Copies one path.
  void Take(int lane, const PathPacket& from, int fromLane)
  {
    this->Rays.Active[lane] = -1;
    this->Rays.Origin.Set(lane, from.Rays.Origin.Get(fromLane));
    this->Rays.Direction.Set(lane, from.Rays.Direction.Get(fromLane));
    this->Beta.Set(lane, from.Beta.Get(fromLane));
    this->Pdf[lane] = from.Pdf[fromLane];
    this->Normal.Set(lane, from.Normal.Get(fromLane));
    this->Compression[lane] = from.Compression[fromLane];
    this->Streams.Hash[lane] = from.Streams.Hash[fromLane];
    this->Streams.Index[lane] = from.Streams.Index[fromLane];
    this->Path[lane] = from.Path[fromLane];
  }
};

/**
 * Filled by Add, followed by PathIntegrator::Follow, then read and cleared. The paths of one batch
 * determine which rays share a packet, and thereby the last bits of the results. Reproducible
 * results need the same paths in the same batches. Only one thread may use a batch at a time.
 */
class VTKCSLF_EXPORT PathBatch
{
public:
  /// The most paths: enough for several packets per octant after some reflections, which bins keep
  /// together, and few enough for a core's cache.
  static constexpr int Capacity = 4096;

  /// The start of a path.
  struct Start
  {
    Ray First;
    std::uint64_t Hash = 0;  ///< of its texel, for its random numbers
    std::uint32_t Index = 0; ///< of the texel's samples
    float Pdf =
      std::numeric_limits<float>::infinity(); ///< of the first direction; infinite if given
    glm::vec3 Normal{ 0.0f }; ///< of the LightReceiver where it starts, unless it is given
  };

  /// Paths begin after `depth` reflections. If they are averaged with hundreds of others, the error
  /// of each hardly matters: paths of little weight end early, and look-ups may be less exact.
  explicit PathBatch(int depth = 0, bool areAveraged = false)
    : Depth(depth)
    , Averaged(areAveraged)
  {
  }

  int GetSize() const { return this->Size; }
  int GetDepth() const { return this->Depth; }
  bool AreAveraged() const { return this->Averaged; }

  void Clear() { this->Size = 0; }

  /// Adds a path whose first ray was traced already, or one whose first ray is to be traced and
  /// counted. All paths of a batch must be of the same kind. Paths are numbered from 0; there must
  /// be at most Capacity.
  void Add(const Start& start, const Hit& seen)
  {
    const int path = this->Size;
    this->Add(start);
    this->Seen[path / LaneCount].Set(path % LaneCount, seen);
    this->AreSeen = true;
  }
  void Add(const Start& start);

  /// The hit of each path's first ray, available at least after Follow.
  Hit GetSeen(int path) const { return this->Seen[path / LaneCount].Get(path % LaneCount); }

  /// The radiance along each path's first ray, after Follow.
  const glm::vec3& GetRadiance(int path) const { return this->Radiances[path]; }

  /// The share of a path's first ray that something covers, after Follow: 1 unless it meets no
  /// surface.
  float GetCoverage(int path) const { return this->Coverages[path]; }

  ///@{
  /// For the functions that follow the paths: packets of the active paths, and their results.
  void Begin();
  int GetNumberOfPackets() const { return (this->ActiveCount + LaneCount - 1) / LaneCount; }
  PathPacket& GetPacket(int packet) { return this->Packets[packet]; }
  glm::vec3* GetRadiances() { return this->Radiances.data(); }
  float* GetCoverages() { return this->Coverages.data(); }
  ///@}

  /// The hits of a packet's first rays, to be set if unknown.
  HitLanes& GetFirstHits(int packet) { return this->Seen[packet]; }
  bool AreFirstHitsKnown() const { return this->AreSeen; }

  /// Gathers the active paths again, with those of a bin side by side.
  void Compact();

private:
  int Depth;
  bool Averaged;
  int Size = 0;
  int ActiveCount = 0;        // the active paths, in the first packets
  bool AreSeen = false;       // whether first rays were traced before
  std::vector<HitLanes> Seen; // by packets of all paths
  std::vector<glm::vec3> Radiances;
  std::vector<float> Coverages;
  std::vector<PathPacket> Packets;
  std::vector<PathPacket> Next;
  std::vector<int> Order; // the places of paths in the packets, as they are gathered again
};
}

#endif
