// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Copying coded tracks from one container into another.
 */
#ifndef cslfRemux_h
#define cslfRemux_h

#include <string>
#include <vector>

namespace cslf
{
namespace testing
{
/// How a copy differs. What is empty or 0 stays as it is.
struct RemuxChanges
{
  std::string Comment;
  ///@{
  /// What the container says that frames measure.
  int Width = 0;
  int Height = 0;
  ///@}
  int Repeats = 1;         ///< of all frames, one after the other
  std::vector<int> Frames; ///< of each track: how many are left
};

/// Does what `ffmpeg -i from -map 0 -c copy to` does, but for the changes.
bool Remux(const std::string& from, const std::string& to, const RemuxChanges& changes = {});
}
}

#endif
