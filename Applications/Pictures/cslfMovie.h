// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures as a movie for any player: H.264 or VP9, 4:2:0, 8 bits, or an animated WebP picture.
 */
#ifndef cslfMovie_h
#define cslfMovie_h

#include "cslfFrameFiles.h"

#include <string>

namespace cslf::tool
{
/// How FFmpeg encodes a movie.
struct MovieFormat
{
  const char* Extension;
  const char* Encoder;
  const char* Quality; ///< the encoder's options: name=value:name=value
  bool IsSubsampled;   ///< in YCbCr, otherwise RGB
};

/// The format of a file name. Null if its extension is of none.
const MovieFormat* FindMovieFormat(const std::string& fileName);

/// Throws a Failure if this tool or its FFmpeg cannot encode such pictures. If the format is
/// subsampled, their width and height must be even.
std::unique_ptr<FrameWriter> MakeMovieWriter(
  const std::string& fileName, int width, int height, double frameRate);
}

#endif
