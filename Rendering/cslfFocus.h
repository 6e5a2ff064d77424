// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The default focus of the focal lookup.
 */
#ifndef cslfFocus_h
#define cslfFocus_h

#include "Pipeline/cslfFieldStore.h"
#include "cslfDescription.h"

#include <array>

class vtkImageData;

namespace cslf
{
/// For each entry face, the point in CC on the axis through the cube's centre at the median depth
/// that the face's middle viewpoint sees towards the opposite face. It is no nearer than the cube's
/// centre, because a near focus doubles everything around it. For a field without a depth channel,
/// and for a face that sees nothing there, it is the cube's centre. `image` contains the whole
/// field.
VTKCSLF_EXPORT std::array<glm::dvec3, FaceCount> FindFocalPoints(
  const Description& description, vtkImageData* image);

/// The same for one face, from the viewpoint FindFocalSlice alone. For damaged samples, which have
/// no colour, the cube's centre.
VTKCSLF_EXPORT glm::dvec3 FindFocalPoint(
  const Description& description, int face, const ViewpointSamples& samples);
VTKCSLF_EXPORT int FindFocalSlice(const Description& description, int face);
}

#endif
