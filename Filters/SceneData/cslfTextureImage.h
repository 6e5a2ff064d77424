// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The image that a vtkTexture shows, and its place on an actor; and which arrays and tables contain
 * colours.
 */
#ifndef cslfTextureImage_h
#define cslfTextureImage_h

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

class vtkActor;
class vtkDataArray;
class vtkPolyData;
class vtkScalarsToColors;
class vtkTexture;

namespace cslf
{
/// Whether an array contains colours: unsigned chars of 3 or 4 components. False for null.
bool HoldsColors(vtkDataArray* array);

/// Whether a table contains any colours. VTK reads past the end of tables without colours.
bool HasColors(vtkScalarsToColors* table);

/// The input of a texture in the first two axes, with its pixels as scalars of points. The columns
/// are along the first axis that has more than one pixel, so an image of one column becomes one
/// row, as in VTK's window. Null if the image is three-dimensional or has no pixels.
vtkSmartPointer<vtkImageData> MakeFlatImage(vtkTexture* texture);

/// The same as vtkTexture draws it: of unsigned chars of 1 to 4 components. Other types are
/// converted to colours by the texture's colour mode and lookup table, or by a table over their
/// range. Unsigned chars that are colours are shared, not copied. Direct float colours are clamped
/// to [0,1]. Null also if the table has no colours.
vtkSmartPointer<vtkImageData> MakeTextureImage(vtkTexture* texture);

/// Applies the transform of an actor's texture coordinates, if there is one.
void TransformTCoords(vtkActor* actor, vtkPolyData* block);
}

#endif
