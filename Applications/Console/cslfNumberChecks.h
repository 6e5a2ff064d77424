// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checks the values of options, and describes them in words for the help. CLI11's ranges accept
 * NaN, and the messages of ranges without an upper limit show the largest double with all its
 * digits.
 */
#ifndef cslfNumberChecks_h
#define cslfNumberChecks_h

#include "cslfJoin.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

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
  return AtLeast(std::numeric_limits<double>::min(), "not above 0", "above 0");
}

/// A number in the help, without exponent.
inline std::string Spell(double number)
{
  std::ostringstream text;
  text << std::fixed << number;
  std::string digits = text.str();
  digits.erase(digits.find_last_not_of('0') + 1);
  return digits.back() == '.' ? digits.substr(0, digits.size() - 1) : digits;
}

/// Accepts the numbers of a range. The help does not mention ends that nobody reaches.
template <typename T>
CLI::Validator Between(T least, T most)
{
  constexpr double endless = 1e9;
  const auto end = static_cast<double>(most);
  // CLI::Range accepts NaN, which is not at least any number.
  CLI::Validator range = CLI::Range(least, most) &
    AtLeast(std::numeric_limits<double>::lowest(), "not a number", "a number");
  range.description(end < endless ? Spell(static_cast<double>(least)) + " to " + Spell(end)
                                  : "at least " + Spell(static_cast<double>(least)));
  return range;
}

///@{
/// The names of the checks that list words, for their completion.
constexpr const char* ChoiceName = "choice";
constexpr const char* SuggestionName = "suggestion";
///@}

/// Accepts these words only.
inline CLI::Validator OneOf(const std::vector<std::string>& words)
{
  CLI::Validator choice = CLI::IsMember(words);
  choice.description(Join(words)).name(ChoiceName);
  return choice;
}

/// Accepts everything, also other words than these.
inline CLI::Validator Suggest(const std::string& words)
{
  return CLI::Validator([](std::string&) { return std::string(); }, words, SuggestionName);
}

///@{
/// Placeholders of values with a unit.
constexpr const char* SizePlaceholder = "SIZE";
constexpr const char* TimePlaceholder = "TIME";
///@}

/// Makes a number of bytes of a size with a unit, of any case.
inline CLI::Validator Bytes()
{
  CLI::Validator unit =
    CLI::AsNumberWithUnit(std::map<std::string, double>{ { "b", 1.0 }, { "k", 1e3 }, { "kb", 1e3 },
      { "kib", 0x1p10 }, { "m", 1e6 }, { "mb", 1e6 }, { "mib", 0x1p20 }, { "g", 1e9 },
      { "gb", 1e9 }, { "gib", 0x1p30 }, { "t", 1e12 }, { "tb", 1e12 }, { "tib", 0x1p40 } });
  unit.description("");
  return unit;
}

/// Makes a number of seconds of a time with a unit.
inline CLI::Validator Seconds()
{
  CLI::Validator unit = CLI::AsNumberWithUnit(std::map<std::string, double>{
    { "s", 1.0 }, { "m", 60.0 }, { "min", 60.0 }, { "h", 3600.0 }, { "d", 86400.0 } });
  unit.description("");
  return unit;
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
