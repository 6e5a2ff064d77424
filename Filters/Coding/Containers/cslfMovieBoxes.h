// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checks the boxes of MP4 files before FFmpeg allocates memory for what they announce.
 */
#ifndef cslfMovieBoxes_h
#define cslfMovieBoxes_h

#include <cstdint>
#include <vector>

namespace cslf
{
class InputFile;

/// Whether a file is large enough for the tables and samples that its boxes announce. FFmpeg
/// allocates memory for these, up to 2 GiB per table, before it reads them. False if there is no
/// movie, as in truncated files. True for Matroska, where FFmpeg limits each element to 256 MiB.
///
/// If true, `brokenSizes` are the offsets, in ascending order, of 32-bit sample sizes that are
/// larger than the file. FFmpeg would not read any sample after a size of 1 GiB or more.
bool CanHoldMovieBoxes(const InputFile& file, std::vector<std::uint64_t>& brokenSizes);
}

#endif
