// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf completion: scripts that complete the command line in shells, made from CLI11's parser.
#include "Console/cslfHelp.h"
#include "Console/cslfNumberChecks.h"
#include "cslfCommands.h"
#include "cslfJoin.h"

#include "vtkCSLFSceneSource.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace cslf::tool
{
namespace
{
/// What the parser knows of an option or an argument.
struct Item
{
  std::vector<std::string> Names; ///< with their dashes; none for an argument
  std::string Help;
  std::string Placeholder; ///< empty for a flag
  std::vector<std::string> Choices;

  bool TakesFile() const
  {
    return this->Placeholder == FilePlaceholder || this->Placeholder == ScenePlaceholder;
  }
  bool TakesFolder() const { return this->Placeholder == FolderPlaceholder; }
};

/// A command with its path, such as "cslf render".
struct Level
{
  std::string Path;
  std::vector<std::pair<std::string, std::string>> Commands; ///< their names and descriptions
  std::vector<Item> Options;
  std::vector<Item> Arguments;
};

Item ReadItem(CLI::Option* option)
{
  Item item;
  for (const std::string& letter : option->get_snames())
  {
    item.Names.push_back("-" + letter);
  }
  for (const std::string& word : option->get_lnames())
  {
    item.Names.push_back("--" + word);
  }
  const std::string help = option->get_description();
  item.Help = help.substr(0, help.find_first_of(";:("));
  item.Help.erase(item.Help.find_last_not_of(' ') + 1);
  item.Placeholder = GetPlaceholder(option);
  item.Choices = GetChoices(option);
  if (item.Placeholder == ScenePlaceholder)
  {
    for (int i = 0; i < vtkCSLFSceneSource::GetNumberOfScenes(); ++i)
    {
      item.Choices.emplace_back(vtkCSLFSceneSource::GetSceneName(i));
    }
  }
  return item;
}

void ReadLevels(CLI::App* app, const std::string& path, std::vector<Level>& levels)
{
  Level level;
  level.Path = path;
  for (CLI::Option* option : app->get_options({}))
  {
    const Item item = ReadItem(option);
    if (!item.Names.empty())
    {
      level.Options.push_back(item);
    }
    if (option->get_positional())
    {
      level.Arguments.push_back(item);
    }
  }
  const std::vector<CLI::App*> commands = app->get_subcommands({});
  for (const CLI::App* command : commands)
  {
    level.Commands.emplace_back(command->get_name(), command->get_description());
  }
  levels.push_back(level);
  for (CLI::App* command : commands)
  {
    ReadLevels(command, path + " " + command->get_name(), levels);
  }
}

/// A word of a shell, in quotes. Fish escapes other characters in them than the others.
std::string Quote(const std::string& text, bool isFish = false)
{
  std::string quoted;
  for (const char c : text)
  {
    quoted += c == '\''     ? (isFish ? "\\'" : "'\\''")
      : c == '\\' && isFish ? "\\\\"
                            : std::string(1, c);
  }
  return "'" + quoted + "'";
}

/// The patterns of all commands below the first, for the loops that find the command.
std::string JoinPaths(const std::vector<Level>& levels, const char* separator)
{
  std::vector<std::string> paths;
  for (std::size_t i = 1; i < levels.size(); ++i)
  {
    paths.push_back(Quote(levels[i].Path));
  }
  return Join(paths, separator);
}

std::vector<std::string> ListNames(const std::vector<Item>& items)
{
  std::vector<std::string> names;
  for (const Item& item : items)
  {
    names.insert(names.end(), item.Names.begin(), item.Names.end());
  }
  return names;
}

std::vector<std::string> ListCommands(const Level& level)
{
  std::vector<std::string> names;
  for (const auto& [name, help] : level.Commands)
  {
    names.push_back(name);
  }
  return names;
}

/// The assignments of bash that offer the values of an item.
std::string OfferInBash(const Item& item)
{
  std::string text = "words=" + Quote(Join(item.Choices, " "));
  text += item.TakesFile() ? " files=-f" : item.TakesFolder() ? " files=-d" : "";
  return text;
}

std::string MakeBash(const std::vector<Level>& levels)
{
  std::ostringstream text;
  text << "# Completion of cslf in bash, made by: cslf completion bash\n"
          "_cslf()\n{\n"
          "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
          "  local command=cslf words= files= i\n"
          "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
          "    case \"$command ${COMP_WORDS[i]}\" in\n      "
       << JoinPaths(levels, " | ")
       << ")\n        command=\"$command ${COMP_WORDS[i]}\" ;;\n    esac\n  done\n"
          "  case \"$command $previous\" in\n";
  for (const Level& level : levels)
  {
    for (const Item& item : level.Options)
    {
      if (!item.Placeholder.empty())
      {
        text << "    "
             << JoinAs(
                  item.Names,
                  [&level](const std::string& name) { return Quote(level.Path + " " + name); },
                  " | ")
             << ") " << OfferInBash(item) << " ;;\n";
      }
    }
  }
  text << "    *)\n      case \"$command:$current\" in\n";
  for (const Level& level : levels)
  {
    text << "        " << Quote(level.Path + ":-")
         << "*) words=" << Quote(Join(ListNames(level.Options), " ")) << " ;;\n";
    Item arguments;
    arguments.Choices = ListCommands(level);
    for (const Item& argument : level.Arguments)
    {
      arguments.Choices.insert(
        arguments.Choices.end(), argument.Choices.begin(), argument.Choices.end());
      arguments.Placeholder = argument.Placeholder;
    }
    text << "        " << Quote(level.Path + ":") << "*) " << OfferInBash(arguments) << " ;;\n";
  }
  text << "      esac ;;\n  esac\n"
          "  COMPREPLY=()\n"
          "  local IFS=$'\\n'\n"
          "  [[ -z $words ]] || mapfile -t COMPREPLY "
          "< <(IFS=' ' compgen -W \"$words\" -- \"$current\")\n"
          "  [[ -z $files ]] || mapfile -t -O ${#COMPREPLY[@]} COMPREPLY "
          "< <(compgen $files -- \"$current\")\n"
          "}\n"
          "complete -o filenames -F _cslf cslf\n";
  return text.str();
}

/// What follows the name or the number of an item in a specification for zsh's _arguments.
std::string OfferInZsh(const Item& item)
{
  if (item.Placeholder.empty())
  {
    return {};
  }
  const std::string words = item.Choices.empty() ? "" : "compadd -- " + Join(item.Choices, " ");
  const std::string files = item.TakesFile() ? "_files"
    : item.TakesFolder()                     ? "_files -/"
                                             : std::string();
  const std::string both = words.empty() || files.empty() ? words + files : words + "; " + files;
  // Colons separate the parts.
  std::string placeholder;
  for (const char c : item.Placeholder)
  {
    placeholder += (c == ':' || c == '\\' ? "\\" : "") + std::string(1, c);
  }
  return ":" + placeholder + ":" + (both.empty() ? " " : "{ " + both + " }");
}

/// A description in brackets.
std::string BracketInZsh(const std::string& help)
{
  std::string text;
  for (const char c : help)
  {
    text += (c == '[' || c == ']' || c == '\\' ? "\\" : "") + std::string(1, c);
  }
  return "[" + text + "]";
}

std::string MakeZsh(const std::vector<Level>& levels)
{
  std::ostringstream text;
  text << "#compdef cslf\n"
          "# Completion of cslf in zsh, made by: cslf completion zsh\n"
          "_cslf()\n{\n"
          "  local command=cslf\n"
          "  local -a commands\n"
          "  while (( CURRENT > 2 )); do\n"
          "    case \"$command $words[2]\" in\n      ("
       << JoinPaths(levels, " | ")
       << ")\n        command=\"$command $words[2]\" ;;\n"
          "      (*) break ;;\n    esac\n"
          "    shift words\n    (( --CURRENT ))\n  done\n"
          "  case $command in\n";
  for (const Level& level : levels)
  {
    text << "    (" << Quote(level.Path) << ")\n";
    if (!level.Commands.empty())
    {
      text << "      commands=("
           << JoinAs(
                level.Commands,
                [](const auto& command) { return Quote(command.first + ":" + command.second); },
                "\n        ")
           << ")\n      _describe command commands\n";
    }
    text << "      _arguments";
    for (const Item& item : level.Options)
    {
      for (const std::string& name : item.Names)
      {
        text << " \\\n        " << Quote("*" + name + BracketInZsh(item.Help) + OfferInZsh(item));
      }
    }
    for (const Item& item : level.Arguments)
    {
      text << " \\\n        "
           << Quote((&item == &level.Arguments.back() ? "*" : "") + OfferInZsh(item));
    }
    text << " ;;\n";
  }
  text << "  esac\n}\n"
          "if [[ $funcstack[1] == _cslf ]]; then _cslf \"$@\"; else compdef _cslf cslf; fi\n";
  return text.str();
}

std::string OfferInFish(const Item& item)
{
  std::vector<std::string> words = item.Choices;
  if (item.TakesFolder())
  {
    words.emplace_back("(__fish_complete_directories)");
  }
  return (item.TakesFile() ? " --force-files" : " --no-files") +
    (words.empty() ? "" : " --arguments " + Quote(Join(words, " "), true));
}

std::string MakeFish(const std::vector<Level>& levels)
{
  std::ostringstream text;
  text << "# Completion of cslf in fish, made by: cslf completion fish\n"
          "function __cslf_is_at\n"
          "    set -l command cslf\n"
          "    for word in (commandline --tokenize --cut-at-cursor --current-process)[2..]\n"
          "        switch \"$command $word\"\n            case "
       << JoinPaths(levels, " ")
       << "\n                set command \"$command $word\"\n        end\n    end\n"
          "    test \"$command\" = \"$argv\"\nend\n"
          "complete --command cslf --no-files\n";
  for (const Level& level : levels)
  {
    const std::string begin =
      "complete --command cslf --condition " + Quote("__cslf_is_at " + level.Path, true);
    for (const auto& [name, help] : level.Commands)
    {
      text << begin << " --arguments " << name << " --description " << Quote(help, true) << "\n";
    }
    for (const Item& item : level.Options)
    {
      text << begin;
      for (const std::string& name : item.Names)
      {
        const bool isLong = name[1] == '-';
        text << (isLong ? " --long-option " : " --short-option ") << name.substr(isLong ? 2 : 1);
      }
      if (!item.Placeholder.empty())
      {
        text << " --require-parameter" << OfferInFish(item);
      }
      text << " --description " << Quote(item.Help, true) << "\n";
    }
    for (const Item& item : level.Arguments)
    {
      text << begin << OfferInFish(item) << "\n";
    }
  }
  return text.str();
}

Result Run(CLI::App& app, const std::string& shell)
{
  std::vector<Level> levels;
  ReadLevels(&app, app.get_name(), levels);
  Result result;
  result.Text = shell == "bash" ? MakeBash(levels)
    : shell == "zsh"            ? MakeZsh(levels)
                                : MakeFish(levels);
  result.JSON = { { "shell", shell }, { "script", result.Text } };
  return result;
}
}

void AddCompletion(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("completion", "Print a script that completes command lines in a shell");
  command->footer(MakeFooter({ "source <(cslf completion bash)", "cslf completion fish | source" },
    "An installed cslf brings these scripts along, where the shells look for them."));
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "the shell")
    ->check(OneOf({ "bash", "zsh", "fish" }))
    ->required();
  command->callback(
    [&app, shell, &chosen] { chosen = [&app, shell] { return Run(app, *shell); }; });
}
}
