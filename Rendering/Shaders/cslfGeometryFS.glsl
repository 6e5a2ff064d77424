//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Writes where the geometry is, its normal and its own colour, for cslfSurface.glsl.

//VTK::Output::Dec

in vec3 pointCCVSOutput;
in vec4 colorVSOutput;

//CSLF::Normals::Dec

void main()
{
  vec3 normal = cross(dFdx(pointCCVSOutput), dFdy(pointCCVSOutput));
  gl_FragData[0] = vec4(pointCCVSOutput, PackNormal(normal));
  gl_FragData[1] = colorVSOutput;
}
