// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Work done in the background by threads that the whole process shares. They have a low priority,
 * so that drawing continues while viewpoints are decoded.
 *
 * Before the process forks, it waits until no step is being done, and none begins until it has
 * forked. So the forked process, which does not have these threads, finds everything that steps use
 * in order: locks are free, and files and decoders are between two steps.
 */
#ifndef cslfBackgroundSteps_h
#define cslfBackgroundSteps_h

#include <functional>
#include <memory>

namespace cslf
{
class BackgroundSteps
{
public:
  /// `step` does the next piece of work, or nothing if there is none. As many threads as
  /// vtkSMPTools has call it at once. Its exceptions are ignored, so it must leave work that failed
  /// marked as not done.
  explicit BackgroundSteps(std::function<void()> step);

  /// Drops steps that have not begun and waits for the others.
  ~BackgroundSteps();

  BackgroundSteps(const BackgroundSteps&) = delete;
  BackgroundSteps& operator=(const BackgroundSteps&) = delete;

  /// Requests one more step. Returns at once.
  void Post();

  /// In a forked process, requests the steps again that its parent had requested but not begun. To
  /// be called before waiting for them.
  void PostAgain();

private:
  struct Gate;
  std::shared_ptr<Gate> Entrance;
};
}

#endif
