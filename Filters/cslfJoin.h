// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lists of names for messages.
 */
#ifndef cslfJoin_h
#define cslfJoin_h

#include <string>

namespace cslf
{
/// All texts of a container in one, each after a prefix.
template <typename Texts>
std::string Join(const Texts& texts, const char* separator = ", ", const char* prefix = "")
{
  std::string list;
  for (const std::string& text : texts)
  {
    list += (list.empty() ? "" : separator) + (prefix + text);
  }
  return list;
}
}

#endif
