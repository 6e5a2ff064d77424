// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How files are named until they are whole.
 */
#ifndef cslfUnfinished_h
#define cslfUnfinished_h

namespace cslf
{
/// Appended to the name of a file while it is written; it is then renamed.
constexpr const char* UnfinishedSuffix = ".unfinished";
}

#endif
