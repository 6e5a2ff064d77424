// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Joins the parts of a light field from several ranks.
 */
#ifndef cslfGatherField_h
#define cslfGatherField_h

#include <vtkSmartPointer.h>

class vtkImageData;
class vtkMultiProcessController;

namespace cslf
{
/**
 * Joins ranges of viewpoints (z slices), one from each rank, on rank 0. All ranks call it; those
 * above 0 get null. A part may be null or empty. If two ranks have a slice, the higher rank's is
 * used.
 */
vtkSmartPointer<vtkImageData> GatherField(
  vtkImageData* part, vtkMultiProcessController* controller);
}

#endif
