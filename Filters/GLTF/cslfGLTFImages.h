// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decodes the images of a glTF file.
 */
#ifndef cslfGLTFImages_h
#define cslfGLTFImages_h

#include "cslfGLTFDocument.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>
#include <utility>

namespace cslf
{
class GLTFImages
{
public:
  explicit GLTFImages(GLTFDocument& document);

  /// An image of 8 bits with 1 to 4 components, with or without its alpha. It is decoded once.
  /// Throws a GLTFError on failure.
  vtkSmartPointer<vtkImageData> Get(std::size_t index, bool dropAlpha);

private:
  vtkSmartPointer<vtkImageData> Read(std::size_t index);

  GLTFDocument& Document;
  std::map<std::pair<std::size_t, bool>, vtkSmartPointer<vtkImageData>> Known;
};
}

#endif
