// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light as the values that a display is given for it: what VTK's window interpolates.
 */
#ifndef cslfDisplayedColor_h
#define cslfDisplayedColor_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec3.hpp>

class vtkDataObject;

namespace cslf
{
/// Linear light, not negative, by sRGB's transfer function, which goes on above white.
VTKCSLF_EXPORT glm::vec3 ToDisplayed(const glm::vec3& light);

/// The inverse. Up to white by a table, which is exact to 1e-6.
VTKCSLF_EXPORT glm::vec3 FromDisplayed(const glm::vec3& displayed);

/// The CSLF:DisplayedWhite of a material; 0 in all components where not all are above 0.
glm::vec3 GetDisplayedWhite(vtkDataObject* material);
}

#endif
