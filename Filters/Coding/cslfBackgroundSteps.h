// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Work done in the background by threads that the whole process shares. They have a low priority,
 * so that drawing goes on while viewpoints are decoded.
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
  /// `step` does the next piece of work, or nothing if there is none. Several threads call it at
  /// once, as many as vtkSMPTools has. An exception that it throws is dropped: it must leave what
  /// it has not done to be found so.
  explicit BackgroundSteps(std::function<void()> step);

  /// Steps that have not begun are dropped, those that have are waited for.
  ~BackgroundSteps();

  BackgroundSteps(const BackgroundSteps&) = delete;
  BackgroundSteps& operator=(const BackgroundSteps&) = delete;

  /// Has one more step done, some time. Returns at once.
  void Post();

private:
  struct Gate;
  std::shared_ptr<Gate> Entrance;
};
}

#endif
