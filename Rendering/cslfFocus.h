// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where the focal lookup is sharp unless told otherwise.
 */
#ifndef cslfFocus_h
#define cslfFocus_h

#include "cslfDescription.h"
#include "cslfViewpointSource.h"

#include <array>

class vtkImageData;

namespace cslf
{
/// For each entry face the point, in CC, on the axis through the cube's centre, that lies at the
/// median depth of what the middle viewpoint of the face sees towards the opposite face, but no
/// nearer than the cube's centre: a near focus doubles all that is around it. The cube's centre for
/// a field without a depth channel, and for a face that sees nothing there. `image` holds the whole
/// field.
VTKCSLF_EXPORT std::array<glm::dvec3, FaceCount> FindFocalPoints(
  const Description& description, vtkImageData* image);

/// The same for one face, from the viewpoint FindFocalSlice alone. For samples without colour,
/// which are damaged, the cube's centre.
VTKCSLF_EXPORT glm::dvec3 FindFocalPoint(
  const Description& description, int face, const ViewpointSamples& samples);
VTKCSLF_EXPORT int FindFocalSlice(const Description& description, int face);
}

#endif
