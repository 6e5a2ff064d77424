// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a field shows in some pixels, as the mapper draws it with its default settings.
 */
#ifndef cslfShownPixels_h
#define cslfShownPixels_h

#include "vtkCSLFModule.h" // for export macro

#include "Coding/Geometry/cslfGeometryRays.h"
#include "Pipeline/cslfFieldStream.h"
#include "cslfDescription.h"
#include "cslfPixelBeams.h"

#include <glm/vec4.hpp>

#include <cstddef>
#include <optional>
#include <vector>

class vtkImageData;
class vtkPolyData;

namespace cslf
{
/// Viewpoints that are looked up together, because they fit in memory, and the rays that they
/// suffice for: all, or those that enter a face between two rows of its viewpoints.
struct ViewpointBand
{
  Slab Slices;
  int Face = -1;
  int FirstRow = 0;
  int EndRow = 0;
};

class VTKCSLF_EXPORT ShownPixels
{
public:
  /// Looks up what the geometry alone shows. It may be null, and must outlive this object.
  ShownPixels(const Description& field, vtkPolyData* geometry, const std::vector<PixelBeam>& beams);

  /// The largest size of viewpoints in memory, in bytes.
  static constexpr double LargestBand = 1024.0 * 1024 * 1024;

  /// The viewpoints that the other rays need: all, or so few at a time that they fit.
  std::vector<ViewpointBand> PlanBands(double bytes = LargestBand) const;

  /// Looks up the rays of a band. The image contains at least its slices.
  void LookUp(const ViewpointBand& band, vtkImageData* image);

  /// The colours over black of the pixels as bytes of a display, and alpha: from 0 to 1. When all
  /// bands have been looked up.
  std::vector<glm::dvec4> GetColors() const;

private:
  /// A ray of a pixel that meets the cube.
  struct Ray
  {
    std::size_t Pixel;
    int SeenFaces;
    RayCoordinates Coordinates;
    bool IsKnown = false;
    glm::dvec4 Color{ 0.0 };
  };

  bool IsIn(const ViewpointBand& band, const Ray& ray) const;

  Description Field;
  std::optional<GeometryRays> Surfaces;
  std::size_t Pixels;
  std::vector<Ray> Rays;
};
}

#endif
