// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkSMPTools::For for work that may throw.
 */
#ifndef cslfParallelFor_h
#define cslfParallelFor_h

#include "Pipeline/cslfInterpreter.h"

#include <vtkSMPTools.h>

#include <atomic>
#include <exception>

namespace cslf
{
/// Calls `functor(begin, end)` for parts of a range, in threads. An exception in a thread of
/// vtkSMPTools would end the process. So the first one is stored, parts that have not begun are
/// skipped, and the exception is thrown to the caller when all threads are done. The functor
/// invokes no events, unless in the calling thread with WithLock.
template <typename Functor>
void ParallelFor(vtkIdType first, vtkIdType last, vtkIdType grain, const Functor& functor)
{
  std::atomic<bool> hasFailed{ false };
  std::exception_ptr exception;
  const WithoutLock unlocked;
  vtkSMPTools::For(first, last, grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      try
      {
        if (!hasFailed)
        {
          functor(begin, end);
        }
      }
      catch (...)
      {
        if (!hasFailed.exchange(true))
        {
          exception = std::current_exception();
        }
      }
    });
  if (exception)
  {
    std::rethrow_exception(exception);
  }
}
}

#endif
