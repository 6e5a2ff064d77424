// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cslf command-line tool.
#include "Console/cslfHelp.h"
#include "cslfCommands.h"

int main(int argc, char* argv[])
{
  using namespace cslf::tool;
  Program program;
  program.Name = "cslf";
  program.Description =
    "Cube surface light fields: sample a scene, encode it as video, view it from anywhere";
  program.Footer = MakeFooter({ "cslf sample cornell-box -o box.mp4", "cslf view box.mp4" },
    "\"cslf COMMAND --help\" explains a command.\n\nExit codes: 0: success. 2: a field's file "
    "lacks viewpoints, and --allow-missing was not given. 1: any other error.");
  program.Commands = { AddSample, AddEncode, AddDecode, AddResample, AddRender, AddTrace,
    AddCompare, AddInfo, AddView, AddEvaluate, AddVerify, AddSheet, AddExport, AddScenes,
    AddCompletion };
  return RunProgram(program, argc, argv);
}
