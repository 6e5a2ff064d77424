// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTerminal.h"

#ifdef _WIN32
#include "Files/Windows/cslfWindows.h"
#else
#include <unistd.h>
#endif

namespace cslf::tool
{
bool IsErrorTerminal()
{
#ifdef _WIN32
  const HANDLE terminal = ::GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  return ::GetConsoleMode(terminal, &mode) &&
    ::SetConsoleMode(terminal, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
#else
  return ::isatty(STDERR_FILENO) != 0;
#endif
}
}
