// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The arrays that readers fill.
 */
#ifndef cslfFieldArrays_h
#define cslfFieldArrays_h

#include "cslfDescription.h"
#include "cslfViewpointSamples.h"
#include "vtkCSLFModule.h" // for export macro

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <glm/vec4.hpp>

#include <vector>

class vtkImageData;

class vtkIdTypeArray;

namespace cslf
{
/// The name of the array of the missing viewpoints' slices. There is none if nothing is missing.
constexpr const char* MissingViewpointsName = "MissingViewpoints";

void SetMissing(vtkIdTypeArray* slices, vtkImageData* image);

/// In ascending order, of `count` slices. Ignores other numbers.
VTKCSLF_EXPORT std::vector<int> GetMissing(vtkImageData* image, int count);

/// An array of a channel. Throws std::bad_alloc if there is not enough memory. VTK would also
/// report an error of the internal array.
vtkSmartPointer<vtkDataArray> MakeArray(const Channel& channel, vtkIdType tuples);

///@{
/// A colour of an array with four components: from 0 to 1 if they are bytes.
VTKCSLF_EXPORT glm::vec4 GetColor(vtkDataArray* array, vtkIdType tuple);
VTKCSLF_EXPORT void SetColor(vtkDataArray* array, vtkIdType tuple, const glm::vec4& color);
///@}

/// The known channels of a field, with arrays of that many tuples. Throws std::bad_alloc.
ViewpointSamples MakeSamples(const Description& field, vtkIdType tuples);

/// Copies of viewpoints of a field. Throws std::bad_alloc.
std::vector<ViewpointSamples> CopySamples(
  const Description& field, const std::vector<ViewpointSamples>& samples);

/// Viewpoints of a field where nothing is covered. They share their arrays. Throws std::bad_alloc.
std::vector<ViewpointSamples> MakeBlankSamples(const Description& field, std::size_t count);

/// Fills a viewpoint's texels as if nothing was covered.
void Clear(const Description& field, const ViewpointSamples& samples);

/// Sets the range of slices of image data, and allocates arrays for all channels. The first becomes
/// the active one. Throws std::bad_alloc.
void AllocateSlices(const Description& field, int first, int last, vtkImageData* image);

/// Whether memory may be allocated for a range of `count` slices, `there` of which exist in the
/// file. Otherwise a damaged or malicious header could take any amount of memory.
bool AreEnough(const Description& field, vtkIdType there, vtkIdType count);
}

#endif
