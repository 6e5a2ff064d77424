// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The part of cslf::Lookup for points of a field's geometry. After unstructured lumigraph rendering
// (Buehler et al. 2001): a point takes its colour from views that see it, the more the nearer they
// are to the line of sight.
#include "Lookup/cslfLookup.h"

#include "Lookup/cslfFaceSpace.h"
#include "Lookup/cslfLookupConstants.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
using namespace lookup;

namespace
{
/// The ways to the viewpoints of a ring.
constexpr int RingWays[8][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 }, { -1, 0 }, { -1, -1 },
  { 0, -1 }, { 1, -1 } };
}

void Sightings::Add(const Sighting& sighting, double weight)
{
  if (sighting.Share * weight > 0.0 && this->Count < 4)
  {
    this->Weights[this->Count] = sighting.Share * weight;
    this->All[this->Count++] = sighting;
  }
}

// The texels around a view's image of a point that lie on its surface. Depths are compared with
// those of the surface's plane, because the inverse depth of a plane is linear over a tile.
Sighting Lookup::See(const View& view, const FacePoint& surface) const
{
  const Projection seen = Project(view, surface.Point);
  Sighting sighting;
  sighting.At = seen.At;
  const glm::dvec3 way = surface.Point - glm::dvec3(view.Position, 0.0);
  const double facing = -glm::dot(surface.Normal, way);
  if (!this->IsKept(view, seen.At) || facing < MinimumFacing * glm::length(way))
  {
    return sighting;
  }
  const double resolution = this->Field.Grid.GetResolution();
  const glm::dvec2 position =
    glm::clamp(this->Depth.TexelPosition(seen.At), 0.5, resolution - 0.5) - 0.5;
  const glm::dvec2 base = glm::clamp(glm::floor(position), 0.0, std::max(resolution - 2.0, 0.0));
  const glm::dvec2 weight = position - base;
  const ExitFrame frame =
    FindExit(view, way, ShareOfWays(way, view.InverseToPositive, view.InverseToNegative));
  const glm::dvec2 slope =
    glm::dvec2(glm::dot(frame.S, surface.Normal), glm::dot(frame.T, surface.Normal)) *
    (2.0 / resolution) / -facing;
  const double tolerance = SurfaceTolerance * seen.InverseDepth +
    std::min(0.5 * (std::abs(slope.x) + std::abs(slope.y)), SlopeTolerance * seen.InverseDepth);
  for (int k = 0; k < 4; ++k)
  {
    const glm::dvec2 corner(TexelCorners[k][0], TexelCorners[k][1]);
    const glm::dvec2 share = glm::mix(1.0 - weight, weight, corner);
    const double expected = seen.InverseDepth + glm::dot(slope, corner - weight);
    const glm::ivec2 texel(base + corner);
    const double stored = this->FetchInverseDepth(seen.At, texel.x, texel.y);
    sighting.Texels[k] = std::abs(stored - expected) < tolerance ? share.x * share.y : 0.0;
    sighting.Share += sighting.Texels[k];
  }
  return sighting;
}

Sightings Lookup::SeeFromAround(const ViewCell& views, const FacePoint& surface) const
{
  Sightings found;
  found.Count = 4;
  for (int k = 0; k < 4; ++k)
  {
    found.All[k] = this->See(views.Views[k], surface);
    found.Weights[k] = (views.Views[k].Weight + MinimumWeight) * found.All[k].Share;
  }
  return found;
}

// How near a viewpoint is to the line of sight, as a weight.
double Lookup::NearnessOf(const glm::dvec2& viewpoint, const FacePoint& surface)
{
  const glm::dvec3 toView = glm::normalize(glm::dvec3(viewpoint, 0.0) - surface.Point);
  const double away = glm::distance(toView, surface.ToEye) + MinimumAngle;
  return 1.0 / (away * away);
}

// The nearest viewpoint to a place on the face.
Lookup::View Lookup::FindView(int face, const glm::dvec2& coordinates) const
{
  const NodeBracket u = this->Field.Grid.FindNodes(coordinates.x);
  const NodeBracket v = this->Field.Grid.FindNodes(coordinates.y);
  return this->MakeView(
    face, u.Weight > 0.5 ? u.Upper : u.Lower, v.Weight > 0.5 ? v.Upper : v.Lower, 1.0);
}

// The sightings by viewpoints in rings around the entry: those of the first ring that has any.
Sightings Lookup::SeeFromAfar(const FacePoint& surface) const
{
  const Layout& grid = this->Field.Grid;
  const NodeBracket u = grid.FindNodes(surface.Entry.x);
  const NodeBracket v = grid.FindNodes(surface.Entry.y);
  const glm::dvec2 size(grid.NodeCoordinate(u.Upper) - grid.NodeCoordinate(u.Lower),
    grid.NodeCoordinate(v.Upper) - grid.NodeCoordinate(v.Lower));
  const double rings = std::floor(2.0 / std::min(size.x, size.y) + 0.5);
  Sightings found;
  for (double ring = 1.0; found.Count == 0 && ring <= rings;
       ring += std::max(1.0, std::floor(RingGrowth * ring)))
  {
    for (const auto& way : RingWays)
    {
      const glm::dvec2 place = surface.Entry + ring * size * glm::dvec2(way[0], way[1]);
      if (glm::all(glm::lessThan(glm::abs(place), 1.0 + 0.5 * size)))
      {
        const View view = this->FindView(surface.Face, glm::clamp(place, -1.0, 1.0));
        found.Add(this->See(view, surface), NearnessOf(view.Position, surface));
      }
    }
  }
  return found;
}

// A point as the viewpoints of a face see it. False if its line of sight does not come from there.
bool Lookup::ToFace(
  int face, const GeometryPoint& surface, const glm::dvec3& directionCC, FacePoint& point)
{
  const glm::dvec3 origin = CubeToFaceSpace(face, glm::dvec3(0.0));
  const glm::dvec3 direction = CubeToFaceSpace(face, directionCC) - origin;
  if (direction.z <= 0.0)
  {
    return false;
  }
  point.Face = face;
  point.Point = CubeToFaceSpace(face, surface.PointCC);
  point.Normal = CubeToFaceSpace(face, surface.NormalCC) - origin;
  point.Normal *= glm::dot(point.Normal, direction) > 0.0 ? -1.0 : 1.0;
  point.ToEye = -glm::normalize(direction);
  const glm::dvec2 entry =
    glm::dvec2(point.Point) - glm::dvec2(direction) * (point.Point.z / direction.z);
  point.Entry = glm::clamp(entry, -1.0, 1.0);
  return true;
}

Sightings Lookup::OnSurface(
  const RayCoordinates& ray, const GeometryPoint& surface, int faces) const
{
  const glm::dvec3 directionCC = FaceToCube(ray.Exit.Face, ray.Exit.Coordinates) -
    FaceToCube(ray.Entry.Face, ray.Entry.Coordinates);
  FacePoint point;
  if (!this->Samples.GetArray(KnownChannel::Depth) ||
    !ToFace(ray.Entry.Face, surface, directionCC, point))
  {
    return {};
  }
  Sightings found = this->SeeFromAround(this->FindViews(ToFaceSpace(ray)), point);
  if (glm::dot(found.Weights, glm::dvec4(1.0)) > EnoughSight)
  {
    return found;
  }
  found = this->SeeFromAfar(point);
  for (int face = 0; face < FaceCount && found.Count == 0; ++face)
  {
    if ((faces >> face & 1) != 0 && face != ray.Entry.Face &&
      ToFace(face, surface, directionCC, point))
    {
      found = this->SeeFromAfar(point);
    }
  }
  return found;
}
}
