// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The commands of the tool, which the files in Commands define.
 */
#ifndef cslfCommands_h
#define cslfCommands_h

#include "cslfJSON.h"

#include <functional>
#include <string>

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

///@{
/// Adds a command to the tool. When the command line names it, `chosen` becomes its function.
void AddSample(CLI::App& app, Command& chosen);
void AddEncode(CLI::App& app, Command& chosen);
void AddDecode(CLI::App& app, Command& chosen);
void AddRender(CLI::App& app, Command& chosen);
void AddResample(CLI::App& app, Command& chosen);
void AddTrace(CLI::App& app, Command& chosen);
void AddCompare(CLI::App& app, Command& chosen);
void AddCompletion(CLI::App& app, Command& chosen);
void AddInfo(CLI::App& app, Command& chosen);
void AddView(CLI::App& app, Command& chosen);
void AddEvaluate(CLI::App& app, Command& chosen);
void AddEvaluateTexels(CLI::App& app, Command& chosen);
void AddScenes(CLI::App& app, Command& chosen);
void AddSheet(CLI::App& app, Command& chosen);
void AddExport(CLI::App& app, Command& chosen);
void AddBenchmark(CLI::App& app, Command& chosen);
void AddBenchmarkCodec(CLI::App& benchmark, Command& chosen);
void AddBenchmarkKeyViews(CLI::App& benchmark, Command& chosen);
void AddBenchmarkOpening(CLI::App& benchmark, Command& chosen);
void AddBenchmarkRender(CLI::App& benchmark, Command& chosen);
void AddBenchmarkSampler(CLI::App& benchmark, Command& chosen);
///@}
}

#endif
