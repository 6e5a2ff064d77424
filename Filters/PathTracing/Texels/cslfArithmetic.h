// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Identifies the arithmetic of a computer. Embree and the C library choose their functions by the
 * processor, and some of these use approximations that differ between manufacturers, so the last
 * bits of a texel depend on the processor and on the versions of the libraries.
 */
#ifndef cslfArithmetic_h
#define cslfArithmetic_h

#include "vtkCSLFModule.h" // for export macro

#include <string>

namespace cslf
{
/// A hash of a small picture, which is traced at the first call. Processes with the same hash trace
/// scenes to the same last bit; others do not.
VTKCSLF_EXPORT const std::string& GetArithmetic();
}

#endif
