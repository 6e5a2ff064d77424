//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the square [-1,1]^2 as the entry face, or over the whole picture.

// vtkOpenGLQuadHelper's names.
in vec4 ndCoordIn;
in vec2 texCoordIn;
out vec4 pointVSOutput; // homogeneous, in FC: on the entry face, or on the near side of the display

uniform mat4 FCDCMatrix;
uniform mat4 DCFCMatrix;
uniform bool IsWhole;
uniform float MarkDC; // z of everything drawn; the clipping range does not cut it

void main()
{
  vec4 displayed = vec4(ndCoordIn.xy, 0.0, 1.0);
  vec4 onFace = vec4(2.0 * texCoordIn - 1.0, 0.0, 1.0);
  pointVSOutput = IsWhole ? DCFCMatrix * displayed : onFace;
  gl_Position = IsWhole ? displayed : FCDCMatrix * onFace;
  gl_Position.z = MarkDC * gl_Position.w;
}
