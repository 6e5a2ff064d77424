// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parts of a light field that the ranks hold, as a whole.
 */
#ifndef cslfGatherField_h
#define cslfGatherField_h

#include <vtkSmartPointer.h>

class vtkImageData;
class vtkMultiProcessController;

namespace cslf
{
/**
 * Joins ranges of viewpoints (z slices), one of each rank, on rank 0. All ranks call it; those
 * above 0 get null. A part may be null or empty; where slices are held twice, the higher rank's are
 * taken.
 */
vtkSmartPointer<vtkImageData> GatherField(
  vtkImageData* part, vtkMultiProcessController* controller);
}

#endif
