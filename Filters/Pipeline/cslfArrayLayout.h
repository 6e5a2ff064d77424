// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arrays of any layout in memory. The values of a vtkAOSDataArrayTemplate, such as vtkFloatArray,
 * lie in memory tuple by tuple. Those of other arrays that users may hand in do not: the components
 * of a vtkSOADataArrayTemplate lie apart, and implicit arrays compute their values.
 *
 * Whatever comes from outside passes through these functions before its values are read by
 * pointers.
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
/// The array itself if its values lie in memory tuple by tuple, else a copy of which that is true.
/// Null for null.
VTKCSLF_EXPORT vtkSmartPointer<vtkDataArray> ToAOS(vtkDataArray* array);

/// The same as an array of that class, such as vtkFloatArray; null for an array of other values.
template <typename Array>
vtkSmartPointer<Array> ToAOS(vtkDataArray* array)
{
  return Array::SafeDownCast(ToAOS(array));
}

/// The image itself if the values of its points' arrays lie in memory tuple by tuple. Else an image
/// with copies of those arrays, which holds the z slices from `first` to `last` only. All arrays of
/// the image must have a tuple for each point.
VTKCSLF_EXPORT vtkSmartPointer<vtkImageData> ToAOS(vtkImageData* image, int first, int last);

/// Replaces the arrays that need it by copies whose values lie in memory tuple by tuple. Returns
/// whether there were any.
VTKCSLF_EXPORT bool MakeAOS(vtkFieldData* fields);
VTKCSLF_EXPORT bool MakeAOS(vtkDataSetAttributes* attributes);
}

#endif
