// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Viewpoints whose surfaces are those of a geometry, so that a file needs to contain only the
 * colours that the geometry does not have: readers compute coverage, depth, and the others.
 */
#ifndef cslfGeometryFit_h
#define cslfGeometryFit_h

#include "cslfGeometryTexels.h"
#include "cslfViewpointSamples.h"

#include <cmath>
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
  std::size_t Colored = 0;   ///< whose colour is the geometry's
  std::size_t Compared = 0;  ///< those among them where both have one surface
  double ColorSquares = 0.0; ///< of the differences of these, of all three components, from 0 to 1

  void operator+=(const GeometryFit& other)
  {
    this->Texels += other.Texels;
    this->Wrong += other.Wrong;
    this->Colored += other.Colored;
    this->Compared += other.Compared;
    this->ColorSquares += other.ColorSquares;
  }

  /// From 0 to 1.
  double GetLoss() const
  {
    return this->Texels > 0 ? static_cast<double>(this->Wrong) / static_cast<double>(this->Texels)
                            : 0.0;
  }

  /// The share of the texels whose colour is the geometry's, from 0 to 1.
  double GetColorShare() const
  {
    return this->Texels > 0 ? static_cast<double>(this->Colored) / static_cast<double>(this->Texels)
                            : 0.0;
  }

  /// The root mean square of the differences of colours, from 0 to 1.
  double GetColorError() const
  {
    return this->Compared > 0
      ? std::sqrt(this->ColorSquares / (3.0 * static_cast<double>(this->Compared)))
      : 0.0;
  }
};

/// Changes the colours of a viewpoint to those of the surfaces that a geometry has at the centres
/// of its texels. The samples have 16-bit depth. A texel whose centre lies on another surface, at
/// silhouettes, gets the colour of the nearest texels of the geometry's surface. If `hasCoverage`
/// is set, alpha becomes that of the geometry, 0 or 1, and colours are not multiplied by it: where
/// it is 0, they continue those around, and have no meaning. Otherwise alpha is not changed.
/// Colours that are the geometry's have no meaning either, and continue those around. Depth is not
/// changed.
GeometryFit FitToGeometry(
  int resolution, const DrawnTexels& drawn, bool hasCoverage, const ViewpointSamples& samples);

/// The reader's part: depth and colours become those of the geometry. If `hasCoverage` is set,
/// alpha does, too, and colour 0 where it is 0; otherwise depth is filled where alpha is 0.
void ApplyGeometry(const DrawnTexels& drawn, bool hasCoverage, const ViewpointSamples& samples);
}

#endif
