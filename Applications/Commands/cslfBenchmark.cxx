// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf benchmark: measures the cost of parts of CSLF, with one command per part.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "cslfCommands.h"

#include <CLI/CLI.hpp>

namespace cslf::tool
{
void AddBenchmark(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand("benchmark", "Measure quality and speed");
  command->footer(MakeFooter({ "cslf benchmark render box.mp4 -o bench" }));
  command->require_subcommand(1);
  AddBenchmarkRender(*command, chosen);
  AddBenchmarkOpening(*command, chosen);
  AddBenchmarkSampler(*command, chosen);
#ifdef CSLF_HAS_ENCODER
  AddBenchmarkCodec(*command, chosen);
  AddBenchmarkKeyViews(*command, chosen);
#else
  for (const char* name : { "codec", "key-views" })
  {
    CLI::App* missing =
      command->add_subcommand(name, "Not available: built without the video encoder");
    missing->allow_extras();
    missing->callback(
      [&chosen] {
        chosen = []() -> Result
        { throw Failure("This cslf was built without the video encoder."); };
      });
  }
#endif
}
}
