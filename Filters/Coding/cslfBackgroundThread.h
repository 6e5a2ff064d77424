// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What threads that work in the background need from the operating system.
 */
#ifndef cslfBackgroundThread_h
#define cslfBackgroundThread_h

namespace cslf
{
/// Lowers the priority of the calling thread, so that threads that draw come first where there are
/// no cores for both. Works once for each thread; further calls do nothing.
void LowerThreadPriority();

/// A number that changes in a forked process; constant on systems where VTK programs do not fork.
long GetForkNumber();
}

#endif
