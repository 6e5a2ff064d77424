// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLookup.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cslf
{
namespace
{
// These constants stand in cslfLookup.glsl too.

/// Depth closer than this fraction of a chord is not told apart.
constexpr double LeastDepth = 1.0 / 4096.0;
/// Neighbouring texels whose inverse depths differ by less than this share are of one surface.
constexpr double SurfaceStep = 0.1;
/// A view cannot tell points of the ray apart that it sees within this many texels.
constexpr double SlackTexels = 0.25;
/// Nor points closer than this in w.
constexpr double MostSlack = 0.1;
/// The search starts no closer to the entry than at this inverse fraction.
constexpr double NearestStart = 40.0;
/// The focal lookup looks no closer to the entry than at this fraction of the chord.
constexpr double NearestFocus = 0.05;
/// How many texels a view's image of the ray may move in a step of the search.
constexpr double TexelsPerStep = 4.0;
constexpr int LeastSteps = 8;
constexpr int MostSteps = 128;
/// Halvings of a step that holds a crossing.
constexpr int Refinements = 8;
/// A crossing this far behind the surface, as a share of w, passed an edge instead.
constexpr double EdgeStep = 0.03;
/// A view colours points within this share of w of the surface that it sees.
constexpr double SightTolerance = 0.1;
/// A view sees through points that are clear by more than this; coded depth errs by less.
constexpr double ClearanceTolerance = 0.1;
/// Keeps a ray through a viewpoint from depending on that viewpoint alone.
constexpr double LeastWeight = 0.0001;

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
  , SceneMinimum(description.GetSceneMinimumCC() - LookupSceneMargin)
  , SceneMaximum(description.GetSceneMaximumCC() + LookupSceneMargin)
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

// Within one surface interpolated, which is exact for planes; across an edge the nearer surface's.
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

Lookup::RayViews Lookup::FindViews(const RayCoordinates& ray) const
{
  const Layout& grid = this->Field.Grid;
  RayViews result;
  result.Entry = FaceToCube(ray.Entry.Face, ray.Entry.Coordinates);
  result.Chord = FaceToCube(ray.Exit.Face, ray.Exit.Coordinates) - result.Entry;
  const NodeBracket u = grid.FindNodes(ray.Entry.Coordinates.x);
  const NodeBracket v = grid.FindNodes(ray.Entry.Coordinates.y);
  for (int k = 0; k < 4; ++k)
  {
    const bool upperU = k % 2 == 1;
    const bool upperV = k / 2 == 1;
    const Viewpoint viewpoint{ ray.Entry.Face, upperU ? u.Upper : u.Lower,
      upperV ? v.Upper : v.Lower };
    View& view = result.Views[k];
    view.Slice = grid.SliceOf(viewpoint);
    view.Face = ray.Entry.Face;
    view.Position = grid.ViewpointPosition(viewpoint);
    view.Weight = (upperU ? u.Weight : 1.0 - u.Weight) * (upperV ? v.Weight : 1.0 - v.Weight);
    const double texels = 0.5 * grid.GetResolution() * glm::distance(view.Position, result.Entry);
    view.Slack = std::min(SlackTexels / std::max(texels, SlackTexels), MostSlack);
  }
  return result;
}

const Lookup::View& Lookup::FindNearestView(const RayViews& ray)
{
  return *std::max_element(
    ray.Views, ray.Views + 4, [](const View& a, const View& b) { return a.Weight < b.Weight; });
}

Lookup::Projection Lookup::Project(const View& view, const glm::dvec3& pointCC) const
{
  const glm::dvec3 direction = pointCC - view.Position;
  double inverseDepth = 1.0 / LeastDepth;
  int axis = FaceAxis(view.Face);
  for (int a = 0; a < 3; ++a)
  {
    // Along the entry face's axis only the opposite face is an exit.
    const double sign =
      a == FaceAxis(view.Face) ? -FaceSign(view.Face) : (direction[a] < 0.0 ? -1.0 : 1.0);
    const double toExit = std::abs(sign - view.Position[a]);
    if (toExit < inverseDepth * sign * direction[a])
    {
      inverseDepth = toExit / (sign * direction[a]);
      axis = a;
    }
  }
  const int face = axis == FaceAxis(view.Face) ? FaceOf(axis, -FaceSign(view.Face))
                                               : FaceOf(axis, direction[axis]);
  const glm::dvec3 exit = view.Position + inverseDepth * direction;
  return { TileOf(view.Face, face), CubeToFace(face, exit), inverseDepth };
}

// The guess of a lookup that does not search: the surface that the nearest view sees where it sees
// the ray's point at `fraction`; without a depth channel that point itself.
double Lookup::GuessSurface(const RayViews& ray, double fraction) const
{
  if (!this->Depths)
  {
    return fraction;
  }
  const View& view = FindNearestView(ray);
  const Projection seen = this->Project(view, ray.Entry + fraction * ray.Chord);
  const glm::dvec3 exit = FaceToCube(ExitFaceOf(view.Face, seen.Tile), seen.Coordinates);
  const glm::dvec3 surface = view.Position +
    (exit - view.Position) / this->ReadNearestInverseDepth(view.Slice, seen.Tile, seen.Coordinates);
  return std::clamp(
    glm::dot(surface - ray.Entry, ray.Chord) / glm::dot(ray.Chord, ray.Chord), 0.0, 1.0);
}

LookupResult Lookup::LookThrough(const RayViews& ray, double fraction) const
{
  LookupResult result;
  result.Fraction = this->GuessSurface(ray, fraction);
  for (const View& view : ray.Views)
  {
    const Projection seen = this->Project(view, ray.Entry + fraction * ray.Chord);
    result.Color += view.Weight * this->ReadColor(view.Slice, seen.Tile, seen.Coordinates);
  }
  return result;
}

//------------------------------------------------------------------------------
// Lookups without depth

LookupResult Lookup::Nearest(const RayCoordinates& ray) const
{
  const RayViews views = this->FindViews(ray);
  return { this->ReadNearestColor(FindNearestView(views).Slice,
             TileOf(ray.Entry.Face, ray.Exit.Face), ray.Exit.Coordinates),
    this->GuessSurface(views, 1.0) };
}

LookupResult Lookup::Linear(const RayCoordinates& ray) const
{
  const RayViews views = this->FindViews(ray);
  return { this->ReadColor(FindNearestView(views).Slice, TileOf(ray.Entry.Face, ray.Exit.Face),
             ray.Exit.Coordinates),
    this->GuessSurface(views, 1.0) };
}

LookupResult Lookup::Bilinear(const RayCoordinates& ray) const
{
  return this->LookThrough(this->FindViews(ray), 1.0);
}

LookupResult Lookup::Focal(const RayCoordinates& ray, const glm::dvec3& focalPointCC) const
{
  const RayViews views = this->FindViews(ray);
  const Range range = this->ClipToScene(views);
  if (range.Nearest <= range.Farthest)
  {
    return {};
  }
  const double fraction =
    glm::dot(focalPointCC - views.Entry, views.Chord) / glm::dot(views.Chord, views.Chord);
  return this->LookThrough(
    views, std::max(NearestFocus, std::clamp(fraction, 1.0 / range.Nearest, 1.0 / range.Farthest)));
}

//------------------------------------------------------------------------------
// Depth-corrected lookup

// The part of the ray that the scene can fill; empty where nearest <= farthest.
Lookup::Range Lookup::ClipToScene(const RayViews& ray) const
{
  double first = 1.0 / NearestStart;
  double last = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    const double direction = std::abs(ray.Chord[a]) < 1e-9 ? 1e-9 : ray.Chord[a];
    const double t0 = (this->SceneMinimum[a] - ray.Entry[a]) / direction;
    const double t1 = (this->SceneMaximum[a] - ray.Entry[a]) / direction;
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  }
  return { 1.0 / first, 1.0 / std::max(last, 1.0 / NearestStart) };
}

int Lookup::CountSteps(const RayViews& ray, const Range& range) const
{
  double reach = 0.0;
  for (const View& view : ray.Views)
  {
    reach = std::max(reach, glm::distance(view.Position, ray.Entry));
  }
  const double texels =
    0.5 * this->Field.Grid.GetResolution() * reach * (range.Nearest - range.Farthest);
  return std::clamp(static_cast<int>(std::ceil(texels / TexelsPerStep)), LeastSteps, MostSteps);
}

// How far before the surface that view k sees in its direction the ray's point at w lies, in
// inverse depth: positive where the view sees through the point, negative where it is hidden.
double Lookup::Clearance(const RayViews& ray, int k, double w) const
{
  const View& view = ray.Views[k];
  const Projection seen = this->Project(view, ray.Entry + ray.Chord / std::max(w, 1.0));
  return seen.InverseDepth - this->ReadInverseDepth(view.Slice, seen.Tile, seen.Coordinates);
}

Lookup::Crossing Lookup::RefineCrossing(
  const RayViews& ray, int k, double behind, double before) const
{
  double clearance = this->Clearance(ray, k, behind);
  for (int i = 0; i < Refinements; ++i)
  {
    const double middle = 0.5 * (behind + before);
    const double c = this->Clearance(ray, k, middle);
    if (c > 0.0)
    {
      before = middle;
    }
    else
    {
      behind = middle;
      clearance = c;
    }
  }
  return { behind, clearance > -EdgeStep * behind };
}

// Free-space voting: whether any other view sees through the ray's point at w.
bool Lookup::IsSeenThrough(const RayViews& ray, int exceptView, double w) const
{
  for (int k = 0; k < 4; ++k)
  {
    const double slack = ray.Views[k].Slack;
    if (k != exceptView &&
      std::min(this->Clearance(ray, k, w + slack), this->Clearance(ray, k, w - slack)) >
        ClearanceTolerance)
    {
      return true;
    }
  }
  return false;
}

// The first point at which a view's sight along the ray ends on a surface and that no view sees
// through. Where there is none, the first edge behind which no view sees; otherwise 0.
double Lookup::FindSurface(const RayViews& ray) const
{
  const Range range = this->ClipToScene(ray);
  if (range.Nearest <= range.Farthest)
  {
    return 0.0;
  }
  const int steps = this->CountSteps(ray, range);
  const double step = (range.Nearest - range.Farthest) / steps;
  double clearances[4];
  for (int k = 0; k < 4; ++k)
  {
    clearances[k] = this->Clearance(ray, k, range.Nearest);
  }
  double edge = 0.0;
  for (int i = 1; i <= steps; ++i)
  {
    const double w = range.Nearest - step * i;
    double surface = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      const double before = clearances[k];
      clearances[k] = this->Clearance(ray, k, w);
      if (before > 0.0 && clearances[k] <= 0.0)
      {
        const Crossing crossing = this->RefineCrossing(ray, k, w, w + step);
        const double best = crossing.IsSurface ? surface : edge;
        if (crossing.W > best && !this->IsSeenThrough(ray, k, crossing.W))
        {
          (crossing.IsSurface ? surface : edge) = crossing.W;
        }
      }
    }
    if (surface > 0.0)
    {
      return surface;
    }
  }
  return edge;
}

// The views that see the surface at w from the ray's side share its colour; where none does, all.
glm::dvec4 Lookup::BlendVisible(const RayViews& ray, double w) const
{
  glm::dvec4 visible(0.0);
  glm::dvec4 all(0.0);
  double weights = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    const View& view = ray.Views[k];
    const Projection seen = this->Project(view, ray.Entry + ray.Chord / w);
    const glm::dvec4 color = this->ReadColor(view.Slice, seen.Tile, seen.Coordinates);
    all += view.Weight * color;
    const double before = this->Clearance(ray, k, w + view.Slack);
    const double behind = this->Clearance(ray, k, w - view.Slack);
    if (before >= behind)
    {
      const double distance = std::max(0.0, std::max(behind, -before));
      const double weight =
        (view.Weight + LeastWeight) * std::max(0.0, 1.0 - distance / (SightTolerance * w));
      visible += weight * color;
      weights += weight;
    }
  }
  return weights > 0.0 ? visible / weights : all;
}

LookupResult Lookup::DepthCorrected(const RayCoordinates& ray) const
{
  if (!this->Depths)
  {
    return this->Focal(ray, glm::dvec3(0.0));
  }
  const RayViews views = this->FindViews(ray);
  const double w = this->FindSurface(views);
  if (w == 0.0)
  {
    return {};
  }
  return { this->BlendVisible(views, w), 1.0 / w };
}
}
