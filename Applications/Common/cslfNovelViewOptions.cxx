// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfNovelViewOptions.h"

#include <CLI/CLI.hpp>

namespace cslf
{
namespace tool
{
void NovelViewOptions::AddTo(CLI::App& command, const std::string& group)
{
  command.add_option("--views", this->Views, "novel views")
    ->check(CLI::Range(1, 1000))
    ->capture_default_str()
    ->group(group);
  command.add_option("--size", this->Size, "of a view, in pixels")
    ->check(CLI::Range(1, 8192))
    ->capture_default_str()
    ->group(group);
  command.add_option("--spp", this->Samples, "samples per pixel of the truth, both halves")
    ->check(CLI::Range(2, 1 << 20))
    ->capture_default_str()
    ->group(group);
  command.add_option("--seed", this->Seed, "of the views and of the truth")
    ->check(CLI::Range(0, 1 << 29))
    ->capture_default_str()
    ->group(group);
  command
    .add_option("--truth", this->TruthFolder,
      "a folder that keeps the truth: what is there already is not traced again")
    ->group(group);
}
}
}
