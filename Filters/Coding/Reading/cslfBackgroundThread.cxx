// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBackgroundThread.h"

#if defined(_WIN32)
#include "Files/Windows/cslfWindows.h"
#elif defined(__APPLE__)
#include <pthread.h>
#include <unistd.h>
#else
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace cslf
{
namespace
{
void LowerPriority()
{
#if defined(_WIN32)
  ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_BELOW_NORMAL);
#elif defined(__APPLE__)
  ::pthread_set_qos_class_self_np(QOS_CLASS_UTILITY, 0);
#elif defined(__linux__)
  // With this niceness a busy thread leaves the others nine tenths of a core.
  constexpr int niceness = 10;
  const auto thread = static_cast<id_t>(::gettid());
  ::setpriority(PRIO_PROCESS, thread, ::getpriority(PRIO_PROCESS, thread) + niceness);
#endif
}
}

void LowerThreadPriority()
{
  thread_local bool isLow = false;
  if (!isLow)
  {
    isLow = true;
    LowerPriority();
  }
}

void OnFork(void (*before)(), void (*after)())
{
#if defined(_WIN32)
  (void)before;
  (void)after;
#else
  ::pthread_atfork(before, after, after);
#endif
}

long GetForkNumber()
{
#if defined(_WIN32)
  return 0;
#else
  return static_cast<long>(::getpid());
#endif
}
}
