// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The samples of a viewpoint.
 */
#ifndef cslfViewpointSamples_h
#define cslfViewpointSamples_h

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

namespace cslf
{
/// The samples of one viewpoint. The arrays are shared and must not be changed.
struct ViewpointSamples
{
  vtkSmartPointer<vtkDataArray> Color;
  vtkSmartPointer<vtkDataArray> Depth; ///< null if the field has none
  vtkIdType First = 0;                 ///< the first tuple of the strip
};
}

#endif
