// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The lookups, as in cslfLookup.cxx, which explains every step. Positions along a ray are inverse
// fractions w: the chord's point at w is Entry + Chord / w. All points are in FC.

uniform vec3 FocalPointFC;

// What a lookup returns: the places where the four views see what the ray sees.
struct LookupResult
{
  Place Place00;
  Place Place10;
  Place Place01;
  Place Place11;
  vec4 Weights;   // of the places; those whose tiles are not stored do not count
  bool IsNearest; // whether the nearest texel is to be read, otherwise texels are interpolated
  float Fraction; // of the way from entry to exit
  bool IsFinal;   // otherwise the ray is left to another lookup
};

struct View
{
  SlicePlace Slice;
  vec2 Position;
  vec2 InverseToPositive;
  vec2 InverseToNegative;
  float Weight;
};

struct Projection
{
  Place At;
  float InverseDepth;
};

// The viewpoints around a ray's entry: 00 is the nearest, 11 is opposite to it.
struct ViewCell
{
  View View00;
  View View10;
  View View01;
  View View11;
  float Stride; // in w, of the search
};

// A step of the search along a ray. The clearances are those of the four views.
struct Step
{
  float Before;
  vec4 ClearancesBefore;
  float Behind;
  vec4 ClearancesBehind;
  int Count;         // of the steps so far
  float FirstHidden; // where no view sees the ray's points first; 0: nowhere so far
};

// The hit of a ray.
struct Surface
{
  float W;    // 0: nothing
  vec4 Sight; // how well the four views see it, in [0,1]
};

View MakeView(float slot, vec2 position, vec2 weight)
{
  View view;
  view.Slice = FindSlice(slot);
  view.Position = position;
  view.InverseToPositive = InverseToPositive(position);
  view.InverseToNegative = InverseToNegative(position);
  view.Weight = weight.x * weight.y;
  return view;
}

// `slots` are those at the lower corner, at upper u, at upper v and at both.
ViewCell MakeCell(vec3 entry, vec4 slots, vec2 lower, vec2 upper)
{
  vec2 weight = clamp((entry.xy - lower) / (upper - lower), 0.0, 1.0);
  bvec2 isUpper = greaterThan(weight, vec2(0.5));
  slots = isUpper.x ? slots.yxwz : slots;
  slots = isUpper.y ? slots.zwxy : slots;
  vec2 near = mix(lower, upper, isUpper);
  vec2 far = mix(upper, lower, isUpper);
  vec2 nearWeight = max(weight, 1.0 - weight);
  vec2 farWeight = 1.0 - nearWeight;
  ViewCell views;
  views.View00 = MakeView(slots.x, near, nearWeight);
  views.View10 = MakeView(slots.y, vec2(far.x, near.y), vec2(farWeight.x, nearWeight.y));
  views.View01 = MakeView(slots.z, vec2(near.x, far.y), vec2(nearWeight.x, farWeight.y));
  views.View11 = MakeView(slots.w, far, farWeight);
  views.Stride = min(2.0 * TexelsPerStep / (Resolution * length(far - entry.xy)), MaximumStride);
  return views;
}

ViewCell FindViews(vec3 entry)
{
  Cell cell = FindCell(entry.xy);
  return MakeCell(entry, cell.Slots, cell.Lower, cell.Upper);
}

// The viewpoints at the corners of that many rings of cells around the inner ones. They may see
// what the inner ones do not.
ViewCell FindOuterViews(vec3 entry, float rings)
{
  Cell inner = FindCell(entry.xy);
  vec2 reach = (rings - 0.5) * (inner.Upper - inner.Lower);
  vec2 low = max(inner.Lower - reach, -1.0);
  vec2 high = min(inner.Upper + reach, 1.0);
  Cell cell00 = FindCell(low);
  Cell cell10 = FindCell(vec2(high.x, low.y));
  Cell cell01 = FindCell(vec2(low.x, high.y));
  Cell cell11 = FindCell(high);
  vec2 lower = cell00.Lower;
  vec2 upper = cell11.Upper;
  // The viewpoints of cells of different levels are not the corners of a rectangle.
  bool is10 = cell10.Upper.x == upper.x && cell10.Lower.y == lower.y;
  bool is01 = cell01.Lower.x == lower.x && cell01.Upper.y == upper.y;
  return MakeCell(entry,
    vec4(cell00.Slots.x, is10 ? cell10.Slots.y : AbsentSlot, is01 ? cell01.Slots.z : AbsentSlot,
      cell11.Slots.w),
    lower, upper);
}

// The components along (s,t) of a vector, or the (s,t) of a point with z - 1 in place of z, on the
// exit face that a direction with these shares meets.
vec2 ToExitFace(vec3 share, vec3 direction, vec3 vector)
{
  vec2 sideX = ExitCoordinates(SideXAxes, vector.yz);
  vec2 sideY = ExitCoordinates(SideYAxes, vector.xz);
  vec2 opposite = ExitCoordinates(OppositeAxes, vector.xy);
  sideX = direction.x < 0.0 ? sideX * SideXFlip : sideX;
  sideY = direction.y < 0.0 ? sideY * SideYFlip : sideY;
  return share.x > max(share.y, share.z) ? sideX : (share.y > share.z ? sideY : opposite);
}

vec3 ShareOfWays(View view, vec3 direction)
{
  return ShareOfWays(direction, view.InverseToPositive, view.InverseToNegative);
}

Projection Project(View view, vec3 point)
{
  vec3 direction = vec3(point.xy - view.Position, point.z);
  vec3 share = ShareOfWays(view, direction);
  Projection seen;
  seen.At.Slice = view.Slice;
  seen.InverseDepth = 1.0 / max(max(max(share.x, share.y), share.z), MinimumDepth);
  vec3 exit = vec3(view.Position, -1.0) + seen.InverseDepth * direction;
  float blockX = direction.x < 0.0 ? SideXBlocks.y : SideXBlocks.x;
  float blockY = direction.y < 0.0 ? SideYBlocks.y : SideYBlocks.x;
  seen.At.Coordinates = ToExitFace(share, direction, exit);
  seen.At.Block = share.x > max(share.y, share.z)
    ? blockX
    : (share.y > share.z ? blockY : OppositeBlock);
  return seen;
}

// The position along the ray of the surface that a view sees in the direction of a point.
float GuessSurface(Ray ray, View view, float fraction)
{
#ifdef HAS_DEPTH
  vec3 point = ray.Entry + fraction * ray.Chord;
  Projection seen = Project(view, point);
  float depth = max(ReadNearestDepth(seen.At), MinimumDepth);
  vec3 viewpoint = vec3(view.Position, 0.0);
  vec3 surface = viewpoint + (point - viewpoint) * (seen.InverseDepth * depth);
  float guess = clamp(dot(surface - ray.Entry, ray.Chord) / dot(ray.Chord, ray.Chord), 0.0, 1.0);
  return IsKept(seen.At) > 0.0 ? guess : fraction;
#else
  return fraction;
#endif
}

vec4 ListWeights(ViewCell views)
{
  return vec4(views.View00.Weight, views.View10.Weight, views.View01.Weight, views.View11.Weight);
}

// Where a single view is read.
LookupResult AtPlace(Place place, float fraction)
{
  return LookupResult(
    place, place, place, place, vec4(1.0, 0.0, 0.0, 0.0), false, fraction, true);
}

// Where the views see a point.
LookupResult FindPlaces(ViewCell views, vec3 point, vec4 weights, float fraction)
{
  Place place00 = Project(views.View00, point).At;
  Place place10 = Project(views.View10, point).At;
  Place place01 = Project(views.View01, point).At;
  Place place11 = Project(views.View11, point).At;
  return LookupResult(place00, place10, place01, place11, weights, false, fraction, true);
}

LookupResult FindNothing()
{
  Place place = Place(SlicePlace(0.0, 0.0), 0.0, vec2(0.0));
  return LookupResult(place, place, place, place, vec4(0.0), false, 1.0, true);
}

LookupResult LookThrough(Ray ray, float fraction)
{
  ViewCell views = FindViews(ray.Entry);
  vec3 point = ray.Entry + fraction * ray.Chord;
  return FindPlaces(
    views, point, ListWeights(views), GuessSurface(ray, views.View00, fraction));
}

LookupResult LookupNearest(Ray ray)
{
  View view = FindViews(ray.Entry).View00;
  Place place = Project(MakeView(0.0, ray.Entry.xy, vec2(1.0)), ray.Entry + ray.Chord).At;
  place.Slice = view.Slice;
  LookupResult result = AtPlace(place, GuessSurface(ray, view, 1.0));
  result.IsNearest = true;
  return result;
}

LookupResult LookupLinear(Ray ray)
{
  View view = FindViews(ray.Entry).View00;
  return AtPlace(Project(view, ray.Entry + ray.Chord).At, GuessSurface(ray, view, 1.0));
}

LookupResult LookupBilinear(Ray ray)
{
  return LookThrough(ray, 1.0);
}

LookupResult LookupFocal(Ray ray)
{
  vec2 range = ClipToScene(CastGridRay(ray));
  if (range.x >= range.y)
  {
    return FindNothing();
  }
  float fraction =
    dot(FocalPointFC - ray.Entry, ray.Chord) / dot(ray.Chord, ray.Chord);
  return LookThrough(ray, max(NearestFocus, clamp(fraction, range.x, range.y)));
}

float Clearance(View view, vec3 point)
{
  Projection seen = Project(view, point);
  return seen.InverseDepth - ReadInverseDepth(seen.At);
}

// Of the views 00, 10, 01, 11. The last one is computed only on request.
vec4 Clearances(Ray ray, ViewCell views, float w, bool all)
{
  vec3 point = ray.Entry + ray.Chord / w;
  return vec4(Clearance(views.View00, point), Clearance(views.View10, point),
    Clearance(views.View01, point), all ? Clearance(views.View11, point) : NotAsked);
}

// Whether any view knows that a point is hidden, and none sees through it.
bool IsHidden(vec4 clearances)
{
  return all(lessThanEqual(clearances, vec4(0.0))) && any(greaterThan(clearances, vec4(-Unknown)));
}

// The views whose sight ends between two points of the ray.
bvec4 EndsOfSight(vec4 before, vec4 behind)
{
  return greaterThan(vec4(greaterThan(before, vec4(0.0))), vec4(greaterThan(behind, vec4(0.0))));
}

// The view whose sight ends first between `before` and `behind`: 1 for it, 0 for the others.
vec4 ChooseCrossing(vec4 before, vec4 behind)
{
  vec4 share = mix(vec4(-1.0), behind / (behind - before), EndsOfSight(before, behind));
  float first = max(max(share.x, share.y), max(share.z, share.w));
  vec4 chosen = vec4(share.x == first ? 1.0 : 0.0, 0.0, 0.0, 0.0);
  chosen.y = share.y == first ? 1.0 - chosen.x : 0.0;
  chosen.z = share.z == first ? 1.0 - chosen.x - chosen.y : 0.0;
  chosen.w = 1.0 - chosen.x - chosen.y - chosen.z;
  return chosen;
}

View ChooseView(ViewCell views, vec4 chosen)
{
  if (chosen.x > 0.0)
  {
    return views.View00;
  }
  if (chosen.y > 0.0)
  {
    return views.View10;
  }
  if (chosen.z > 0.0)
  {
    return views.View01;
  }
  return views.View11;
}

float RefineCrossing(Ray ray, View view, float before, float behind, float clearanceBefore,
  float clearanceBehind)
{
  float w = behind;
  for (int i = 0; i < Refinements; ++i)
  {
    float share = clearanceBehind / (clearanceBehind - clearanceBefore);
    w = mix(behind, before, clamp(share, MinimumShare, 1.0 - MinimumShare));
    float clearance = Clearance(view, ray.Entry + ray.Chord / w);
    if (abs(clearance) < Convergence * w)
    {
      break;
    }
    if (clearance > 0.0)
    {
      before = w;
      clearanceBefore = clearance;
    }
    else
    {
      behind = w;
      clearanceBehind = clearance;
    }
  }
  return w;
}

// Continues from `step.Behind` to where any view's sight ends. False if there is no such place.
bool FindStep(
  Ray ray, ViewCell views, GridRay gridRay, vec2 range, bool all, inout Step step)
{
  while (step.Behind > range.y && step.Count < MaximumSteps)
  {
    step.Behind = SkipEmpty(gridRay, step.Behind, range.y);
    if (step.Behind <= range.y)
    {
      break;
    }
    step.ClearancesBehind = Clearances(ray, views, step.Behind, all);
    if (step.FirstHidden == 0.0 && IsHidden(step.ClearancesBehind))
    {
      step.FirstHidden = step.Behind;
    }
    bool inside = true;
    while (inside)
    {
      step.Before = step.Behind;
      step.ClearancesBefore = step.ClearancesBehind;
      float stride = max(views.Stride, StepShare * step.Before);
      step.Behind = max(step.Before - stride, range.y);
      step.ClearancesBehind = Clearances(ray, views, step.Behind, all);
      ++step.Count;
      if (any(EndsOfSight(step.ClearancesBefore, step.ClearancesBehind)))
      {
        return true;
      }
      inside = step.Behind > range.y && step.Count < MaximumSteps && IsOccupied(gridRay, step.Behind);
    }
  }
  return false;
}

// How well views see a point with these clearances, in [0,1].
vec4 Nearness(vec4 clearances, float w)
{
  return max(vec4(0.0), 1.0 - abs(clearances) / (SightTolerance * w));
}

// The normal of the surface that a view sees at a point, divided by the distance of its plane from
// the viewpoint.
vec3 FindNormal(View view, vec3 point)
{
  vec3 way = vec3(point.xy - view.Position, point.z);
  vec3 share = ShareOfWays(view, way);
  vec2 slope = ReadSlope(Project(view, point).At);
  vec3 normal = vec3(dot(slope, ToExitFace(share, way, vec3(1.0, 0.0, 0.0))),
    dot(slope, ToExitFace(share, way, vec3(0.0, 1.0, 0.0))),
    dot(slope, ToExitFace(share, way, vec3(0.0, 0.0, 1.0))));
  float along = 1.0 - dot(normal, way);
  if (share.x > max(share.y, share.z))
  {
    return normal + vec3(along / way.x, 0.0, 0.0);
  }
  return normal +
    (share.y > share.z ? vec3(0.0, along / way.y, 0.0) : vec3(0.0, 0.0, along / way.z));
}

// The views whose viewpoint lies within a texel of the plane of the surface that `view` sees at a
// point. The surface may be too thin in their images to show.
bvec4 SeeEdgeOn(ViewCell views, View view, vec3 point, float w)
{
  vec3 normal = FindNormal(view, point);
  float atPoint = dot(normal, point);
  vec4 distances = vec4(dot(normal.xy, views.View00.Position),
                     dot(normal.xy, views.View10.Position), dot(normal.xy, views.View01.Position),
                     dot(normal.xy, views.View11.Position)) -
    atPoint;
  return lessThan(
    abs(distances), vec4(EdgeOnTexels * 2.0 / (Resolution * w) * length(normal)));
}

// Steps with all four views, or with the three nearest.
Surface FindSurface(Ray ray, ViewCell views, GridRay gridRay, vec2 range, bool all)
{
  Step step;
  step.Behind = range.x;
  step.Count = 0;
  step.FirstHidden = 0.0;
  Surface doubtful = Surface(0.0, vec4(0.0));
  float least = DoubtTexels / Resolution;
  float w = 0.0;
  vec4 clearances = vec4(0.0);
  bool isFound = false;
  for (int i = 0; i < MaximumCandidates; ++i)
  {
    if (!FindStep(ray, views, gridRay, range, all, step))
    {
      break;
    }
    vec4 chosen = ChooseCrossing(step.ClearancesBefore, step.ClearancesBehind);
    w = RefineCrossing(ray, ChooseView(views, chosen), step.Before, step.Behind,
      dot(step.ClearancesBefore, chosen), dot(step.ClearancesBehind, chosen));
    clearances = Clearances(ray, views, w, true);
    float most = max(max(clearances.x, clearances.y), max(clearances.z, clearances.w)) / w;
    bool isSeenThrough = most > ClearanceTolerance;
    bool isSurface = abs(dot(clearances, chosen)) < EdgeStep * w;
    if (isSurface && most < least)
    {
      least = most;
      doubtful = Surface(w, Nearness(clearances, w));
    }
    if (isSurface && isSeenThrough)
    {
      vec4 seers = vec4(greaterThan(clearances, vec4(ClearanceTolerance * w)));
      bvec4 edgeOn = SeeEdgeOn(views, ChooseView(views, chosen), ray.Entry + ray.Chord / w, w);
      isSeenThrough = any(greaterThan(seers, vec4(edgeOn)));
    }
    isFound = !isSeenThrough && isSurface;
    if (isFound)
    {
      break;
    }
    bool isKnown = any(greaterThan(clearances, vec4(-Unknown)));
    if (!isSeenThrough && isKnown && step.FirstHidden == 0.0)
    {
      step.FirstHidden = w;
    }
    step.Behind = w - RestartShare * views.Stride;
  }
  if (isFound)
  {
    float before = all ? step.ClearancesBefore.w
                       : Clearance(views.View11, ray.Entry + ray.Chord / step.Before);
    vec4 fromFront = vec4(lessThan(clearances, vec4(step.ClearancesBefore.xyz, before)));
    return Surface(w, Nearness(clearances, w) * fromFront);
  }
  if (step.FirstHidden > 0.0)
  {
    return Surface(step.FirstHidden, vec4(0.0));
  }
#ifdef SHOWS_ENVIRONMENT
  if (doubtful.W == 0.0)
  {
    return Surface(1.0, Nearness(Clearances(ray, views, 1.0, true), 1.0));
  }
#endif
  return doubtful;
}

// Where the views see the surface of a ray, if there is one: those that see it from the ray's side;
// if there are none, all.
LookupResult FindVisible(Ray ray, ViewCell views, Surface surface)
{
  vec4 weights = ListWeights(views);
  vec4 visible = (weights + MinimumWeight) * surface.Sight;
  float sum = dot(visible, vec4(1.0));
  return FindPlaces(views, ray.Entry + ray.Chord / surface.W, sum > 0.0 ? visible / sum : weights,
    1.0 / surface.W);
}

// The range of w in which the scene can lie.
vec2 FindRange(GridRay gridRay)
{
  return 1.0 / max(ClipToScene(gridRay), 1.0 / NearestStart);
}

// The surface found with the three nearest views. False if none of the four sees it.
bool FindSeen(Ray ray, ViewCell views, out Surface surface)
{
  GridRay gridRay = CastGridRay(ray);
  surface = FindSurface(ray, views, gridRay, FindRange(gridRay), false);
  return surface.W == 0.0 || surface.Sight != vec4(0.0);
}

// With the three nearest views. Not final if none of the four sees the surface.
LookupResult LookupSeen(Ray ray)
{
  ViewCell views = FindViews(ray.Entry);
  Surface surface;
  bool isSeen = FindSeen(ray, views, surface);
  LookupResult result = FindNothing();
  if (surface.W > 0.0)
  {
    result = FindVisible(ray, views, surface);
  }
  result.IsFinal = isSeen;
  return result;
}

// Viewpoints farther and farther away may see what the four views do not.
void SearchAround(
  Ray ray, GridRay gridRay, vec2 range, inout ViewCell views, inout Surface surface)
{
  float hidden = surface.W;
  range.x = min(hidden + max(views.Stride, StepShare * hidden), range.x);
  vec4 clearances = Clearances(ray, views, hidden, true);
  float known = dot(vec4(greaterThan(clearances, vec4(-Unknown))), ListWeights(views));
  vec2 size = abs(views.View11.Position - views.View00.Position);
  float cells = known > KnownShare ? floor(2.0 / min(size.x, size.y) + 0.5) : 0.0;
  for (float rings = 1.0; surface.Sight == vec4(0.0) && rings < cells; rings = 2.0 * rings + 1.0)
  {
    ViewCell outer = FindOuterViews(ray.Entry, rings);
    Surface seen = FindSurface(ray, outer, gridRay, range, true);
    if (seen.W < hidden && any(greaterThan(seen.Sight, vec4(OuterSight))))
    {
      surface = seen;
      views = outer;
    }
  }
}

// With all four views, then with those farther around.
Surface FindUnseen(Ray ray, out ViewCell views)
{
  GridRay gridRay = CastGridRay(ray);
  vec2 range = FindRange(gridRay);
  views = FindViews(ray.Entry);
  Surface surface = FindSurface(ray, views, gridRay, range, true);
  if (surface.W > 0.0)
  {
    SearchAround(ray, gridRay, range, views, surface);
  }
  return surface;
}

// For rays that LookupSeen leaves.
LookupResult LookupUnseen(Ray ray)
{
  ViewCell views;
  Surface surface = FindUnseen(ray, views);
  return surface.W > 0.0 ? FindVisible(ray, views, surface) : FindNothing();
}

// The same for rays that miss the geometry: what no view sees is nothing.
LookupResult LookupAround(Ray ray)
{
  ViewCell views;
  Surface surface = FindUnseen(ray, views);
  return surface.Sight != vec4(0.0) ? FindVisible(ray, views, surface) : FindNothing();
}

// Final if the grid has nothing on the ray.
LookupResult LookupEmpty(Ray ray)
{
  LookupResult result = FindNothing();
  GridRay gridRay = CastGridRay(ray);
  vec2 range = FindRange(gridRay);
#ifdef SHOWS_ENVIRONMENT
  result.IsFinal = false;
#else
  result.IsFinal = SkipEmpty(gridRay, range.x, range.y) == 0.0;
#endif
  return result;
}
