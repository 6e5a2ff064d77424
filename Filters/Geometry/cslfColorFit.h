// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fits colours of points to samples of a surface, and divides its triangles where these do not
 * suffice.
 */
#ifndef cslfColorFit_h
#define cslfColorFit_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfSideColors.h"
#include "cslfSurfaceMesh.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <unordered_map>
#include <vector>

namespace cslf
{
/// The sums of least squares of the samples of a side of a triangle, by its barycentric
/// coordinates.
struct SampleSums
{
  float Squares[6] = {}; ///< of products of coordinates: 00, 11, 22, 01, 12, 20
  glm::vec3 Products[3] = { glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f) };
  float Energy = 0.0f;      ///< of the colours' squares
  float Weight = 0.0f;      ///< the area of the samples that count
  glm::vec3 Origin{ 0.0f }; ///< the first colour: in the sums, colours are less that

  void Add(const glm::vec3& place, const glm::vec3& color, float weight)
  {
    this->Origin = this->Weight > 0.0f ? this->Origin : color;
    const glm::vec3 rest = color - this->Origin;
    for (int i = 0; i < 3; ++i)
    {
      this->Squares[i] += weight * place[i] * place[i];
      this->Squares[3 + i] += weight * place[i] * place[(i + 1) % 3];
      this->Products[i] += weight * place[i] * rest;
    }
    this->Energy += weight * glm::dot(rest, rest);
    this->Weight += weight;
  }

  /// The sum of a row of the matrix, which is that of the coordinate.
  float GetShare(int row) const
  {
    return this->Squares[row] + this->Squares[3 + row] + this->Squares[3 + (row + 2) % 3];
  }

  /// The sum of a coordinate times the colours.
  glm::vec3 GetProduct(int row) const
  {
    return this->Products[row] + this->GetShare(row) * this->Origin;
  }

  /// The matrix of the sums times a vector.
  void Multiply(const glm::vec3 values[3], glm::vec3 results[3]) const
  {
    const float* s = this->Squares;
    results[0] = s[0] * values[0] + s[3] * values[1] + s[5] * values[2];
    results[1] = s[3] * values[0] + s[1] * values[1] + s[4] * values[2];
    results[2] = s[5] * values[0] + s[4] * values[1] + s[2] * values[2];
  }

  /// The sum of the squared errors of interpolated colours, of all three components.
  double GetError(const glm::vec3 values[3]) const
  {
    const glm::vec3 rest[3] = { values[0] - this->Origin, values[1] - this->Origin,
      values[2] - this->Origin };
    glm::vec3 products[3];
    this->Multiply(rest, products);
    double error = this->Energy;
    for (int i = 0; i < 3; ++i)
    {
      error += glm::dot(products[i] - 2.0f * this->Products[i], rest[i]);
    }
    return std::max(error, 0.0);
  }

  /// The same for the colours of a triangle that fit its samples best.
  double GetLeastError() const
  {
    const float* s = this->Squares;
    const double smooth = 1e-6 * this->Weight;
    const glm::dmat3 matrix(
      s[0] + smooth, s[3], s[5], s[3], s[1] + smooth, s[4], s[5], s[4], s[2] + smooth);
    const glm::dmat3 inverse = glm::inverse(matrix);
    double error = this->Energy;
    for (int c = 0; c < 3; ++c)
    {
      const glm::dvec3 products(this->Products[0][c], this->Products[1][c], this->Products[2][c]);
      error -= glm::dot(products, inverse * products);
    }
    return this->Weight > 0.0f ? std::max(error, 0.0) : 0.0;
  }
};

/// A triangle's samples.
struct TriangleSamples
{
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  SampleSums Sides[2]; ///< the front, where corners run counterclockwise, and the back
  bool AreComplete[2] = { true, true }; ///< whether the light of all that is seen is known
  glm::vec3 Normal{ 0.0f };
  float Area = 0.0f; ///< 0 if it has none
  /// How much brighter the samples are than their colours, at least 1.
  float Brightness[2] = { 1.0f, 1.0f };
  double Detail = 0.0; ///< GetLeastError of the colours under white light, of either side

  /// The number of the map that tells its colours, from 1, or 0: then the sides have colours,
  /// otherwise light, and places on the map.
  std::uint8_t Map = 0;
  SampleSums Places;
  float PlaceTolerance = 0.0f; ///< the RMS error of places that is small enough

  /// Of arrays, three values each, as shares of their ranges; none if there are no arrays.
  std::vector<SampleSums> Arrays;
  float MaximumLight = 0.0f; ///< of the samples
  float BaseSquare = 1.0f;   ///< the mean square of its colours under white light, if it has a map
  bool IsRound = false;      ///< whether what it belongs to has no creases
  std::uint32_t Region = None; ///< of the scene, to which it belongs
};

struct ColorFitSettings
{
  float ShortestEdge = 0.0f;      ///< edges that are no longer are not divided
  float ShortestArrayEdge = 0.0f; ///< the same where only values of arrays err
  bool ClampsColors = true;       ///< whether colours end at 1
  bool HasCreases = true; ///< whether angles between triangles are those of what was sampled
  bool KeepsMesh = false; ///< whether each point has one colour, and no triangle is divided
  double Tolerance = 0.0; ///< the RMS error of a triangle that is small enough
  /// The same for what best fits its detail: the colours may be better known than their light.
  double DetailTolerance = 0.0;
  double ArrayTolerance = 0.0; ///< the same for values of arrays
  std::size_t MaximumTriangles = 0;

  /// Moves a point of a surface onto the region to which it belongs, given its normal; may be
  /// empty.
  std::function<glm::vec3(const glm::vec3& point, const glm::vec3& normal, std::uint32_t region)>
    Project;
};

/// What is fitted besides colours.
struct FittedValues
{
  std::vector<glm::vec2> Places;              ///< on maps; none if there are no maps
  std::vector<std::vector<glm::vec3>> Arrays; ///< as TriangleSamples::Arrays, each of all points
};

/**
 * The colours of points are those of least squares, as in "Least Squares Vertex Baking" (Kavan,
 * Bargteil, Sloan 2011): colours that are interpolated linearly come as close to the samples as
 * they can. Triangles that err by more than the tolerance are divided at their longest edge, those
 * with the largest errors first. Triangles do not share the colour of a corner where there is a
 * crease between them, or if they belong to different regions.
 *
 * Call SetSamples for all triangles of ListNew, then Solve, then Refine, and again until Refine
 * returns false; at last Finish.
 */
class VTKCSLF_EXPORT ColorFit
{
public:
  /// The mesh must be welded, and outlive this object.
  ColorFit(SurfaceMesh& mesh, const ColorFitSettings& settings);

  /// The triangles that have no samples yet.
  std::vector<std::size_t> ListNew() const;

  /// May be called by several threads for different triangles.
  void SetSamples(std::size_t triangle, const TriangleSamples& samples)
  {
    this->Samples[triangle] = samples;
    this->AreNew[triangle] = 0;
  }

  /// Calls `proceed` now and then, which may throw.
  void Solve(const std::function<void(double)>& proceed);

  /// Divides triangles that err. False if there are none, or no more are allowed.
  bool Refine();

  /// Gives each colour a point of its own, unless those at a place are nearly the same. Mapped
  /// points get no scalars, but their places.
  SideColors Finish(FittedValues& values);

private:
  /// What is fitted: the colours of both sides, places on maps, and arrays.
  static constexpr int PlaceKind = 2;
  static constexpr int FirstArrayKind = 3;

  const SampleSums& GetSums(std::size_t triangle, int kind) const
  {
    const TriangleSamples& samples = this->Samples[triangle];
    return kind >= FirstArrayKind ? samples.Arrays[kind - FirstArrayKind]
      : kind == PlaceKind         ? samples.Places
                                  : samples.Sides[kind];
  }

  float GetSmoothness(std::size_t triangle, int kind) const;
  void JoinCorners();
  void SolveKind(int kind, const std::function<bool()>& goOn);
  void Apply(int kind, const std::vector<glm::vec3>& values, std::vector<glm::vec3>& results) const;
  void PinArrays();
  std::vector<std::uint8_t> FindMaps() const;
  std::vector<std::uint64_t> ChooseEdges() const;
  void LimitEdges(std::vector<std::uint64_t>& edges) const;
  void ProjectMiddles(const std::unordered_map<std::uint64_t, unsigned int>& middles);
  double FindError(std::size_t triangle, int side) const;
  double FindPlaceError(std::size_t triangle) const;
  double FindArrayError(std::size_t triangle) const;
  bool HasDetail(std::size_t triangle, double tolerances) const;
  float FindLength(std::size_t triangle, int edge) const;
  std::array<std::vector<char>, 2> FindExact() const;
  std::array<std::vector<unsigned char>, 2> FindExactCodes() const;

  ColorFitSettings Settings;
  SurfaceMesh& Surface;
  std::vector<TriangleSamples> Samples;       // of the triangles
  std::vector<char> AreNew;                   // whether they have no samples yet
  std::vector<glm::uvec3> Values;             // of the corners of each triangle
  std::vector<unsigned int> Places;           // the point of each value
  std::vector<std::vector<glm::vec3>> Colors; // of each kind, of the values
};
}

#endif
