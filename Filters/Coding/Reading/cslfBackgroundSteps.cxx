// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBackgroundSteps.h"

#include "cslfBackgroundThread.h"

#include <vtkSMPTools.h>
#include <vtkThreadedTaskQueue.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>

namespace cslf
{
namespace
{
/// All steps of the process, which do not run while it forks.
class RunningSteps
{
public:
  static RunningSteps& Get()
  {
    // It lives as long as the process, like the threads.
    static auto* steps = new RunningSteps;
    return *steps;
  }

  void Begin()
  {
    const std::lock_guard<std::mutex> entrance(this->Entrance);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    ++this->Count;
  }

  void End()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    --this->Count;
    this->Left.notify_all();
  }

private:
  RunningSteps() { OnFork(&RunningSteps::BeforeFork, &RunningSteps::AfterFork); }

  /// Lets no step in until AfterFork, and waits for those inside. Threads wait at a mutex and not
  /// for the condition variable, because that would count them in the forked process, too, and wait
  /// there for them to leave.
  static void BeforeFork()
  {
    RunningSteps& steps = Get();
    steps.Entrance.lock();
    std::unique_lock<std::mutex> lock(steps.Mutex);
    steps.Left.wait(lock, [&steps] { return steps.Count == 0; });
    lock.release();
  }

  static void AfterFork()
  {
    RunningSteps& steps = Get();
    steps.Mutex.unlock();
    steps.Entrance.unlock();
  }

  std::mutex Entrance;
  std::mutex Mutex; ///< of the count
  std::condition_variable Left;
  int Count = 0;
};
}

/// State shared by the owner and its threads. It may outlive the owner.
struct BackgroundSteps::Gate
{
  std::mutex Mutex;
  std::condition_variable Left; ///< a thread has left
  std::function<void()> Step;
  bool IsOpen = true; ///< while the owner lives
  int Inside = 0;
  int Posted = 0;               ///< steps that have not begun
  long Owner = GetForkNumber(); ///< the process that posted them

  bool Enter()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    --this->Posted;
    this->Inside += this->IsOpen ? 1 : 0;
    return this->IsOpen;
  }

  void Leave()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    --this->Inside;
    this->Left.notify_all();
  }

  static void Pass(const std::shared_ptr<Gate>& gate)
  {
    LowerThreadPriority();
    RunningSteps::Get().Begin();
    if (gate->Enter())
    {
      try
      {
        gate->Step();
      }
      catch (const std::exception&)
      {
        // The owner finds that the step is missing, and gets the error when it does the step
        // itself.
      }
      gate->Leave();
    }
    RunningSteps::Get().End();
  }

  /// The queue lives as long as the process: in older versions of VTK its destructor may miss a
  /// thread that is about to sleep, and wait forever. A forked process does not have the threads of
  /// its parent, so it makes its own queue.
  static void Push(const std::shared_ptr<Gate>& gate)
  {
    using Queue = vtkThreadedTaskQueue<void, std::shared_ptr<Gate>>;
    constexpr bool ordered = true;
    constexpr int unlimited = -1;
    static std::mutex mutex;
    static Queue* queue = nullptr;
    static long owner = 0;
    const std::lock_guard<std::mutex> lock(mutex);
    if (!queue || owner != GetForkNumber())
    {
      RunningSteps::Get();
      queue = new Queue(
        &Gate::Pass, ordered, unlimited, std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()));
      owner = GetForkNumber();
    }
    queue->Push(std::shared_ptr<Gate>(gate));
  }
};

BackgroundSteps::BackgroundSteps(std::function<void()> step)
  : Entrance(std::make_shared<Gate>())
{
  this->Entrance->Step = std::move(step);
}

BackgroundSteps::~BackgroundSteps()
{
  std::unique_lock<std::mutex> lock(this->Entrance->Mutex);
  this->Entrance->IsOpen = false;
  this->Entrance->Left.wait(lock, [this] { return this->Entrance->Inside == 0; });
}

void BackgroundSteps::Post()
{
  this->PostAgain();
  {
    const std::lock_guard<std::mutex> lock(this->Entrance->Mutex);
    ++this->Entrance->Posted;
  }
  Gate::Push(this->Entrance);
}

void BackgroundSteps::PostAgain()
{
  int lost = 0;
  {
    const std::lock_guard<std::mutex> lock(this->Entrance->Mutex);
    if (this->Entrance->Owner != GetForkNumber())
    {
      this->Entrance->Owner = GetForkNumber();
      lost = this->Entrance->Posted;
    }
  }
  for (; lost > 0; --lost)
  {
    Gate::Push(this->Entrance);
  }
}
}
