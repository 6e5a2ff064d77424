// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProgram.h"

#include "cslfHelp.h"
#include "cslfMessages.h"
#include "cslfNumberChecks.h"
#include "cslfParallel.h"
#include "cslfSceneText.h"

#include <vtkSMPTools.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <new>
#include <string>
#include <vector>

namespace cslf::tool
{
namespace
{
/// Runs the command. On failure prints one line.
int Run(const Command& command, bool isJSON)
{
  constexpr int exitMissing = 2;
  int exitCode = EXIT_FAILURE;
  std::string error;
  Result result;
  try
  {
    result = command();
    error = GetFirstError();
  }
  catch (const std::bad_alloc&)
  {
    error = "There is not enough memory.";
  }
  catch (const MissingViewpoints& missing)
  {
    exitCode = exitMissing;
    error = missing.what();
  }
  catch (const std::exception& exception)
  {
    // VTK's first message is the cause, unless the exception includes it.
    error = GetFirstError();
    const std::string text = exception.what();
    error = text.find(error) != std::string::npos ? text : error;
  }
  const Ending ending = EndTogether(error);
  if (ending.HasFailed)
  {
    if (!ending.Error.empty())
    {
      PrintError(ending.Error);
    }
    return exitCode;
  }
  if (IsFirstRank())
  {
    PrintWarnings();
    std::cout << (isJSON ? Print(result.JSON) : result.Text) << std::flush;
  }
  return EXIT_SUCCESS;
}

/// The arguments from the last to the first, as CLI11 wants them. It would take -.5 for an option,
/// but -0.5 for a number. "cslf help sample" is "cslf sample --help".
std::vector<std::string> GetArguments(int argc, char* argv[])
{
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  for (std::string& argument : arguments)
  {
    if (argument.compare(0, 2, "-.") == 0 && ToNumber(argument))
    {
      argument.insert(1, "0");
    }
  }
  if (!arguments.empty() && arguments.front() == "help")
  {
    const auto isOther = [](const std::string& argument) { return argument != "help"; };
    arguments.erase(arguments.begin(), std::find_if(arguments.begin(), arguments.end(), isOther));
    arguments.emplace_back("--help");
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/// Whether a parser's error is no error, but asks for the help or the version. The help of a
/// command that does not exist is an error.
bool IsRequest(const CLI::App& app, const CLI::ParseError& error)
{
  const bool isSuccess = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
  const bool isHelp = dynamic_cast<const CLI::CallForHelp*>(&error) != nullptr;
  return isSuccess && !(isHelp && app.get_subcommands().empty() && !app.remaining().empty());
}

/// Reports wrong arguments. Without a command, that is the help.
void ReportArguments(const CLI::App& app, const CLI::ParseError& error)
{
  const std::vector<std::string> others = app.remaining();
  if (!app.get_subcommands().empty())
  {
    PrintError(error.what());
  }
  else if (others.empty())
  {
    std::cerr << app.help();
  }
  else
  {
    const std::string kind = others.front().compare(0, 1, "-") == 0 ? "option " : "command ";
    PrintError("There is no " + kind + others.front() + "; see " + app.get_name() + " --help.");
  }
}

/// Adds the common options to the commands. The numbers of all options must be finite.
void AddCommonOptions(CLI::App& app, bool& isJSON, int& threads)
{
  app.get_help_ptr()->group(GeneralGroup);
  for (CLI::App* command : app.get_subcommands({}))
  {
    RequireFiniteNumbers(*command);
    command->add_flag("--json", isJSON, "print one JSON object instead of text")
      ->group(GeneralGroup);
    command->add_option("--threads", threads, "number of threads (default: number of cores)")
      ->default_str("") // not 0, which stands for it
      ->check(Positive())
      ->group(GeneralGroup);
    command->get_help_ptr()->group(GeneralGroup);
  }
}
}

int RunProgram(const Program& program, int argc, char* argv[])
{
  const ParallelRun parallel(&argc, &argv);
  SetProgramName(program.Name);
  CLI::App app(program.Description, program.Name);
  app.formatter(MakeHelpFormatter());
  app.set_help_flag("-h,--help", "print this help");
  app.set_version_flag("--version", CSLF_VERSION, "print the version")->group(GeneralGroup);
  app.require_subcommand(1);
  Command chosen;
  for (const auto add : program.Commands)
  {
    add(app, chosen);
  }
  app.footer(program.Footer);
  bool isJSON = false;
  int threads = 0;
  AddCommonOptions(app, isJSON, threads);
  try
  {
    app.parse(GetArguments(argc, argv));
  }
  catch (const CLI::ParseError& error)
  {
    const bool isRequest = IsRequest(app, error);
    if (!IsFirstRank())
    {
      return isRequest ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (isRequest)
    {
      return app.exit(error);
    }
    ReportArguments(app, error);
    return EXIT_FAILURE;
  }
  if (!TakesPart())
  {
    return EXIT_SUCCESS;
  }
  if (threads > 0)
  {
    vtkSMPTools::Initialize(threads);
  }
  CatchMessages();
  return Run(chosen, isJSON);
}
}
