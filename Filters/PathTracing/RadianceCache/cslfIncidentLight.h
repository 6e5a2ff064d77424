// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that arrives at a point from all directions above it, for rough surfaces, whose lobes
 * blur it. After radiance caching (Krivanek, Gautron, Pattanaik and Bouatouch, IEEE TVCG 11(5),
 * 2005), with other basis functions.
 */
#ifndef cslfIncidentLight_h
#define cslfIncidentLight_h

#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Materials/cslfSurfaceMaterial.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace cslf
{
/// The means of a direction's products over some distribution, in world coordinates: 1, x, y, z,
/// xx, yy, zz, xy, xz, yz.
using DirectionMoments = std::array<float, 10>;

/// Radiance as a quadratic polynomial of the incident direction.
struct IncidentLight
{
  glm::vec3 Terms[10] = {};                             ///< the factors of DirectionMoments
  glm::vec3 Normal{ 0.0f };                             ///< of the surface that it arrives at
  glm::vec3 Mean{ 0.0f };                               ///< of cosine-distributed directions
  float Error = std::numeric_limits<float>::infinity(); ///< the approximate error of a lobe's mean

  bool IsKnown() const { return this->Error < std::numeric_limits<float>::infinity(); }

  /// The mean radiance of a lobe.
  glm::vec3 Get(const DirectionMoments& lobe) const
  {
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < lobe.size(); ++i)
    {
      sum += lobe[i] * this->Terms[i];
    }
    return sum;
  }
};

/**
 * The lobe of an opaque, rough dielectric boundary: the mean directions of the light that it
 * reflects.
 */
class GlossyLobe
{
public:
  /// An unknown lobe: that of a mirror, or of several roughnesses.
  GlossyLobe() = default;
  explicit GlossyLobe(const SurfaceMaterial& material);

  bool IsKnown() const { return !this->Rows.empty(); }

  /// The moments of the incident directions, weighted by the BSDF and the cosine. Both vectors are
  /// of unit length.
  DirectionMoments GetMoments(const glm::vec3& normal, const glm::vec3& outgoing) const;

  /// The approximate share of the hemisphere that it covers, projected to the surface.
  float GetSize() const { return this->Size; }

private:
  static constexpr int Steps = 32; // between the cosines of 0 and 1

  /// In the frame in which the outgoing direction has no y.
  struct Row
  {
    float X = 0.0f;
    float Z = 0.0f;
    float XX = 0.0f;
    float YY = 0.0f;
    float XZ = 0.0f;
  };

  static Row MakeRow(const SurfaceMaterial& material, float cosine);

  std::vector<Row> Rows;
  float Size = 0.0f;
};

/// Fits the light that arrives at a point to samples of it. Stores only sums.
class IncidentFit
{
public:
  /// Adds the radiance from a direction. Directions are cosine-distributed; each 16 successive ones
  /// are close to each other.
  void Add(const glm::vec2& place, const glm::vec3& radiance);

  /// The polynomial, its error for lobes of some size, and the mean. Places are coordinates in the
  /// frame.
  IncidentLight Solve(const Frame& frame, float lobeSize) const;

private:
  static constexpr int Polynomials = 6;
  static constexpr int Products = Polynomials * (Polynomials + 1) / 2;

  /// Sums over values of the polynomials, z, and radiances, l.
  struct Moments
  {
    double ZZ[Products] = {};
    glm::dvec3 LZ[Polynomials] = {};
    glm::dvec3 LL{ 0.0 };

    void Add(const float z[Polynomials], const glm::vec3& l);

    /// The sum of squared residuals of a polynomial with these factors.
    glm::dvec3 GetSquares(const glm::dvec3 factors[Polynomials]) const;
  };

  float GetError(const glm::dvec3 factors[Polynomials], float lobeSize) const;

  int Count = 0;
  glm::dvec3 Sums[Polynomials] = {}; // of the radiances times the polynomials
  Moments Samples;                   // of the samples
  Moments Cells;                     // of the means of each 16 successive samples
  float CellZ[Polynomials] = {};     // the sums of an incomplete group of 16
  glm::vec3 CellL{ 0.0f };
};

/// The light that arrives at a surface: the mean of some of its points. Its error is computed from
/// other samples, the pilots. From the same samples, light that is too dark by chance would seem
/// too accurate.
IncidentLight Average(const std::vector<IncidentLight>& lights,
  const std::vector<IncidentLight>& pilots, const glm::vec3& normal);

/// The light that arrives at each brick of a lattice that is not part of another.
class IncidentField
{
public:
  void Resize(std::size_t bricks) { this->Indices.resize(bricks, None); }

  void Set(std::size_t brick, const IncidentLight& light)
  {
    this->Indices[brick] = static_cast<std::uint32_t>(this->Lights.size());
    this->Lights.push_back(light);
  }

  /// Null if unknown.
  const IncidentLight* Get(std::size_t brick) const
  {
    const bool isKnown = brick < this->Indices.size() && this->Indices[brick] != None;
    return isKnown ? &this->Lights[this->Indices[brick]] : nullptr;
  }

  /// Writes or reads all data.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    archive.Array(this->Indices);
    archive.Array(this->Lights);
  }

private:
  static constexpr std::uint32_t None = 0xffffffffu;

  std::vector<std::uint32_t> Indices; // of each brick; empty if nothing is known
  std::vector<IncidentLight> Lights;
};
}

#endif
