// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkSMPTools::For for work that may throw, and for long work.
 */
#ifndef cslfParallelFor_h
#define cslfParallelFor_h

#include "Pipeline/cslfInterpreter.h"
#include "Pipeline/cslfPhase.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <thread>

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

/// The same in batches of about a tenth of a second, between which the calling thread reports the
/// share that is done. How often it does depends on the machine. Returns false, with a part of the
/// range left out, if `progress` does.
template <typename Functor>
bool ParallelFor(vtkIdType first, vtkIdType last, const Progress& progress, const Functor& functor)
{
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds shortest(50);
  constexpr std::chrono::milliseconds longest(200);
  const vtkIdType smallest = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
  vtkIdType size = smallest;
  for (vtkIdType begin = first; begin < last;)
  {
    if (!progress(static_cast<double>(begin - first) / static_cast<double>(last - first)))
    {
      return false;
    }
    const Clock::time_point start = Clock::now();
    const vtkIdType end = begin + std::min(size, last - begin);
    ParallelFor(begin, end, 0, functor);
    const Clock::duration taken = Clock::now() - start;
    size = taken < shortest ? 2 * size : taken > longest ? std::max(size / 2, smallest) : size;
    begin = end;
  }
  return progress(1.0);
}

/// Waits for work in another thread. Meanwhile, this thread calls `report` several times a second.
template <typename Result, typename Report>
void WaitFor(const std::future<Result>& work, const Report& report)
{
  constexpr std::chrono::milliseconds step(50);
  const WithoutLock unlocked;
  while (work.wait_for(step) != std::future_status::ready)
  {
    report();
  }
}

/// Does work that cannot be interrupted, and returns its result. Meanwhile, the calling thread
/// reports progress: two thirds after the expected time. If `progress` throws or returns false, the
/// work is left to end by itself, so it must own all that it uses, and Aborted is thrown.
template <typename Result>
Result DoApart(
  const Progress& progress, double expectedSeconds, const std::function<Result()>& work)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto task = std::make_shared<std::packaged_task<Result()>>(work);
  std::future<Result> result = task->get_future();
  std::thread([task] { (*task)(); }).detach();
  WaitFor(result,
    [&]
    {
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (!progress(1.0 - std::exp(-seconds / expectedSeconds)))
      {
        throw Aborted();
      }
    });
  return result.get();
}
}

#endif
