// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The terminal's capabilities.
 */
#ifndef cslfTerminal_h
#define cslfTerminal_h

namespace cslf::tool
{
/// Whether standard error is a terminal that understands escape sequences.
bool IsErrorTerminal();
}

#endif
