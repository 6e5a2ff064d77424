// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Keeps exceptions within VTK's methods.
 */
#ifndef cslfGuard_h
#define cslfGuard_h

#include <exception>
#include <new>
#include <string>

namespace cslf
{
/// Does `work()`, which may run out of memory, and returns its result. No exception may leave VTK's
/// methods, so it catches them, returns false and gives the reason.
template <typename Work>
bool Guard(const Work& work, std::string& problem)
{
  try
  {
    return work();
  }
  catch (const std::bad_alloc&)
  {
    problem = "there is not enough memory";
  }
  catch (const std::exception& exception)
  {
    problem = exception.what();
  }
  return false;
}
}

#endif
