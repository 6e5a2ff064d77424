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

namespace cslf::tool
{
/// A picture of red, green and blue bytes, and its label.
struct LabelledPicture
{
  vtkSmartPointer<vtkImageData> Picture;
  std::string Label;
};

/// The pictures in one picture, row by row from the top. If all labels are empty, they get no
/// space.
vtkSmartPointer<vtkImageData> MakeContactSheet(
  const std::vector<LabelledPicture>& pictures, int columns);
}

#endif
