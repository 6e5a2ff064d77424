// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the fragments of a shader come by what is the same for all of them. Graphics cards read
 * uniforms at no cost. llvmpipe reads a uniform for each lane of its vectors by itself, in some
 * 30 instructions for each component, but a vertex shader's flat output in one.
 */
#ifndef cslfFlatUniforms_h
#define cslfFlatUniforms_h

#include "vtkCSLFModule.h"

#include <string>

namespace cslf
{
/// Whether the driver of the current context reads uniforms lane by lane: llvmpipe, Mesa's software
/// OpenGL, by the renderer's name.
bool ReadsUniformsByLane();

/// Has the vertex shader of a program hand the uniforms of its fragment shader on as flat outputs,
/// so that fragments read these in their place. Their names, and how they are set, stay. Numbers,
/// vectors of floats and square matrices are found where a line begins with their declaration; all
/// else stays as it is, arrays among it, and all of it where the vertex shader has no line
/// `void main()` followed by one with its brace.
void VTKCSLF_EXPORT HandUniformsOn(std::string& vertex, std::string& fragment);
}

#endif
