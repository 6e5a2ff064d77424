// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfColorOptions.h"

#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "cslfTableOptions.h"

#include <CLI/CLI.hpp>

namespace cslf::tool
{
void ColorOptions::AddTo(CLI::App& command, const std::string& group, const ColorDefaults& defaults)
{
  command
    .add_option("--color-by", this->Array,
      "the array that colours the surfaces, of points or else of cells; for one of its components, "
      "add a colon and its number, x, y, z, its name or magnitude: velocity:x; none: no array "
      "(default: " +
        defaults.Array + ")")
    ->option_text("ARRAY[:COMPONENT]")
    ->group(group);
  CLI::Option* map =
    AddOption(command, options::ColorMap, this->Map)->type_name("NAME")->group(group);
  if (!defaults.Map.empty())
  {
    map->description(defaults.Map);
  }
  command
    .add_option("--range", this->Range,
      "the values of the colour map's ends (default: " + defaults.Range + ")")
    ->expected(2)
    ->check(Finite())
    ->type_name("MIN MAX")
    ->group(group);
}

bool ColorOptions::IsEmpty() const
{
  return this->Array.empty() && !this->HasMap() && this->Range.empty();
}

void ColorOptions::CheckRange() const
{
  if (!this->Range.empty() && !(this->Range[0] < this->Range[1]))
  {
    throw Failure("The first number of --range must be smaller than the second.");
  }
}
}
