//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws a field's geometry, from CC.

in vec3 vertexCC;
in vec4 vertexColor;
out vec3 pointCCVSOutput;
out vec4 colorVSOutput;

uniform mat4 CCDCMatrix;

void main()
{
  pointCCVSOutput = vertexCC;
  colorVSOutput = vertexColor;
  gl_Position = CCDCMatrix * vec4(vertexCC, 1.0);
}
