// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * OpenGL's functions through the loader that this VTK was built with: glew up to 9.3, glad since.
 */
#ifndef cslfOpenGL_h
#define cslfOpenGL_h

#include <vtkVersionMacros.h>

#if VTK_MAJOR_VERSION > 9 || (VTK_MAJOR_VERSION == 9 && VTK_MINOR_VERSION >= 4)
#include <vtk_glad.h>
#else
#include <vtk_glew.h>
#endif

#endif
