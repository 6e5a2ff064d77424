// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Looks up light rays in the field's samples (paper, section 3.4). The functions here and those of
 * cslfLookup.glsl have the same names and the same results. The C++ version is for tests, analysis
 * and debugging.
 *
 * Points are in the entry face's space (FC). Positions along a ray are inverse fractions: the
 * chord's point at `w` is entry + chord / w, from w = 1 at the exit upwards. Depth is also read as
 * inverse depth: then a plane's depth is linear over a tile, and the image of a ray moves through a
 * view at constant speed.
 */
#ifndef cslfLookup_h
#define cslfLookup_h

#include "cslfDescription.h"
#include "cslfSceneGrid.h"

#include <vtkType.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

class vtkDataArray;
class vtkImageData;

namespace cslf
{
/// What a lookup returns.
struct LookupResult
{
  /// As encoded in the field, with associated alpha.
  glm::dvec4 Color{ 0.0 };
  /// Where the ray meets the surface, as a fraction of the way from entry to exit, or the best
  /// guess of a lookup that does not know it.
  double Fraction = 1.0;
};

/// Looks up rays in a field, or in some viewpoints of it, in memory. The image must outlive this
/// object.
class VTKCSLF_EXPORT Lookup
{
public:
  /// `image` must contain the whole field that `description` describes.
  Lookup(const Description& description, vtkImageData* image);

  /// `image` contains only the listed slices, in that order. All rays must enter between those
  /// viewpoints.
  Lookup(const Description& description, vtkImageData* image, const std::vector<int>& slices);

  /// Restricts lookups to the samples that the mapper keeps for a camera outside the cube that sees
  /// these faces, one bit per face: only viewpoints on these faces, and not what these see through
  /// them. No line of sight leaves through such a face, but a viewpoint may see a point of a ray in
  /// front of it. 0 removes the restriction.
  void LeaveOut(int seenFaces);

  /// Nearest viewpoint, nearest texel.
  LookupResult Nearest(const RayCoordinates& ray) const;

  /// Nearest viewpoint, texels interpolated.
  LookupResult Linear(const RayCoordinates& ray) const;

  /// Viewpoints and texels interpolated: quadrilinear in (u,v,s,t).
  LookupResult Bilinear(const RayCoordinates& ray) const;

  /// The four viewpoints around the entry, each looked up at its image of the ray's point nearest
  /// to the focal point, within the scene's bounds.
  LookupResult Focal(const RayCoordinates& ray, const glm::dvec3& focalPointCC) const;

  /// The four viewpoints around the entry, each looked up at its image of the surface that the ray
  /// hits first, if it sees it. If none does, four viewpoints farther away are used. Without a
  /// depth channel: like Focal about the cube's centre.
  LookupResult DepthCorrected(const RayCoordinates& ray) const;

private:
  /// A ray through the cube, in the space of its entry face.
  struct Ray
  {
    int Face;
    glm::dvec3 Entry;
    glm::dvec3 Chord; ///< from entry to exit
  };

  /// One of the viewpoints around a ray's entry.
  struct View
  {
    int Slice;
    int Face;
    glm::dvec2 Position; ///< on the face
    glm::dvec2 InverseToPositive;
    glm::dvec2 InverseToNegative;
    double Weight; ///< bilinear, of (u,v)
  };

  /// The image of a point in a view, and the point's depth there.
  struct Projection
  {
    int Tile;
    glm::dvec2 Coordinates; ///< (s,t) on the tile's exit face
    double InverseDepth;    ///< 1 over the point's chord fraction
  };

  /// The views around a ray's entry: 00, 10, 01 and 11.
  struct ViewCell
  {
    View Views[4]; ///< the nearest, its neighbours along u and v, the opposite one
    double Stride; ///< in w, of the search
  };

  /// A step of the search along a ray. The clearances are those of the four views.
  struct Step
  {
    double Before = 0.0;
    glm::dvec4 ClearancesBefore{ 0.0 };
    double Behind = 0.0;
    glm::dvec4 ClearancesBehind{ 0.0 };
    int Count = 0;            ///< of the steps so far
    double FirstHidden = 0.0; ///< where no view sees the ray's points first; 0: nowhere so far
  };

  /// The hit of a ray.
  struct Surface
  {
    double W = 0.0;          ///< 0: nothing
    glm::dvec4 Sight{ 0.0 }; ///< how well the four views see it, in [0,1]
  };

  /// A range of w.
  struct Range
  {
    double Nearest;
    double Farthest;
  };

  bool IsKept(int entryFace, int tile) const
  {
    return (this->LeftOut >> ExitFaceOf(entryFace, tile) & 1) == 0;
  }
  bool IsKept(const View& view, int tile) const
  {
    return this->Places[view.Slice] >= 0 && this->IsKept(view.Face, tile);
  }
  glm::dvec2 TexelPosition(const glm::dvec2& coordinates) const;
  vtkIdType TexelIndex(int slice, int tile, int p, int q) const;
  glm::dvec4 FetchColor(int slice, int tile, int p, int q) const;
  double FetchInverseDepth(int slice, int tile, int p, int q) const;
  glm::dvec4 ReadNearestColor(int slice, int tile, const glm::dvec2& coordinates) const;
  glm::dvec4 ReadColor(int slice, int tile, const glm::dvec2& coordinates) const;
  double ReadNearestInverseDepth(int slice, int tile, const glm::dvec2& coordinates) const;
  double ReadInverseDepth(int slice, int tile, const glm::dvec2& coordinates) const;

  static Ray ToFaceSpace(const RayCoordinates& ray);
  View MakeView(int face, int i, int j, double weight) const;
  ViewCell MakeCell(const Ray& ray, const NodeBracket& u, const NodeBracket& v) const;
  ViewCell FindViews(const Ray& ray) const;
  ViewCell FindOuterViews(const Ray& ray, int rings) const;
  static Projection Project(const View& view, const glm::dvec3& point);
  double GuessSurface(const Ray& ray, double fraction) const;
  glm::dvec4 ReadColorOf(const View& view, const glm::dvec3& point) const;
  static glm::dvec4 ListWeights(const ViewCell& views);
  glm::dvec4 BlendColors(
    const ViewCell& views, const glm::dvec3& point, const glm::dvec4& weights) const;
  LookupResult LookThrough(const Ray& ray, double fraction) const;

  SceneGrid::Ray CastGridRay(const Ray& ray) const;
  double Clearance(const View& view, const glm::dvec3& point) const;
  glm::dvec4 Clearances(const Ray& ray, const ViewCell& views, double w, bool all) const;
  double RefineCrossing(const Ray& ray, const View& view, double before, double behind,
    double clearanceBefore, double clearanceBehind) const;
  bool FindStep(const Ray& ray, const ViewCell& views, const SceneGrid::Ray& gridRay,
    const Range& range, bool all, Step& step) const;
  Surface FindSurface(const Ray& ray, const ViewCell& views, const SceneGrid::Ray& gridRay,
    const Range& range, bool all) const;
  void SearchAround(const Ray& ray, const SceneGrid::Ray& gridRay, const Range& whole,
    ViewCell& views, Surface& surface) const;
  glm::dvec4 BlendVisible(const Ray& ray, const ViewCell& views, const Surface& surface) const;

  Description Field;
  SceneGrid Grid;
  std::vector<int> Places; ///< the place of each slice in the arrays
  vtkDataArray* Colors;
  vtkDataArray* Depths;
  double ColorScale;
  double DepthScale;
  int LeftOut = 0; ///< exit faces, one bit each
};
}

#endif
