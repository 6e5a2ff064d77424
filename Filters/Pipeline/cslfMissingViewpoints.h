// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The list of viewpoints that image data lacks and that are left empty in it, because the file they
 * come from is damaged or unfinished. It is in the field data.
 */
#ifndef cslfMissingViewpoints_h
#define cslfMissingViewpoints_h

#include "vtkCSLFModule.h" // for export macro

#include <vector>

class vtkIdTypeArray;
class vtkImageData;

namespace cslf
{
/// The name of the array of the missing viewpoints' slices. There is none if nothing is missing.
constexpr const char* MissingViewpointsName = "MissingViewpoints";

void SetMissing(vtkIdTypeArray* slices, vtkImageData* image);

/// In ascending order, of `count` slices. Ignores other numbers.
VTKCSLF_EXPORT std::vector<int> GetMissing(vtkImageData* image, int count);
}

#endif
