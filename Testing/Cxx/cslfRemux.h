// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Copying coded tracks from one container into another.
 */
#ifndef cslfRemux_h
#define cslfRemux_h

#include <map>
#include <string>
#include <vector>

namespace cslf
{
namespace testing
{
/// Texts by the names of a container's tags.
using Tags = std::map<std::string, std::string>;

/// How a copy differs. What is empty or 0 stays as it is.
struct RemuxChanges
{
  Tags SetTags; ///< to another text each; an empty one removes the tag
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

/// The text of a file's tag, empty if there is none.
std::string ReadTag(const std::string& fileName, const std::string& name);
}
}

#endif
