// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Conversion between linear light and displayed values, which VTK's window interpolates.
 */
#ifndef cslfDisplayedColor_h
#define cslfDisplayedColor_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec3.hpp>

namespace cslf
{
/// The displayed value of non-negative linear light, by sRGB's transfer function, continued above
/// white.
VTKCSLF_EXPORT glm::vec3 ToDisplayed(const glm::vec3& light);

/// The inverse. Up to white it uses a table, which is accurate to 1e-6.
VTKCSLF_EXPORT glm::vec3 FromDisplayed(const glm::vec3& displayed);
}

#endif
