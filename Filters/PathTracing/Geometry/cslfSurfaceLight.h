// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that leaves a field's geometry, as colours of its points, for surfaces that look the
 * same from all directions.
 */
#ifndef cslfSurfaceLight_h
#define cslfSurfaceLight_h

#include "vtkCSLFModule.h" // for export macro

#include "Geometry/cslfSideColors.h"
#include "Geometry/cslfSurfaceMesh.h"
#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Scene/cslfScene.h"
#include "Pipeline/cslfPhase.h"
#include "cslfSurfaceRegions.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/// A side of a surface: the points without a colour that can be seen, and rays that meet them. All
/// rays of a grid are alike.
struct SurfaceSide
{
  std::vector<std::size_t> Points;
  std::vector<RayGrid> Rays;
};

/// The front, where corners run counterclockwise, and the back.
using SurfaceSides = std::array<SurfaceSide, 2>;

struct SurfaceLightSettings
{
  const SurfaceRegions* Regions = nullptr; ///< of the scene
  float Texel = 0.0f;                      ///< at the cube's centre, in scene space
  double Exposure = 1.0;                   ///< the colours are those of radiance times this
  bool ClampsColors = true;                ///< whether colours end at white
  bool HasCreases = true; ///< whether the mesh is so fine that its creases are the scene's
  bool KeepsMesh = false; ///< whether its triangles and points stay as they are
  double Tolerance = 0.0; ///< the RMS error of a triangle's colours that is small enough
  std::size_t MaximumTriangles = 0;
  std::vector<std::uint32_t> Sources; ///< of kept triangles, the mesh to which each belongs
};

/// Fits colours to what samples of the surface show, see ColorFit, and divides its triangles along
/// the edges of shadows and of colours, down to texels. Samples that cannot be seen, such as those
/// below another body, hardly count. Points that no sample with stored light is near get no colour.
/// Colours are sRGB-encoded. The light may be null: then only surfaces without lighting have
/// colours, and there are none at all without such. If colours are clamped, surfaces whose colours
/// a map tells have light, and places on it. The mesh must be welded. Throws Aborted.
SideColors FitLight(const Scene& scene, const StoredLight* light,
  const SurfaceLightSettings& settings, const Progress& progress, SurfaceMesh& mesh);

/// Finds the sides of points that can be seen and have no colours, and rays that start close
/// to them, given the size of texels at the cube's centre. Where bodies are thin, rays to the back
/// meet the opposite wall, from its front. Throws Aborted.
void FindSides(const Scene& scene, float texel, const SurfaceMesh& mesh, const Progress& progress,
  const SideColors& colors, SurfaceSides& sides);
}

#endif
