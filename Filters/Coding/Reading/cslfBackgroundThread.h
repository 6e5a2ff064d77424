// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Operating system functions for background threads.
 */
#ifndef cslfBackgroundThread_h
#define cslfBackgroundThread_h

namespace cslf
{
/// Lowers the priority of the calling thread, so that drawing threads come first if there are not
/// enough cores. Further calls on the same thread do nothing.
void LowerThreadPriority();

/// Calls functions when this process forks: `before` it does, then `after` in both processes. They
/// must remain valid. Does nothing on systems where VTK programs do not fork.
void OnFork(void (*before)(), void (*after)());

/// A number that changes in a forked process; constant on systems where VTK programs do not fork.
long GetForkNumber();
}

#endif
