// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Passes constant values to the fragments of a shader. Graphics cards read uniforms at no cost.
 * llvmpipe reads a uniform separately for each lane of its vectors, in some 30 instructions per
 * component, but a vertex shader's flat output in one.
 */
#ifndef cslfFlatUniforms_h
#define cslfFlatUniforms_h

#include "vtkCSLFModule.h"

#include <string>

class vtkMatrix4x4;
class vtkShaderProgram;

namespace cslf
{
/// Sets an identity to the matrix from the space of an entry face to that of the cube.
void GetFaceToCube(int entryFace, vtkMatrix4x4* fccc);

/// Sets all that go with an entry face.
void SetFaceUniforms(vtkShaderProgram* program, int entryFace);

/// Whether the driver of the current context reads uniforms lane by lane: llvmpipe, Mesa's software
/// OpenGL, by the renderer's name.
bool ReadsUniformsByLane();

/// Makes a program's vertex shader pass the uniforms of its fragment shader as flat outputs, which
/// fragments read instead. Their names, and the way to set them, do not change. Numbers, vectors of
/// floats and square matrices are found if a line begins with their declaration; others, such as
/// arrays, are not changed. Nothing is changed if the vertex shader has no line `void main()`
/// followed by a line with its brace.
void VTKCSLF_EXPORT HandUniformsOn(std::string& vertex, std::string& fragment);
}

#endif
