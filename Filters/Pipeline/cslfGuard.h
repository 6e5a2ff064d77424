// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What keeps exceptions within VTK's methods.
 */
#ifndef cslfGuard_h
#define cslfGuard_h

#include <exception>
#include <new>
#include <string>

namespace cslf
{
/// Does `work()`, which may lack memory, and returns what that does. No exception may leave VTK's
/// methods: of one it returns false and says what was wrong.
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
