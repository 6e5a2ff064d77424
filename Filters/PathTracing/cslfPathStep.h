// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What happens to paths between the end of one ray and the start of the next.
 */
#ifndef cslfPathStep_h
#define cslfPathStep_h

#include "cslfDirectLight.h"
#include "cslfPathPacket.h"
#include "cslfScatterLanes.h"

namespace cslf
{
class PathIntegrator;
class RadianceCache;
struct PathSettings;

/// Advances one packet of paths by one step.
class PathStep
{
public:
  /// After `depth` reflections, of which `vertex` were made by these paths.
  PathStep(const PathIntegrator& paths, int depth, int vertex);

  /// Lets the paths see what their rays hit, and go on. Adds what they find to the radiances of the
  /// batch's paths. Returns the number of shadow rays.
  std::uint64_t Advance(PathPacket& paths, const HitLanes& hits, glm::vec3* radiances);

private:
  void AddEnvironment(PathPacket& paths, const HitLanes& hits);
  void EndWhereKnown(PathPacket& paths, const HitLanes& hits);
  void AddEmission(const PathPacket& paths, const HitLanes& hits);
  void MakeScattering(const PathPacket& paths);
  void AddCached(const PathPacket& paths, const HitLanes& hits);
  std::uint64_t AddLight(const PathPacket& paths);
  void ChooseDirections(PathPacket& paths);
  void EndByChance(PathPacket& paths);

  const PathIntegrator& Paths;
  const Scene& World;
  const PathSettings& Settings;
  const DirectLight& Light;
  const RadianceCache* Cache;
  int Depth;
  std::uint32_t Vertex;

  // Of the packet.
  Vec3Lanes Found; // the radiance that the step adds
  ScatterLanes Points;
  LaneMask GoesOn;       // whether paths may go on from what is matte
  Lanes<float> Lobe;     // of what is not matte: the random number that chooses it
  Lobes Open[LaneCount]; // of what is not matte: the lobes in which the path may go on
  Lanes<float> OpenProbability;
  Vec3Lanes Local; // the next direction
};
}

#endif
