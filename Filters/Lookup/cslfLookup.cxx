// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lookup/cslfLookup.h"

#include "Lookup/cslfFaceSpace.h"
#include "Lookup/cslfLookupConstants.h"

#include <vtkImageData.h>
#include <vtkPointData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cslf
{
using namespace lookup;

namespace
{
/// Whether any view knows that a point is hidden, and none sees through it.
bool IsHidden(const glm::dvec4& clearances)
{
  return glm::all(glm::lessThanEqual(clearances, glm::dvec4(0.0))) &&
    glm::any(glm::greaterThan(clearances, glm::dvec4(-Unknown)));
}

/// The views whose sight ends between two points of the ray.
glm::bvec4 EndsOfSight(const glm::dvec4& before, const glm::dvec4& behind)
{
  return glm::greaterThan(glm::dvec4(glm::greaterThan(before, glm::dvec4(0.0))),
    glm::dvec4(glm::greaterThan(behind, glm::dvec4(0.0))));
}

/// The view whose sight ends first between `before` and `behind`.
int ChooseCrossing(const glm::dvec4& before, const glm::dvec4& behind)
{
  const glm::dvec4 share =
    glm::mix(glm::dvec4(-1.0), behind / (behind - before), EndsOfSight(before, behind));
  int first = 0;
  for (int k = 1; k < 4; ++k)
  {
    first = share[k] > share[first] ? k : first;
  }
  return first;
}

/// The range of w in which the scene can lie.
glm::dvec2 FindRange(const SceneGrid::Ray& gridRay)
{
  return 1.0 / glm::max(SceneGrid::ClipToScene(gridRay), 1.0 / NearestStart);
}

/// How well views see a point with these clearances, in [0,1].
glm::dvec4 Nearness(const glm::dvec4& clearances, double w)
{
  return glm::max(glm::dvec4(0.0), 1.0 - glm::abs(clearances) / (SightTolerance * w));
}

std::vector<int> ListSlices(const Layout& grid)
{
  std::vector<int> slices(grid.GetSlices());
  std::iota(slices.begin(), slices.end(), 0);
  return slices;
}
}

Lookup::Lookup(const Description& description, vtkImageData* image)
  : Lookup(description, image, ListSlices(description.Grid))
{
}

Lookup::Lookup(const Description& description, vtkImageData* image, const std::vector<int>& slices)
  : Field(description)
  , Grid(description, image, slices)
  , Samples(image)
  , Depth(description.Grid, this->Samples.GetArray(KnownChannel::Depth), slices)
{
}

void Lookup::SetSurfaces(const std::shared_ptr<const SurfaceCells>& surfaces)
{
  this->Surfaces = surfaces;
  this->LeaveOut(this->LeftOut);
}

void Lookup::LeaveOut(int seenFaces)
{
  this->LeftOut = seenFaces;
  this->Grid = SceneGrid(this->Field);
  this->OffSurfaces = SceneGrid(this->Field, this->Surfaces);
  const auto texels = static_cast<vtkIdType>(this->Field.Grid.GetStripTexels());
  for (int slice = 0; slice < this->Field.Grid.GetSlices(); ++slice)
  {
    const int face = this->Field.Grid.ViewpointOf(slice).Face;
    const int strip = this->Depth.StripOf(slice);
    if (strip >= 0 && (seenFaces == 0 || (seenFaces >> face & 1) != 0))
    {
      int tiles = 0;
      for (int tile = 0; tile < TileCount; ++tile)
      {
        tiles |= this->IsKept(face, tile) ? 1 << tile : 0;
      }
      this->Grid.Add(slice, this->Samples.At(strip * texels), tiles);
      if (this->Surfaces)
      {
        this->OffSurfaces.Add(slice, this->Samples.At(strip * texels), tiles);
      }
    }
  }
  this->Grid.Spread();
  this->OffSurfaces.Spread();
}

//------------------------------------------------------------------------------
// Reading depth

double Lookup::FetchInverseDepth(const Place& place, int p, int q) const
{
  return 1.0 / std::max(this->Depth.FetchNumber(place, p, q), MinimumDepth);
}

Lookup::Corners Lookup::FetchCorners(const Place& place) const
{
  const glm::dvec2 position = this->Depth.TexelPosition(place) - 0.5;
  const glm::ivec2 base(glm::floor(position));
  Corners corners;
  corners.Weight = position - glm::dvec2(base);
  corners.D00 = this->FetchInverseDepth(place, base.x, base.y);
  corners.D10 = this->FetchInverseDepth(place, base.x + 1, base.y);
  corners.D01 = this->FetchInverseDepth(place, base.x, base.y + 1);
  corners.D11 = this->FetchInverseDepth(place, base.x + 1, base.y + 1);
  const double least =
    std::min(std::min(corners.D00, corners.D10), std::min(corners.D01, corners.D11));
  corners.Most = std::max(std::max(corners.D00, corners.D10), std::max(corners.D01, corners.D11));
  corners.IsEdge = corners.Most - least > SurfaceStep * corners.Most;
  return corners;
}

// Within one surface, interpolates, which is exact for planes. Across an edge, takes the nearer
// surface.
double Lookup::ReadInverseDepth(const Place& place) const
{
  const Corners at = this->FetchCorners(place);
  return at.IsEdge ? at.Most
                   : glm::mix(glm::mix(at.D00, at.D10, at.Weight.x),
                       glm::mix(at.D01, at.D11, at.Weight.x), at.Weight.y);
}

// How much the inverse depth of a surface changes with the coordinates; 0 across an edge.
glm::dvec2 Lookup::ReadSlope(const Place& place) const
{
  const Corners at = this->FetchCorners(place);
  const glm::dvec2 slope(at.D10 - at.D00 + at.D11 - at.D01, at.D01 - at.D00 + at.D11 - at.D10);
  return at.IsEdge ? glm::dvec2(0.0) : 0.25 * this->Field.Grid.GetResolution() * slope;
}

//------------------------------------------------------------------------------
// Views

Lookup::Ray Lookup::ToFaceSpace(const RayCoordinates& ray)
{
  const int face = ray.Entry.Face;
  const glm::dvec3 entry(ray.Entry.Coordinates, 0.0);
  const glm::dvec3 exitCC = FaceToCube(ray.Exit.Face, ray.Exit.Coordinates);
  return { face, entry, CubeToFaceSpace(face, exitCC) - entry };
}

Lookup::View Lookup::MakeView(int face, int i, int j, double weight) const
{
  const Layout& grid = this->Field.Grid;
  const glm::dvec2 position(grid.NodeCoordinate(i), grid.NodeCoordinate(j));
  return { grid.SliceOf({ face, i, j }), face, position, InverseToPositive(position),
    InverseToNegative(position), weight };
}

Lookup::ViewCell Lookup::MakeCell(const Ray& ray, const NodeBracket& u, const NodeBracket& v) const
{
  const bool isUpperU = u.Weight > 0.5;
  const bool isUpperV = v.Weight > 0.5;
  const int near[2] = { isUpperU ? u.Upper : u.Lower, isUpperV ? v.Upper : v.Lower };
  const int far[2] = { isUpperU ? u.Lower : u.Upper, isUpperV ? v.Lower : v.Upper };
  const double nearU = std::max(u.Weight, 1.0 - u.Weight);
  const double nearV = std::max(v.Weight, 1.0 - v.Weight);
  ViewCell views;
  views.Views[0] = this->MakeView(ray.Face, near[0], near[1], nearU * nearV);
  views.Views[1] = this->MakeView(ray.Face, far[0], near[1], (1.0 - nearU) * nearV);
  views.Views[2] = this->MakeView(ray.Face, near[0], far[1], nearU * (1.0 - nearV));
  views.Views[3] = this->MakeView(ray.Face, far[0], far[1], (1.0 - nearU) * (1.0 - nearV));
  const double reach = glm::distance(views.Views[3].Position, glm::dvec2(ray.Entry));
  views.Stride =
    std::min(2.0 * TexelsPerStep / (this->Field.Grid.GetResolution() * reach), MaximumStride);
  return views;
}

Lookup::ViewCell Lookup::FindViews(const Ray& ray) const
{
  const Layout& grid = this->Field.Grid;
  return this->MakeCell(ray, grid.FindNodes(ray.Entry.x), grid.FindNodes(ray.Entry.y));
}

// The viewpoints at the corners of that many rings of cells around the inner ones. They may see
// what the inner ones do not.
Lookup::ViewCell Lookup::FindOuterViews(const Ray& ray, int rings) const
{
  const auto widen = [this, rings](double coordinate)
  {
    const Layout& grid = this->Field.Grid;
    NodeBracket nodes = grid.FindNodes(coordinate);
    const double lower = grid.NodeCoordinate(nodes.Lower);
    const double upper = grid.NodeCoordinate(nodes.Upper);
    const double reach = (rings - 0.5) * (upper - lower);
    nodes.Lower = grid.FindNodes(lower - reach).Lower;
    nodes.Upper = grid.FindNodes(upper + reach).Upper;
    const double first = grid.NodeCoordinate(nodes.Lower);
    nodes.Weight = (coordinate - first) / (grid.NodeCoordinate(nodes.Upper) - first);
    return nodes;
  };
  return this->MakeCell(ray, widen(ray.Entry.x), widen(ray.Entry.y));
}

// The exit face that a direction from a view meets.
ExitFrame Lookup::FindExit(const View& view, const glm::dvec3& direction, const glm::dvec3& share)
{
  if (share.x > std::max(share.y, share.z))
  {
    return FindExitFrame(view.Face, 0, direction.x);
  }
  return share.y > share.z ? FindExitFrame(view.Face, 1, direction.y)
                           : FindExitFrame(view.Face, 2, 1.0);
}

Lookup::Projection Lookup::Project(const View& view, const glm::dvec3& point)
{
  const glm::dvec3 direction = point - glm::dvec3(view.Position, 0.0);
  const glm::dvec3 share = ShareOfWays(direction, view.InverseToPositive, view.InverseToNegative);
  const double depth = std::max({ share.x, share.y, share.z, MinimumDepth });
  const ExitFrame frame = FindExit(view, direction, share);
  const glm::dvec3 exit = glm::dvec3(view.Position, -1.0) + direction / depth;
  return { { view.Slice, frame.Tile, { glm::dot(frame.S, exit), glm::dot(frame.T, exit) } },
    1.0 / depth };
}

// The guess of a lookup that does not search: the position along the ray of the surface that a
// view sees in the direction of the ray's point at `fraction`. Without a depth channel, it is that
// point.
double Lookup::GuessSurface(const Ray& ray, const View& view, double fraction) const
{
  if (!this->Samples.GetArray(KnownChannel::Depth))
  {
    return fraction;
  }
  const glm::dvec3 point = ray.Entry + fraction * ray.Chord;
  const Projection seen = Project(view, point);
  const double depth = std::max(this->Depth.ReadNearest(seen.At).x, MinimumDepth);
  const glm::dvec3 viewpoint(view.Position, 0.0);
  const glm::dvec3 surface = viewpoint + (point - viewpoint) * (seen.InverseDepth * depth);
  const double guess =
    std::clamp(glm::dot(surface - ray.Entry, ray.Chord) / glm::dot(ray.Chord, ray.Chord), 0.0, 1.0);
  return this->IsKept(view, seen.At) ? guess : fraction;
}

glm::dvec4 Lookup::ListWeights(const ViewCell& views)
{
  return { views.Views[0].Weight, views.Views[1].Weight, views.Views[2].Weight,
    views.Views[3].Weight };
}

// Where a single view is read.
LookupResult Lookup::AtPlace(const View& view, const Place& place, double fraction) const
{
  LookupResult result;
  result.Places[0] = place;
  result.Weights[0] = this->IsKept(view, place) ? 1.0 : 0.0;
  result.Fraction = fraction;
  return result;
}

// Where the views see a point.
LookupResult Lookup::FindPlaces(
  const ViewCell& views, const glm::dvec3& point, const glm::dvec4& weights, double fraction) const
{
  LookupResult result;
  for (int k = 0; k < 4; ++k)
  {
    const View& view = views.Views[k];
    result.Places[k] = Project(view, point).At;
    result.Weights[k] = this->IsKept(view, result.Places[k]) ? weights[k] : 0.0;
  }
  result.Fraction = fraction;
  return result;
}

LookupResult Lookup::LookThrough(const Ray& ray, double fraction) const
{
  const ViewCell views = this->FindViews(ray);
  return this->FindPlaces(views, ray.Entry + fraction * ray.Chord, ListWeights(views),
    this->GuessSurface(ray, views.Views[0], fraction));
}

//------------------------------------------------------------------------------
// Lookups without depth

LookupResult Lookup::Nearest(const RayCoordinates& ray) const
{
  const Ray rayFC = ToFaceSpace(ray);
  const View view = this->FindViews(rayFC).Views[0];
  const int tile = TileOf(ray.Entry.Face, ray.Exit.Face);
  LookupResult result = this->AtPlace(
    view, { view.Slice, tile, ray.Exit.Coordinates }, this->GuessSurface(rayFC, view, 1.0));
  result.IsNearest = true;
  return result;
}

LookupResult Lookup::Linear(const RayCoordinates& ray) const
{
  const Ray rayFC = ToFaceSpace(ray);
  const View view = this->FindViews(rayFC).Views[0];
  return this->AtPlace(
    view, Project(view, rayFC.Entry + rayFC.Chord).At, this->GuessSurface(rayFC, view, 1.0));
}

LookupResult Lookup::Bilinear(const RayCoordinates& ray) const
{
  return this->LookThrough(ToFaceSpace(ray), 1.0);
}

LookupResult Lookup::Focal(const RayCoordinates& ray, const glm::dvec3& focalPointCC) const
{
  const Ray rayFC = ToFaceSpace(ray);
  const glm::dvec2 range = SceneGrid::ClipToScene(CastGridRay(this->Grid, rayFC));
  if (range.x >= range.y)
  {
    return {};
  }
  const glm::dvec3 focalPoint = CubeToFaceSpace(rayFC.Face, focalPointCC);
  const double fraction =
    glm::dot(focalPoint - rayFC.Entry, rayFC.Chord) / glm::dot(rayFC.Chord, rayFC.Chord);
  return this->LookThrough(rayFC, std::max(NearestFocus, std::clamp(fraction, range.x, range.y)));
}

//------------------------------------------------------------------------------
// Depth-corrected lookup

SceneGrid::Ray Lookup::CastGridRay(const SceneGrid& grid, const Ray& ray)
{
  const glm::dvec3 entryCC = FaceSpaceToCube(ray.Face, ray.Entry);
  const glm::dvec3 exitCC = FaceSpaceToCube(ray.Face, ray.Entry + ray.Chord);
  return grid.CastGridRay(entryCC, exitCC - entryCC);
}

// The distance, in inverse depth, of a point in front of the surface that a view sees in its
// direction: positive if the view sees through the point, negative if it is hidden.
double Lookup::Clearance(const View& view, const glm::dvec3& point) const
{
  const Projection seen = Project(view, point);
  if (!this->IsKept(view, seen.At))
  {
    return seen.InverseDepth - 1.0 / MinimumDepth;
  }
  return seen.InverseDepth - this->ReadInverseDepth(seen.At);
}

// Of the four views. The last one is computed only on request.
glm::dvec4 Lookup::Clearances(const Ray& ray, const ViewCell& views, double w, bool all) const
{
  const glm::dvec3 point = ray.Entry + ray.Chord / w;
  return { this->Clearance(views.Views[0], point), this->Clearance(views.Views[1], point),
    this->Clearance(views.Views[2], point),
    all ? this->Clearance(views.Views[3], point) : NotAsked };
}

// Where a view's sight along the ray ends, between two points with these clearances. Clearance
// along the ray is linear if the surface is flat, so few subdivisions are enough.
double Lookup::RefineCrossing(const Ray& ray, const View& view, double before, double behind,
  double clearanceBefore, double clearanceBehind) const
{
  double w = behind;
  for (int i = 0; i < Refinements; ++i)
  {
    const double share = clearanceBehind / (clearanceBehind - clearanceBefore);
    w = glm::mix(behind, before, std::clamp(share, MinimumShare, 1.0 - MinimumShare));
    const double clearance = this->Clearance(view, ray.Entry + ray.Chord / w);
    if (std::abs(clearance) < Convergence * w)
    {
      break;
    }
    (clearance > 0.0 ? before : behind) = w;
    (clearance > 0.0 ? clearanceBefore : clearanceBehind) = clearance;
  }
  return w;
}

// Continues from `step.Behind` to where any view's sight ends. False if there is no such place.
// Skips cells of the grid without surfaces.
bool Lookup::FindStep(const Ray& ray, const ViewCell& views, const SceneGrid::Ray& gridRay,
  const glm::dvec2& range, bool all, Step& step) const
{
  while (step.Behind > range.y && step.Count < MaximumSteps)
  {
    step.Behind = gridRay.Grid->SkipEmpty(gridRay, step.Behind, range.y);
    if (step.Behind <= range.y)
    {
      break;
    }
    step.ClearancesBehind = this->Clearances(ray, views, step.Behind, all);
    if (step.FirstHidden == 0.0 && IsHidden(step.ClearancesBehind))
    {
      step.FirstHidden = step.Behind;
    }
    bool inside = true;
    while (inside)
    {
      step.Before = step.Behind;
      step.ClearancesBefore = step.ClearancesBehind;
      const double stride = std::max(views.Stride, StepShare * step.Before);
      step.Behind = std::max(step.Before - stride, range.y);
      step.ClearancesBehind = this->Clearances(ray, views, step.Behind, all);
      ++step.Count;
      if (glm::any(EndsOfSight(step.ClearancesBefore, step.ClearancesBehind)))
      {
        return true;
      }
      inside = step.Behind > range.y && step.Count < MaximumSteps &&
        gridRay.Grid->IsOccupied(gridRay, step.Behind);
    }
  }
  return false;
}

// The normal of the surface that a view sees at a point, divided by the distance of its plane from
// the viewpoint: the inverse depth at an exit is the product of this and the way to the exit.
glm::dvec3 Lookup::FindNormal(const View& view, const glm::dvec3& point) const
{
  const glm::dvec3 way = point - glm::dvec3(view.Position, 0.0);
  const ExitFrame frame =
    FindExit(view, way, ShareOfWays(way, view.InverseToPositive, view.InverseToNegative));
  const glm::dvec2 slope = this->ReadSlope(Project(view, point).At);
  const glm::dvec3 normal = slope.x * frame.S + slope.y * frame.T;
  const glm::dvec3 outward = glm::cross(frame.S, frame.T);
  return normal + (1.0 - glm::dot(normal, way)) / glm::dot(outward, way) * outward;
}

// The views whose viewpoint lies within a texel of the plane of the surface that `view` sees at a
// point. The surface may be too thin in their images to show.
glm::bvec4 Lookup::SeeEdgeOn(
  const ViewCell& views, const View& view, const glm::dvec3& point, double w) const
{
  const glm::dvec3 normal = this->FindNormal(view, point);
  const double texel = 2.0 / (this->Field.Grid.GetResolution() * w);
  glm::bvec4 edgeOn;
  for (int k = 0; k < 4; ++k)
  {
    const double distance = glm::dot(normal, glm::dvec3(views.Views[k].Position, 0.0) - point);
    edgeOn[k] = std::abs(distance) < EdgeOnTexels * texel * glm::length(normal);
  }
  return edgeOn;
}

// Free-space voting: the first point at which a view's sight along the ray ends on a surface and
// that no view sees through. If there is none, the first point that no view sees. Otherwise the
// surface that is least seen through, if it is nearly one, because texels that are coarse for the
// scene have larger errors than coded depth. Otherwise 0, or where the ray leaves the cube, if it
// may show the environment. Steps are taken by all four views, or by the three nearest, which is
// nearly as good and takes less time.
Lookup::Surface Lookup::FindSurface(const Ray& ray, const ViewCell& views,
  const SceneGrid::Ray& gridRay, const glm::dvec2& range, bool all) const
{
  Step step;
  step.Behind = range.x;
  Surface doubtful;
  double least = DoubtTexels / this->Field.Grid.GetResolution();
  for (int i = 0; i < MaximumCandidates && this->FindStep(ray, views, gridRay, range, all, step);
       ++i)
  {
    const int k = ChooseCrossing(step.ClearancesBefore, step.ClearancesBehind);
    const double w = this->RefineCrossing(ray, views.Views[k], step.Before, step.Behind,
      step.ClearancesBefore[k], step.ClearancesBehind[k]);
    const glm::dvec4 clearances = this->Clearances(ray, views, w, true);
    const double most = std::max({ clearances.x, clearances.y, clearances.z, clearances.w }) / w;
    bool isSeenThrough = most > ClearanceTolerance;
    const bool isSurface = std::abs(clearances[k]) < EdgeStep * w;
    const glm::dvec4 near = Nearness(clearances, w);
    if (isSurface && most < least)
    {
      least = most;
      doubtful = { w, near };
    }
    if (isSurface && isSeenThrough)
    {
      const glm::bvec4 edgeOn =
        this->SeeEdgeOn(views, views.Views[k], ray.Entry + ray.Chord / w, w);
      isSeenThrough = false;
      for (int other = 0; other < 4; ++other)
      {
        isSeenThrough |= clearances[other] > ClearanceTolerance * w && !edgeOn[other];
      }
    }
    if (!isSeenThrough && isSurface)
    {
      // The other side of a thin sheet is not the ray's: there, clearance grows along the ray.
      glm::dvec4 before = step.ClearancesBefore;
      if (!all)
      {
        before.w = this->Clearance(views.Views[3], ray.Entry + ray.Chord / step.Before);
      }
      return { w, near * glm::dvec4(glm::lessThan(clearances, before)) };
    }
    const bool isKnown = glm::any(glm::greaterThan(clearances, glm::dvec4(-Unknown)));
    if (!isSeenThrough && isKnown && step.FirstHidden == 0.0)
    {
      step.FirstHidden = w;
    }
    step.Behind = w - RestartShare * views.Stride;
  }
  if (step.FirstHidden > 0.0)
  {
    return { step.FirstHidden, glm::dvec4(0.0) };
  }
  if (doubtful.W == 0.0 && this->Field.MayShowEnvironment())
  {
    return { 1.0, Nearness(this->Clearances(ray, views, 1.0, true), 1.0) };
  }
  return doubtful;
}

// Where the views see the surface of a ray: those that see it from the ray's side; if there are
// none, all.
LookupResult Lookup::FindVisible(
  const Ray& ray, const ViewCell& views, const Surface& surface) const
{
  const glm::dvec4 weights = ListWeights(views);
  const glm::dvec4 visible = (weights + MinimumWeight) * surface.Sight;
  const double sum = visible.x + visible.y + visible.z + visible.w;
  return this->FindPlaces(
    views, ray.Entry + ray.Chord / surface.W, sum > 0.0 ? visible / sum : weights, 1.0 / surface.W);
}

// With the three nearest views. Not final if none of the four sees the surface.
LookupResult Lookup::Seen(const Ray& ray, const SceneGrid::Ray& gridRay) const
{
  const ViewCell views = this->FindViews(ray);
  const Surface surface = this->FindSurface(ray, views, gridRay, FindRange(gridRay), false);
  if (surface.W == 0.0)
  {
    return {};
  }
  LookupResult result = this->FindVisible(ray, views, surface);
  result.IsFinal = surface.Sight != glm::dvec4(0.0);
  return result;
}

// Viewpoints farther and farther away may see what the four views do not.
void Lookup::SearchAround(const Ray& ray, const SceneGrid::Ray& gridRay, glm::dvec2 range,
  ViewCell& views, Surface& surface) const
{
  // Starts one step earlier, where the outer ones may see the surface at once. A surface that they
  // find in front of the hidden point is a silhouette, which the inner ones show better.
  const double hidden = surface.W;
  range.x = std::min(hidden + std::max(views.Stride, StepShare * hidden), range.x);
  const glm::bvec4 isKnown =
    glm::greaterThan(this->Clearances(ray, views, hidden, true), glm::dvec4(-Unknown));
  const double known = glm::dot(glm::dvec4(isKnown), ListWeights(views));
  const glm::dvec2 size = glm::abs(views.Views[3].Position - views.Views[0].Position);
  const int cells =
    known > KnownShare ? static_cast<int>(std::lround(2.0 / std::min(size.x, size.y))) : 0;
  for (int rings = 1; surface.Sight == glm::dvec4(0.0) && rings < cells; rings = 2 * rings + 1)
  {
    const ViewCell outer = this->FindOuterViews(ray, rings);
    const Surface seen = this->FindSurface(ray, outer, gridRay, range, true);
    if (seen.W < hidden && glm::any(glm::greaterThan(seen.Sight, glm::dvec4(OuterSight))))
    {
      surface = seen;
      views = outer;
    }
  }
}

// For rays that Seen leaves: with all four views, then with those farther around.
Lookup::Surface Lookup::FindUnseen(
  const Ray& ray, const SceneGrid::Ray& gridRay, ViewCell& views) const
{
  const glm::dvec2 range = FindRange(gridRay);
  views = this->FindViews(ray);
  Surface surface = this->FindSurface(ray, views, gridRay, range, true);
  if (surface.W > 0.0)
  {
    this->SearchAround(ray, gridRay, range, views, surface);
  }
  return surface;
}

LookupResult Lookup::DepthCorrected(const RayCoordinates& ray) const
{
  if (!this->Samples.GetArray(KnownChannel::Depth))
  {
    return this->Focal(ray, glm::dvec3(0.0));
  }
  const Ray rayFC = ToFaceSpace(ray);
  const SceneGrid::Ray gridRay = CastGridRay(this->Grid, rayFC);
  const LookupResult result = this->Seen(rayFC, gridRay);
  if (result.IsFinal)
  {
    return result;
  }
  ViewCell views;
  const Surface surface = this->FindUnseen(rayFC, gridRay, views);
  return surface.W > 0.0 ? this->FindVisible(rayFC, views, surface) : LookupResult();
}

//------------------------------------------------------------------------------
// What a geometry of the opaque surfaces lacks

LookupResult Lookup::OffSurface(const RayCoordinates& ray) const
{
  const Ray rayFC = ToFaceSpace(ray);
  const SceneGrid::Ray gridRay = CastGridRay(this->OffSurfaces, rayFC);
  const LookupResult result = this->Seen(rayFC, gridRay);
  if (result.IsFinal)
  {
    return result;
  }
  const bool showsEnvironment = this->Field.MayShowEnvironment();
  ViewCell views;
  const Surface surface =
    this->FindUnseen(rayFC, showsEnvironment ? CastGridRay(this->Grid, rayFC) : gridRay, views);
  return showsEnvironment || surface.Sight != glm::dvec4(0.0)
    ? this->FindVisible(rayFC, views, surface)
    : LookupResult();
}

LookupResult Lookup::InFront(const RayCoordinates& ray, const GeometryPoint& surface) const
{
  const Ray rayFC = ToFaceSpace(ray);
  return this->SearchInFront(
    rayFC, CastGridRay(this->OffSurfaces, rayFC), surface, glm::length(rayFC.Chord));
}

LookupResult Lookup::CloseInFront(const RayCoordinates& ray, const GeometryPoint& surface) const
{
  const Ray rayFC = ToFaceSpace(ray);
  return this->SearchInFront(rayFC, CastGridRay(this->Grid, rayFC), surface,
    CloseTexels * 2.0 / this->Field.Grid.GetResolution());
}

// What a ray meets before a point of the geometry, at most that far from it.
LookupResult Lookup::SearchInFront(
  const Ray& ray, const SceneGrid::Ray& gridRay, const GeometryPoint& surface, double reach) const
{
  const glm::dvec3 way = CubeToFaceSpace(ray.Face, surface.PointCC) - ray.Entry;
  const double length = glm::length(ray.Chord);
  const double fraction =
    std::max(glm::dot(way, ray.Chord) / (length * length), 1.0 / NearestStart);
  glm::dvec2 range = FindRange(gridRay);
  range.x = std::min(range.x, 1.0 / std::max(fraction - reach / length, 1.0 / NearestStart));
  range.y = std::max(range.y, (1.0 + FrontMargin) / fraction);
  LookupResult result;
  result.IsFinal = false;
  if (range.x > range.y)
  {
    const ViewCell views = this->FindViews(ray);
    const Surface found = this->FindSurface(ray, views, gridRay, range, false);
    // Neither a hidden point nor a doubtful one.
    if (found.W > range.y && found.Sight != glm::dvec4(0.0) &&
      glm::all(glm::lessThan(
        this->Clearances(ray, views, found.W, true), glm::dvec4(ClearanceTolerance * found.W))))
    {
      result = this->FindVisible(ray, views, found);
    }
  }
  return result;
}
}
