// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Estimates the time to build a lattice, and roughly its values, from a part of its bricks that is
 * spread over the scene.
 */
#ifndef cslfLatticeProbe_h
#define cslfLatticeProbe_h

#include "cslfLatticeBuilder.h"

namespace cslf
{
/// Builds all bricks if that takes no more than a few times `seconds`. Otherwise builds more and
/// more of them until it has worked for `seconds`, or for a few per cent of the time for all, and
/// estimates all others from the points of the built ones. Returns the seconds that building the
/// whole takes. Ends early if `goOn` returns false.
double ProbeLattice(const Scene& scene, LatticeBuilder& builder, double seconds,
  const LatticeBuilder::Progress& goOn);
}

#endif
