// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The tool's help: CLI11's, with ranges, choices and defaults in words.
 */
#ifndef cslfHelp_h
#define cslfHelp_h

#include <memory>
#include <string>
#include <vector>

namespace CLI
{
class App;
class FormatterBase;
class Option;
}

namespace cslf::tool
{
/// The group of options that all commands have, which is the last in the help.
constexpr const char* GeneralGroup = "General";

///@{
/// Placeholders of values that are the names of files, which shells complete.
constexpr const char* FilePlaceholder = "FILE";
constexpr const char* FolderPlaceholder = "FOLDER";
constexpr const char* ScenePlaceholder = "SCENE"; ///< or a scene without files
///@}

/// Formats the help of an application and its commands.
std::shared_ptr<CLI::FormatterBase> MakeHelpFormatter();

/// The end of a command's help: lines to be typed, and an explanation.
std::string MakeFooter(const std::vector<std::string>& examples, const std::string& text = "");

/// What stands for the value of an option in the help, such as FILE. Empty for flags.
std::string GetPlaceholder(const CLI::Option* option);

/// The words that an option takes, or some of them. Empty if it takes others only.
std::vector<std::string> GetChoices(const CLI::Option* option);
}

#endif
