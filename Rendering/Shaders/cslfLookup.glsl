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
const float Unknown = 2000.0;

// Of guesses, which only this side has: how far the surface may be from the plane, as a share of w;
// within how many cells of the plane the grid's first cell that is not empty counts as its own; and
// the least slope that a shift is worked out with.
const float GuessTolerance = 0.02;
const float GuessCells = 2.5;
const float LeastSlope = 0.01;

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
  float Block;
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
  float W;      // 0: nothing
  vec4 Sight;   // how well the four views see it, in [0,1]
  float Hidden; // where no view sees the ray's points before it; 0: nowhere
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

ViewCell FindViews(vec3 entry)
{
  Cell cell = FindCell(entry.xy);
  vec2 lower = 1.0 - cell.Weight;
  ViewCell views;
  views.View00 = MakeView(cell.Slots.x, cell.Lower, lower);
  views.View10 =
    MakeView(cell.Slots.y, vec2(cell.Upper.x, cell.Lower.y), vec2(cell.Weight.x, lower.y));
  views.View01 =
    MakeView(cell.Slots.z, vec2(cell.Lower.x, cell.Upper.y), vec2(lower.x, cell.Weight.y));
  views.View11 = MakeView(cell.Slots.w, cell.Upper, cell.Weight);
  float reach = length(max(entry.xy - cell.Lower, cell.Upper - entry.xy));
  views.Stride = min(2.0 * TexelsPerStep / (Resolution * reach), MostStride);
  return views;
}

// The viewpoints around those: what the inner ones do not see, these may.
ViewCell FindOuterViews(vec3 entry)
{
  Cell inner = FindCell(entry.xy);
  vec2 halfSize = 0.5 * (inner.Upper - inner.Lower);
  vec2 low = max(inner.Lower - halfSize, -1.0);
  vec2 high = min(inner.Upper + halfSize, 1.0);
  Cell cell00 = FindCell(low);
  Cell cell10 = FindCell(vec2(high.x, low.y));
  Cell cell01 = FindCell(vec2(low.x, high.y));
  Cell cell11 = FindCell(high);
  vec2 weight = (entry.xy - cell00.Lower) / (cell11.Upper - cell00.Lower);
  vec2 lower = 1.0 - weight;
  ViewCell views;
  views.View00 = MakeView(cell00.Slots.x, cell00.Lower, lower);
  views.View10 =
    MakeView(cell10.Slots.y, vec2(cell10.Upper.x, cell10.Lower.y), vec2(weight.x, lower.y));
  views.View01 =
    MakeView(cell01.Slots.z, vec2(cell01.Lower.x, cell01.Upper.y), vec2(lower.x, weight.y));
  views.View11 = MakeView(cell11.Slots.w, cell11.Upper, weight);
  float reach = length(max(entry.xy - cell00.Lower, cell11.Upper - entry.xy));
  views.Stride = min(2.0 * TexelsPerStep / (Resolution * reach), MostStride);
  return views;
}

View FindNearestView(vec3 entry)
{
  Cell cell = FindCell(entry.xy);
  bvec2 isUpper = greaterThan(cell.Weight, vec2(0.5));
  vec2 slots = isUpper.y ? cell.Slots.zw : cell.Slots.xy;
  return MakeView(isUpper.x ? slots.y : slots.x,
    vec2(isUpper.x ? cell.Upper.x : cell.Lower.x, isUpper.y ? cell.Upper.y : cell.Lower.y),
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
  float blockX = direction.x < 0.0 ? SideXBlocks.y : SideXBlocks.x;
  float blockY = direction.y < 0.0 ? SideYBlocks.y : SideYBlocks.x;
  seen.Coordinates = toX ? sideX : (toY ? sideY : opposite);
  seen.Block = toX ? blockX : (toY ? blockY : OppositeBlock);
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
  float depth = max(ReadNearestDepth(view.Slice, seen.Block, seen.Coordinates), LeastDepth);
  vec3 viewpoint = vec3(view.Position, 0.0);
  vec3 surface = viewpoint + (point - viewpoint) * (seen.InverseDepth * depth);
  float guess = clamp(dot(surface - ray.Entry, ray.Chord) / dot(ray.Chord, ray.Chord), 0.0, 1.0);
  return IsKept(view.Slice, seen.Block) > 0.0 ? guess : fraction;
}

vec4 ReadColorOf(View view, vec3 point)
{
  Projection seen = Project(view, point);
  return ReadColor(view.Slice, seen.Block, seen.Coordinates);
}

// Adds what a view sees to a weighted sum, if it sees anything.
void AddColorOf(View view, vec3 point, float weight, inout vec4 color, inout float weights)
{
  Projection seen = Project(view, point);
  weight *= IsKept(view.Slice, seen.Block);
  color += weight * ReadColor(view.Slice, seen.Block, seen.Coordinates);
  weights += weight;
}

vec4 ListWeights(ViewCell views)
{
  return vec4(views.View00.Weight, views.View10.Weight, views.View01.Weight, views.View11.Weight);
}

vec4 BlendColors(ViewCell views, vec3 point, vec4 weights)
{
  vec4 color = vec4(0.0);
  float sum = 0.0;
  AddColorOf(views.View00, point, weights.x, color, sum);
  AddColorOf(views.View10, point, weights.y, color, sum);
  AddColorOf(views.View01, point, weights.z, color, sum);
  AddColorOf(views.View11, point, weights.w, color, sum);
  return color / max(sum, LeastWeight);
}

LookupResult LookThrough(Ray ray, float fraction)
{
  ViewCell views = FindViews(ray.Entry);
  vec3 point = ray.Entry + fraction * ray.Chord;
  LookupResult result;
  result.Color = BlendColors(views, point, ListWeights(views));
  result.Fraction = GuessSurface(ray, FindNearestView(ray.Entry), fraction);
  return result;
}

LookupResult LookupNearest(Ray ray)
{
  View view = FindNearestView(ray.Entry);
  Projection exit = Project(MakeView(0.0, ray.Entry.xy, vec2(1.0)), ray.Entry + ray.Chord);
  return LookupResult(ReadNearestColor(view.Slice, exit.Block, exit.Coordinates),
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
  return seen.InverseDepth - ReadInverseDepth(view.Slice, seen.Block, seen.Coordinates);
}

// Of the four views, in the order 00, 10, 01, 11.
vec4 Clearances(Ray ray, ViewCell views, float w)
{
  vec3 point = ray.Entry + ray.Chord / w;
  return vec4(Clearance(views.View00, point), Clearance(views.View10, point),
    Clearance(views.View01, point), Clearance(views.View11, point));
}

// Whether some view knows that a point is hidden, and none sees through it.
bool IsHidden(vec4 clearances)
{
  return all(lessThanEqual(clearances, vec4(0.0))) && any(greaterThan(clearances, vec4(-Unknown)));
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

Surface FindSurface(Ray ray, ViewCell views, GridRay gridRay, vec2 range)
{
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
      return Surface(w, near * fromFront, step.FirstHidden);
    }
    bool isKnown = any(greaterThan(clearances, vec4(-Unknown)));
    if (!isSeenThrough && isKnown && step.FirstHidden == 0.0)
    {
      step.FirstHidden = w;
    }
    step.Behind = w - RestartShare * views.Stride;
  }
  return Surface(step.FirstHidden, vec4(0.0), step.FirstHidden);
}

// The views that see the surface from the ray's side share its colour; where none does, all.
vec4 BlendVisible(Ray ray, ViewCell views, Surface surface)
{
  vec3 point = ray.Entry + ray.Chord / surface.W;
  vec4 weights = ListWeights(views);
  vec4 visible = (weights + LeastWeight) * surface.Sight;
  float sum = dot(visible, vec4(1.0));
  return BlendColors(views, point, sum > 0.0 ? visible / sum : weights);
}

LookupResult LookupDepth(Ray ray)
{
  if (!HasDepth)
  {
    return LookupFocal(ray);
  }
  GridRay gridRay = CastGridRay(ray);
  vec2 range = 1.0 / max(ClipToScene(gridRay), 1.0 / NearestStart);
  ViewCell views = FindViews(ray.Entry);
  Surface surface = FindSurface(ray, views, gridRay, range);
  if (surface.W == 0.0)
  {
    return LookupResult(vec4(0.0), 1.0);
  }
  if (surface.Sight == vec4(0.0))
  {
    range.x = min(surface.W + max(views.Stride, StepShare * surface.W), range.x);
    ViewCell outer = FindOuterViews(ray.Entry);
    Surface seen = FindSurface(ray, outer, gridRay, range);
    bool isBehind = seen.W < (1.0 - EdgeStep) * surface.W && seen.Hidden == 0.0;
    if (isBehind && seen.Sight != vec4(0.0))
    {
      surface = seen;
      views = outer;
    }
  }
  return LookupResult(BlendVisible(ray, views, surface), 1.0 / surface.W);
}

// How far the clearances of the four views grow with w before a plane; below 0 for those behind it.
// For a view at a ray's entry it is 1, and it goes with the view's nearness to the plane.
vec4 GuessSlopes(ViewCell views, vec4 plane, float atEntry)
{
  vec4 x = vec4(views.View00.Position.x, views.View10.Position.x, views.View01.Position.x,
    views.View11.Position.x);
  vec4 y = vec4(views.View00.Position.y, views.View10.Position.y, views.View01.Position.y,
    views.View11.Position.y);
  return atEntry / (plane.x * x + plane.y * y + plane.w);
}

// Whether the search may begin at a plane that the ray meets at w: where it would come upon it in
// its first step, or the grid's first cell that is not empty belongs to the plane.
bool IsFirst(ViewCell views, vec4 plane, float atEntry, float first, float w)
{
  float stride = max(views.Stride, StepShare * first);
  vec3 perCell = mat3(FCCCMatrix) * plane.xyz * (SceneMaximum - SceneMinimum) / GridCells;
  float height = atEntry * (1.0 - w / first);
  bool isNear = height * height < GuessCells * GuessCells * dot(perCell, perCell);
  return w <= first && (w >= first - stride || isNear);
}

// As LookupDepth, where a plane is guessed that the ray's surface is near to. False where the views
// do not confirm it.
bool LookupGuessed(Ray ray, vec4 plane, out LookupResult result)
{
  result = LookupResult(vec4(0.0), 1.0);
  GridRay gridRay = CastGridRay(ray);
  vec2 range = 1.0 / max(ClipToScene(gridRay), 1.0 / NearestStart);
  float first = SkipEmpty(gridRay, range.x, range.y);
  if (first == 0.0)
  {
    return true;
  }
  ViewCell views = FindViews(ray.Entry);
  float atEntry = dot(plane.xyz, ray.Entry) + plane.w;
  float w = -dot(plane.xyz, ray.Chord) / (atEntry == 0.0 ? 1.0 : atEntry);
  bool isFirst = w >= range.y && IsFirst(views, plane, atEntry, first, w);
  w = isFirst ? w : first;
  vec4 clearances = Clearances(ray, views, w);
  vec4 slopes = GuessSlopes(views, plane, atEntry);
  vec4 fromFront = vec4(greaterThan(slopes, vec4(0.0)));
  vec4 sees = fromFront * vec4(lessThan(abs(clearances), vec4(EdgeStep * w)));
  vec4 shifts = sees * clearances / max(slopes, vec4(LeastSlope));
  bool isSeenThrough = any(greaterThan(clearances, vec4(ClearanceTolerance * w)));
  bool isSurface = sees != vec4(0.0) && all(lessThan(abs(shifts), vec4(GuessTolerance * w)));
  if (!isFirst || isSeenThrough || !isSurface)
  {
    return false;
  }
  float shift = min(min(shifts.x, shifts.y), min(shifts.z, shifts.w));
  w -= shift;
  clearances -= shift * slopes;
  vec4 near = max(vec4(0.0), 1.0 - abs(clearances) / (SightTolerance * w));
  result = LookupResult(BlendVisible(ray, views, Surface(w, near * fromFront, 0.0)), 1.0 / w);
  return true;
}
