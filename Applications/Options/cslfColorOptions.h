// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which array colours surfaces, and how, on the command line.
 */
#ifndef cslfColorOptions_h
#define cslfColorOptions_h

#include "Options/cslfOptionTable.h"

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace cslf::tool
{
/// What the help says of the options that are not given.
struct ColorDefaults
{
  std::string Array;
  std::string Map; ///< replaces the help of the table; empty: does not
  std::string Range;
};

struct ColorOptions
{
  std::string Array; ///< of points or cells; may have a colon and a component. Empty by default
  int Map = options::ColorMap.Default;
  std::vector<double> Range; ///< of the ends of the map; empty by default

  /// Adds --color-by, --color-map and --range.
  void AddTo(CLI::App& command, const std::string& group, const ColorDefaults& defaults);

  bool IsEmpty() const;

  /// Whether another map than the automatic one is chosen.
  bool HasMap() const { return this->Map != options::ColorMap.Default; }

  /// Throws a Failure if the range is empty.
  void CheckRange() const;
};

/// The array's name that means no array, unless there is one of that name.
constexpr const char* NoArray = "none";
}

#endif
