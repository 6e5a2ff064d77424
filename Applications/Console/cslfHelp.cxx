// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfHelp.h"

#include "cslfJoin.h"
#include "cslfNumberChecks.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

namespace cslf::tool
{
namespace
{
constexpr std::size_t LineWidth = 80;
constexpr std::size_t CommandColumn = 20;
constexpr std::size_t OptionColumn = 6;

/// Breaks a text into lines. `first` is before the first, as many spaces as `column` before the
/// others. Lines of the text that begin with a space are not broken.
std::string Wrap(const std::string& text, std::size_t column, const std::string& first = "")
{
  std::string result;
  std::istringstream lines(text);
  std::string begin = first;
  for (std::string line; std::getline(lines, line);)
  {
    if (line.empty() || line.front() == ' ')
    {
      result += begin + line + "\n";
      begin.assign(column, ' ');
      continue;
    }
    std::string current = begin;
    bool isFresh = true;
    std::istringstream words(line);
    for (std::string word; words >> word; isFresh = false)
    {
      if (!isFresh && current.size() + 1 + word.size() > LineWidth)
      {
        result += current + "\n";
        current.assign(column, ' ');
        isFresh = true;
      }
      current += (isFresh ? "" : " ") + word;
    }
    result += current + "\n";
    begin.assign(column, ' ');
  }
  return result;
}

/// The type's name and the descriptions of the checks, which CLI11 joins.
std::pair<std::string, std::string> SplitTypeName(const CLI::Option* option)
{
  const std::string whole = option->get_type_name();
  const std::size_t end = whole.find(':');
  return { whole.substr(0, end), end == std::string::npos ? "" : whole.substr(end + 1) };
}

/// A default as the user would type it: vectors are "[1,2]" for CLI11.
std::string GetDefault(const CLI::Option* option)
{
  std::string text = option->get_default_str();
  if (text.size() > 2 && text.front() == '[' && text.back() == ']')
  {
    text = text.substr(1, text.size() - 2);
    std::replace(text.begin(), text.end(), ',', option->get_delimiter() == ',' ? ',' : ' ');
  }
  return text;
}

std::string JoinNames(const std::set<CLI::Option*>& options)
{
  return JoinAs(options, [](const CLI::Option* option) { return option->get_name(); });
}

/// The words that a check of that name lists. Empty if there is none.
std::vector<std::string> GetWords(const CLI::Option* option, const char* check)
{
  try
  {
    // There is no other way to a check.
    return CLI::detail::split_up(
      const_cast<CLI::Option*>(option)->get_validator(check)->get_description(), ',');
  }
  catch (const CLI::OptionNotFound&)
  {
    return {};
  }
}

/// A description with the range, the default and so on in brackets at its end.
std::string Describe(const CLI::Option* option)
{
  std::vector<std::string> parts;
  if (option->get_items_expected_max() != 0)
  {
    // The description mentions suggestions where they need to be known.
    const bool hasSuggestions = !GetWords(option, SuggestionName).empty();
    const std::string checks = hasSuggestions ? "" : SplitTypeName(option).second;
    const std::string standard = GetDefault(option);
    if (option->get_required() && !option->get_positional())
    {
      parts.emplace_back("required");
    }
    if (!checks.empty())
    {
      parts.push_back(checks);
    }
    if (!standard.empty())
    {
      parts.push_back("default " + standard);
    }
  }
  if (!option->get_needs().empty())
  {
    parts.push_back("needs " + JoinNames(option->get_needs()));
  }
  if (!option->get_excludes().empty())
  {
    parts.push_back("not with " + JoinNames(option->get_excludes()));
  }
  std::string text = option->get_description();
  for (const std::string& part : parts)
  {
    // Within the brackets that are there already.
    const bool isIn = text.back() == ')';
    text.erase(text.size() - (isIn ? 1 : 0));
    text += (isIn ? "; " : " (") + part + ")";
  }
  return text;
}

class HelpFormatter : public CLI::Formatter
{
public:
  // What the versions of CLI11 put between the parts differs, so they are made here.
  std::string make_help(
    const CLI::App* app, std::string name, CLI::AppFormatMode /*mode*/) const override
  {
    return this->make_description(app) + this->make_usage(app, std::move(name)) +
      this->MakeOptions(app) + this->MakeCommands(app) + "\n" + this->make_footer(app);
  }

  std::string make_usage(const CLI::App* app, std::string name) const override
  {
    std::string text = "Usage: " + name + " [options]";
    for (const CLI::Option* option : GetOptions(app, true))
    {
      text += " " + this->make_option_usage(option);
    }
    if (!app->get_subcommands({}).empty())
    {
      text += app->get_require_subcommand_min() == 0 ? " [command]" : " command";
    }
    return text + "\n";
  }

  std::string make_description(const CLI::App* app) const override
  {
    return Wrap(app->get_description() + ".", 0);
  }

  std::string make_option(const CLI::Option* option, bool isPositional) const override
  {
    std::string name;
    if (isPositional)
    {
      const bool isList = option->get_items_expected_max() > 1;
      name = option->get_name(true, false) + (isList ? "..." : "");
    }
    else
    {
      std::vector<std::string> names;
      for (const std::string& letter : option->get_snames())
      {
        names.push_back("-" + letter);
      }
      for (const std::string& word : option->get_lnames())
      {
        names.push_back("--" + word);
      }
      const bool isRepeated = option->get_delimiter() == '\0' &&
        option->get_items_expected_max() > option->get_items_expected_min() &&
        option->get_items_expected_max() > 1;
      const std::string placeholder = GetPlaceholder(option) + (isRepeated ? "..." : "");
      name = JoinAs(names, [](const std::string& item) { return item; }) +
        (placeholder.empty() ? "" : " " + placeholder);
    }
    return "  " + name + "\n" +
      Wrap(Describe(option), OptionColumn, std::string(OptionColumn, ' '));
  }

  std::string make_subcommand(const CLI::App* command) const override
  {
    std::string begin = "  " + command->get_name();
    begin.resize(std::max(begin.size() + 1, CommandColumn), ' ');
    return Wrap(command->get_description(), CommandColumn, begin);
  }

  std::string make_footer(const CLI::App* app) const override { return Wrap(app->get_footer(), 0); }

private:
  static std::vector<const CLI::Option*> GetOptions(const CLI::App* app, bool arePositional)
  {
    return app->get_options([arePositional](const CLI::Option* option)
      { return arePositional ? option->get_positional() : option->nonpositional(); });
  }

  std::string MakeGroup(const std::string& title, bool arePositional,
    const std::vector<const CLI::Option*>& options) const
  {
    std::string text;
    for (const CLI::Option* option : options)
    {
      text += this->make_option(option, arePositional);
    }
    return text.empty() ? text : "\n" + title + ":\n" + text;
  }

  /// The arguments, and the options by groups, the general one last.
  std::string MakeOptions(const CLI::App* app) const
  {
    std::vector<std::string> groups = app->get_groups();
    std::stable_partition(
      groups.begin(), groups.end(), [](const std::string& group) { return group != GeneralGroup; });
    std::string text = this->MakeGroup("Arguments", true, GetOptions(app, true));
    for (const std::string& group : groups)
    {
      std::vector<const CLI::Option*> members = GetOptions(app, false);
      members.erase(std::remove_if(members.begin(), members.end(),
                      [&group](const CLI::Option* option) { return option->get_group() != group; }),
        members.end());
      text += group.empty() ? "" : this->MakeGroup(group, false, members);
    }
    return text;
  }

  std::string MakeCommands(const CLI::App* app) const
  {
    std::string text;
    for (const CLI::App* command : app->get_subcommands({}))
    {
      text += this->make_subcommand(command);
    }
    return text.empty() ? text : "\nCommands:\n" + text;
  }
};
}

std::shared_ptr<CLI::FormatterBase> MakeHelpFormatter()
{
  return std::make_shared<HelpFormatter>();
}

std::string MakeFooter(const std::vector<std::string>& examples, const std::string& text)
{
  std::string footer = examples.size() > 1 ? "Examples:\n" : "Example:\n";
  for (const std::string& example : examples)
  {
    footer += "  " + example + "\n";
  }
  return footer + (text.empty() ? "" : "\n" + text);
}

std::string GetPlaceholder(const CLI::Option* option)
{
  if (option->get_items_expected_max() == 0)
  {
    return {};
  }
  static const std::map<std::string, std::string> words = { { "INT", "NUMBER" },
    { "UINT", "NUMBER" }, { "FLOAT", "NUMBER" }, { "TEXT", "NAME" } };
  const std::string whole = option->get_option_text();
  const std::string type = whole.empty() ? SplitTypeName(option).first : whole;
  const auto found = words.find(type);
  return found == words.end() ? type : found->second;
}

std::vector<std::string> GetChoices(const CLI::Option* option)
{
  const std::vector<std::string> choices = GetWords(option, ChoiceName);
  return choices.empty() ? GetWords(option, SuggestionName) : choices;
}
}
