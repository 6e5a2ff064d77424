// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The uniforms of cslfCube.glsl.
 */
#ifndef cslfFaceUniforms_h
#define cslfFaceUniforms_h

class vtkMatrix4x4;
class vtkShaderProgram;

namespace cslf
{
/// Sets an identity to the matrix from the space of an entry face to that of the cube.
void GetFaceToCube(int entryFace, vtkMatrix4x4* fccc);

/// Sets all that go with an entry face.
void SetFaceUniforms(vtkShaderProgram* program, int entryFace);
}

#endif
