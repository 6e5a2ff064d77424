// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The image that a vtkTexture shows.
 */
#ifndef cslfTextureImage_h
#define cslfTextureImage_h

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

class vtkTexture;

namespace cslf
{
/// The input of a texture as vtkTexture draws it: two-dimensional, in the first two axes, of
/// unsigned chars of 1 to 4 components. Other types are converted to colours by the texture's
/// colour mode and lookup table, or by a table over their range. Unsigned chars that are colours
/// are shared, not copied. Direct float colours are clamped to [0,1]. Null if the texture has no
/// such image.
vtkSmartPointer<vtkImageData> MakeTextureImage(vtkTexture* texture);
}

#endif
