//VTK::System::Dec
#extension GL_ARB_texture_gather : enable
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Looks up the ray from the eye through each fragment (paper, algorithm 1). cslfMapperFS.glsl puts
// the results into the scene.

//VTK::Output::Dec

in vec4 pointVSOutput;

uniform vec4 EyeFC; // w = 1: the eye; w = 0: the direction of parallel projection
uniform mat4 FCDCMatrix;
uniform vec3 FocalPointFC;
uniform sampler2D GuessDepth; // z of DC of a small picture of the same view
uniform vec2 PictureSize;     // of the picture that is drawn, in pixels

const float NothingDC = 1.0e30; // where nothing is seen; greater where nothing was drawn

//CSLF::Cube::Dec
//CSLF::Field::Dec
//CSLF::SceneGrid::Dec
//CSLF::Lookup::Dec

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
  return FindGuess().Z == vec4(NothingDC);
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
  return all(lessThan(z, vec4(NothingDC)));
}

void main()
{
  vec3 point = pointVSOutput.xyz / pointVSOutput.w;
  vec3 direction = EyeFC.w > 0.0 ? point - EyeFC.xyz : EyeFC.xyz;
  vec2 entry = point.xy - direction.xy * (point.z / direction.z);
  if (direction.z <= 0.0 || any(greaterThan(abs(entry), vec2(1.0))))
  {
    discard;
  }
  Ray ray = CastRay(point, direction);
  LookupResult result;
  //CSLF::Lookup::Impl
  gl_FragData[0] = result.Color;
  vec4 hitDC = FCDCMatrix * vec4(ray.Entry + result.Fraction * ray.Chord, 1.0);
  gl_FragData[1] = vec4(result.Color.a > 0.0 ? hitDC.z / hitDC.w : NothingDC);
}
