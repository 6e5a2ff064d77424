// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Copying coded tracks from one container into another.
 */
#ifndef cslfRemux_h
#define cslfRemux_h

#include <string>

namespace cslf
{
namespace testing
{
/// Does what `ffmpeg -i from -map 0 -c copy to` does.
bool Remux(const std::string& from, const std::string& to);
}
}

#endif
