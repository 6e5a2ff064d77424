// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLookup.h"

#include "cslfFaceSpace.h"

#include <vtkDataArray.h>
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
namespace
{
// These constants are also defined in cslfLookup.glsl.

/// Smaller differences of depth, as a fraction of a chord, are ignored.
constexpr double LeastDepth = 1.0 / 4096.0;
/// Neighbouring texels are on one surface if their inverse depths differ by less than this share.
constexpr double SurfaceStep = 0.1;
/// The search starts no closer to the entry than this inverse fraction.
constexpr double NearestStart = 40.0;
/// The smallest fraction of the chord at which the focal lookup looks.
constexpr double NearestFocus = 0.05;
/// The most texels by which a view's image of the ray moves in a step of the search, unless the
/// step is smaller than a share of w.
constexpr double TexelsPerStep = 3.0;
constexpr double StepShare = 0.08;
/// The largest step in w.
constexpr double MostStride = 0.5;
constexpr int MostSteps = 96;
/// The number of ends of sight along a ray that are examined.
constexpr int MostCandidates = 16;
/// Subdivisions of a step with a crossing: each keeps at least a share of the step, and they end
/// when the clearance is less than a share of w.
constexpr int Refinements = 12;
constexpr double LeastShare = 0.02;
constexpr double Convergence = 0.0005;
/// The search continues behind a crossing that is not a surface by this share of a stride.
constexpr double RestartShare = 0.02;
/// A crossing where the clearance jumps by more than this share of w is an edge, not a surface.
constexpr double EdgeStep = 0.03;
/// A view sees through points whose clearance exceeds this share of w; the error of coded depth is
/// smaller.
constexpr double ClearanceTolerance = 0.05;
/// A view colours points within this share of w of the surface it sees.
constexpr double SightTolerance = 0.1;
/// Viewpoints farther away than the four around a ray must see a surface at least this well, out of
/// 1, because nothing else corrects their errors.
constexpr double OuterSight = 0.97;
/// They are used if the views of the four that know the hidden point have more than this share of
/// the weights. The others lack its tile, and might see the surface.
constexpr double KnownShare = 0.7;
/// Prevents a ray through a viewpoint from depending only on that viewpoint.
constexpr double LeastWeight = 0.0001;

/// If nothing else is found, the largest share of w by which a surface may be seen through, in
/// texels.
constexpr double DoubtTexels = 8.0;
/// A view with a missing tile has a clearance below minus this.
constexpr double Unknown = 2000.0;
/// The clearance of a view that is not used.
constexpr double NotAsked = -2.0 * Unknown;

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
  , Places(description.Grid.GetSlices(), -1)
  , Colors(image->GetPointData()->GetArray(ColorName))
  , Depths(image->GetPointData()->GetArray(DepthName))
  , ColorScale(this->Colors->GetDataType() == VTK_UNSIGNED_CHAR ? 1.0 / 255.0 : 1.0)
  , DepthScale(
      this->Depths && this->Depths->GetDataType() == VTK_UNSIGNED_SHORT ? 1.0 / 65535.0 : 1.0)
{
  for (std::size_t place = 0; place < slices.size(); ++place)
  {
    this->Places[slices[place]] = static_cast<int>(place);
  }
}

void Lookup::LeaveOut(int seenFaces)
{
  this->LeftOut = seenFaces;
  this->Grid = SceneGrid(this->Field);
  ViewpointSamples samples;
  samples.Color = this->Colors;
  samples.Depth = this->Depths;
  const vtkIdType texels =
    static_cast<vtkIdType>(this->Field.Grid.GetStripWidth()) * this->Field.Grid.GetResolution();
  for (int slice = 0; slice < this->Field.Grid.GetSlices(); ++slice)
  {
    const int face = this->Field.Grid.ViewpointOf(slice).Face;
    if (this->Places[slice] >= 0 && (seenFaces == 0 || (seenFaces >> face & 1) != 0))
    {
      int tiles = 0;
      for (int tile = 0; tile < TileCount; ++tile)
      {
        tiles |= this->IsKept(face, tile) ? 1 << tile : 0;
      }
      samples.First = this->Places[slice] * texels;
      this->Grid.Add(slice, samples, tiles);
    }
  }
  this->Grid.Spread();
}

//------------------------------------------------------------------------------
// Reading texels

glm::dvec2 Lookup::TexelPosition(const glm::dvec2& coordinates) const
{
  return 0.5 * (coordinates + 1.0) * static_cast<double>(this->Field.Grid.GetResolution());
}

vtkIdType Lookup::TexelIndex(int slice, int tile, int p, int q) const
{
  const int resolution = this->Field.Grid.GetResolution();
  const vtkIdType row =
    static_cast<vtkIdType>(this->Places[slice]) * resolution + std::clamp(q, 0, resolution - 1);
  return row * this->Field.Grid.GetStripWidth() + tile * resolution +
    std::clamp(p, 0, resolution - 1);
}

glm::dvec4 Lookup::FetchColor(int slice, int tile, int p, int q) const
{
  double color[4];
  this->Colors->GetTuple(this->TexelIndex(slice, tile, p, q), color);
  return this->ColorScale * glm::dvec4(color[0], color[1], color[2], color[3]);
}

double Lookup::FetchInverseDepth(int slice, int tile, int p, int q) const
{
  const double depth =
    this->DepthScale * this->Depths->GetComponent(this->TexelIndex(slice, tile, p, q), 0);
  return 1.0 / std::max(depth, LeastDepth);
}

glm::dvec4 Lookup::ReadNearestColor(int slice, int tile, const glm::dvec2& coordinates) const
{
  const glm::ivec2 texel(glm::floor(this->TexelPosition(coordinates)));
  return this->FetchColor(slice, tile, texel.x, texel.y);
}

glm::dvec4 Lookup::ReadColor(int slice, int tile, const glm::dvec2& coordinates) const
{
  const glm::dvec2 position = this->TexelPosition(coordinates) - 0.5;
  const glm::ivec2 base(glm::floor(position));
  const glm::dvec2 weight = position - glm::dvec2(base);
  return glm::mix(glm::mix(this->FetchColor(slice, tile, base.x, base.y),
                    this->FetchColor(slice, tile, base.x + 1, base.y), weight.x),
    glm::mix(this->FetchColor(slice, tile, base.x, base.y + 1),
      this->FetchColor(slice, tile, base.x + 1, base.y + 1), weight.x),
    weight.y);
}

double Lookup::ReadNearestInverseDepth(int slice, int tile, const glm::dvec2& coordinates) const
{
  const glm::ivec2 texel(glm::floor(this->TexelPosition(coordinates)));
  return this->FetchInverseDepth(slice, tile, texel.x, texel.y);
}

// Within one surface, interpolates, which is exact for planes. Across an edge, takes the nearer
// surface.
double Lookup::ReadInverseDepth(int slice, int tile, const glm::dvec2& coordinates) const
{
  const glm::dvec2 position = this->TexelPosition(coordinates) - 0.5;
  const glm::ivec2 base(glm::floor(position));
  const glm::dvec2 weight = position - glm::dvec2(base);
  const double d00 = this->FetchInverseDepth(slice, tile, base.x, base.y);
  const double d10 = this->FetchInverseDepth(slice, tile, base.x + 1, base.y);
  const double d01 = this->FetchInverseDepth(slice, tile, base.x, base.y + 1);
  const double d11 = this->FetchInverseDepth(slice, tile, base.x + 1, base.y + 1);
  const double least = std::min(std::min(d00, d10), std::min(d01, d11));
  const double most = std::max(std::max(d00, d10), std::max(d01, d11));
  if (most - least > SurfaceStep * most)
  {
    return most;
  }
  return glm::mix(glm::mix(d00, d10, weight.x), glm::mix(d01, d11, weight.x), weight.y);
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
    std::min(2.0 * TexelsPerStep / (this->Field.Grid.GetResolution() * reach), MostStride);
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

Lookup::Projection Lookup::Project(const View& view, const glm::dvec3& point)
{
  const glm::dvec3 direction = point - glm::dvec3(view.Position, 0.0);
  const glm::dvec3 share = ShareOfWays(direction, view.InverseToPositive, view.InverseToNegative);
  const double depth = std::max({ share.x, share.y, share.z, LeastDepth });
  int axis = 2;
  double sign = 1.0;
  if (share.x > std::max(share.y, share.z))
  {
    axis = 0;
    sign = direction.x;
  }
  else if (share.y > share.z)
  {
    axis = 1;
    sign = direction.y;
  }
  const ExitFrame frame = FindExitFrame(view.Face, axis, sign);
  const glm::dvec3 exit = glm::dvec3(view.Position, -1.0) + direction / depth;
  return { frame.Tile, { glm::dot(frame.S, exit), glm::dot(frame.T, exit) }, 1.0 / depth };
}

// The guess of a lookup that does not search: the position along the ray of the surface that the
// nearest view sees in the direction of the ray's point at `fraction`. Without a depth channel, it
// is that point.
double Lookup::GuessSurface(const Ray& ray, double fraction) const
{
  if (!this->Depths)
  {
    return fraction;
  }
  const View view = this->FindViews(ray).Views[0];
  const glm::dvec3 point = ray.Entry + fraction * ray.Chord;
  const Projection seen = Project(view, point);
  const glm::dvec3 viewpoint(view.Position, 0.0);
  const glm::dvec3 surface = viewpoint +
    (point - viewpoint) * seen.InverseDepth /
      this->ReadNearestInverseDepth(view.Slice, seen.Tile, seen.Coordinates);
  const double guess =
    std::clamp(glm::dot(surface - ray.Entry, ray.Chord) / glm::dot(ray.Chord, ray.Chord), 0.0, 1.0);
  return this->IsKept(view.Face, seen.Tile) ? guess : fraction;
}

glm::dvec4 Lookup::ReadColorOf(const View& view, const glm::dvec3& point) const
{
  const Projection seen = Project(view, point);
  return this->ReadColor(view.Slice, seen.Tile, seen.Coordinates);
}

glm::dvec4 Lookup::ListWeights(const ViewCell& views)
{
  return { views.Views[0].Weight, views.Views[1].Weight, views.Views[2].Weight,
    views.Views[3].Weight };
}

// The mean of what the views see of a point, over those that see anything.
glm::dvec4 Lookup::BlendColors(
  const ViewCell& views, const glm::dvec3& point, const glm::dvec4& weights) const
{
  glm::dvec4 color(0.0);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    const View& view = views.Views[k];
    const Projection seen = Project(view, point);
    const double weight = this->IsKept(view, seen.Tile) ? weights[k] : 0.0;
    if (weight > 0.0)
    {
      color += weight * this->ReadColor(view.Slice, seen.Tile, seen.Coordinates);
      sum += weight;
    }
  }
  return color / std::max(sum, LeastWeight);
}

LookupResult Lookup::LookThrough(const Ray& ray, double fraction) const
{
  LookupResult result;
  result.Fraction = this->GuessSurface(ray, fraction);
  const ViewCell views = this->FindViews(ray);
  result.Color = this->BlendColors(views, ray.Entry + fraction * ray.Chord, ListWeights(views));
  return result;
}

//------------------------------------------------------------------------------
// Lookups without depth

LookupResult Lookup::Nearest(const RayCoordinates& ray) const
{
  const Ray rayFC = ToFaceSpace(ray);
  return { this->ReadNearestColor(this->FindViews(rayFC).Views[0].Slice,
             TileOf(ray.Entry.Face, ray.Exit.Face), ray.Exit.Coordinates),
    this->GuessSurface(rayFC, 1.0) };
}

LookupResult Lookup::Linear(const RayCoordinates& ray) const
{
  const Ray rayFC = ToFaceSpace(ray);
  return { this->ReadColorOf(this->FindViews(rayFC).Views[0], rayFC.Entry + rayFC.Chord),
    this->GuessSurface(rayFC, 1.0) };
}

LookupResult Lookup::Bilinear(const RayCoordinates& ray) const
{
  return this->LookThrough(ToFaceSpace(ray), 1.0);
}

LookupResult Lookup::Focal(const RayCoordinates& ray, const glm::dvec3& focalPointCC) const
{
  const Ray rayFC = ToFaceSpace(ray);
  double first;
  double last;
  SceneGrid::ClipToScene(this->CastGridRay(rayFC), first, last);
  if (first >= last)
  {
    return {};
  }
  const glm::dvec3 focalPoint = CubeToFaceSpace(rayFC.Face, focalPointCC);
  const double fraction =
    glm::dot(focalPoint - rayFC.Entry, rayFC.Chord) / glm::dot(rayFC.Chord, rayFC.Chord);
  return this->LookThrough(rayFC, std::max(NearestFocus, std::clamp(fraction, first, last)));
}

//------------------------------------------------------------------------------
// Depth-corrected lookup

SceneGrid::Ray Lookup::CastGridRay(const Ray& ray) const
{
  const glm::dvec3 entryCC = FaceSpaceToCube(ray.Face, ray.Entry);
  const glm::dvec3 exitCC = FaceSpaceToCube(ray.Face, ray.Entry + ray.Chord);
  return this->Grid.CastGridRay(entryCC, exitCC - entryCC);
}

// The distance, in inverse depth, of a point in front of the surface that a view sees in its
// direction: positive if the view sees through the point, negative if it is hidden.
double Lookup::Clearance(const View& view, const glm::dvec3& point) const
{
  const Projection seen = Project(view, point);
  if (!this->IsKept(view, seen.Tile))
  {
    return seen.InverseDepth - 1.0 / LeastDepth;
  }
  return seen.InverseDepth - this->ReadInverseDepth(view.Slice, seen.Tile, seen.Coordinates);
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
    w = glm::mix(behind, before, std::clamp(share, LeastShare, 1.0 - LeastShare));
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
  const Range& range, bool all, Step& step) const
{
  while (step.Behind > range.Farthest && step.Count < MostSteps)
  {
    step.Behind = this->Grid.SkipEmpty(gridRay, step.Behind, range.Farthest);
    if (step.Behind <= range.Farthest)
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
      step.Behind = std::max(step.Before - stride, range.Farthest);
      step.ClearancesBehind = this->Clearances(ray, views, step.Behind, all);
      ++step.Count;
      if (glm::any(EndsOfSight(step.ClearancesBefore, step.ClearancesBehind)))
      {
        return true;
      }
      inside = step.Behind > range.Farthest && step.Count < MostSteps &&
        this->Grid.IsOccupied(gridRay, step.Behind);
    }
  }
  return false;
}

// Free-space voting: the first point at which a view's sight along the ray ends on a surface and
// that no view sees through. If there is none, the first point that no view sees. Otherwise the
// surface that is least seen through, if it is nearly one, because texels that are coarse for the
// scene have larger errors than coded depth. Otherwise 0. Steps are taken by all four views, or by
// the three nearest, which is nearly as good and takes less time.
Lookup::Surface Lookup::FindSurface(const Ray& ray, const ViewCell& views,
  const SceneGrid::Ray& gridRay, const Range& range, bool all) const
{
  Step step;
  step.Behind = range.Nearest;
  Surface doubtful;
  double least = DoubtTexels / this->Field.Grid.GetResolution();
  for (int i = 0; i < MostCandidates && this->FindStep(ray, views, gridRay, range, all, step); ++i)
  {
    const int k = ChooseCrossing(step.ClearancesBefore, step.ClearancesBehind);
    const double w = this->RefineCrossing(ray, views.Views[k], step.Before, step.Behind,
      step.ClearancesBefore[k], step.ClearancesBehind[k]);
    const glm::dvec4 clearances = this->Clearances(ray, views, w, true);
    const double most = std::max({ clearances.x, clearances.y, clearances.z, clearances.w }) / w;
    const bool isSeenThrough = most > ClearanceTolerance;
    const bool isSurface = std::abs(clearances[k]) < EdgeStep * w;
    const glm::dvec4 near =
      glm::max(glm::dvec4(0.0), 1.0 - glm::abs(clearances) / (SightTolerance * w));
    if (isSurface && most < least)
    {
      least = most;
      doubtful = { w, near };
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
  if (step.FirstHidden == 0.0)
  {
    return doubtful;
  }
  return { step.FirstHidden, glm::dvec4(0.0) };
}

// The views that see the surface from the ray's side contribute to its colour; if there are none,
// all.
glm::dvec4 Lookup::BlendVisible(const Ray& ray, const ViewCell& views, const Surface& surface) const
{
  const glm::dvec3 point = ray.Entry + ray.Chord / surface.W;
  const glm::dvec4 weights = ListWeights(views);
  const glm::dvec4 visible = (weights + LeastWeight) * surface.Sight;
  const double sum = visible.x + visible.y + visible.z + visible.w;
  return this->BlendColors(views, point, sum > 0.0 ? visible / sum : weights);
}

// Viewpoints farther and farther away may see what the four views do not.
void Lookup::SearchAround(const Ray& ray, const SceneGrid::Ray& gridRay, const Range& whole,
  ViewCell& views, Surface& surface) const
{
  // Starts one step earlier, where the outer ones may see the surface at once. A surface that they
  // find in front of the hidden point is a silhouette, which the inner ones show better.
  const double hidden = surface.W;
  const double stride = std::max(views.Stride, StepShare * hidden);
  const Range range = { std::min(hidden + stride, whole.Nearest), whole.Farthest };
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

LookupResult Lookup::DepthCorrected(const RayCoordinates& ray) const
{
  if (!this->Depths)
  {
    return this->Focal(ray, glm::dvec3(0.0));
  }
  const Ray rayFC = ToFaceSpace(ray);
  const SceneGrid::Ray gridRay = this->CastGridRay(rayFC);
  Range range{};
  SceneGrid::ClipToScene(gridRay, range.Nearest, range.Farthest);
  range = { 1.0 / std::max(range.Nearest, 1.0 / NearestStart),
    1.0 / std::max(range.Farthest, 1.0 / NearestStart) };
  ViewCell views = this->FindViews(rayFC);
  Surface surface = this->FindSurface(rayFC, views, gridRay, range, false);
  if (surface.W > 0.0 && surface.Sight == glm::dvec4(0.0))
  {
    surface = this->FindSurface(rayFC, views, gridRay, range, true);
  }
  if (surface.W == 0.0)
  {
    return {};
  }
  if (surface.Sight == glm::dvec4(0.0))
  {
    this->SearchAround(rayFC, gridRay, range, views, surface);
  }
  return { this->BlendVisible(rayFC, views, surface), 1.0 / surface.W };
}
}
