//VTK::System::Dec
#extension GL_ARB_texture_gather : enable
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Looks up the points of the geometry that the rays through fragments meet.

// Options:
//   LOOKUP      the function that looks up a point
//   ONLY_MARK   defined if only the mark counts
//   ANY_FACE    defined if it does not matter by which face the ray enters
//   OTHER_FACE  defined if it must not be the face that is being drawn
//CSLF::Options::Dec

//VTK::Output::Dec

in vec4 pointVSOutput;

uniform vec4 EyeFC; // w = 1: the eye; w = 0: the direction of parallel projection
uniform mat4 FCDCMatrix;
uniform vec3 FocalPointFC;

//CSLF::Lookup::Dec

void main()
{
#ifdef ONLY_MARK
  if (!IsOnGeometry())
  {
    discard;
  }
  gl_FragData[0] = vec4(0.0);
  gl_FragData[1] = vec4(MissDC);
#else
  vec3 point = pointVSOutput.xyz / pointVSOutput.w;
  vec3 direction = EyeFC.w > 0.0 ? point - EyeFC.xyz : EyeFC.xyz;
  vec2 entry = point.xy - direction.xy * (point.z / direction.z);
  bool isWanted = direction.z > 0.0 && IsOnGeometry();
  bool isHere = all(lessThanEqual(abs(entry), vec2(1.0)));
#if defined(OTHER_FACE)
  isWanted = isWanted && !isHere;
#elif !defined(ANY_FACE)
  isWanted = isWanted && isHere;
#endif
  entry = clamp(entry, -1.0, 1.0);
  if (!isWanted)
  {
    discard;
  }
  GeometryPoint surface = FindGeometryPoint(entry, direction);
  vec4 color = LOOKUP(surface);
  if (color.a <= 0.0)
  {
    discard;
  }
  gl_FragData[0] = color;
  vec4 hitDC = FCDCMatrix * vec4(surface.Point, 1.0);
  gl_FragData[1] = vec4(hitDC.z / hitDC.w);
#endif
}
