// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Options on the command line that are rows of the table of options. Names, ranges, defaults and
 * help come from there.
 */
#ifndef cslfTableOptions_h
#define cslfTableOptions_h

#include "Options/cslfOptionTable.h"
#include "cslfNumberChecks.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace cslf
{
namespace tool
{
/// Accepts the numbers from `least` to the row's maximum.
template <typename T>
CLI::Validator RangeOf(const NumberOption<T>& row, T least)
{
  if (row.Maximum == std::numeric_limits<T>::max())
  {
    return AtLeast(least, "below " + CLI::detail::to_string(least), "NUMBER");
  }
  return CLI::Range(least, row.Maximum);
}

/// Accepts the numbers of the row's range.
template <typename T>
CLI::Validator RangeOf(const NumberOption<T>& row)
{
  return RangeOf(row, row.Minimum);
}

///@{
/// Adds a row's option, which sets a variable. The variable has the default.
template <typename T>
CLI::Option* AddOption(CLI::App& command, const NumberOption<T>& row, T& value)
{
  CLI::Option* option = command.add_option(row.Flag, value, row.Help)->capture_default_str();
  const bool isLimited =
    row.Minimum != std::numeric_limits<T>::lowest() || row.Maximum != std::numeric_limits<T>::max();
  return isLimited ? option->check(RangeOf(row)) : option;
}

inline CLI::Option* AddOption(
  CLI::App& command, const cslf::Option<const char*>& row, std::string& value)
{
  return command.add_option(row.Flag, value, row.Help)->capture_default_str();
}

inline CLI::Option* AddOption(CLI::App& command, const cslf::Option<bool>& row, bool& value)
{
  return command.add_flag(
    row.Flag, value, row.Help + std::string(row.Default ? " (default: yes)" : ""));
}
///@}

/// Adds a row's option, which sets a variable that is empty without it. Its range must be checked.
template <typename T>
CLI::Option* AddOptional(CLI::App& command, const NumberOption<T>& row, std::optional<T>& value)
{
  return command.add_option(row.Flag, value, row.Help)
    ->default_str(CLI::detail::to_string(row.Default));
}

///@{
/// Adds a row's option, which calls a setter of an object.
template <typename T, typename Object>
CLI::Option* AddOption(
  CLI::App& command, const NumberOption<T>& row, Object* object, void (Object::*set)(T))
{
  return command
    .add_option_function<T>(
      row.Flag, [object, set](const T& value) { (object->*set)(value); }, row.Help)
    ->default_str(CLI::detail::to_string(row.Default))
    ->check(RangeOf(row));
}

template <typename Object>
CLI::Option* AddOption(
  CLI::App& command, const cslf::Option<bool>& row, Object* object, void (Object::*set)(bool))
{
  return command.add_flag_function(
    row.Flag, [object, set](std::int64_t count) { (object->*set)(count > 0); },
    row.Help + std::string(row.Default ? " (default: yes)" : ""));
}
///@}
}
}

#endif
