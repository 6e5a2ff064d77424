// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures as a video for any player: H.264, 4:2:0, 8 bits.
 */
#ifndef cslfMovie_h
#define cslfMovie_h

#include "cslfFrameFiles.h"

namespace cslf::tool
{
/// Throws a Failure if this tool or its FFmpeg cannot encode such pictures. Their width and height
/// must be even.
std::unique_ptr<FrameWriter> MakeMovieWriter(
  const std::string& fileName, int width, int height, double frameRate);
}

#endif
