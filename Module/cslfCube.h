// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The geometry of the cube surface parameterisation (paper, section 3.1).
 *
 * Two spaces: world (WC) and cube space (CC), in which the cube is [-1,1]^3 and the axes are
 * parallel to the world's. A point of the cube's surface is a face and two in-face coordinates
 * in [-1,1], with the faces and the in-face axes (sc, tc) of OpenGL's cube maps.
 */
#ifndef cslfCube_h
#define cslfCube_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace cslf
{
/// The cube's faces in OpenGL's cube-map order: +X, -X, +Y, -Y, +Z, -Z.
constexpr int FaceCount = 6;

/// The axis (0, 1, 2) that a face is perpendicular to.
constexpr int FaceAxis(int face)
{
  return face / 2;
}

/// +1 for the faces at the positive end of their axis, -1 for the others.
constexpr int FaceSign(int face)
{
  return face % 2 == 0 ? 1 : -1;
}

/// The face at the end `sign` (>= 0 is positive) of `axis`.
constexpr int FaceOf(int axis, double sign)
{
  return 2 * axis + (sign < 0 ? 1 : 0);
}

/// A point of the cube's surface: a face and its in-face coordinates (sc, tc), each in [-1,1].
struct CubePoint
{
  int Face = 0;
  glm::dvec2 Coordinates{ 0.0 };
};

/// The point in CC at in-face coordinates (sc, tc) of a face. The OpenGL cube-map table, solved
/// for the point.
VTKCSLF_EXPORT glm::dvec3 FaceToCube(int face, const glm::dvec2& coordinates);

/// The in-face coordinates on a given face of a point in CC that lies on that face's plane.
VTKCSLF_EXPORT glm::dvec2 CubeToFace(int face, const glm::dvec3& pointCC);

/// The face that a direction from the cube's centre (or a surface point in CC) meets, and where.
/// Edges and corners belong to the face of the lowest axis.
VTKCSLF_EXPORT CubePoint DirectionToFace(const glm::dvec3& directionCC);

/// The four parameters of a light ray: where it enters the cube, (u,v), and leaves it, (s,t).
struct RayCoordinates
{
  CubePoint Entry;            ///< (u,v)
  CubePoint Exit;             ///< (s,t); never on the entry face
  double EntryDistance = 0.0; ///< ray parameter at the entry, in units of the direction's length
  double ExitDistance = 0.0;  ///< ray parameter at the exit
};

/// The coordinates of the line through `originCC` along `directionCC`, or nothing if the line
/// misses the cube. The line is infinite: distances are negative behind the origin. Lines with
/// values that are not finite or a direction of length 0 count as misses.
VTKCSLF_EXPORT std::optional<RayCoordinates> RayToCoordinates(
  const glm::dvec3& originCC, const glm::dvec3& directionCC);

/// An axis-aligned box in the world, mapped to [-1,1]^3 in CC. Its three edges may differ.
struct VTKCSLF_EXPORT Cube
{
  glm::dvec3 Center{ 0.0 };
  glm::dvec3 Edges{ 2.0 };

  /// The default cube of a scene: centred on its bounding box, with an edge of the longest side
  /// times (1 + 2 offset). `bounds` in VTK's order. A scene without extent gets a unit edge.
  static Cube FromBounds(const double bounds[6], double offset);

  /// Whether a box (VTK's order) lies strictly inside.
  bool Contains(const double bounds[6]) const;

  glm::dvec3 PointToCube(const glm::dvec3& pointWC) const;
  glm::dvec3 PointToWorld(const glm::dvec3& pointCC) const;
  glm::dvec3 VectorToCube(const glm::dvec3& vectorWC) const;
  glm::dvec3 VectorToWorld(const glm::dvec3& vectorCC) const;

  /// The cube's bounds in the world, in VTK's order.
  void GetBounds(double bounds[6]) const;
};
}

#endif
