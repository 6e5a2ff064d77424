// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The depths that viewpoints of a field see.
 */
#ifndef cslfDepthViews_h
#define cslfDepthViews_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfCube.h"
#include "cslfLayout.h"
#include "cslfTileFrame.h"
#include "cslfViewpointSamples.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace cslf
{
/// A place in the strip of a viewpoint.
struct StripPlace
{
  int Tile = 0;
  double X = 0.0; ///< in texels, whose centres have whole numbers
  double Y = 0.0;
  double InverseDepth = 0.0; ///< 1 over the fraction of the chord; above 1 within the cube
};

/// A plane through a point, in CC. All points with dot(Normal, point - Point) = 0.
struct SurfacePlane
{
  glm::dvec3 Point;
  glm::dvec3 Normal; ///< towards the side that is seen; its length does not matter
};

/// What a viewpoint sees of a plane.
struct PlaneSight
{
  bool IsSeen = false;
  double Footprint = 0.0; ///< the area on the plane of the texel that sees it
  double Cosine = 0.0;    ///< between the plane's normal and the direction to the viewpoint
  StripPlace Place;
};

/// Depths of some viewpoints, with 16 bits each. Lengths and areas are in mesh space: CC, with all
/// axes scaled alike, such that the cube's longest edge is that of [-1,1]^3.
class VTKCSLF_EXPORT DepthViews
{
public:
  ///@{
  /// What texels have instead of an inverse depth: nothing there, or not known.
  static constexpr float Nothing = 0.0f;
  static constexpr float Unknown = -1.0f;
  ///@}

  /// Depths of that grid of texels.
  DepthViews(const Layout& grid, const Cube& box);

  /// Adds a viewpoint. The samples may have another resolution.
  void Add(int slice, int resolution, const ViewpointSamples& samples);

  const Layout& GetGrid() const { return this->Grid; }
  const glm::dvec3& GetScale() const { return this->Scale; } ///< from CC to mesh space
  int GetCount() const { return static_cast<int>(this->Slices.size()); }
  int GetSlice(int view) const { return this->Slices[view]; }

  /// The size of a texel at the cube's centre, in mesh space.
  double GetTexel() const { return 1.0 / this->Grid.GetResolution(); }

  /// Nothing, Unknown, or a number of at least 1.
  float GetInverseDepth(int view, int tile, int x, int y) const
  {
    const std::size_t row = static_cast<std::size_t>(y) * this->Grid.GetStripWidth();
    return this->Inverse[this->Depths[view][row + tile * this->Grid.GetResolution() + x]];
  }

  /// Where a viewpoint sees a point in CC. False if it lies on or outside of the viewpoint's face.
  bool Project(int view, const glm::dvec3& point, StripPlace& place) const;

  /// Whether a viewpoint sees that there is no surface at a point in CC: the four texels around it
  /// see something behind it, by more than that distance.
  bool SeesThrough(int view, const glm::dvec3& point, double distance) const;

  /// Whether a viewpoint sees a plane at its point, within that distance.
  PlaneSight See(int view, const SurfacePlane& plane, double distance) const;

  /// The area in mesh space, at an inverse depth, of a tile's texel on the plane of the points with
  /// dot(normal, point - viewpoint) = 1 in CC.
  double FindFootprint(const TileFrame& frame, const glm::dvec3& normal, double inverse) const;

private:
  Layout Grid;
  glm::dvec3 Scale;
  std::vector<float> Inverse; ///< of all codes of depth
  std::vector<int> Slices;
  std::vector<Viewpoint> Viewpoints;
  std::vector<glm::dvec3> Positions; ///< of the viewpoints, in CC
  std::vector<std::vector<unsigned short>> Depths;
};
}

#endif
