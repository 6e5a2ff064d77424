// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The places where the scene's surfaces may be, as in cslfSceneGrid.cxx: a coarse grid over the
// scene's bounds. Positions along a ray are fractions of its chord.

uniform sampler3D SceneGridTexture; // rings of empty cells around each cell; 0: not empty
uniform vec3 SceneMinimum;          // CC
uniform vec3 SceneMaximum;          // CC

// A ray in units of the grid's cells.
struct GridRay
{
  vec3 Entry;
  vec3 InverseChord;
  vec3 Chord;
};

GridRay CastGridRay(Ray ray)
{
  vec3 scale = float(GridCells) / (SceneMaximum - SceneMinimum);
  GridRay gridRay;
  gridRay.Entry = ((FCCCMatrix * vec4(ray.Entry, 1.0)).xyz - SceneMinimum) * scale;
  gridRay.Chord = mat3(FCCCMatrix) * ray.Chord * scale;
  gridRay.Chord = vec3(abs(gridRay.Chord.x) < MinimumChord ? MinimumChord : gridRay.Chord.x,
    abs(gridRay.Chord.y) < MinimumChord ? MinimumChord : gridRay.Chord.y,
    abs(gridRay.Chord.z) < MinimumChord ? MinimumChord : gridRay.Chord.z);
  gridRay.InverseChord = 1.0 / gridRay.Chord;
  return gridRay;
}

// The first (x) and last (y) fraction at which the scene may lie. Empty if x >= y.
vec2 ClipToScene(GridRay gridRay)
{
  vec3 t0 = -gridRay.Entry * gridRay.InverseChord;
  vec3 t1 = (float(GridCells) - gridRay.Entry) * gridRay.InverseChord;
  vec3 near = min(t0, t1);
  vec3 far = max(t0, t1);
  return vec2(max(max(near.x, near.y), max(near.z, 0.0)),
    min(min(far.x, far.y), min(far.z, 1.0)));
}

// The number of rings of empty cells around a point, including its own cell. 0: it is not empty.
float CountRings(vec3 cell)
{
  return floor(255.0 * texelFetch(SceneGridTexture, ivec3(cell), 0).r + 0.5);
}

vec3 FindCell(GridRay gridRay, float t)
{
  return clamp(floor(gridRay.Entry + t * gridRay.Chord), vec3(0.0), vec3(GridCells - 1));
}

bool IsOccupied(GridRay gridRay, float w)
{
  return CountRings(FindCell(gridRay, 1.0 / w)) == 0.0;
}

// The first w from `w` on where the grid is not empty. 0 if there is none before `last`.
float SkipEmpty(GridRay gridRay, float w, float last)
{
  float t = 1.0 / w;
  float end = 1.0 / last;
  vec3 ahead = step(vec3(0.0), gridRay.Chord);
  for (int i = 0; i < MaximumSkips && t < end; ++i)
  {
    vec3 cell = FindCell(gridRay, t);
    float rings = CountRings(cell);
    if (rings == 0.0)
    {
      break;
    }
    vec3 wall = cell + mix(vec3(1.0 - rings), vec3(rings), ahead);
    vec3 walls = (wall - gridRay.Entry) * gridRay.InverseChord;
    t = max(t, min(min(walls.x, walls.y), walls.z)) + SkipMargin;
  }
  return t >= end ? 0.0 : 1.0 / t;
}
