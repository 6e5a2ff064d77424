// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checks the header of an EXR file before OpenEXR reads it.
 */
#ifndef cslfEXRHeader_h
#define cslfEXRHeader_h

#include <vector>

namespace cslf
{
/// Whether an EXR file contains one image of that size, in rows, and OpenEXR will interpret its
/// header correctly. OpenEXR allocates memory for whatever a header claims.
bool IsSoundEXR(const std::vector<unsigned char>& content, int width, int height);
}

#endif
