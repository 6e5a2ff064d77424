// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The lookups, the twin of Rendering/cslfLookup.cxx, where every step is explained. Positions along
// a ray are inverse fractions w: the chord's point at w is Entry + Chord / w. All points are in FC.

const float NearestStart = 40.0;
const float NearestFocus = 0.05;
const float TexelsPerStep = 3.0;
const float StepShare = 0.08;
const float MostStride = 0.5;
const int MostSteps = 96;
const int MostCandidates = 16;
const int Refinements = 12;
const float LeastShare = 0.02;
const float Convergence = 0.0005;
const float RestartShare = 0.02;
const float EdgeStep = 0.03;
const float ClearanceTolerance = 0.05;
const float SightTolerance = 0.1;
const float LeastWeight = 0.0001;

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
  float Tile;
  vec2 Coordinates;
  float InverseDepth;
};

// The viewpoints around a ray's entry.
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

// What a ray meets.
struct Surface
{
  float W;    // 0: nothing
  vec4 Sight; // how well the four views see it, in [0,1]
};

View MakeView(vec2 node, vec2 position, vec2 weight)
{
  View view;
  view.Slice = FindSlice(node.x, node.y);
  view.Position = position;
  view.InverseToPositive = InverseToPositive(position);
  view.InverseToNegative = InverseToNegative(position);
  view.Weight = weight.x * weight.y;
  return view;
}

ViewCell FindViews(vec3 entry)
{
  NodeBracket u = FindNodes(entry.x);
  NodeBracket v = FindNodes(entry.y);
  vec2 node = vec2(u.Lower, v.Lower);
  vec2 lower = vec2(u.LowerCoordinate, v.LowerCoordinate);
  vec2 upper = vec2(u.UpperCoordinate, v.UpperCoordinate);
  vec2 weight = vec2(u.Weight, v.Weight);
  ViewCell views;
  views.View00 = MakeView(node, lower, 1.0 - weight);
  views.View10 = MakeView(node + vec2(1.0, 0.0), vec2(upper.x, lower.y),
    vec2(weight.x, 1.0 - weight.y));
  views.View01 = MakeView(node + vec2(0.0, 1.0), vec2(lower.x, upper.y),
    vec2(1.0 - weight.x, weight.y));
  views.View11 = MakeView(node + 1.0, upper, weight);
  float reach = length(max(entry.xy - lower, upper - entry.xy));
  views.Stride = min(2.0 * TexelsPerStep / (Resolution * reach), MostStride);
  return views;
}

View FindNearestView(vec3 entry)
{
  NodeBracket u = FindNodes(entry.x);
  NodeBracket v = FindNodes(entry.y);
  bool upperU = u.Weight > 0.5;
  bool upperV = v.Weight > 0.5;
  return MakeView(vec2(upperU ? u.Lower + 1.0 : u.Lower, upperV ? v.Lower + 1.0 : v.Lower),
    vec2(upperU ? u.UpperCoordinate : u.LowerCoordinate,
      upperV ? v.UpperCoordinate : v.LowerCoordinate),
    vec2(1.0));
}

Projection Project(View view, vec3 point)
{
  vec3 direction = vec3(point.xy - view.Position, point.z);
  vec3 share = ShareOfWays(direction, view.InverseToPositive, view.InverseToNegative);
  Projection seen;
  seen.InverseDepth = 1.0 / max(max(max(share.x, share.y), share.z), LeastDepth);
  vec3 exit = vec3(view.Position, -1.0) + seen.InverseDepth * direction;
  bool toX = share.x > max(share.y, share.z);
  bool toY = share.y > share.z;
  vec2 sideX = ExitCoordinates(SideXAxes, exit.yz);
  vec2 sideY = ExitCoordinates(SideYAxes, exit.xz);
  vec2 opposite = ExitCoordinates(OppositeAxes, exit.xy);
  sideX = direction.x < 0.0 ? sideX * SideXFlip : sideX;
  sideY = direction.y < 0.0 ? sideY * SideYFlip : sideY;
  float tileX = direction.x < 0.0 ? SideXTiles.y : SideXTiles.x;
  float tileY = direction.y < 0.0 ? SideYTiles.y : SideYTiles.x;
  seen.Coordinates = toX ? sideX : (toY ? sideY : opposite);
  seen.Tile = toX ? tileX : (toY ? tileY : OppositeTile);
  return seen;
}

// Where the surface that a view sees in the direction of a point lies along the ray.
float GuessSurface(Ray ray, View view, float fraction)
{
  if (!HasDepth)
  {
    return fraction;
  }
  vec3 point = ray.Entry + fraction * ray.Chord;
  Projection seen = Project(view, point);
  float depth = max(ReadNearestDepth(view.Slice, seen.Tile, seen.Coordinates), LeastDepth);
  vec3 viewpoint = vec3(view.Position, 0.0);
  vec3 surface = viewpoint + (point - viewpoint) * (seen.InverseDepth * depth);
  return clamp(dot(surface - ray.Entry, ray.Chord) / dot(ray.Chord, ray.Chord), 0.0, 1.0);
}

vec4 ReadColorOf(View view, vec3 point)
{
  Projection seen = Project(view, point);
  return ReadColor(view.Slice, seen.Tile, seen.Coordinates);
}

LookupResult LookThrough(Ray ray, float fraction)
{
  ViewCell views = FindViews(ray.Entry);
  vec3 point = ray.Entry + fraction * ray.Chord;
  LookupResult result;
  result.Color = views.View00.Weight * ReadColorOf(views.View00, point) +
    views.View10.Weight * ReadColorOf(views.View10, point) +
    views.View01.Weight * ReadColorOf(views.View01, point) +
    views.View11.Weight * ReadColorOf(views.View11, point);
  result.Fraction = GuessSurface(ray, FindNearestView(ray.Entry), fraction);
  return result;
}

LookupResult LookupNearest(Ray ray)
{
  View view = FindNearestView(ray.Entry);
  Projection exit = Project(MakeView(vec2(0.0), ray.Entry.xy, vec2(1.0)), ray.Entry + ray.Chord);
  return LookupResult(ReadNearestColor(view.Slice, exit.Tile, exit.Coordinates),
    GuessSurface(ray, view, 1.0));
}

LookupResult LookupLinear(Ray ray)
{
  View view = FindNearestView(ray.Entry);
  return LookupResult(ReadColorOf(view, ray.Entry + ray.Chord), GuessSurface(ray, view, 1.0));
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
    return LookupResult(vec4(0.0), 1.0);
  }
  float fraction =
    dot(FocalPointFC - ray.Entry, ray.Chord) / dot(ray.Chord, ray.Chord);
  return LookThrough(ray, max(NearestFocus, clamp(fraction, range.x, range.y)));
}

float Clearance(View view, vec3 point)
{
  Projection seen = Project(view, point);
  return seen.InverseDepth - ReadInverseDepth(view.Slice, seen.Tile, seen.Coordinates);
}

// Of the four views, in the order 00, 10, 01, 11.
vec4 Clearances(Ray ray, ViewCell views, float w)
{
  vec3 point = ray.Entry + ray.Chord / w;
  return vec4(Clearance(views.View00, point), Clearance(views.View10, point),
    Clearance(views.View01, point), Clearance(views.View11, point));
}

// 1 for the views whose sight ends between two points of the ray, 0 for the others.
vec4 EndsOfSight(vec4 before, vec4 behind)
{
  return vec4(greaterThan(before, vec4(0.0))) * vec4(lessThanEqual(behind, vec4(0.0)));
}

// Which view's sight ends first between `before` and `behind`: 1 for it, 0 for the others.
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
    w = mix(behind, before, clamp(share, LeastShare, 1.0 - LeastShare));
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

// Goes on from `step.Behind` to where some view's sight ends. False where there is no such place.
bool FindStep(Ray ray, ViewCell views, GridRay gridRay, vec2 range, inout Step step)
{
  while (step.Behind > range.y && step.Count < MostSteps)
  {
    step.Behind = SkipEmpty(gridRay, step.Behind, range.y);
    if (step.Behind <= range.y)
    {
      break;
    }
    step.ClearancesBehind = Clearances(ray, views, step.Behind);
    if (step.FirstHidden == 0.0 && all(lessThanEqual(step.ClearancesBehind, vec4(0.0))))
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
      step.ClearancesBehind = Clearances(ray, views, step.Behind);
      ++step.Count;
      if (EndsOfSight(step.ClearancesBefore, step.ClearancesBehind) != vec4(0.0))
      {
        return true;
      }
      inside = step.Behind > range.y && step.Count < MostSteps && IsOccupied(gridRay, step.Behind);
    }
  }
  return false;
}

Surface FindSurface(Ray ray, ViewCell views)
{
  GridRay gridRay = CastGridRay(ray);
  vec2 range = ClipToScene(gridRay);
  range = 1.0 / max(range, 1.0 / NearestStart);
  Step step;
  step.Behind = range.x;
  step.Count = 0;
  step.FirstHidden = 0.0;
  for (int i = 0; i < MostCandidates; ++i)
  {
    if (!FindStep(ray, views, gridRay, range, step))
    {
      break;
    }
    vec4 chosen = ChooseCrossing(step.ClearancesBefore, step.ClearancesBehind);
    float w = RefineCrossing(ray, ChooseView(views, chosen), step.Before, step.Behind,
      dot(step.ClearancesBefore, chosen), dot(step.ClearancesBehind, chosen));
    vec4 clearances = Clearances(ray, views, w);
    bool isSeenThrough = any(greaterThan(clearances, vec4(ClearanceTolerance * w)));
    bool isSurface = abs(dot(clearances, chosen)) < EdgeStep * w;
    if (!isSeenThrough && isSurface)
    {
      vec4 near = max(vec4(0.0), 1.0 - abs(clearances) / (SightTolerance * w));
      vec4 fromFront = vec4(lessThan(clearances, step.ClearancesBefore));
      return Surface(w, near * fromFront);
    }
    if (!isSeenThrough && step.FirstHidden == 0.0)
    {
      step.FirstHidden = w;
    }
    step.Behind = w - RestartShare * views.Stride;
  }
  return Surface(step.FirstHidden, vec4(0.0));
}

// The views that see the surface from the ray's side share its colour; where none does, all.
vec4 BlendVisible(Ray ray, ViewCell views, Surface surface)
{
  vec3 point = ray.Entry + ray.Chord / surface.W;
  vec4 weights = vec4(views.View00.Weight, views.View10.Weight, views.View01.Weight,
    views.View11.Weight);
  vec4 visible = (weights + LeastWeight) * surface.Sight;
  float sum = dot(visible, vec4(1.0));
  weights = sum > 0.0 ? visible / sum : weights;
  return weights.x * ReadColorOf(views.View00, point) +
    weights.y * ReadColorOf(views.View10, point) + weights.z * ReadColorOf(views.View01, point) +
    weights.w * ReadColorOf(views.View11, point);
}

LookupResult LookupDepth(Ray ray)
{
  if (!HasDepth)
  {
    return LookupFocal(ray);
  }
  ViewCell views = FindViews(ray.Entry);
  Surface surface = FindSurface(ray, views);
  if (surface.W == 0.0)
  {
    return LookupResult(vec4(0.0), 1.0);
  }
  return LookupResult(BlendVisible(ray, views, surface), 1.0 / surface.W);
}
