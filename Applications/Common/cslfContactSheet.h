// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures in a grid, each with a line of text below it.
 */
#ifndef cslfContactSheet_h
#define cslfContactSheet_h

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkImageData;

namespace cslf
{
namespace tool
{
/// A picture of red, green and blue bytes and what to say of it.
struct LabelledPicture
{
  vtkSmartPointer<vtkImageData> Picture;
  std::string Label;
};

/// The pictures, row by row from the top, as one. Where no label says anything there is no space
/// left for them.
vtkSmartPointer<vtkImageData> MakeContactSheet(
  const std::vector<LabelledPicture>& pictures, int columns);
}
}

#endif
