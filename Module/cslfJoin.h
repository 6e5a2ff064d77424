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
/// The texts that `toText` makes of a container's items, in one.
template <typename Items, typename ToText>
std::string JoinAs(const Items& items, const ToText& toText, const char* separator = ", ")
{
  std::string list;
  for (const auto& item : items)
  {
    list += (list.empty() ? "" : separator) + std::string(toText(item));
  }
  return list;
}

/// All texts of a container in one, each after a prefix.
template <typename Texts>
std::string Join(const Texts& texts, const char* separator = ", ", const char* prefix = "")
{
  return JoinAs(
    texts, [prefix](const std::string& text) { return prefix + text; }, separator);
}
}

#endif
