// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What an EXR file says of itself, checked before OpenEXR sees it.
 */
#ifndef cslfEXRHeader_h
#define cslfEXRHeader_h

#include <vector>

namespace cslf
{
/// Whether an EXR file holds one image of that size, in rows, and its header is one that OpenEXR
/// reads as it was written: OpenEXR allocates memory for whatever a header claims.
bool IsSoundEXR(const std::vector<unsigned char>& content, int width, int height);
}

#endif
