//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Writes where the geometry is, its normal and its own colour, for cslfSurface.glsl; or, if it
// alone shows the field, what is seen.

// Options:
//   ALONE            it alone shows the field: all colours are exact
//   BACK_COLORS      its back has other colours
//   BRIGHT           some colours are above 1
//   CLIPPING_PLANES  how many planes cut it
//CSLF::Options::Dec

//VTK::Output::Dec

in vec3 pointCCVSOutput;
in vec4 colorVSOutput;

#ifdef BACK_COLORS
in vec4 backColorVSOutput;
uniform int IsMirrored; // whether what is counterclockwise appears clockwise
#endif

#ifdef CLIPPING_PLANES
uniform vec4 ClippingPlanesCC[CLIPPING_PLANES]; // visible parts lie where they are positive
#endif

//CSLF::Normals::Dec

#ifdef BRIGHT
const float BrightOffset = 5e-6; // of the depth buffer's range: some 80 of its steps
#endif

void main()
{
#ifdef CLIPPING_PLANES
  for (int i = 0; i < CLIPPING_PLANES; ++i)
  {
    if (dot(ClippingPlanesCC[i], vec4(pointCCVSOutput, 1.0)) < 0.0)
    {
      discard;
    }
  }
#endif
  vec4 color = colorVSOutput;
#ifdef BACK_COLORS
  color = gl_FrontFacing == (IsMirrored == 0) ? colorVSOutput : backColorVSOutput;
#endif
#ifdef ALONE
  gl_FragData[0] = vec4(color.rgb, 1.0);
  gl_FragData[1] = vec4(2.0 * gl_FragCoord.z - 1.0); // z in DC
#else
  vec3 normal = cross(dFdx(pointCCVSOutput), dFdy(pointCCVSOutput));
  gl_FragData[0] = vec4(pointCCVSOutput, PackNormal(normal));
  gl_FragData[1] = color;
#endif
#ifdef BRIGHT
  // Where what is bright touches the back of something dark, as a lamp does the roof above it, both
  // are as deep, and a single ray that met the former would make the pixel white.
  bool isBright = max(color.r, max(color.g, color.b)) > 1.0;
  gl_FragDepth = gl_FragCoord.z + (isBright ? BrightOffset : 0.0);
#endif
}
