// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Copies coded tracks from one container to another.
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

/// The changes in a copy. Values that are empty or 0 change nothing.
struct RemuxChanges
{
  Tags SetTags; ///< new texts of tags; an empty one removes the tag
  ///@{
  /// The size of frames according to the container.
  int Width = 0;
  int Height = 0;
  ///@}
  int Repeats = 1;         ///< of all frames, one after the other
  std::vector<int> Frames; ///< of each track: the number that is left
};

/// Does the same as `ffmpeg -i from -map 0 -c copy to`, except for the changes.
bool Remux(const std::string& from, const std::string& to, const RemuxChanges& changes = {});

/// The text of a file's tag, empty if there is none.
std::string ReadTag(const std::string& fileName, const std::string& name);
}
}

#endif
