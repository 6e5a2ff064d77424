// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a light ray sees, looked up in the field's samples (paper, section 3.4). The functions here
 * and those of cslfLookup.glsl have the same names and the same results; this side serves tests,
 * analysis, and readers who would rather step through C++.
 *
 * Positions along a ray are inverse fractions: the chord's point at `w` is entry + chord / w, from
 * w = 1 at the exit upwards. Depth is read as inverse depth likewise: in these terms a plane's
 * depth is linear over a tile, and the image of a ray moves through a view at a steady pace.
 */
#ifndef cslfLookup_h
#define cslfLookup_h

#include "cslfDescription.h"

#include <vtkType.h>

#include <glm/vec4.hpp>

#include <vector>

class vtkDataArray;
class vtkImageData;

namespace cslf
{
/// The scene's bounds are widened by this, in CC, so that surfaces on them are crossed.
constexpr double LookupSceneMargin = 0.01;

/// What a lookup returns.
struct LookupResult
{
  /// As encoded in the field, associated alpha.
  glm::dvec4 Color{ 0.0 };
  /// Where the ray meets the surface, as a fraction of the way from entry to exit, or the best
  /// guess of a lookup that does not know.
  double Fraction = 1.0;
};

/// Looks rays up in a field, or in some viewpoints of it, held in memory. Not owning: the image
/// must outlive it.
class VTKCSLF_EXPORT Lookup
{
public:
  /// `image` must hold the whole field that `description` describes.
  Lookup(const Description& description, vtkImageData* image);

  /// `image` holds only the slices listed, in that order. All rays looked up must enter between
  /// those viewpoints.
  Lookup(const Description& description, vtkImageData* image, const std::vector<int>& slices);

  /// Nearest viewpoint, nearest texel.
  LookupResult Nearest(const RayCoordinates& ray) const;

  /// Nearest viewpoint, texels interpolated.
  LookupResult Linear(const RayCoordinates& ray) const;

  /// Viewpoints and texels interpolated: quadrilinear in (u,v,s,t).
  LookupResult Bilinear(const RayCoordinates& ray) const;

  /// The four viewpoints around the entry, each looked up where it sees the point of the ray that
  /// is nearest to the focal point, within the scene's bounds.
  LookupResult Focal(const RayCoordinates& ray, const glm::dvec3& focalPointCC) const;

  /// The four viewpoints around the entry, each looked up where it sees the surface that the ray
  /// meets first, if it sees it. Without a depth channel: as Focal about the cube's centre.
  LookupResult DepthCorrected(const RayCoordinates& ray) const;

private:
  /// One of the viewpoints around a ray's entry.
  struct View
  {
    int Slice;
    int Face;
    glm::dvec3 Position; ///< CC
    double Weight;       ///< bilinear, of (u,v)
    double Slack;        ///< how far along the ray (in w) the view cannot tell points apart
  };

  /// Where a view sees a point, and how deep the point lies there.
  struct Projection
  {
    int Tile;
    glm::dvec2 Coordinates; ///< (s,t) on the tile's exit face
    double InverseDepth;    ///< 1 over the point's chord fraction
  };

  /// A ray and the views around its entry.
  struct RayViews
  {
    glm::dvec3 Entry; ///< CC
    glm::dvec3 Chord; ///< from entry to exit
    View Views[4];
  };

  /// A range of w.
  struct Range
  {
    double Nearest;
    double Farthest;
  };

  /// Where a view's sight of the ray's points ends.
  struct Crossing
  {
    double W = 0.0;         ///< 0 for none
    bool IsSurface = false; ///< otherwise the ray passes behind an edge that hides it
  };

  glm::dvec2 TexelPosition(const glm::dvec2& coordinates) const;
  vtkIdType TexelIndex(int slice, int tile, int p, int q) const;
  glm::dvec4 FetchColor(int slice, int tile, int p, int q) const;
  double FetchInverseDepth(int slice, int tile, int p, int q) const;
  glm::dvec4 ReadNearestColor(int slice, int tile, const glm::dvec2& coordinates) const;
  glm::dvec4 ReadColor(int slice, int tile, const glm::dvec2& coordinates) const;
  double ReadNearestInverseDepth(int slice, int tile, const glm::dvec2& coordinates) const;
  double ReadInverseDepth(int slice, int tile, const glm::dvec2& coordinates) const;

  RayViews FindViews(const RayCoordinates& ray) const;
  static const View& FindNearestView(const RayViews& ray);
  Projection Project(const View& view, const glm::dvec3& pointCC) const;
  double GuessSurface(const RayViews& ray, double fraction) const;
  LookupResult LookThrough(const RayViews& ray, double fraction) const;

  Range ClipToScene(const RayViews& ray) const;
  int CountSteps(const RayViews& ray, const Range& range) const;
  double Clearance(const RayViews& ray, int k, double w) const;
  Crossing RefineCrossing(const RayViews& ray, int k, double behind, double before) const;
  bool IsSeenThrough(const RayViews& ray, int exceptView, double w) const;
  double FindSurface(const RayViews& ray) const;
  glm::dvec4 BlendVisible(const RayViews& ray, double w) const;

  Description Field;
  glm::dvec3 SceneMinimum; ///< CC
  glm::dvec3 SceneMaximum; ///< CC
  std::vector<int> Places; ///< where each slice lies in the arrays
  vtkDataArray* Colors;
  vtkDataArray* Depths;
  double ColorScale;
  double DepthScale;
};
}

#endif
