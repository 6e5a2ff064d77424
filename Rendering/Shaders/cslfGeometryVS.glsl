//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws a field's geometry, from CC.

// Options:
//   CLIPPING_PLANES  how many planes cut it
//CSLF::Options::Dec

in vec3 vertexCC;
in vec4 vertexColor;
out vec3 pointCCVSOutput;
out vec4 colorVSOutput;

uniform mat4 CCDCMatrix;
#ifdef CLIPPING_PLANES
uniform vec4 ClippingPlanesCC[CLIPPING_PLANES]; // visible parts lie where they are positive
out float gl_ClipDistance[CLIPPING_PLANES];
#endif

void main()
{
  pointCCVSOutput = vertexCC;
  colorVSOutput = vertexColor;
  gl_Position = CCDCMatrix * vec4(vertexCC, 1.0);
#ifdef CLIPPING_PLANES
  for (int i = 0; i < CLIPPING_PLANES; ++i)
  {
    gl_ClipDistance[i] = dot(ClippingPlanesCC[i], vec4(vertexCC, 1.0));
  }
#endif
}
