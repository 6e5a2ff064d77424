// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTextureImage.h"

#include "PathTracing/Materials/cslfSurfaceColors.h"
#include "Pipeline/cslfArrayLayout.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace cslf
{
namespace
{
/// Float colours in [0,1] or 16-bit colours as bytes.
vtkSmartPointer<vtkUnsignedCharArray> ToBytes(vtkDataArray* colors)
{
  const double unit = colors->GetDataType() == VTK_FLOAT ? 1.0 : VTK_UNSIGNED_SHORT_MAX;
  const int components = std::min(colors->GetNumberOfComponents(), 4);
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetNumberOfComponents(components);
  bytes->SetNumberOfTuples(colors->GetNumberOfTuples());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = colors->GetComponent(i, c) / unit;
      bytes->SetTypedComponent(
        i, c, static_cast<unsigned char>(value > 0.0 ? 255.0 * std::min(value, 1.0) + 0.5 : 0.0));
    }
  }
  return bytes;
}

/// Maps scalars by the texture's table, without changing the texture. Null if the table has no
/// colours.
vtkSmartPointer<vtkUnsignedCharArray> MapByTable(vtkTexture* texture, vtkDataArray* scalars)
{
  vtkSmartPointer<vtkScalarsToColors> table = texture->GetLookupTable();
  if (!table)
  {
    vtkNew<vtkLookupTable> standard;
    standard->SetRange(scalars->GetRange(0));
    standard->Build();
    table = standard;
  }
  if (!HasColors(table))
  {
    return nullptr;
  }
  vtkSmartPointer<vtkUnsignedCharArray> colors;
  colors.TakeReference(table->MapScalars(scalars, texture->GetColorMode(), -1));
  return colors;
}

/// The image that vtkOpenGLTexture::Load passes to OpenGL, as bytes.
vtkSmartPointer<vtkUnsignedCharArray> MakePixels(vtkTexture* texture, vtkDataArray* scalars)
{
  const int mode = texture->GetColorMode();
  const int type = scalars->GetDataType();
  const auto bytes = ToAOS<vtkUnsignedCharArray>(scalars);
  if (bytes && mode != VTK_COLOR_MODE_MAP_SCALARS && bytes->GetNumberOfComponents() <= 4)
  {
    return bytes;
  }
  const bool direct = mode == VTK_COLOR_MODE_DIRECT_SCALARS &&
    (type == VTK_UNSIGNED_SHORT || type == VTK_FLOAT) && scalars->GetNumberOfComponents() >= 3;
  return direct ? ToBytes(scalars) : MapByTable(texture, scalars);
}
}

vtkSmartPointer<vtkImageData> MakeTextureImage(vtkTexture* texture)
{
  vtkImageData* input = texture->GetInput();
  if (!input)
  {
    return nullptr;
  }
  vtkDataArray* scalars = input->GetPointData()->GetScalars();
  const bool ofCells = !scalars;
  scalars = ofCells ? input->GetCellData()->GetScalars() : scalars;
  if (!scalars || scalars->GetNumberOfTuples() == 0)
  {
    return nullptr;
  }
  // The axes along which the image extends, at most two.
  int size[2] = { 1, 1 };
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int points = input->GetDimensions()[axis];
    if (points > 1 && axes == 2)
    {
      return nullptr;
    }
    // An image that is only one pixel wide has its pixels along the first axis.
    if (points > 1 || (axis == 0 && axes == 0))
    {
      size[axes++] = ofCells ? std::max(points - 1, 1) : points;
    }
  }
  const vtkSmartPointer<vtkUnsignedCharArray> pixels = MakePixels(texture, scalars);
  if (!pixels || pixels->GetNumberOfTuples() != vtkIdType(size[0]) * size[1])
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size[0], size[1], 1);
  image->GetPointData()->SetScalars(pixels);
  return image;
}
}
