//VTK::System::Dec
#extension GL_ARB_texture_gather : enable
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Looks up the ray from the eye through each fragment (paper, algorithm 1). cslfMapperFS.glsl puts
// the results into the scene.

// Options:
//   LOOKUP      the function that looks up a ray
//   HAS_DEPTH   defined only if the field has depth
//   DEPTH_ONLY  defined only if colour does not matter, except whether there is anything
//CSLF::Options::Dec

//VTK::Output::Dec

in vec4 pointVSOutput;

uniform vec4 EyeFC; // w = 1: the eye; w = 0: the direction of parallel projection
uniform mat4 FCDCMatrix;
uniform vec3 FocalPointFC;

//CSLF::Lookup::Dec

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
  LookupResult result = LOOKUP(ray);
  if (!result.IsFinal)
  {
    discard;
  }
#ifdef DEPTH_ONLY
  vec4 color = result.Weights;
#else
  vec4 color = BlendColor(result);
#endif
  gl_FragData[0] = color;
  vec4 hitDC = FCDCMatrix * vec4(ray.Entry + result.Fraction * ray.Chord, 1.0);
  gl_FragData[1] = vec4(color.a > 0.0 ? hitDC.z / hitDC.w : MissDC);
}
