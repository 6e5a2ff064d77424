// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The depth lookup's guesses from a small picture of the same view. They need neighbouring pixels,
// so they exist only in GLSL. Their results are those of cslfLookup.glsl.

uniform sampler2D GuessDepth; // z of DC of the small picture
uniform vec2 PictureSize;     // of the picture that is drawn, in pixels

// The largest distance of the surface from the plane of a guess, relative to w, and the smallest
// slope for computing a shift.
const float GuessTolerance = 0.02;
const float MinimumSlope = 0.01;

// The guess around a fragment: z of DC of four of its pixels, at the lower corner, at upper x, at
// upper y and at both.
struct Guess
{
  vec4 Z;
  vec2 Offset; // of the fragment from the lower corner, in pixels of the guess
  vec2 Size;   // of the guess
};

Guess FindGuess()
{
  Guess guess;
  guess.Size = vec2(textureSize(GuessDepth, 0));
  vec2 position = gl_FragCoord.xy / PictureSize * guess.Size - 0.5;
  vec2 base = clamp(floor(position), vec2(0.0), max(guess.Size - 2.0, 0.0));
  guess.Offset = position - base;
#ifdef GL_ARB_texture_gather
  guess.Z = textureGather(GuessDepth, (base + 1.0) / guess.Size).wzxy;
#else
  ivec2 low = ivec2(base);
  ivec2 high = min(low + 1, ivec2(guess.Size) - 1);
  guess.Z = vec4(texelFetch(GuessDepth, low, 0).r,
    texelFetch(GuessDepth, ivec2(high.x, low.y), 0).r,
    texelFetch(GuessDepth, ivec2(low.x, high.y), 0).r, texelFetch(GuessDepth, high, 0).r);
#endif
  return guess;
}

// Whether the guess has nothing around the fragment.
bool GuessNothing()
{
  return FindGuess().Z == vec4(MissDC);
}

// The plane of FC through the guess around the fragment. False if the guess has gaps there.
bool GuessPlane(out vec4 plane)
{
  Guess guess = FindGuess();
  vec4 z = guess.Z;
  vec2 row = mix(z.xz, z.yw, guess.Offset.x);
  float here = mix(row.x, row.y, guess.Offset.y);
  vec2 slope =
    0.5 * guess.Size * vec2(mix(z.y - z.x, z.w - z.z, guess.Offset.y), row.y - row.x);
  vec2 fragmentDC = 2.0 * gl_FragCoord.xy / PictureSize - 1.0;
  plane = vec4(slope, -1.0, here - dot(slope, fragmentDC)) * FCDCMatrix;
  return all(lessThan(z, vec4(MissDC)));
}

// How much the clearances of the four views grow with w in front of a plane. Negative for views
// behind it. For a view at a ray's entry it is 1, and it goes with the view's nearness to the
// plane.
vec4 GuessSlopes(ViewCell views, vec4 plane, float atEntry)
{
  vec4 x = vec4(views.View00.Position.x, views.View10.Position.x, views.View01.Position.x,
    views.View11.Position.x);
  vec4 y = vec4(views.View00.Position.y, views.View10.Position.y, views.View01.Position.y,
    views.View11.Position.y);
  return atEntry / (plane.x * x + plane.y * y + plane.w);
}

// For the small picture: like LookupSeen, but only whether there is a surface, and where.
LookupResult LookupGuess(Ray ray)
{
  Surface surface;
  LookupResult result = FindNothing();
  result.IsFinal = FindSeen(ray, FindViews(ray.Entry), surface);
  if (surface.W > 0.0)
  {
    result.Weights = vec4(1.0);
    result.Fraction = 1.0 / surface.W;
  }
  return result;
}

// Like LookupSeen, if the guess has nothing on the ray. Not final if the grid does not confirm
// this.
LookupResult LookupMiss(Ray ray)
{
  if (GuessNothing())
  {
    return LookupEmpty(ray);
  }
  LookupResult result = FindNothing();
  result.IsFinal = false;
  return result;
}

// Like LookupSeen, if the guess has a plane near the ray's surface. Not final if the views do not
// confirm this.
LookupResult LookupGuessed(Ray ray)
{
  LookupResult result = FindNothing();
  result.IsFinal = false;
  vec4 plane;
  if (!GuessPlane(plane))
  {
    return result;
  }
  ViewCell views = FindViews(ray.Entry);
  float atEntry = dot(plane.xyz, ray.Entry) + plane.w;
  float w = -dot(plane.xyz, ray.Chord) / (atEntry == 0.0 ? 1.0 : atEntry);
  bool isInside = w >= 1.0 && w <= NearestStart;
  w = isInside ? w : 1.0;
  vec4 clearances = Clearances(ray, views, w, true);
  vec4 slopes = GuessSlopes(views, plane, atEntry);
  vec4 fromFront = vec4(greaterThan(slopes, vec4(0.0)));
  vec4 sees = fromFront * vec4(lessThan(abs(clearances), vec4(EdgeStep * w)));
  vec4 shifts = sees * clearances / max(slopes, vec4(MinimumSlope));
  bool isSeenThrough = any(greaterThan(clearances, vec4(ClearanceTolerance * w)));
  bool isSurface = sees != vec4(0.0) && all(lessThan(abs(shifts), vec4(GuessTolerance * w)));
  if (!isInside || isSeenThrough || !isSurface)
  {
    return result;
  }
  float shift = min(min(shifts.x, shifts.y), min(shifts.z, shifts.w));
  w -= shift;
  clearances -= shift * slopes;
  return FindVisible(ray, views, Surface(w, Nearness(clearances, w) * fromFront));
}
