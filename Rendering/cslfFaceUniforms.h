// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The uniforms of cslfCube.glsl.
 */
#ifndef cslfFaceUniforms_h
#define cslfFaceUniforms_h

class vtkShaderProgram;

namespace cslf
{
/// Sets all that go with an entry face.
void SetFaceUniforms(vtkShaderProgram* program, int entryFace);
}

#endif
