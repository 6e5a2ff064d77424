// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How long a lattice would take to build, and roughly what it would hold: found out from a part of
 * its bricks, spread over the scene.
 */
#ifndef cslfLatticeProbe_h
#define cslfLatticeProbe_h

#include "cslfLatticeBuilder.h"

namespace cslf
{
/// Builds all bricks where that takes no more than a few times `seconds`. Otherwise more and more
/// of them until it has worked for `seconds`, or for a few per cent of what all would take, and
/// gives all others estimates made from the built ones' points. The seconds that building the whole
/// takes.
double ProbeLattice(const Scene& scene, LatticeBuilder& builder, double seconds);
}

#endif
