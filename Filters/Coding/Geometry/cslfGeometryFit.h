// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Viewpoints whose surfaces are those of a geometry, so that a file needs to contain only their
 * colours: readers compute coverage and depth.
 */
#ifndef cslfGeometryFit_h
#define cslfGeometryFit_h

#include "cslfViewpointSamples.h"

#include <cstddef>
#include <vector>

namespace cslf
{
/// How well a geometry tells what viewpoints see.
struct GeometryFit
{
  std::size_t Texels = 0; ///< with a surface
  /// Those among them whose surface the geometry does not have (unless they are at most half
  /// covered and beside a silhouette) or hides, those of the geometry whose colour is not known,
  /// and, inside of its outlines, those that are partly transparent.
  std::size_t Wrong = 0;

  void operator+=(const GeometryFit& other)
  {
    this->Texels += other.Texels;
    this->Wrong += other.Wrong;
  }

  /// From 0 to 1.
  double GetLoss() const
  {
    return this->Texels > 0 ? static_cast<double>(this->Wrong) / static_cast<double>(this->Texels)
                            : 0.0;
  }
};

/// Changes the colours of a viewpoint to those of the surfaces that a geometry has at the centres
/// of its texels. `depths` are the geometry's (see GeometryDepths), the samples have 16-bit depth.
/// A texel whose centre lies on another surface, at silhouettes, gets the colour of the nearest
/// texels of the geometry's surface. If `hasCoverage` is set, alpha becomes that of the geometry, 0
/// or 1, and colours are not multiplied by it: where it is 0, they continue those around, and have
/// no meaning. Otherwise alpha is not changed. Depth is not changed.
GeometryFit FitToGeometry(int resolution, const std::vector<unsigned short>& depths,
  bool hasCoverage, const ViewpointSamples& samples);

/// The reader's part: the samples' depth is that of the geometry. If `hasCoverage` is set, alpha
/// becomes the geometry's, and colour 0 where it is 0; otherwise depth is filled where alpha is 0.
void ApplyGeometry(std::size_t texels, bool hasCoverage, const ViewpointSamples& samples);
}

#endif
