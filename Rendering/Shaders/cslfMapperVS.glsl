//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the cube's faces and hands each fragment its point in cube space.

in vec4 vertexMC;
in vec3 positionCC;
out vec3 positionCCVSOutput;

//VTK::Camera::Dec
//VTK::PositionVC::Dec
//VTK::Picking::Dec

void main()
{
  positionCCVSOutput = positionCC;
  //VTK::PositionVC::Impl
  //VTK::Picking::Impl
}
