// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that surfaces diffuse, worked out once for all viewpoints: it looks alike from
 * everywhere, so a texel that sees a diffuse surface needs no path but a look-up. And the light
 * that arrives at rough dielectrics, from where: what they reflect is looked up, too, unless that
 * may be seen.
 *
 * Stored of diffuse light is the radiance of a white surface: the irradiance over pi, weighted by
 * what a dielectric's boundary lets in. The surface's own colour, and what the boundary lets out,
 * are multiplied at the look-up, so textures stay as sharp as they are.
 */
#ifndef cslfRadianceCache_h
#define cslfRadianceCache_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/cslfDisplayCurve.h"
#include "PathTracing/cslfPathIntegrator.h"
#include "cslfCacheCheck.h"
#include "cslfIncidentLight.h"
#include "cslfLatticeBuilder.h"
#include "cslfOpenSides.h"
#include "cslfSurfaceLattice.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace cslf
{
struct CacheSettings
{
  /// The largest error of interpolation between stored points that adds no further points, in parts
  /// of white as it is displayed, on the scale of DisplayCurve.
  double Tolerance = 1.0 / 128;

  /// The smallest distance of stored points, in scene space.
  double Spacing = 0.005;

  /// The most paths for one point.
  int Samples = 1024;

  double Exposure = 1.0;

  /// The exposures at which the light may be displayed, in both directions: see DisplayCurve.
  double DisplayRange = DisplayCurve::ByteRange;

  std::uint32_t Seed = 0;
  PathSettings Paths;

  /// Where above 0, the cache is filled only roughly, in about so many seconds, to find out how
  /// long filling it would take.
  double ProbeSeconds = 0.0;

  /// The ranks that fill the cache together, with the same settings; null for this one alone.
  CacheShare* Share = nullptr;
};

class VTKCSLF_EXPORT RadianceCache
{
public:
  RadianceCache(const Scene& scene, const CacheSettings& settings);

  /// Fills the cache. `goOn` is told the progress, in [0,1]; false where it returned false, on any
  /// rank.
  bool Build(const std::function<bool(double)>& goOn);

  /// Whether the cache knows a surface: spheres, tubes, instances and the insides of closed bodies
  /// it does not.
  bool Covers(const Hit& hit) const
  {
    return this->World.GetMeshes()[hit.Mesh].CanHoldLattice() &&
      this->Sides.Has(this->World.GetTriangleIndex(hit.Mesh, hit.Triangle), hit.Back);
  }

  /// The diffuse radiance of a surface point that it covers, were it white.
  glm::vec3 Get(const Hit& hit) const
  {
    const std::size_t triangle = this->World.GetTriangleIndex(hit.Mesh, hit.Triangle);
    const glm::vec3 value = this->Values.Get(triangle, hit.Back, hit.U, hit.V);
    return this->HasSecond ? value + this->Second.Get(triangle, hit.Back, hit.U, hit.V) : value;
  }

  /// The same for a packet.
  void Get(LatticePacket& packet) const;

  /// The light that arrives at a surface that it covers; null where that is not known.
  const IncidentLight* GetIncident(const Hit& hit) const
  {
    return this->Lobes[hit.Mesh].IsKnown()
      ? this->Incident.Get(this->Values.FindRoot(
          this->World.GetTriangleIndex(hit.Mesh, hit.Triangle), hit.Back, hit.U, hit.V))
      : nullptr;
  }

  /// What the specular lobe of a dielectric reflects, given its albedo. False where its error,
  /// beside diffuse light, may be seen as more than this many tolerances.
  bool GetReflected(const Hit& hit, const IncidentLight& light, const glm::vec3& normal,
    const glm::vec3& outgoing, float albedo, float tolerances, glm::vec3& reflected) const;

  const OpenSides& GetSides() const { return this->Sides; }

  /// Whether the values hold all light, or only what is sampled at its sources.
  bool IsComplete() const { return this->Complete; }

  std::size_t GetNumberOfValues() const { return this->Values.GetNumberOfValues(); }

  /// The seconds that filling it would take, after a probe.
  double GetExpectedSeconds() const { return this->ExpectedSeconds; }

  /// The rays traced to fill it, by all ranks.
  std::uint64_t GetNumberOfRays() const { return this->Rays; }

  /// The smallest distance of stored points, in scene space: that of the settings, or more where
  /// the scene would need too many bricks.
  double GetSpacing() const { return this->Spacing; }

  bool IsCoarsened() const { return this->Spacing > 1.001 * this->Settings.Spacing; }

  /// How far it differs from path tracing, if that was measured.
  const CacheCheck& GetCheck() const { return this->Check; }
  void SetCheck(const CacheCheck& check) { this->Check = check; }

  /// Hands over all that a finished cache knows, to be kept, or taken back where the settings are
  /// the same.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    archive.Value(this->Complete);
    archive.Value(this->Spacing);
    archive.Value(this->Check);
    this->Sides.Exchange(archive);
    this->Values.Exchange(archive);
    this->Incident.Exchange(archive);
  }

private:
  /// Told the progress, in [0,1]; the work ends where it returns false.
  using Progress = std::function<bool(double)>;

  LatticeSettings GetLatticeSettings() const;
  void FindLobes();

  /// Builds one pass's lattice, or probes it in a part of the seconds for that.
  bool BuildLattice(LatticeBuilder& builder, double part, const Progress& goOn);

  /// Estimates the light that is sampled at its sources.
  bool SampleLights(const Progress& goOn);

  /// Estimates the light that is found by looking around, after `depth` reflections at least.
  bool Gather(const LatticeSettings& lattice, int firstSamples, int lastSamples, int depth,
    SurfaceLattice& values, IncidentField& incident, const Progress& goOn);

  bool Fill(const Progress& goOn);

  const Scene& World;
  CacheSettings Settings;
  DisplayCurve Display;
  OpenSides Sides;
  SurfaceLattice Values;
  IncidentField Incident;        // by the bricks of the values
  std::vector<GlossyLobe> Lobes; // of each mesh that reflects it
  std::unique_ptr<const LatticeLayout> Layout;
  SurfaceLattice Second; // while the cache is built: a second summand
  bool HasSecond = false;
  bool Complete = false;
  double Spacing = 0.0;
  CacheCheck Check;
  std::uint64_t Rays = 0;
  double ExpectedSeconds = 0.0;
};
}

#endif
