// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the programs here have in common: a command line that chooses one of several commands, whose
 * result is printed as text or JSON.
 */
#ifndef cslfProgram_h
#define cslfProgram_h

#include "cslfJSON.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace cslf::tool
{
/// The results of a command: for people, and for programs (`--json`).
struct Result
{
  std::string Text;
  nlohmann::json JSON;
};

/// A result for programs. Names of files may have any bytes, but JSON only those of UTF-8: each of
/// the others becomes U+FFFD.
inline std::string Print(const nlohmann::json& json)
{
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// A command with its options filled in. Throws a Failure.
using Command = std::function<Result()>;

struct Program
{
  std::string Name;
  std::string Description;
  std::string Footer; ///< of the help

  /// Functions that add a command each. When the command line names it, `chosen` becomes its
  /// function.
  std::vector<void (*)(CLI::App& app, Command& chosen)> Commands;
};

/// The main function: parses the command line, runs the command, prints its result or what is
/// wrong, and returns the exit code.
int RunProgram(const Program& program, int argc, char* argv[]);
}

#endif
