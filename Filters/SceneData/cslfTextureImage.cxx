// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTextureImage.h"

#include "Pipeline/cslfArrayLayout.h"
#include "Pipeline/cslfVTKCompatibility.h"

#include <vtkActor.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDiscretizableColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTexture.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace cslf
{
namespace
{
/// The array that a texture shows, which only subclasses can read.
class TextureAccess : public vtkTexture
{
public:
  static vtkDataArray* GetPixels(vtkTexture* texture)
  {
    using Get = vtkDataArray* (vtkAlgorithm::*)(int, vtkDataObject*);
    const Get get = &TextureAccess::GetInputArrayToProcess;
    vtkImageData* image = texture->GetInput();
    return image ? (texture->*get)(0, image) : nullptr;
  }
};

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

/// The matrix of texture coordinates: that of the actor's texture, which VTK sets before it draws,
/// or one in the actor's property keys. Null if there is none.
const double* FindTextureTransform(vtkActor* actor)
{
  vtkTexture* texture = actor->GetTexture();
  if (texture && texture->GetTransform())
  {
    return texture->GetTransform()->GetMatrix()->GetData();
  }
  vtkInformation* keys = actor->GetPropertyKeys();
  return keys ? keys->Get(TextureTransformKey()) : nullptr;
}
}

bool HoldsColors(vtkDataArray* array)
{
  return vtkUnsignedCharArray::SafeDownCast(array) && array->GetNumberOfComponents() >= 3 &&
    array->GetNumberOfComponents() <= 4;
}

bool HasColors(vtkScalarsToColors* table)
{
  if (auto* colors = vtkLookupTable::SafeDownCast(table))
  {
    return colors->GetNumberOfTableValues() > 0;
  }
  auto* steps = vtkDiscretizableColorTransferFunction::SafeDownCast(table);
  if (steps && steps->GetIndexedLookup() && steps->GetNumberOfIndexedColors() > 0)
  {
    return true;
  }
  auto* function = vtkColorTransferFunction::SafeDownCast(table);
  return !function || function->GetSize() > 0;
}

vtkSmartPointer<vtkImageData> MakeFlatImage(vtkTexture* texture)
{
  vtkImageData* input = texture->GetInput();
  vtkDataArray* pixels = TextureAccess::GetPixels(texture);
  if (!pixels || pixels->GetNumberOfTuples() == 0)
  {
    return nullptr;
  }
  int size[3];
  input->GetDimensions(size);
  if (pixels->GetNumberOfTuples() == input->GetNumberOfCells())
  {
    for (int& axis : size)
    {
      axis = std::max(axis - 1, 1);
    }
  }
  if (size[0] == 1)
  {
    std::rotate(size, size + 1, size + 3);
  }
  else if (size[1] == 1)
  {
    std::swap(size[1], size[2]);
  }
  if (size[2] != 1 || pixels->GetNumberOfTuples() != vtkIdType(size[0]) * size[1])
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size);
  image->GetPointData()->SetScalars(pixels);
  return image;
}

vtkSmartPointer<vtkImageData> MakeTextureImage(vtkTexture* texture)
{
  vtkSmartPointer<vtkImageData> image = MakeFlatImage(texture);
  const vtkSmartPointer<vtkUnsignedCharArray> pixels =
    image ? MakePixels(texture, image->GetPointData()->GetScalars()) : nullptr;
  if (!pixels)
  {
    return nullptr;
  }
  image->GetPointData()->SetScalars(pixels);
  return image;
}

void TransformTCoords(vtkActor* actor, vtkPolyData* block)
{
  vtkDataArray* coordinates = block->GetPointData()->GetTCoords();
  const double* matrix = FindTextureTransform(actor);
  if (!matrix || !coordinates || coordinates->GetNumberOfComponents() < 2)
  {
    return;
  }
  vtkNew<vtkFloatArray> moved;
  moved->SetName(coordinates->GetName());
  moved->SetNumberOfComponents(2);
  moved->SetNumberOfTuples(coordinates->GetNumberOfTuples());
  for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
  {
    const double u = coordinates->GetComponent(i, 0);
    const double v = coordinates->GetComponent(i, 1);
    for (int c = 0; c < 2; ++c)
    {
      const double* row = matrix + 4 * c;
      moved->SetTypedComponent(i, c, static_cast<float>(row[0] * u + row[1] * v + row[3]));
    }
  }
  block->GetPointData()->SetTCoords(moved);
}
}
