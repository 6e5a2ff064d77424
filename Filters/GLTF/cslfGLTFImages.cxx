// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFImages.h"

#include "Files/cslfEncodedImage.h"

#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <string>

namespace cslf
{
namespace
{
vtkSmartPointer<vtkImageData> Decode(const GLTFValue& owner, const GLTFBytes& bytes)
{
  std::string error;
  auto image = DecodeImage(bytes.Data, bytes.Size, "", error);
  if (!image)
  {
    owner.Fail(error);
  }
  return image;
}

/// An image without its alpha.
vtkSmartPointer<vtkImageData> DropAlpha(vtkImageData* image)
{
  auto* source = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  if (source->GetNumberOfComponents() % 2 != 0)
  {
    return image;
  }
  const int components = source->GetNumberOfComponents() - 1;
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(components);
  pixels->SetNumberOfTuples(source->GetNumberOfTuples());
  for (vtkIdType i = 0; i < source->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      pixels->SetTypedComponent(i, c, source->GetTypedComponent(i, c));
    }
  }
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->CopyStructure(image);
  copy->GetPointData()->SetScalars(pixels);
  return copy;
}
}

GLTFImages::GLTFImages(GLTFDocument& document)
  : Document(document)
{
}

vtkSmartPointer<vtkImageData> GLTFImages::Get(std::size_t index, bool dropAlpha)
{
  const std::pair<std::size_t, bool> key(index, dropAlpha);
  const auto found = this->Known.find(key);
  if (found != this->Known.end())
  {
    return found->second;
  }
  vtkSmartPointer<vtkImageData> image =
    dropAlpha ? DropAlpha(this->Get(index, false)) : this->Read(index);
  this->Known[key] = image;
  return image;
}

vtkSmartPointer<vtkImageData> GLTFImages::Read(std::size_t index)
{
  const GLTFValue image = this->Document.GetElement("images", index);
  if (const std::optional<std::size_t> view = image["bufferView"].GetIndex())
  {
    return Decode(image, this->Document.GetBufferView(*view));
  }
  const GLTFValue uri = image["uri"];
  if (!uri.IsPresent())
  {
    image.Fail("has neither a uri nor a bufferView");
  }
  const std::string bytes = this->Document.ReadResource(uri);
  return Decode(image, { reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), 0 });
}
}
