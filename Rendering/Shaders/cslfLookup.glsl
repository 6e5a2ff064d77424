// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The lookups, the twin of Rendering/cslfLookup.cxx, where every step is explained. Positions along
// a ray are inverse fractions w: the chord's point at w is Entry + Chord / w.

const float SlackTexels = 0.25;
const float MostSlack = 0.1;
const float NearestStart = 40.0;
const float NearestFocus = 0.05;
const float TexelsPerStep = 4.0;
const int LeastSteps = 8;
const int MostSteps = 128;
const int Refinements = 8;
const float EdgeStep = 0.03;
const float SightTolerance = 0.1;
const float ClearanceTolerance = 0.1;
const float LeastWeight = 0.0001;

struct LookupResult
{
  vec4 Color;     // associated alpha
  float Fraction; // of the way from entry to exit
};

struct View
{
  float Slot;
  vec3 Position; // CC
  float Weight;
  float Slack;
};

struct Projection
{
  int Tile;
  vec2 Coordinates;
  float InverseDepth;
};

struct Crossing
{
  float W;
  bool IsSurface;
};

// The ray being looked up and the viewpoints around its entry.
int EntryFace;
vec3 Entry;
vec3 Chord;
View Views[4];

void FindViews(RayCoordinates ray)
{
  EntryFace = ray.Entry.Face;
  Entry = FaceToCube(ray.Entry.Face, ray.Entry.Coordinates);
  Chord = FaceToCube(ray.Exit.Face, ray.Exit.Coordinates) - Entry;
  Cell cell = FindCell(ray.Entry.Coordinates);
  for (int k = 0; k < 4; ++k)
  {
    bvec2 isUpper = bvec2(k % 2 == 1, k / 2 == 1);
    Views[k].Slot = cell.Slots[k];
    Views[k].Position = FaceToCube(EntryFace, mix(cell.Lower, cell.Upper, isUpper));
    vec2 weight = mix(1.0 - cell.Weight, cell.Weight, isUpper);
    Views[k].Weight = weight.x * weight.y;
    float texels = 0.5 * Resolution * distance(Views[k].Position, Entry);
    Views[k].Slack = min(SlackTexels / max(texels, SlackTexels), MostSlack);
  }
}

int FindNearestView()
{
  int nearest = 0;
  for (int k = 1; k < 4; ++k)
  {
    nearest = Views[k].Weight > Views[nearest].Weight ? k : nearest;
  }
  return nearest;
}

Projection Project(int k, vec3 pointCC)
{
  vec3 direction = pointCC - Views[k].Position;
  int entryAxis = FaceAxis(EntryFace);
  vec3 sign = vec3(direction.x < 0.0 ? -1.0 : 1.0, direction.y < 0.0 ? -1.0 : 1.0,
    direction.z < 0.0 ? -1.0 : 1.0);
  // Along the entry face's axis only the opposite face is an exit.
  sign[entryAxis] = -FaceSign(EntryFace);
  vec3 toExit = abs(sign - Views[k].Position);
  vec3 pace = sign * direction;
  float inverseDepth = 1.0 / LeastDepth;
  int axis = entryAxis;
  for (int a = 0; a < 3; ++a)
  {
    if (toExit[a] < inverseDepth * pace[a])
    {
      inverseDepth = toExit[a] / pace[a];
      axis = a;
    }
  }
  int face = FaceOf(axis, sign[axis]);
  vec3 exit = Views[k].Position + inverseDepth * direction;
  return Projection(TileOf(EntryFace, face), CubeToFace(face, exit), inverseDepth);
}

float GuessSurface(float fraction)
{
  if (!HasDepth)
  {
    return fraction;
  }
  int k = FindNearestView();
  Projection seen = Project(k, Entry + fraction * Chord);
  vec3 exit = FaceToCube(ExitFaceOf(EntryFace, seen.Tile), seen.Coordinates);
  vec3 surface = Views[k].Position +
    (exit - Views[k].Position) /
      ReadNearestInverseDepth(Views[k].Slot, seen.Tile, seen.Coordinates);
  return clamp(dot(surface - Entry, Chord) / dot(Chord, Chord), 0.0, 1.0);
}

LookupResult LookThrough(float fraction)
{
  vec4 color = vec4(0.0);
  for (int k = 0; k < 4; ++k)
  {
    Projection seen = Project(k, Entry + fraction * Chord);
    color += Views[k].Weight * ReadColor(Views[k].Slot, seen.Tile, seen.Coordinates);
  }
  return LookupResult(color, GuessSurface(fraction));
}

LookupResult LookupNearest(RayCoordinates ray)
{
  FindViews(ray);
  int tile = TileOf(ray.Entry.Face, ray.Exit.Face);
  return LookupResult(
    ReadNearestColor(Views[FindNearestView()].Slot, tile, ray.Exit.Coordinates),
    GuessSurface(1.0));
}

LookupResult LookupLinear(RayCoordinates ray)
{
  FindViews(ray);
  int tile = TileOf(ray.Entry.Face, ray.Exit.Face);
  return LookupResult(
    ReadColor(Views[FindNearestView()].Slot, tile, ray.Exit.Coordinates), GuessSurface(1.0));
}

LookupResult LookupBilinear(RayCoordinates ray)
{
  FindViews(ray);
  return LookThrough(1.0);
}

// The nearest (x) and farthest (y) w that the scene can fill; empty where x <= y.
vec2 ClipToScene()
{
  vec3 direction = vec3(abs(Chord.x) < 1.0e-9 ? 1.0e-9 : Chord.x,
    abs(Chord.y) < 1.0e-9 ? 1.0e-9 : Chord.y, abs(Chord.z) < 1.0e-9 ? 1.0e-9 : Chord.z);
  vec3 t0 = (SceneMinimum - Entry) / direction;
  vec3 t1 = (SceneMaximum - Entry) / direction;
  vec3 near = min(t0, t1);
  vec3 far = max(t0, t1);
  float first = max(max(near.x, near.y), max(near.z, 1.0 / NearestStart));
  float last = min(min(far.x, far.y), min(far.z, 1.0));
  return vec2(1.0 / first, 1.0 / max(last, 1.0 / NearestStart));
}

LookupResult LookupFocal(RayCoordinates ray, vec3 focalPointCC)
{
  FindViews(ray);
  vec2 range = ClipToScene();
  if (range.x <= range.y)
  {
    return LookupResult(vec4(0.0), 1.0);
  }
  float fraction = dot(focalPointCC - Entry, Chord) / dot(Chord, Chord);
  return LookThrough(max(NearestFocus, clamp(fraction, 1.0 / range.x, 1.0 / range.y)));
}

int CountSteps(vec2 range)
{
  float reach = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    reach = max(reach, distance(Views[k].Position, Entry));
  }
  float texels = 0.5 * Resolution * reach * (range.x - range.y);
  return clamp(int(ceil(texels / TexelsPerStep)), LeastSteps, MostSteps);
}

float Clearance(int k, float w)
{
  Projection seen = Project(k, Entry + Chord / max(w, 1.0));
  return seen.InverseDepth - ReadInverseDepth(Views[k].Slot, seen.Tile, seen.Coordinates);
}

Crossing RefineCrossing(int k, float behind, float before)
{
  float clearance = Clearance(k, behind);
  for (int i = 0; i < Refinements; ++i)
  {
    float middle = 0.5 * (behind + before);
    float c = Clearance(k, middle);
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
  return Crossing(behind, clearance > -EdgeStep * behind);
}

bool IsSeenThrough(int exceptView, float w)
{
  for (int k = 0; k < 4; ++k)
  {
    float slack = Views[k].Slack;
    if (k != exceptView &&
      min(Clearance(k, w + slack), Clearance(k, w - slack)) > ClearanceTolerance)
    {
      return true;
    }
  }
  return false;
}

float FindSurface()
{
  vec2 range = ClipToScene();
  if (range.x <= range.y)
  {
    return 0.0;
  }
  int steps = CountSteps(range);
  float stride = (range.x - range.y) / float(steps);
  float clearances[4];
  for (int k = 0; k < 4; ++k)
  {
    clearances[k] = Clearance(k, range.x);
  }
  float edge = 0.0;
  for (int i = 1; i <= steps; ++i)
  {
    float w = range.x - stride * float(i);
    float surface = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      float before = clearances[k];
      clearances[k] = Clearance(k, w);
      if (before > 0.0 && clearances[k] <= 0.0)
      {
        Crossing crossing = RefineCrossing(k, w, w + stride);
        float best = crossing.IsSurface ? surface : edge;
        if (crossing.W > best && !IsSeenThrough(k, crossing.W))
        {
          if (crossing.IsSurface)
          {
            surface = crossing.W;
          }
          else
          {
            edge = crossing.W;
          }
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

vec4 BlendVisible(float w)
{
  vec4 visible = vec4(0.0);
  vec4 all = vec4(0.0);
  float weights = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    Projection seen = Project(k, Entry + Chord / w);
    vec4 color = ReadColor(Views[k].Slot, seen.Tile, seen.Coordinates);
    all += Views[k].Weight * color;
    float before = Clearance(k, w + Views[k].Slack);
    float behind = Clearance(k, w - Views[k].Slack);
    if (before >= behind)
    {
      float distance = max(0.0, max(behind, -before));
      float weight =
        (Views[k].Weight + LeastWeight) * max(0.0, 1.0 - distance / (SightTolerance * w));
      visible += weight * color;
      weights += weight;
    }
  }
  return weights > 0.0 ? visible / weights : all;
}

LookupResult LookupDepth(RayCoordinates ray)
{
  if (!HasDepth)
  {
    return LookupFocal(ray, vec3(0.0));
  }
  FindViews(ray);
  float w = FindSurface();
  if (w == 0.0)
  {
    return LookupResult(vec4(0.0), 1.0);
  }
  return LookupResult(BlendVisible(w), 1.0 / w);
}
