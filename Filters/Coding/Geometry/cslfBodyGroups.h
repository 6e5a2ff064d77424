// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Groups of bodies of a geometry that are one mesh at several places, as files store them.
 */
#ifndef cslfBodyGroups_h
#define cslfBodyGroups_h

#include "cslfCube.h"
#include "cslfJSONForward.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace cslf
{
/// Four bytes for each point of a geometry, or none at all.
struct PointCodes
{
  std::vector<unsigned char> Colors; ///< red, green, blue and 255
  std::vector<unsigned char> BackColors;
  std::vector<unsigned char> Flags; ///< two, and two times 0
};

/// The numbers of a group, as the file has them.
struct BodyGroup
{
  std::vector<std::uint32_t> Corners; ///< three a triangle of the prototype
  std::vector<std::int16_t> Points;   ///< three a point of the prototype
  double Extent = 0.0;                ///< the largest coordinate
  bool AreBalls = false;              ///< the prototype stands for the unit sphere

  /// The matrix of each body, row by row: from the prototype to cube coordinates.
  std::vector<std::array<std::int16_t, 12>> Placements;

  /// The colours of a body: their mean, and multiples of vectors that are orthogonal. A vector has
  /// red, green and blue of each point, on the front or on both sides.
  std::vector<std::int32_t> Mean;
  std::vector<std::vector<std::int16_t>> Vectors;
  std::vector<std::vector<std::int16_t>> Multiples; ///< of each vector, for each body

  std::vector<unsigned char> Flags; ///< those of the front of all points, then of the back

  std::size_t GetPoints() const { return this->Points.size() / 3; }
  std::size_t GetTriangles() const { return this->Corners.size() / 3; }
  std::size_t GetBodies() const { return this->Placements.size(); }
};

/**
 * The colours of the bodies of a group are alike, so they are stored as multiples of a few vectors,
 * the principal components, as in "Clustered Principal Components for Precomputed Radiance
 * Transfer" (Sloan, Hall, Hart, Snyder 2003).
 */
class BodyGroups
{
public:
  /// Takes the last points and triangles out of a geometry, if its arrays tell that they are
  /// bodies, and their codes out of `codes`. Colours end at `maximum`. The triangles must be in the
  /// order of the polygons.
  static BodyGroups Take(vtkPolyData* geometry, vtkPolyData* triangles, const Cube& box,
    int positionBits, int maximum, PointCodes& codes);

  bool IsEmpty() const { return this->Groups.empty(); }
  bool HasColors() const { return this->Sides > 0; }
  bool HasBackColors() const { return this->Sides == 2; }
  bool HasExactColors() const { return this->HasFlags; }
  std::size_t CountPoints() const;
  std::size_t CountTriangles() const;

  ///@{
  /// What the header of the geometry says of them, and its opposite, which leaves room for all
  /// numbers, but not for more points and triangles, or bytes, than allowed. Throws std::exception.
  nlohmann::json Describe() const;
  static BodyGroups Read(
    const nlohmann::json& header, int positionBits, std::size_t mostPoints, std::size_t mostBytes);
  ///@}

  ///@{
  /// The bytes, their number, and the opposite. Throws std::exception.
  std::vector<unsigned char> Pack() const;
  std::size_t GetSize() const;
  void Unpack(const unsigned char* bytes);
  ///@}

  /// Adds the codes of all bodies. Backs are added if there are any, or `hasBack`.
  void AddCodes(int maximum, bool hasBack, PointCodes& codes) const;

  /// Adds points and triangles of all bodies, and the arrays that tell of them.
  void Append(const Cube& box, vtkPolyData* geometry) const;

private:
  bool Fit(int maximum, const PointCodes& codes);
  std::array<double, 12> GetMatrix(const BodyGroup& group, std::size_t body) const;
  double GetOffsetSteps() const;
  double GetLinearStep(const BodyGroup& group) const;

  std::vector<BodyGroup> Groups;
  int PositionBits = 0;
  int Sides = 0; ///< that have colours
  int Step = 0;  ///< by which vectors are multiplied
  bool HasFlags = false;
};
}

#endif
