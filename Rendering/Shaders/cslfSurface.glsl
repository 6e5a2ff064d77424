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
  ivec3 Address; // of the texels around the place: the first of four
  vec4 Texels;   // the weights of those that lie on the surface
  float Share;   // their sum
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

// The surface that a ray meets between the eye and the geometry, if the views see one at most that
// far from the latter. Otherwise not final.
LookupResult SearchInFront(Ray ray, float reach)
{
  LookupResult result = FindNothing();
  result.IsFinal = false;
  vec4 picture = texelFetch(SurfacePoints, PictureTexel(), 0);
  vec3 point = (picture.xyz - FCCCMatrix[3].xyz) * mat3(FCCCMatrix);
  GridRay gridRay = CastGridRay(ray);
  vec2 range = FindRange(gridRay);
  float square = dot(ray.Chord, ray.Chord);
  float fraction = max(dot(point - ray.Entry, ray.Chord) / square, 1.0 / NearestStart);
  float eye = EyeFC.w > 0.0 ? dot(EyeFC.xyz - ray.Entry, ray.Chord) / square : 0.0;
  float start = max(fraction - reach * inversesqrt(square), max(eye, 1.0 / NearestStart));
  range.x = min(range.x, 1.0 / start);
  range.y = max(range.y, (1.0 + FrontMargin) / fraction);
  if (picture.w > 0.0 && range.x > range.y)
  {
    ViewCell views = FindViews(ray.Entry);
    Surface surface = FindSurface(ray, views, gridRay, range, false);
    // Neither a hidden point nor a doubtful one.
    if (surface.W > range.y && surface.Sight != vec4(0.0) &&
      all(lessThan(Clearances(ray, views, surface.W, true), vec4(ClearanceTolerance * surface.W))))
    {
      result = FindVisible(ray, views, surface);
    }
  }
  return result;
}

LookupResult LookupInFront(Ray ray)
{
  return SearchInFront(ray, length(ray.Chord));
}

// Where the depth is that of something so close to the geometry that the grid does not tell them
// apart.
LookupResult LookupClose(Ray ray)
{
  return SearchInFront(ray, CloseTexels * 2.0 / Resolution);
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
    min(-facing, -MinimumFacing * length(way));
  vec4 expected = seen.InverseDepth + slope.x * (vec4(0.0, 1.0, 1.0, 0.0) - weight.x) +
    slope.y * (vec4(1.0, 1.0, 0.0, 0.0) - weight.y);
  float tolerance = SurfaceTolerance * seen.InverseDepth +
    min(0.5 * (abs(slope.x) + abs(slope.y)), SlopeTolerance * seen.InverseDepth);
  vec4 shares = vec4((1.0 - weight.x) * weight.y, weight.x * weight.y,
    weight.x * (1.0 - weight.y), (1.0 - weight.x) * (1.0 - weight.y));
  float isSeen = step(MinimumFacing * length(way), facing) * IsKept(seen.At);
  Sighting sighting;
  sighting.Address = TexelAddress(seen.At, base);
  sighting.Texels =
    isSeen * shares * vec4(lessThan(abs(inverse - expected), vec4(tolerance)));
  sighting.Share = dot(sighting.Texels, vec4(1.0));
  return sighting;
}

// The sum of what a view sees at the texels on the surface, with their alpha. Where a texel is
// covered only in part, it shows a silhouette, which is the geometry's business.
vec4 ReadSurfaceColor(Sighting sighting)
{
  ivec3 address = sighting.Address;
  vec4 texel01 = texelFetch(ColorTexture, address + ivec3(0, 1, 0), 0);
  vec4 texel11 = texelFetch(ColorTexture, address + ivec3(1, 1, 0), 0);
  vec4 texel10 = texelFetch(ColorTexture, address + ivec3(1, 0, 0), 0);
  vec4 texel00 = texelFetch(ColorTexture, address, 0);
  return sighting.Texels.x * texel01 + sighting.Texels.y * texel11 + sighting.Texels.z * texel10 +
    sighting.Texels.w * texel00;
}

// Colours are added up view by view, because keeping all sightings until the end would take many
// registers.
void Add(inout vec4 sum, inout float share, View view, float weight, GeometryPoint surface)
{
  Sighting sighting = See(view, surface);
  sum += weight * ReadSurfaceColor(sighting);
  share += weight * sighting.Share;
}

vec4 ToMean(vec4 sum)
{
  return sum.a > 0.0 ? sum / sum.a : vec4(0.0);
}

// How near a viewpoint is to the line of sight, as a weight.
float NearnessOf(vec2 viewpoint, GeometryPoint surface)
{
  vec3 toView = normalize(vec3(viewpoint, 0.0) - surface.Point);
  float away = length(toView - surface.ToEye) + MinimumAngle;
  return 1.0 / (away * away);
}

// The nearest viewpoint to a place on the face: its coordinates and slot.
vec3 FindViewpoint(vec2 coordinates)
{
  Cell cell = FindCell(coordinates);
  bvec2 isUpper = greaterThan(coordinates - cell.Lower, cell.Upper - coordinates);
  float slot = isUpper.x ? (isUpper.y ? cell.Slots.w : cell.Slots.y)
                         : (isUpper.y ? cell.Slots.z : cell.Slots.x);
  return vec3(mix(cell.Lower, cell.Upper, isUpper), slot);
}

bool IsFacing(vec2 viewpoint, GeometryPoint surface)
{
  vec3 toView = vec3(viewpoint, 0.0) - surface.Point;
  return dot(surface.Normal, toView) >= MinimumFacing * length(toView);
}

// By the viewpoints around the entry. Nothing, if they see little of the point.
vec4 LookupNear(GeometryPoint surface)
{
  ViewCell views = FindViews(vec3(surface.Entry, 0.0));
  vec4 weights = ListWeights(views) + MinimumWeight;
  vec4 sum = vec4(0.0);
  float share = 0.0;
  Add(sum, share, views.View00, weights.x, surface);
  Add(sum, share, views.View10, weights.y, surface);
  Add(sum, share, views.View01, weights.z, surface);
  Add(sum, share, views.View11, weights.w, surface);
  return share > EnoughSight ? ToMean(sum) : vec4(0.0);
}

// Viewpoints in rings around the entry, 8 in each.
struct Rings
{
  vec2 CellSize;
  float Ring;
  float Last; // less than the first if no viewpoint of the face can see the point
  int Next;   // in the ring
};

Rings StartRings(GeometryPoint surface)
{
  Cell inner = FindCell(surface.Entry);
  vec2 size = inner.Upper - inner.Lower;
  bool isBehind =
    abs(surface.Normal.x) + abs(surface.Normal.y) <= dot(surface.Normal, surface.Point);
  return Rings(size, 1.0, isBehind ? 0.0 : floor(2.0 / min(size.x, size.y) + 0.5), 0);
}

// Goes on to the next viewpoint that the surface faces. False at the end of the rings, or of this
// ring if it was enough. Without this, which is cheap, most viewpoints would be asked in vain.
bool FindNext(inout Rings rings, bool isEnough, GeometryPoint surface, out vec3 viewpoint)
{
  viewpoint = vec3(0.0);
  while (rings.Ring <= rings.Last && !(isEnough && rings.Next == 0))
  {
    int i = rings.Next;
    vec2 way = vec2(i == 0 || i == 1 || i == 7 ? 1.0 : i == 2 || i == 6 ? 0.0 : -1.0,
      i > 0 && i < 4 ? 1.0 : i == 0 || i == 4 ? 0.0 : -1.0);
    vec2 place = surface.Entry + rings.Ring * rings.CellSize * way;
    rings.Next = (i + 1) & 7;
    rings.Ring += rings.Next == 0 ? max(1.0, floor(RingGrowth * rings.Ring)) : 0.0;
    viewpoint = FindViewpoint(clamp(place, -1.0, 1.0));
    if (all(lessThan(abs(place), vec2(1.0) + 0.5 * rings.CellSize)) &&
      IsFacing(viewpoint.xy, surface))
    {
      return true;
    }
  }
  return false;
}

// By viewpoints farther away: up to four of the first ring that has any.
vec4 LookupFar(GeometryPoint surface)
{
  Rings rings = StartRings(surface);
  vec4 sum = vec4(0.0);
  int count = 0;
  vec3 viewpoint;
  while (count < 4 && FindNext(rings, count > 0, surface, viewpoint))
  {
    float share = 0.0;
    Add(sum, share, MakeView(viewpoint.z, viewpoint.xy, vec2(1.0)),
      NearnessOf(viewpoint.xy, surface), surface);
    count += share > 0.0 ? 1 : 0;
  }
  return ToMean(sum);
}

// The geometry's own colour, where it alone shows the surface well.
vec4 LookupExact(GeometryPoint surface)
{
  vec4 color = texelFetch(SurfaceColors, PictureTexel(), 0);
  return color.a > 0.99 ? color / color.a : vec4(0.0);
}

// The geometry's own colour.
vec4 LookupOwn(GeometryPoint surface)
{
  vec4 color = texelFetch(SurfaceColors, PictureTexel(), 0);
  return color.a > 0.0 ? color / color.a : vec4(0.0);
}
