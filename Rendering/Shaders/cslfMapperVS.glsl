//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws faces of the cube and hands each fragment its point in cube space: the entry face of the
// pass, or, where the eye is inside the cube, all others, by which rays leave.

in vec4 vertexMC;
in vec4 faceCC; // position in CC and face
out vec3 positionCCVSOutput;

uniform int EntryFacePass;
uniform bool DrawsExits;

//VTK::Camera::Dec
//VTK::PositionVC::Dec
//VTK::Picking::Dec

void main()
{
  positionCCVSOutput = faceCC.xyz;
  //VTK::PositionVC::Impl
  //VTK::Picking::Impl
  if ((int(faceCC.w + 0.5) == EntryFacePass) == DrawsExits)
  {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }
}
