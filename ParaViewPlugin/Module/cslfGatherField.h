// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Joins the parts of a light field from several ranks.
 */
#ifndef cslfGatherField_h
#define cslfGatherField_h

#include <vtkSmartPointer.h>

#include <string>

class vtkImageData;
class vtkMultiProcessController;

namespace cslf
{
/**
 * Joins ranges of viewpoints (z slices), one from each rank, on rank 0. All ranks call it, also
 * those whose part could not be made, with the reason in `fault`. A part may be null or empty. If
 * two ranks have a slice, the higher rank's is used.
 *
 * Ranks above 0 get null. If any rank has a fault, or slices between the parts are missing, all get
 * null, and `fault` says why, in one sentence.
 */
vtkSmartPointer<vtkImageData> GatherField(
  vtkImageData* part, vtkMultiProcessController* controller, std::string& fault);
}

#endif
