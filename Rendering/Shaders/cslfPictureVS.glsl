//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws the square [-1,1]^2 as the entry face, or, where the eye is inside the cube and all faces
// may be anywhere, over the whole picture.

// As vtkOpenGLQuadHelper names them.
in vec4 ndCoordIn;
in vec2 texCoordIn;
out vec2 positionVSOutput;

uniform mat4 FCDCMatrix;
uniform bool IsEyeInside;
uniform float MarkDC; // z of all that is drawn: the camera's clipping range does not cut the faces

void main()
{
  positionVSOutput = 2.0 * texCoordIn - 1.0;
  gl_Position = IsEyeInside ? vec4(ndCoordIn.xy, 0.0, 1.0)
                            : FCDCMatrix * vec4(positionVSOutput, 0.0, 1.0);
  gl_Position.z = MarkDC * gl_Position.w;
}
