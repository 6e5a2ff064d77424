// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lists of names for messages.
 */
#ifndef cslfJoin_h
#define cslfJoin_h

#include <cstddef>
#include <string>

namespace cslf
{
/// Replaces control characters, which could break lines of messages or control terminals, by \x and
/// two hexadecimal digits.
inline std::string MakePrintable(const std::string& text)
{
  const char* const digits = "0123456789abcdef";
  std::string printable;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    // UTF-8 encodes the control characters from 0x80 to 0x9f in two bytes.
    const bool isTwoBytes = byte == 0xc2 && next >= 0x80 && next <= 0x9f;
    const int control = isTwoBytes ? next : byte;
    if (isTwoBytes || byte < 0x20 || byte == 0x7f)
    {
      printable += std::string("\\x") + digits[control / 16] + digits[control % 16];
      i += isTwoBytes ? 1 : 0;
    }
    else
    {
      printable += text[i];
    }
  }
  return printable;
}

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
