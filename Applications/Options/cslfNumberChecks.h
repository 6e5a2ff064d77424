// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checks the numbers of options. CLI11's ranges accept NaN, and the messages of ranges without an
 * upper limit show the largest double with all its digits.
 */
#ifndef cslfNumberChecks_h
#define cslfNumberChecks_h

#include <CLI/CLI.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace cslf::tool
{
/// Accepts numbers of at least `least`.
inline CLI::Validator AtLeast(double least, const std::string& fault, const std::string& name)
{
  return CLI::Validator(
    [least, fault](std::string& text)
    {
      double number = 0.0;
      return CLI::detail::lexical_cast(text, number) && number >= least
        ? std::string()
        : "Value " + text + " is " + fault;
    },
    name);
}

inline CLI::Validator Positive()
{
  return AtLeast(std::numeric_limits<double>::min(), "not above 0", "POSITIVE");
}

/// Refuses infinity and NaN.
inline CLI::Validator Finite()
{
  return CLI::Validator(
    [](std::string& text)
    {
      double number = 0.0;
      return CLI::detail::lexical_cast(text, number) && !std::isfinite(number)
        ? "Value " + text + " is not a finite number"
        : std::string();
    },
    "");
}

/// Refuses infinity and NaN in all options of a command whose type is named FLOAT. Those with
/// another name need their own check.
inline void RequireFiniteNumbers(CLI::App& command)
{
  for (CLI::Option* option : command.get_options())
  {
    if (option->get_type_name().find("FLOAT") != std::string::npos)
    {
      option->check(Finite());
    }
  }
}
}

#endif
