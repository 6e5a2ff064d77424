// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * OpenGL's functions through VTK's loader: glad, or glew in older versions.
 */
#ifndef cslfOpenGL_h
#define cslfOpenGL_h

#if __has_include(<vtk_glad.h>)
#include <vtk_glad.h>
#else
#include <vtk_glew.h>
#endif

#endif
