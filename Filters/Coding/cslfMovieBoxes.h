// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The boxes of MP4 files, before FFmpeg takes memory for what they announce.
 */
#ifndef cslfMovieBoxes_h
#define cslfMovieBoxes_h

#include <cstdint>
#include <string>
#include <vector>

namespace cslf
{
/// Whether a file can hold the tables and samples that its boxes announce. FFmpeg takes memory for
/// these, up to 2 GiB a table, before it reads them. It is false where there is no movie, as in
/// files that are cut short, and true for files that cannot be opened and for Matroska, of which
/// FFmpeg limits each element to 256 MiB.
///
/// Then `brokenSizes` are the places of 32-bit numbers, in bytes and ascending order, that are the
/// sizes of samples but larger than the file. FFmpeg would read none after one of 1 GiB or more.
bool CanHoldMovieBoxes(const std::string& fileName, std::vector<std::uint64_t>& brokenSizes);
}

#endif
