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

//CSLF::Lookup::Dec

void main()
{
  EyeRay eyeRay = FindEyeRay();
  if (!eyeRay.IsInward || !eyeRay.IsOnFace)
  {
    discard;
  }
  Ray ray = CastRay(eyeRay.Point, eyeRay.Direction);
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
  float z = ToDisplayDepth(ray.Entry + result.Fraction * ray.Chord);
  gl_FragData[1] = vec4(color.a > 0.0 ? z : MissDC);
}
