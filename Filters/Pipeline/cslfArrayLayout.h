// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arrays of any layout in memory. The values of a vtkAOSDataArrayTemplate, such as vtkFloatArray,
 * lie in memory tuple by tuple. Those of other arrays do not: a vtkSOADataArrayTemplate stores
 * components separately, and implicit arrays compute their values.
 *
 * All data from users passes through these functions before pointers read its values.
 */
#ifndef cslfArrayLayout_h
#define cslfArrayLayout_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

class vtkDataSetAttributes;
class vtkFieldData;
class vtkImageData;

namespace cslf
{
/// The array itself if its values lie in memory tuple by tuple, else such a copy. Null for null.
VTKCSLF_EXPORT vtkSmartPointer<vtkDataArray> ToAOS(vtkDataArray* array);

/// The same as an array of that class, such as vtkFloatArray. Null for arrays of other values.
template <typename Array>
vtkSmartPointer<Array> ToAOS(vtkDataArray* array)
{
  return Array::SafeDownCast(ToAOS(array));
}

/// The image itself if the values of its points' arrays lie in memory tuple by tuple. Otherwise an
/// image with copies of those arrays, and only the z slices from `first` to `last`. All arrays of
/// the image must have a tuple for each point.
VTKCSLF_EXPORT vtkSmartPointer<vtkImageData> ToAOS(vtkImageData* image, int first, int last);

/// Replaces the arrays that need it by copies whose values lie in memory tuple by tuple. Returns
/// whether there were any.
VTKCSLF_EXPORT bool MakeAOS(vtkFieldData* fields);
VTKCSLF_EXPORT bool MakeAOS(vtkDataSetAttributes* attributes);

/// The attributes themselves if all their arrays are numeric, else without the others, which nobody
/// draws. Those whose tuples are copied pass through this: VTK 9.6 cannot copy single texts.
VTKCSLF_EXPORT vtkSmartPointer<vtkDataSetAttributes> KeepNumeric(vtkDataSetAttributes* attributes);
}

#endif
