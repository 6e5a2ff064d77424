// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfNovelViewOptions.h"

#include "Console/cslfHelp.h"
#include "cslfNumberChecks.h"

#include <CLI/CLI.hpp>

namespace cslf::tool
{
void NovelViewOptions::AddTo(CLI::App& command, const std::string& group)
{
  command.add_option("--views", this->Views, "number of novel views")
    ->check(Between(1, 1000))
    ->capture_default_str()
    ->group(group);
  command.add_option("--size", this->Size, "width and height of a view, in pixels")
    ->check(Between(1, 8192))
    ->capture_default_str()
    ->group(group);
  command
    .add_option(
      "--spp", this->Samples, "samples per pixel of the reference, in both halves together")
    ->check(Between(2, 1 << 20))
    ->capture_default_str()
    ->group(group);
  command.add_option("--seed", this->Seed, "random seed of the views and the reference")
    ->check(Between(0, 1 << 29))
    ->capture_default_str()
    ->group(group);
  command
    .add_option(
      "--truth", this->TruthFolder, "folder that stores the path-traced reference for later runs")
    ->type_name(FolderPlaceholder)
    ->group(group);
}
}
