//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Writes where the geometry is, its normal and its own colour, for cslfSurface.glsl.

// Options:
//   BACK_COLORS      its back has other colours
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
  vec3 normal = cross(dFdx(pointCCVSOutput), dFdy(pointCCVSOutput));
  gl_FragData[0] = vec4(pointCCVSOutput, PackNormal(normal));
#ifdef BACK_COLORS
  gl_FragData[1] = gl_FrontFacing == (IsMirrored == 0) ? colorVSOutput : backColorVSOutput;
#else
  gl_FragData[1] = colorVSOutput;
#endif
}
