// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Diffusely reflected light, computed once for all viewpoints: it is the same in all directions, so
 * a texel that sees a diffuse surface needs a look-up instead of a path. The cache also stores the
 * directional light that arrives at rough dielectrics. Their reflections are looked up, too, unless
 * the error might be visible.
 *
 * Diffuse light is stored as the radiance of a white surface: the irradiance over pi, weighted by
 * the transmission of a dielectric's boundary. The look-up multiplies by the surface's colour and
 * the boundary's outgoing transmission, so textures stay sharp.
 */
#ifndef cslfRadianceCache_h
#define cslfRadianceCache_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "Quality/cslfDisplayCurve.h"
#include "cslfCacheCheck.h"
#include "cslfIncidentLight.h"
#include "cslfLatticeBuilder.h"
#include "cslfOpenSides.h"
#include "cslfShapeLight.h"
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
  /// The largest error of interpolation between stored points that adds no points, relative to
  /// displayed white, on the scale of DisplayCurve.
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

  /// If above 0, the cache is filled only roughly, in about this many seconds, to estimate the time
  /// for filling it.
  double ProbeSeconds = 0.0;

  /// The ranks that fill the cache together, with the same settings; null for this one alone.
  CacheShare* Share = nullptr;
};

class VTKCSLF_EXPORT RadianceCache final : public StoredLight
{
public:
  RadianceCache(const Scene& scene, const CacheSettings& settings);

  /// Fills the cache. `goOn` gets the progress, in [0,1]. Returns false if `goOn` did on any rank.
  bool Build(const std::function<bool(double)>& goOn);

  /// Whether the cache covers a surface with a lattice. It does not cover the insides of closed
  /// bodies. For spheres, tubes and instances, see GetShapes.
  bool Covers(const Hit& hit) const override
  {
    return this->World.GetMeshes()[hit.Mesh].CanHoldLattice() &&
      this->Sides.Has(this->World.GetTriangleIndex(hit.Mesh, hit.Triangle), hit.Back);
  }

  /// The diffuse radiance of a covered surface point, if it were white.
  glm::vec3 Get(const Hit& hit) const override
  {
    const std::size_t triangle = this->World.GetTriangleIndex(hit.Mesh, hit.Triangle);
    const glm::vec3 value = this->Values.Get(triangle, hit.Back, hit.U, hit.V);
    return this->HasSecond ? value + this->Second.Get(triangle, hit.Back, hit.U, hit.V) : value;
  }

  /// The same for a packet.
  void Get(LatticePacket& packet) const;

  bool LookUpRough(
    const Ray& ray, const Hit& hit, float tolerances, glm::vec3& radiance) const override;

  ///@{
  /// The light of spheres, tubes and instances.
  const ShapeLight& GetShapes() const { return this->Shapes; }
  bool HasShape(std::uint32_t mesh) const override { return this->Shapes.Has(mesh); }
  bool GetShape(const Hit& hit, const SurfaceHit& surface, glm::vec3& light) const override
  {
    return this->Shapes.Get(hit, surface, light);
  }
  bool LookUpShape(const Ray& ray, const Hit& hit, glm::vec3& radiance) const override;
  ///@}

  const OpenSides& GetSides() const { return this->Sides; }

  bool IsComplete() const override { return this->Complete; }

  std::size_t GetNumberOfValues() const
  {
    return this->Values.GetNumberOfValues() + this->Shapes.GetNumberOfFits();
  }

  /// The seconds that filling it would take, after a probe.
  double GetExpectedSeconds() const { return this->ExpectedSeconds; }

  /// The rays traced to fill it, by all ranks.
  std::uint64_t GetNumberOfRays() const { return this->Rays; }

  /// The smallest distance of stored points, in scene space: that of the settings, or more if the
  /// scene would need too many bricks.
  double GetSpacing() const { return this->Spacing; }

  bool IsCoarsened() const { return this->Spacing > 1.001 * this->Settings.Spacing; }

  /// The difference from path tracing, if it was measured.
  const CacheCheck& GetCheck() const { return this->Check; }
  void SetCheck(const CacheCheck& check) { this->Check = check; }

  /// Writes the data of a finished cache, or reads it with the same settings.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    archive.Value(this->Complete);
    archive.Value(this->Spacing);
    archive.Value(this->Check);
    this->Sides.Exchange(archive);
    this->Values.Exchange(archive);
    this->Incident.Exchange(archive);
    this->Shapes.Exchange(archive);
  }

private:
  /// Gets the progress, in [0,1]; the work ends if it returns false.
  using Progress = std::function<bool(double)>;

  LatticeSettings GetLatticeSettings() const;

  /// The light that arrives at a covered surface. Null if unknown.
  const IncidentLight* GetIncident(const Hit& hit) const;

  /// The light reflected by the specular lobe of a dielectric, given its albedo. False if its
  /// displayed error, in addition to diffuse light, may exceed this many tolerances.
  bool GetReflected(const Hit& hit, const IncidentLight& light, const glm::vec3& normal,
    const glm::vec3& outgoing, float albedo, float tolerances, glm::vec3& reflected) const;

  /// Whether a ray hits the inside of a closed body without light: see OpenSides::IsInside.
  bool IsInside(const Ray& ray, const Hit& hit) const;
  std::function<bool(const Ray&, const Hit&)> GetInsideTest() const;

  /// The area within which noise is averaged, in scene space.
  float GetNoiseArea() const;
  void FindLobes();
  bool EstimateShapes(int samples, const Progress& goOn);

  /// Builds one pass's lattice, or probes it in a share of the seconds for that.
  bool BuildLattice(LatticeBuilder& builder, double part, const Progress& goOn);

  /// Estimates the light that is sampled at its sources.
  bool SampleLights(const Progress& goOn);

  /// Estimates the light found by sampling directions, after at least `depth` reflections.
  bool GatherAtOnce(const Progress& goOn);
  bool Gather(const LatticeSettings& lattice, int firstSamples, int lastSamples, int depth,
    SurfaceLattice& values, IncidentField& incident, const Progress& goOn);

  bool Fill(const Progress& goOn);

  /// Finds where anything is to be stored.
  bool MakeLayout(const Progress& goOn);
  void FindPlaces(const PathIntegrator& paths, float spacing, const LayoutProgress& progress);
  bool FillLayout(const Progress& goOn);

  const Scene& World;
  CacheSettings Settings;
  DisplayCurve Display;
  OpenSides Sides;
  SurfaceLattice Values;
  IncidentField Incident;        // by the bricks of the values
  std::vector<GlossyLobe> Lobes; // of each mesh that reflects it
  ShapeLight Shapes;
  std::vector<char> AreEnds; // whether paths may end at the shapes of a mesh
  std::unique_ptr<const LatticeLayout> Layout;
  SurfaceLattice Second; // while the cache is built: a second term of the sum
  bool HasSecond = false;
  bool Complete = false;
  double Spacing = 0.0;
  CacheCheck Check;
  std::uint64_t Rays = 0;
  double ExpectedSeconds = 0.0;
};
}

#endif
