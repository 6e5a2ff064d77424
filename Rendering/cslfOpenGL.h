// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * OpenGL's functions through the loader that this VTK was built with: glad, or in older ones glew.
 */
#ifndef cslfOpenGL_h
#define cslfOpenGL_h

#if __has_include(<vtk_glad.h>)
#include <vtk_glad.h>
#else
#include <vtk_glew.h>
#endif

#endif
