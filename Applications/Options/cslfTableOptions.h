// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Options on the command line that are rows of the table of options. Names, ranges, defaults and
 * help come from there.
 */
#ifndef cslfTableOptions_h
#define cslfTableOptions_h

#include "Console/cslfNumberChecks.h"
#include "Options/cslfOptionTable.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cslf::tool
{
/// Accepts the numbers from `least` to the row's maximum.
template <typename T>
CLI::Validator RangeOf(const NumberOption<T>& row, T least)
{
  // Rows without a maximum have the largest number, or one that is as good as unlimited.
  constexpr double unlimited = 1e30;
  if (row.Maximum < std::numeric_limits<T>::max() && static_cast<double>(row.Maximum) < unlimited)
  {
    return Between(least, row.Maximum);
  }
  const std::string limit = CLI::detail::to_string(least);
  return least > std::numeric_limits<T>::lowest()
    ? AtLeast(static_cast<double>(least), "below " + limit, "at least " + limit)
    : CLI::Validator();
}

/// Accepts the numbers of the row's range.
template <typename T>
CLI::Validator RangeOf(const NumberOption<T>& row)
{
  return RangeOf(row, row.Minimum);
}

/// The help of a switch, with its default.
inline std::string GetHelp(const cslf::Option<bool>& row)
{
  return row.Help + std::string(row.Default ? " (default: yes)" : "");
}

/// Adds a row's option, which calls a function with the number of the chosen name.
template <std::size_t Count>
CLI::Option* AddChoice(
  CLI::App& command, const EnumOption<Count>& row, int value, const std::function<void(int)>& set)
{
  const std::vector<std::string> names(row.Names.begin(), row.Names.end());
  return command
    .add_option_function<std::string>(
      row.Flag,
      [names, set](const std::string& name)
      { set(static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin())); },
      row.Help)
    ->check(OneOf(names))
    ->default_str(names[value]);
}

///@{
/// Adds a row's option, which sets a variable. The variable has the default. For numbers, another
/// range may replace the row's.
template <typename T>
CLI::Option* AddOption(CLI::App& command, const NumberOption<T>& row, T& value,
  const std::optional<CLI::Validator>& range = std::nullopt)
{
  return command.add_option(row.Flag, value, row.Help)
    ->check(range.value_or(RangeOf(row)))
    ->capture_default_str();
}

template <std::size_t Count>
CLI::Option* AddOption(CLI::App& command, const EnumOption<Count>& row, int& value)
{
  return AddChoice(command, row, value, [&value](int chosen) { value = chosen; });
}

inline CLI::Option* AddOption(CLI::App& command, const cslf::TextOption& row, std::string& value)
{
  return command.add_option(row.Flag, value, row.Help)
    ->check(Suggest(row.Suggestions))
    ->capture_default_str();
}

inline CLI::Option* AddOption(CLI::App& command, const cslf::Option<bool>& row, bool& value)
{
  return command.add_flag(row.Flag, value, GetHelp(row));
}
///@}

/// Adds a row's option, which sets a variable that is empty without it.
template <typename T>
CLI::Option* AddOptional(CLI::App& command, const NumberOption<T>& row, std::optional<T>& value)
{
  return command.add_option(row.Flag, value, row.Help)
    ->check(RangeOf(row))
    ->default_str(CLI::detail::to_string(row.Default));
}

///@{
/// Adds a row's option, which calls a setter of an object. For numbers, another range may replace
/// the row's.
template <typename T, typename Object>
CLI::Option* AddOption(CLI::App& command, const NumberOption<T>& row, Object* object,
  void (Object::*set)(T), const std::optional<CLI::Validator>& range = std::nullopt)
{
  return command
    .add_option_function<T>(
      row.Flag, [object, set](const T& value) { (object->*set)(value); }, row.Help)
    ->check(range.value_or(RangeOf(row)))
    ->default_str(CLI::detail::to_string(row.Default));
}

template <std::size_t Count, typename Object>
CLI::Option* AddOption(
  CLI::App& command, const EnumOption<Count>& row, Object* object, void (Object::*set)(int))
{
  return AddChoice(command, row, row.Default, [object, set](int value) { (object->*set)(value); });
}

template <typename Object>
CLI::Option* AddOption(
  CLI::App& command, const cslf::Option<bool>& row, Object* object, void (Object::*set)(bool))
{
  return command.add_flag_function(
    row.Flag, [object, set](std::int64_t count) { (object->*set)(count > 0); }, GetHelp(row));
}
///@}
}

#endif
