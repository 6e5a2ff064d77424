// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Looks up points of a field's geometry, as in cslfSurfaceLookup.cxx, which explains every step.
// The points come from the picture that cslfGeometryFS.glsl has drawn. All points are in FC.

uniform sampler2D SurfacePoints; // CC, and a packed normal on either side; 0 without geometry
uniform sampler2D SurfaceColors;

struct GeometryPoint
{
  vec3 Point;
  vec3 Normal; // on the eye's side
  vec3 ToEye;  // the direction, of unit length
  vec2 Entry;  // where the ray enters, or the point of the face that is nearest to this
};

// How a view sees a point of the geometry.
struct Sighting
{
  Place At;
  vec4 Texels; // the weights of the texels around the place, of those that lie on the surface
  float Share; // their sum
};

// Up to four sightings.
struct Sightings
{
  Sighting First;
  Sighting Second;
  Sighting Third;
  Sighting Fourth;
  vec4 Weights;
  int Count;
};

ivec2 PictureTexel()
{
  return ivec2(gl_FragCoord.xy);
}

bool IsOnGeometry()
{
  return texelFetch(SurfacePoints, PictureTexel(), 0).w > 0.0;
}

GeometryPoint FindGeometryPoint(vec2 entry, vec3 direction)
{
  mat3 toCube = mat3(FCCCMatrix);
  vec4 picture = texelFetch(SurfacePoints, PictureTexel(), 0);
  GeometryPoint surface;
  surface.Point = (picture.xyz - FCCCMatrix[3].xyz) * toCube;
  surface.Normal = UnpackNormal(picture.w) * toCube;
  surface.Normal *= dot(surface.Normal, direction) > 0.0 ? -1.0 : 1.0;
  surface.ToEye = -normalize(direction);
  surface.Entry = entry;
  return surface;
}

Sighting See(View view, GeometryPoint surface)
{
  Projection seen = Project(view, surface.Point);
  vec3 way = surface.Point - vec3(view.Position, 0.0);
  float facing = -dot(surface.Normal, way);
  vec2 position = clamp(TexelPosition(seen.At), 0.5, Resolution - 0.5) - 0.5;
  vec2 base = clamp(floor(position), 0.0, max(Resolution - 2.0, 0.0));
  vec2 weight = position - base;
  vec4 inverse = GatherInverseDepths(seen.At, base);
  // A plane's inverse depth is linear over a tile.
  vec2 slope = ToExitFace(ShareOfWays(view, way), way, surface.Normal) * (2.0 / Resolution) /
    min(-facing, -LeastFacing * length(way));
  vec4 expected = seen.InverseDepth + slope.x * (vec4(0.0, 1.0, 1.0, 0.0) - weight.x) +
    slope.y * (vec4(1.0, 1.0, 0.0, 0.0) - weight.y);
  float tolerance = SurfaceTolerance * seen.InverseDepth +
    min(0.5 * (abs(slope.x) + abs(slope.y)), SlopeTolerance * seen.InverseDepth);
  vec4 shares = vec4((1.0 - weight.x) * weight.y, weight.x * weight.y,
    weight.x * (1.0 - weight.y), (1.0 - weight.x) * (1.0 - weight.y));
  float isSeen = step(LeastFacing * length(way), facing) * IsKept(seen.At);
  Sighting sighting;
  sighting.At = seen.At;
  sighting.Texels =
    isSeen * shares * vec4(lessThan(abs(inverse - expected), vec4(tolerance)));
  sighting.Share = dot(sighting.Texels, vec4(1.0));
  return sighting;
}

void Add(inout Sightings found, Sighting sighting, float weight)
{
  if (sighting.Share * weight <= 0.0 || found.Count == 4)
  {
    return;
  }
  float amount = sighting.Share * weight;
  if (found.Count == 0)
  {
    found.First = sighting;
    found.Weights.x = amount;
  }
  else if (found.Count == 1)
  {
    found.Second = sighting;
    found.Weights.y = amount;
  }
  else if (found.Count == 2)
  {
    found.Third = sighting;
    found.Weights.z = amount;
  }
  else
  {
    found.Fourth = sighting;
    found.Weights.w = amount;
  }
  ++found.Count;
}

// The sightings by the four viewpoints around the entry.
Sightings SeeFromAround(ViewCell views, GeometryPoint surface)
{
  Sightings found;
  found.First = See(views.View00, surface);
  found.Second = See(views.View10, surface);
  found.Third = See(views.View01, surface);
  found.Fourth = See(views.View11, surface);
  found.Weights = (ListWeights(views) + LeastWeight) *
    vec4(found.First.Share, found.Second.Share, found.Third.Share, found.Fourth.Share);
  found.Count = 4;
  return found;
}

// The mean of what views see at the texels on the surface, with their alpha. Where a texel is
// covered only in part, it shows a silhouette, which is the geometry's business.
vec4 ReadSurfaceColor(Sighting sighting)
{
  vec2 base = clamp(floor(clamp(TexelPosition(sighting.At), 0.5, Resolution - 0.5) - 0.5), 0.0,
    max(Resolution - 2.0, 0.0));
  ivec3 address = TexelAddress(sighting.At, base);
  vec4 texel01 = texelFetch(ColorTexture, address + ivec3(0, 1, 0), 0);
  vec4 texel11 = texelFetch(ColorTexture, address + ivec3(1, 1, 0), 0);
  vec4 texel10 = texelFetch(ColorTexture, address + ivec3(1, 0, 0), 0);
  vec4 texel00 = texelFetch(ColorTexture, address, 0);
  return sighting.Texels.x * texel01 + sighting.Texels.y * texel11 + sighting.Texels.z * texel10 +
    sighting.Texels.w * texel00;
}

vec4 BlendSightings(Sightings found)
{
  vec4 weights = found.Weights /
    max(vec4(found.First.Share, found.Second.Share, found.Third.Share, found.Fourth.Share),
      vec4(LeastWeight));
  vec4 color = weights.x * ReadSurfaceColor(found.First);
  color += weights.y * ReadSurfaceColor(found.Second);
  color += weights.z * ReadSurfaceColor(found.Third);
  color += weights.w * ReadSurfaceColor(found.Fourth);
  return color.a > 0.0 ? color / color.a : vec4(0.0);
}

// How near a viewpoint is to the line of sight, as a weight.
float NearnessOf(vec2 viewpoint, GeometryPoint surface)
{
  vec3 toView = normalize(vec3(viewpoint, 0.0) - surface.Point);
  float away = length(toView - surface.ToEye) + LeastAngle;
  return 1.0 / (away * away);
}

// The nearest viewpoint to a place on the face.
View FindView(vec2 coordinates)
{
  Cell cell = FindCell(coordinates);
  bvec2 isUpper = greaterThan(coordinates - cell.Lower, cell.Upper - coordinates);
  float slot = isUpper.x ? (isUpper.y ? cell.Slots.w : cell.Slots.y)
                         : (isUpper.y ? cell.Slots.z : cell.Slots.x);
  return MakeView(slot, mix(cell.Lower, cell.Upper, isUpper), vec2(1.0));
}

// The sightings by viewpoints in rings around the entry: those of the first ring that has any.
Sightings SeeFromAfar(GeometryPoint surface)
{
  Sighting none = Sighting(Place(SlicePlace(0.0, 0.0), AbsentSlot, vec2(0.0)), vec4(0.0), 0.0);
  Sightings found = Sightings(none, none, none, none, vec4(0.0), 0);
  Cell inner = FindCell(surface.Entry);
  vec2 size = inner.Upper - inner.Lower;
  float rings = floor(2.0 / min(size.x, size.y) + 0.5);
  for (float ring = 1.0; found.Count == 0 && ring <= rings; ring += max(1.0, floor(RingGrowth * ring)))
  {
    for (int i = 0; i < 8; ++i)
    {
      vec2 way = vec2(i == 0 || i == 1 || i == 7 ? 1.0 : i == 2 || i == 6 ? 0.0 : -1.0,
        i > 0 && i < 4 ? 1.0 : i == 0 || i == 4 ? 0.0 : -1.0);
      vec2 place = surface.Entry + ring * size * way;
      if (all(lessThan(abs(place), vec2(1.0) + 0.5 * size)))
      {
        View view = FindView(clamp(place, -1.0, 1.0));
        Add(found, See(view, surface), NearnessOf(view.Position, surface));
      }
    }
  }
  return found;
}

// By the viewpoints around the entry. Nothing, if they see little of the point.
vec4 LookupNear(GeometryPoint surface)
{
  Sightings found = SeeFromAround(FindViews(vec3(surface.Entry, 0.0)), surface);
  return dot(found.Weights, vec4(1.0)) > EnoughSight ? BlendSightings(found) : vec4(0.0);
}

// By viewpoints farther away.
vec4 LookupFar(GeometryPoint surface)
{
  return BlendSightings(SeeFromAfar(surface));
}

// The geometry's own colour.
vec4 LookupOwn(GeometryPoint surface)
{
  vec4 color = texelFetch(SurfaceColors, PictureTexel(), 0);
  return color.a > 0.0 ? color / color.a : vec4(0.0);
}
