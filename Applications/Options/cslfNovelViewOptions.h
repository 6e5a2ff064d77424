// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The command line options for the novel views of measurements.
 */
#ifndef cslfNovelViewOptions_h
#define cslfNovelViewOptions_h

#include <string>

namespace CLI
{
class App;
}

namespace cslf::tool
{
struct NovelViewOptions
{
  int Views = 6;
  int Size = 512;    ///< along each side, in pixels
  int Samples = 256; ///< per pixel of the reference
  int Seed = 1;
  std::string TruthFolder; ///< keeps the reference for later runs; if empty, it is not kept

  /// Adds --views, --size, --spp, --seed and --truth, under a heading of the help if there is one.
  void AddTo(CLI::App& command, const std::string& group = "Options");
};
}

#endif
