// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Includes Windows' header without macros that conflict with C++, and gives its error messages.
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
/// "cannot WHAT NAME: REASON", with the reason of the last call that failed.
inline std::string ExplainLastError(const std::string& what, const std::string& name)
{
  const auto code = static_cast<int>(::GetLastError());
  return "cannot " + what + " " + name + ": " + std::system_category().message(code);
}
}

#endif
