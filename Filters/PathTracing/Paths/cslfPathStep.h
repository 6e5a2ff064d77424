// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Advances paths from the end of one ray to the start of the next.
 */
#ifndef cslfPathStep_h
#define cslfPathStep_h

#include "cslfDirectLight.h"
#include "cslfPathBatch.h"
#include "cslfSurfaceLanes.h"

namespace cslf
{
class PathBatch;
class PathIntegrator;
class StoredLight;
struct PathSettings;

/// Advances one packet of paths by one step.
class PathStep
{
public:
  /// Of a batch's paths, which made `vertex` reflections.
  PathStep(const PathIntegrator& paths, const PathBatch& batch, int vertex);

  /// Evaluates the rays' hits and continues the paths. Adds the results to the radiances of the
  /// batch's paths. Returns the number of shadow rays.
  std::uint64_t Advance(PathPacket& paths, const HitLanes& hits, glm::vec3* radiances);

private:
  void AddEnvironment(PathPacket& paths, const HitLanes& hits);
  void EndWhereKnown(PathPacket& paths, const HitLanes& hits);
  void AddEmission(const PathPacket& paths, const HitLanes& hits);
  void MakeScattering(const PathPacket& paths);
  void AddStored(const PathPacket& paths, const HitLanes& hits);
  void AddFit(int lane, const Hit& hit, const BSDF* bsdf, const PathPacket& paths);
  void ChooseLobes(int lane, const BSDF& bsdf);
  std::uint64_t AddLight(const PathPacket& paths);
  void ChooseDirections(PathPacket& paths);
  void EndByChance(PathPacket& paths);

  const PathIntegrator& Paths;
  const Scene& World;
  const PathSettings& Settings;
  const DirectLight& Light;
  const StoredLight* Stored;
  int Depth;
  std::uint32_t Vertex;
  bool AreAveraged; // as in PathBatch

  // Of the packet.
  Vec3Lanes Found; // the radiance that the step adds
  ScatterLanes Points;
  LaneMask Continues;    // whether paths may continue from Lambertian surfaces
  Lanes<float> Lobe;     // on other surfaces, the random number that chooses it
  Lobes Open[LaneCount]; // on other surfaces, the lobes in which the path may continue
  Lanes<float> OpenProbability;
  Vec3Lanes Local; // the next direction
};
}

#endif
