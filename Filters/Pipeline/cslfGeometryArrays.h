// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The arrays of a light field's geometry.
 */
#ifndef cslfGeometryArrays_h
#define cslfGeometryArrays_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfCube.h"

#include <vtkType.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace cslf
{
/// Point data: the colour of the side where the corners of polygons run clockwise. `Color` is that
/// of the other side, and of both if there is no such array.
constexpr const char* BackColorName = "BackColor";

/// Point data, two unsigned characters: above 0 where the colour of the front, and that of the
/// back, alone shows the surface around the point well, from all directions, so that no viewpoint
/// is asked. Above 1 it also tells how much brighter the surface is than the colour, which ends at
/// white: see ToExactCode.
constexpr const char* ExactColorName = "ExactColor";

/// 1 and 8 for each doubling, rounded. Of a surface that is brighter by this factor, at least 1.
unsigned char VTKCSLF_EXPORT ToExactCode(double brightness);

/// Point data, an unsigned character: 0, or the number, from 1, of the map by which scalars give
/// the surface around the point its colours. See cslfColorMap.h.
constexpr const char* ColorMapName = "CSLF:ColorMap";

///@{
/// Point data of three floats, for points with a map: the light that leaves the surface in all
/// directions, if its map gave white, times exposure, linear; on the front, and on the back if it
/// differs.
constexpr const char* LightName = "CSLF:Light";
constexpr const char* BackLightName = "CSLF:BackLight";
///@}

///@{
/// Field data: a text of JSON for each map, with the name of the array of scalars among the point
/// data; and the colours of all maps, of four unsigned characters: each has those below its range,
/// within it in equal steps, above it, and of what is not a number.
constexpr const char* ColorMapsName = "CSLF:ColorMaps";
constexpr const char* ColorMapColorsName = "CSLF:ColorMapColors";
constexpr const char* ColorMapImagesName = "CSLF:ColorMapImages"; ///< bytes of encoded images
///@}

/// Field data: the names of the arrays of point data that surfaces have beside the scalars that
/// gave them their colours. See cslfSurfaceArray.h.
constexpr const char* SurfaceArraysName = "CSLF:Arrays";

/// Field data: those of them whose values were integers, though there may be others between points
/// of different ones.
constexpr const char* IntegerArraysName = "CSLF:IntegerArrays";

/// Point data of a block of a scene: the scalars that its map, in the field data above, gave their
/// colours.
constexpr const char* MapScalarName = "CSLF:MapScalar";

/// A number: the root mean square distance, in world coordinates, of the scene's visible surfaces
/// from the geometry, without those that it lost.
constexpr const char* GeometryErrorName = "GeometryError";

/// A number: the share of the scene's visible surfaces that the geometry lost, because it is more
/// than a texel away.
constexpr const char* GeometryLossName = "GeometryLoss";

/// A number that takes the place of the loss if the geometry has only the surfaces that are opaque
/// and visible from both sides: the share of these that it lost. The scene has others as well.
constexpr const char* GeometryOpaqueLossName = "GeometryOpaqueLoss";

/// A geometry that lost more than this share is not complete: what misses it may be a surface.
constexpr double MaximumLossIfComplete = 0.01;

/// A geometry that lost more than this is not looked up, because views with depth alone are better.
constexpr double MaximumUsefulLoss = 0.2;

/// A text: the hash of the scene that is also in the description of its fields.
constexpr const char* GeometrySceneName = "GeometryScene";

/// Field data of four integers for each group of bodies that are one mesh, the prototype, at
/// several places: the points and triangles of the prototype, the number of bodies, and 1 if the
/// prototype stands for the unit sphere, otherwise 0. The bodies come last among the points and the
/// triangles, in the order of the groups, and each has its points and triangles in the order of the
/// prototype's.
constexpr const char* GeometryGroupsName = "GeometryGroups";

///@{
/// Field data: the points of all prototypes, and for each body the matrix of 3 x 4 numbers, row by
/// row, that takes them to world coordinates.
constexpr const char* GeometryPrototypesName = "GeometryPrototypes";
constexpr const char* GeometryPlacementsName = "GeometryPlacements";
///@}

/// A group of bodies.
struct BodyGroupData
{
  std::vector<glm::dvec3> Prototype;
  std::size_t Triangles = 0;                    ///< of the prototype
  std::vector<std::array<double, 12>> Matrices; ///< of each body, row by row
  bool AreBalls = false;
  std::size_t FirstPoint = 0; ///< of the geometry
  std::size_t FirstTriangle = 0;
};

/// The groups that the field data of a geometry with that many points and triangles tells of; none
/// if it does not fit. It is not checked that points and triangles are where it says.
std::vector<BodyGroupData> VTKCSLF_EXPORT ListBodyGroups(
  vtkPolyData* geometry, std::size_t points, std::size_t triangles);

/// A text: the description of the field in the file beside which the tool wrote the geometry.
constexpr const char* GeometryFieldName = "GeometryField";

/// The colours of a geometry's points. Null where there is none.
struct PointColorArrays
{
  vtkDataArray* Front = nullptr;
  vtkDataArray* Back = nullptr;
  vtkDataArray* Exact = nullptr;

  /// Whether the colour on a side is exact.
  bool IsExact(vtkIdType point, bool isBack) const { return this->GetCode(point, isBack) > 0.0; }

  /// How much brighter the surface is than that, at least 1.
  double VTKCSLF_EXPORT GetBrightness(vtkIdType point, bool isBack) const;

  /// ToExactCode, or 0.
  double VTKCSLF_EXPORT GetCode(vtkIdType point, bool isBack) const;
};

/// The point data `Color` and `BackColor`, if each point has four components, and `ExactColor`. The
/// second counts only if it has the type of the first, the third only beside the first.
PointColorArrays VTKCSLF_EXPORT FindPointColors(vtkPolyData* geometry);

///@{
/// The distance of a geometry from the surfaces and the share of them that it lost, if it says so.
/// Of the opaque ones, if it has only these.
std::optional<double> VTKCSLF_EXPORT GetGeometryError(vtkPolyData* geometry);
std::optional<double> VTKCSLF_EXPORT GetGeometryLoss(vtkPolyData* geometry);
///@}

/// Whether a geometry has only the opaque ones of the scene's surfaces: rays may meet others before
/// it.
bool VTKCSLF_EXPORT IsOpaqueGeometry(vtkPolyData* geometry);

/// Whether a geometry has all surfaces, as far as it says so: rays that miss it see none.
bool VTKCSLF_EXPORT IsCompleteGeometry(vtkPolyData* geometry);

/// Whether a geometry has polygons, and did not lose too much.
bool VTKCSLF_EXPORT IsUsefulGeometry(vtkPolyData* geometry);

/// Says in one line why polygons cannot be the geometry of a field with this cube. Empty if they
/// can: cells name points that exist, and lie in the cube.
std::string VTKCSLF_EXPORT DescribeGeometryError(vtkPolyData* geometry, const Cube& box);

/// A warning if a geometry that may have so many triangles is empty or lost too much, or nothing.
std::string VTKCSLF_EXPORT DescribeGeometryLoss(vtkPolyData* geometry, vtkIdType mostTriangles);
}

#endif
