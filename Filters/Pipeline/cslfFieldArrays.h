// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The arrays that readers fill.
 */
#ifndef cslfFieldArrays_h
#define cslfFieldArrays_h

#include "cslfDescription.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

class vtkImageData;

namespace cslf
{
/// An array of a channel. Throws std::bad_alloc where there is not enough memory; VTK would also
/// report an error of the array, of which nobody knows.
vtkSmartPointer<vtkDataArray> MakeArray(const Channel& channel, vtkIdType tuples);

/// Gives image data a range of slices, with arrays of all channels to be filled, of which the first
/// is the active one. Throws std::bad_alloc.
void AllocateSlices(const Description& field, int first, int last, vtkImageData* image);

/// Whether a file is trusted to hold as much as it claims: `there` of `count` slices are. What a
/// damaged or hostile header claims could otherwise take any amount of memory, for nothing.
bool AreEnough(const Description& field, vtkIdType there, vtkIdType count);
}

#endif
