// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sum of two lattices.
 */
#ifndef cslfLatticeSum_h
#define cslfLatticeSum_h

#include "cslfLayoutProgress.h"
#include "cslfSurfaceLattice.h"

namespace cslf
{
/// Adds two lattices with the same roots. The sum is as fine everywhere as the finer one.
SurfaceLattice AddLattices(const SurfaceLattice& a, const SurfaceLattice& b,
  const LayoutProgress& progress = LayoutProgress());
}

#endif
