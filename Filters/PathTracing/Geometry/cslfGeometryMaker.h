// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Makes a field's geometry: a bounded number of triangles that say where its surfaces are.
 */
#ifndef cslfGeometryMaker_h
#define cslfGeometryMaker_h

#include "vtkCSLFModule.h" // for export macro

#include "Geometry/cslfSurfaceError.h"
#include "Geometry/cslfSurfaceMesh.h"
#include "PathTracing/Scene/cslfScene.h"
#include "Pipeline/cslfPhase.h"
#include "cslfCube.h"
#include "cslfLayout.h"
#include "cslfSurfaceLight.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
struct GeometrySettings
{
  Layout Grid;
  Cube Box;
  SceneFrame Frame;
  std::size_t MaximumTriangles = 0;

  /// Of surfaces that look the same from all directions: colours and triangles follow it. Null for
  /// none: then they follow only surfaces without lighting.
  const StoredLight* Light = nullptr;
  double Exposure = 1.0;
  bool ClampsColors = true; ///< whether colours end at white
  double Tolerance = 0.0;   ///< of sRGB-encoded colours: see SurfaceLightSettings
};

struct Geometry
{
  SurfaceMesh Surface; ///< in scene space

  /// Bodies that are one mesh at many places. They come last in the surface, in their order.
  std::vector<InstanceGroup> Groups;

  /// Of the scene's visible surface, in scene space. What is more than a texel away is lost.
  SurfaceError Error;

  /// Whether it would have more triangles if it might: then its creases are not the scene's.
  bool IsReduced = false;

  /// Those that are known, sRGB-encoded. Empty if none is.
  SideColors Colors;

  SurfaceSides Sides; ///< where others can be seen
};

/// Says in a few words why a scene cannot have a geometry: none of its surfaces is opaque, or there
/// are too many shapes. Empty if it can.
VTKCSLF_EXPORT std::string FindGeometryError(const Scene& scene);

/// How many of a scene's shapes, in all instances, its geometry is without: surfaces that rays may
/// pass would need an order.
struct ShapeCounts
{
  std::size_t Opaque = 0;
  std::size_t Omitted = 0;
};
VTKCSLF_EXPORT ShapeCounts CountShapes(const Scene& scene);

/// The opaque surface of a scene that the viewpoints see, simplified where that moves it by much
/// less than a texel, and further until there are few enough triangles. Large ones are divided
/// again. Nothing if `progress` returns false.
VTKCSLF_EXPORT std::optional<Geometry> MakeGeometry(
  const Scene& scene, const GeometrySettings& settings, const Progress& progress);
}

#endif
