//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the face of the cube where rays enter or, if the eye is inside the cube, leave.

in vec4 vertexMC;
in float face;

uniform int FacePass; // the face being drawn

//VTK::Camera::Dec
//VTK::PositionVC::Dec
//VTK::Picking::Dec

void main()
{
  //VTK::PositionVC::Impl
  //VTK::Picking::Impl
  if (int(face + 0.5) != FacePass)
  {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }
}
