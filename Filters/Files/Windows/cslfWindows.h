// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Windows' own header without what collides with C++, and its error messages.
 */
#ifndef cslfWindows_h
#define cslfWindows_h

#ifndef NOMINMAX
#define NOMINMAX
#endif
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#include <windows.h>

#include <string>
#include <system_error>

namespace cslf
{
/// "cannot WHAT NAME: REASON", where the reason is that of the last call that failed.
inline std::string ExplainLastError(const std::string& what, const std::string& name)
{
  const auto code = static_cast<int>(::GetLastError());
  return "cannot " + what + " " + name + ": " + std::system_category().message(code);
}
}

#endif
