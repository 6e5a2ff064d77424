// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of polygonal data as a list of numbers.
 */
#ifndef cslfTriangleList_h
#define cslfTriangleList_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <glm/vec3.hpp>

#include <vector>

class vtkPolyData;

namespace cslf
{
/// Whether a point's coordinates are finite numbers that a float can hold.
bool IsFinite(const glm::dvec3& point);

/// A point of a data object.
glm::dvec3 GetPoint(vtkPolyData* data, vtkIdType index);

struct Triangulation
{
  /// The polygons and strips as triangles, with their point and cell data, without vertices and
  /// lines. Points keep their numbers. Where edges of a polygon cross, new points follow them.
  vtkSmartPointer<vtkPolyData> Triangles;
  vtkIdType Filled = 0;      ///< the number of polygons that VTK's triangles do not fill
  vtkIdType NotFinite = 0;   ///< the number of polygons, other than triangles, with such points
  vtkIdType WithoutArea = 0; ///< the number of polygons, other than triangles, without an area
  vtkIdType Tangled = 0;     ///< the number of polygons that would take too long to fill

  vtkIdType CountOmitted() const { return this->NotFinite + this->WithoutArea + this->Tangled; }
};

///@{
/// What is omitted, in words that follow a number.
constexpr const char* NotFinitePolygons = "polygon(s) with coordinates that are not finite";
constexpr const char* NotFiniteRound =
  "line(s) or vertex cell(s) with coordinates that are not finite";
constexpr const char* PolygonsWithoutArea = "polygon(s) without an area";
constexpr const char* TangledPolygons = "polygon(s) with outlines that take too long to fill";
///@}

/// Triangulates polygons and strips. VTK triangulates polygons. Those for which it fails, because
/// they touch or cross themselves, are filled by the even-odd rule. See PolygonFill.
VTKCSLF_EXPORT Triangulation TriangulatePolygons(vtkPolyData* data);

/// The triangles of TriangulatePolygons.
VTKCSLF_EXPORT vtkSmartPointer<vtkPolyData> Triangulate(vtkPolyData* data);

/// The numbers of the points of all triangles, three for each.
VTKCSLF_EXPORT std::vector<unsigned int> ListCorners(vtkPolyData* triangles);
}

#endif
