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
  EyeRay ray = FindEyeRay();
  bool isWanted = ray.IsInward && IsOnGeometry();
#if defined(OTHER_FACE)
  isWanted = isWanted && !ray.IsOnFace;
#elif !defined(ANY_FACE)
  isWanted = isWanted && ray.IsOnFace;
#endif
  if (!isWanted)
  {
    discard;
  }
  GeometryPoint surface = FindGeometryPoint(clamp(ray.Entry, -1.0, 1.0), ray.Direction);
  vec4 color = LOOKUP(surface);
  if (color.a <= 0.0)
  {
    discard;
  }
  gl_FragData[0] = color;
  gl_FragData[1] = vec4(ToDisplayDepth(surface.Point));
#endif
}
