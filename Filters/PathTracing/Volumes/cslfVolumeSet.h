// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The media of a scene, as rays pass them.
 */
#ifndef cslfVolumeSet_h
#define cslfVolumeSet_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Rays/cslfRayLanes.h"
#include "PathTracing/Rays/cslfRayPacket.h"
#include "cslfVolume.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/// What rays see of media on their way, and what they see through them.
struct VeilLanes
{
  Vec3Lanes Radiance; ///< linear, times opacity
  Lanes<float> Transmittance;
};

/// A collision of a ray with a medium that scatters light.
struct Collision
{
  float Distance = 0.0f;
  glm::vec3 Albedo{ 0.0f };
  float Anisotropy = 0.0f;
};

/**
 * Media that emit their displayed colours and absorb what is behind them are integrated along the
 * rays, as VTK's mappers do: displayed colours are composited in steps, and the sum is made linear.
 * Media that are lit scatter light at random collisions (Woodcock's delta tracking, with a bound of
 * the extinction in each brick of a grid).
 */
class VTKCSLF_EXPORT VolumeSet
{
public:
  /// Beyond this distance from the scene, whose bounding sphere has the radius 1, there is nothing.
  static constexpr float Everywhere = 1e4f;

  /// Volumes that are empty are left out.
  explicit VolumeSet(std::vector<Volume> volumes);

  bool IsEmpty() const { return this->Volumes.empty(); }
  bool IsAnyLit() const { return this->AnyLit; }
  bool IsAnyUnlit() const { return this->AnyUnlit; }
  const std::vector<Volume>& GetVolumes() const { return this->Volumes; }

  /// The box around all, in scene space; only if there are any.
  Box GetBounds() const;

  /// Whether a ray may meet a medium before a distance.
  bool MayMeet(const Ray& ray, float far) const;

  /// Whether any ray of a packet may meet a medium before its hit.
  bool MayMeet(const RayPacket& packet) const;

  /// Media that emit light, from the rays' origins to a distance. The random numbers in [0,1) shift
  /// the steps.
  void Integrate(const RayLanes& rays, const Lanes<float>& far, const Lanes<float>& shifts,
    VeilLanes& veils) const;

  /// The first collision of a ray with a medium that is lit, before a distance. False if there is
  /// none. `seed` determines the random numbers. Unbiased.
  bool FindCollision(const Ray& ray, float far, std::uint64_t seed, Collision& collision) const;

  /// The opacity of media that are lit, in steps like those of Integrate.
  void FindOpacities(const RayLanes& rays, const Lanes<float>& far, const Lanes<float>& shifts,
    Lanes<float>& opacities) const;

  /// Collisions of active rays where that opacity reaches given values, which are less than the
  /// whole. With uniform random values, the distribution is that of FindCollision, but for the
  /// steps. Returns a bit for each collision that was found.
  std::uint32_t FindCollisions(const RayLanes& rays, const Lanes<float>& far,
    const Lanes<float>& shifts, const Lanes<float>& opacities, Collision collisions[]) const;

  /// Attenuates light on its way from a distance along the rays. Unbiased; rays of the same place
  /// and direction get the same result.
  void Attenuate(const RayLanes& rays, const Lanes<float>& far, Lanes<float>& transmittances) const;

  /// Moves the hits of rays that media nearly hide to where half of what is seen there lies: the
  /// depth of a mist. Rays without a hit get one if they see any medium, in a mesh that must not be
  /// read.
  void FindMiddles(RayPacket& packet) const;

private:
  enum class Kinds
  {
    Unlit,
    Lit,
    All
  };

  static bool IsOf(Kinds kinds, const Volume& volume)
  {
    return kinds == Kinds::All || volume.IsLit() == (kinds == Kinds::Lit);
  }

  template <typename Visit>
  void March(const RayLanes& rays, const Lanes<float>& far, const Lanes<float>& shifts, Kinds kinds,
    float scale, const Visit& visit) const;
  void FindMedium(const Ray& ray, float at, std::uint64_t seed, Collision& collision) const;

  std::vector<Volume> Volumes;
  bool AnyLit = false;
  bool AnyUnlit = false;
  Box Bounds;
};
}

#endif
