// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The traced scene: triangles, materials and lights, in a space where the bounding sphere is the
 * unit sphere, so that floats are precise enough for scenes of any position and size.
 */
#ifndef cslfScene_h
#define cslfScene_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Lights/cslfEnvironment.h"
#include "PathTracing/Lights/cslfLocalLights.h"
#include "PathTracing/Lights/cslfPointLight.h"
#include "PathTracing/Rays/cslfHitGeometry.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Rays/cslfRayPacket.h"
#include "PathTracing/Shapes/cslfMesh.h"
#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "Pipeline/cslfPhase.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cslf
{
struct HitLanes;
struct RayLanes;
struct ShadowLanes;
class VolumeSet;

/// The lights other than emissive surfaces.
struct LightSet
{
  Environment Surroundings;
  std::vector<DirectionalLight> Directional;
  std::vector<PointLight> Points;
};

class VTKCSLF_EXPORT Scene
{
public:
  /// Builds the acceleration structure. Vertices must be finite. Throws Aborted if there is a
  /// `progress` and it returns false. `volumes` may be null or empty.
  Scene(std::vector<Mesh> meshes, LightSet lights, const Progress& progress = nullptr,
    std::shared_ptr<const VolumeSet> volumes = nullptr);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The error of the construction; empty if there was none.
  const std::string& GetError() const { return this->Error; }

  Hit Intersect(const Ray& ray) const;
  void Intersect(RayPacket& packet) const;

  /// The same with the packet's MinimumOpacity. If it meets veils, `veils` gets its rays and, where
  /// one hits nothing, the last surface that this ray passes; otherwise it has no hits.
  void Intersect(RayPacket& packet, RayPacket& veils) const;

  /// The first hits of incoherent rays.
  void Intersect(const RayLanes& rays, HitLanes& hits) const;

  /// The share of each light that passes all surfaces and volumes on the way. The light's own
  /// surface does not count. Partly opaque surfaces attenuate; glass and all other surfaces block.
  void FindTransmittances(ShadowLanes& shadows) const;

  SurfaceHit GetSurface(const Ray& ray, const Hit& hit) const;

  /// The surface as seen along its normal, from the side of the hit.
  SurfaceHit GetSurface(const Hit& hit) const;

  glm::vec3 GetBaseColor(const Hit& hit) const
  {
    return this->Meshes[hit.Mesh].GetBaseColor(hit.GetPlace());
  }

  const std::vector<Mesh>& GetMeshes() const { return this->Meshes; }

  /// Shows surfaces whose colours a map tells in a grey of their mean albedo, until it is called
  /// with false.
  void SetNeutral(bool isNeutral);

  /// The volumes; null if there are none.
  const VolumeSet* GetVolumes() const { return this->Volumes.get(); }

  /// The box around all surfaces and volumes; empty if there are none.
  Box GetBounds() const;

  /// The number of a triangle among those of all meshes that can have a lattice.
  std::size_t GetTriangleIndex(std::uint32_t mesh, std::uint32_t triangle) const
  {
    return this->FirstTriangles[mesh] + triangle;
  }

  const Environment& GetEnvironment() const { return this->Lights.Surroundings; }
  const std::vector<DirectionalLight>& GetDirectionalLights() const
  {
    return this->Lights.Directional;
  }
  const std::vector<PointLight>& GetPointLights() const { return this->Lights.Points; }
  const LocalLights& GetLocalLights() const { return this->Locals; }

private:
  struct Acceleration;

  void Trace(RayPacket& packet, RTCRayHit16* veils) const;
  void FindInstances(RayPacket& packet) const;
  void FindInstances(HitLanes& hits) const;
  std::uint32_t GetInstance(std::uint32_t mesh, std::uint32_t geometry) const;

  std::vector<Mesh> Meshes;
  std::vector<std::size_t> FirstTriangles; // of each mesh
  LightSet Lights;
  LocalLights Locals;
  std::string Error;
  std::unique_ptr<Acceleration> Tree;
  std::shared_ptr<const VolumeSet> Volumes;
  bool Small = false; // trace rays to the same octant together, wherever they start
};
}

#endif
