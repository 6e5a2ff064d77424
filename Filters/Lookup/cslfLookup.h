// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Finds where a field's samples have what a light ray sees (paper, section 3.4). What they have
 * there, in which channel, is read by cslfChannelReader.h. The functions here and those of
 * cslfLookup.glsl have the same names, without "Lookup" where they belong to a class, and the same
 * results.
 *
 * Points are in the entry face's space (FC). Positions along a ray are inverse fractions: the
 * chord's point at `w` is entry + chord / w, from w = 1 at the exit upwards. Depth is also read as
 * inverse depth: then a plane's depth is linear over a tile, and the image of a ray moves through a
 * view at constant speed.
 */
#ifndef cslfLookup_h
#define cslfLookup_h

#include "Lookup/cslfChannelReader.h"
#include "Lookup/cslfFaceSpace.h"
#include "Lookup/cslfSceneGrid.h"
#include "cslfDescription.h"
#include "cslfViewpointSamples.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <memory>
#include <vector>

class vtkImageData;

namespace cslf
{
/// What a lookup returns: the places where the four views see what the ray sees.
struct LookupResult
{
  std::array<Place, 4> Places;
  glm::dvec4 Weights{ 0.0 }; ///< of the places; 0 for those that do not count

  /// Whether the nearest texel is to be read. Otherwise texels are interpolated.
  bool IsNearest = false;

  /// Where the ray meets the surface, as a fraction of the way from entry to exit, or the best
  /// guess of a lookup that does not know it.
  double Fraction = 1.0;

  bool IsFinal = true; ///< otherwise the ray is left to another lookup
};

/// A point of a field's geometry.
struct GeometryPoint
{
  glm::dvec3 PointCC;
  glm::dvec3 NormalCC; ///< of unit length, on either side
};

/// The texels around a place, in the order of GLSL's textureGather.
constexpr int TexelCorners[4][2] = { { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } };

/// How a view sees a point of the geometry.
struct Sighting
{
  Place At;
  glm::dvec4 Texels{ 0.0 }; ///< the weights of the texels around the place, in the order of
                            ///< TexelCorners, of those that lie on the surface
  double Share = 0.0;       ///< their sum
};

/// Up to four sightings, and their weights.
struct Sightings
{
  std::array<Sighting, 4> All;
  glm::dvec4 Weights{ 0.0 };
  int Count = 0;

  void Add(const Sighting& sighting, double weight);
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

  /// Sets where a geometry is that has only the opaque ones of the scene's surfaces, for
  /// OffSurface.
  void SetSurfaces(const std::shared_ptr<const SurfaceCells>& surfaces);

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

  /// How views see the point of the geometry that a ray meets first: the four around the entry, or,
  /// if they see little of it, others of the entry face, or of other faces among `faces`, one bit
  /// each. Nothing without a depth channel.
  Sightings OnSurface(const RayCoordinates& ray, const GeometryPoint& surface, int faces) const;

  /// What a ray meets that misses a geometry of the opaque surfaces: like DepthCorrected, but only
  /// what is elsewhere and what a viewpoint sees.
  LookupResult OffSurface(const RayCoordinates& ray) const;

  /// The same before a ray meets that geometry, if one of the four viewpoints around the entry sees
  /// it. Otherwise not final.
  LookupResult InFront(const RayCoordinates& ray, const GeometryPoint& surface) const;

  /// The same for points that OnSurface does not see: what is so close to the geometry that it is
  /// not known to be elsewhere.
  LookupResult CloseInFront(const RayCoordinates& ray, const GeometryPoint& surface) const;

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
    Place At;
    double InverseDepth; ///< 1 over the point's chord fraction
  };

  /// The inverse depths of the four texels around a place.
  struct Corners
  {
    glm::dvec2 Weight; ///< of the upper ones
    double D00;
    double D10;
    double D01;
    double D11;
    double Most;
    bool IsEdge; ///< whether they are not on one surface
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

  /// A point of the geometry, in the space of a face.
  struct FacePoint
  {
    int Face;
    glm::dvec3 Point;
    glm::dvec3 Normal; ///< on the eye's side
    glm::dvec3 ToEye;  ///< the direction, of unit length
    glm::dvec2 Entry;  ///< where the ray enters, or the point of the face that is nearest to this
  };

  bool IsKept(int entryFace, int tile) const
  {
    return (this->LeftOut >> ExitFaceOf(entryFace, tile) & 1) == 0;
  }
  bool IsKept(const View& view, const Place& place) const
  {
    return this->Depth.StripOf(view.Slice) >= 0 && this->IsKept(view.Face, place.Tile);
  }
  double FetchInverseDepth(const Place& place, int p, int q) const;
  Corners FetchCorners(const Place& place) const;
  double ReadInverseDepth(const Place& place) const;
  glm::dvec2 ReadSlope(const Place& place) const;

  static Ray ToFaceSpace(const RayCoordinates& ray);
  View MakeView(int face, int i, int j, double weight) const;
  ViewCell MakeCell(const Ray& ray, const NodeBracket& u, const NodeBracket& v) const;
  ViewCell FindViews(const Ray& ray) const;
  ViewCell FindOuterViews(const Ray& ray, int rings) const;
  static ExitFrame FindExit(const View& view, const glm::dvec3& direction, const glm::dvec3& share);
  static Projection Project(const View& view, const glm::dvec3& point);
  double GuessSurface(const Ray& ray, const View& view, double fraction) const;
  static glm::dvec4 ListWeights(const ViewCell& views);
  LookupResult AtPlace(const View& view, const Place& place, double fraction) const;
  LookupResult FindPlaces(const ViewCell& views, const glm::dvec3& point, const glm::dvec4& weights,
    double fraction) const;
  LookupResult LookThrough(const Ray& ray, double fraction) const;

  static SceneGrid::Ray CastGridRay(const SceneGrid& grid, const Ray& ray);
  double Clearance(const View& view, const glm::dvec3& point) const;
  glm::dvec4 Clearances(const Ray& ray, const ViewCell& views, double w, bool all) const;
  double RefineCrossing(const Ray& ray, const View& view, double before, double behind,
    double clearanceBefore, double clearanceBehind) const;
  bool FindStep(const Ray& ray, const ViewCell& views, const SceneGrid::Ray& gridRay,
    const glm::dvec2& range, bool all, Step& step) const;
  glm::dvec3 FindNormal(const View& view, const glm::dvec3& point) const;
  glm::bvec4 SeeEdgeOn(
    const ViewCell& views, const View& view, const glm::dvec3& point, double w) const;
  Surface FindSurface(const Ray& ray, const ViewCell& views, const SceneGrid::Ray& gridRay,
    const glm::dvec2& range, bool all) const;
  LookupResult FindVisible(const Ray& ray, const ViewCell& views, const Surface& surface) const;
  LookupResult Seen(const Ray& ray, const SceneGrid::Ray& gridRay) const;
  void SearchAround(const Ray& ray, const SceneGrid::Ray& gridRay, glm::dvec2 range,
    ViewCell& views, Surface& surface) const;
  Surface FindUnseen(const Ray& ray, const SceneGrid::Ray& gridRay, ViewCell& views) const;

  LookupResult SearchInFront(const Ray& ray, const SceneGrid::Ray& gridRay,
    const GeometryPoint& surface, double reach) const;

  static bool ToFace(
    int face, const GeometryPoint& surface, const glm::dvec3& directionCC, FacePoint& point);
  static double NearnessOf(const glm::dvec2& viewpoint, const FacePoint& surface);
  View FindView(int face, const glm::dvec2& coordinates) const;
  Sighting See(const View& view, const FacePoint& surface) const;
  Sightings SeeFromAround(const ViewCell& views, const FacePoint& surface) const;
  Sightings SeeFromAfar(const FacePoint& surface) const;

  Description Field;
  std::shared_ptr<const SurfaceCells> Surfaces;
  SceneGrid Grid;
  SceneGrid OffSurfaces;    ///< what is not where the surfaces are
  ViewpointSamples Samples; ///< all of the image
  ChannelReader Depth;
  int LeftOut = 0; ///< exit faces, one bit each
};
}

#endif
