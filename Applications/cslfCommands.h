// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The commands of the tool cslf, which the files in Commands define.
 */
#ifndef cslfCommands_h
#define cslfCommands_h

#include "Console/cslfProgram.h"

namespace cslf::tool
{
///@{
/// Adds a command, as `Program` says.
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
void AddScenes(CLI::App& app, Command& chosen);
void AddSheet(CLI::App& app, Command& chosen);
void AddExport(CLI::App& app, Command& chosen);
void AddVerify(CLI::App& app, Command& chosen);
///@}
}

#endif
