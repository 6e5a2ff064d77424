//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the square [-1,1]^2 as the entry face, or, where the eye is inside the cube and all faces
// may be anywhere, over the whole picture.

// As vtkOpenGLQuadHelper names them.
in vec4 ndCoordIn;
in vec2 texCoordIn;
out vec4 pointVSOutput; // FC, homogeneous: on the entry face, or on the near side of what is displayed

uniform mat4 FCDCMatrix;
uniform mat4 DCFCMatrix;
uniform bool IsEyeInside;
uniform float MarkDC; // z of all that is drawn: the camera's clipping range does not cut the faces

void main()
{
  vec4 displayed = vec4(ndCoordIn.xy, 0.0, 1.0);
  vec4 onFace = vec4(2.0 * texCoordIn - 1.0, 0.0, 1.0);
  pointVSOutput = IsEyeInside ? DCFCMatrix * displayed : onFace;
  gl_Position = IsEyeInside ? displayed : FCDCMatrix * onFace;
  gl_Position.z = MarkDC * gl_Position.w;
}
