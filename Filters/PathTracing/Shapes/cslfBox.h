// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An axis-aligned box.
 */
#ifndef cslfBox_h
#define cslfBox_h

#include <glm/vec3.hpp>

namespace cslf
{
/// An axis-aligned box in scene space; empty where `Low` is above `High`.
struct Box
{
  glm::dvec3 Low{ 0.0 };
  glm::dvec3 High{ 0.0 };
};
}

#endif
