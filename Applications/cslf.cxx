// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cslf command-line tool.
#include "cslfCommands.h"
#include "cslfMessages.h"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <iostream>
#include <new>
#include <string>

namespace
{
using namespace cslf::tool;

/// Runs the command; on failure prints one line.
int Run(const Command& command, bool isJSON)
{
  std::string error;
  try
  {
    const Result result = command();
    error = GetFirstError();
    if (error.empty())
    {
      PrintWarnings();
      std::cout << (isJSON ? result.JSON.dump(2) + "\n" : result.Text) << std::flush;
      return EXIT_SUCCESS;
    }
  }
  catch (const std::bad_alloc&)
  {
    error = "There is not enough memory.";
  }
  catch (const std::exception& exception)
  {
    // What VTK has said first is the cause, unless the exception tells it with its context.
    error = GetFirstError();
    const std::string text = exception.what();
    error = text.find(error) != std::string::npos ? text : error;
  }
  PrintError(error);
  return EXIT_FAILURE;
}
}

int main(int argc, char* argv[])
{
  CLI::App app(
    "Cube surface light fields: sample a scene, code it as video, look at it from anywhere.",
    "cslf");
  app.set_version_flag("--version", CSLF_VERSION);
  app.require_subcommand(1);
  Command chosen;
  for (const auto add : { AddSample, AddEncode, AddDecode, AddResample, AddRender, AddTrace,
         AddCompare, AddInfo, AddView, AddEvaluate, AddSheet })
  {
    add(app, chosen);
  }
  bool isJSON = false;
  for (CLI::App* command : app.get_subcommands({}))
  {
    command->add_flag("--json", isJSON, "print one JSON object instead of text");
  }
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
    {
      return app.exit(error);
    }
    const bool isUnknown = argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty();
    PrintError(isUnknown ? std::string("There is no command ") + argv[1] + ": see cslf --help."
                         : error.what());
    return EXIT_FAILURE;
  }
  CatchMessages();
  return Run(chosen, isJSON);
}
