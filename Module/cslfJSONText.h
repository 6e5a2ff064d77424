// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * JSON texts that come from files. Files may be malicious, so size and depth are limited before the
 * text is used, and whole numbers are checked for their range.
 */
#ifndef cslfJSONText_h
#define cslfJSONText_h

#include "cslfJSON.h"
#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace cslf
{
/// The largest size of a text in bytes: the most that Matroska's demuxer reads of a tag.
constexpr std::size_t MaximumJSONBytes = std::size_t(16) << 20;

/// The largest depth of nested objects and arrays. The functions of the JSON library are recursive.
constexpr int MaximumJSONDepth = 32;

/// Parses a text. Returns a discarded value if the text is not JSON, too long or too deep; `error`
/// then says which in a few words.
VTKCSLF_EXPORT nlohmann::json ParseJSON(const std::string& text, std::string* error = nullptr);

/// What is wrong, in a few words: the message of an exception without what the JSON library puts in
/// front of its own ones.
VTKCSLF_EXPORT std::string DescribeException(const std::exception& exception);

/// Whether a value is a whole number that the type can hold.
template <typename Integer>
bool IsInteger(const nlohmann::json& json)
{
  using Limits = std::numeric_limits<Integer>;
  if (json.is_number_unsigned())
  {
    return json.get<std::uint64_t>() <= static_cast<std::uint64_t>(Limits::max());
  }
  if (!json.is_number_integer())
  {
    return false;
  }
  const auto value = json.get<std::int64_t>();
  return value < 0 ? Limits::is_signed && value >= static_cast<std::int64_t>(Limits::min())
                   : static_cast<std::uint64_t>(value) <= static_cast<std::uint64_t>(Limits::max());
}

/// A whole number. JSON's own conversion wraps large numbers and truncates fractions; this throws
/// std::invalid_argument.
template <typename Integer = int>
Integer ToInteger(const nlohmann::json& json)
{
  if (!IsInteger<Integer>(json))
  {
    throw std::invalid_argument("a value is not an integer within its range");
  }
  return json.get<Integer>();
}

/// The whole number of that name in an object, or `otherwise` if there is none.
template <typename Integer = int>
Integer ToInteger(const nlohmann::json& object, const char* name, Integer otherwise)
{
  const auto found = object.find(name);
  return found != object.end() && IsInteger<Integer>(*found) ? found->get<Integer>() : otherwise;
}

/// An array as it is. Throws std::invalid_argument for anything else.
inline const nlohmann::json& RequireArray(const nlohmann::json& json)
{
  if (!json.is_array())
  {
    throw std::invalid_argument("a value is not a list");
  }
  return json;
}

const nlohmann::json& RequireArray(const nlohmann::json&&) = delete;

/// An array of whole numbers, with the same check.
template <typename Integer = int>
std::vector<Integer> ToIntegers(const nlohmann::json& json)
{
  std::vector<Integer> values;
  for (const nlohmann::json& item : RequireArray(json))
  {
    values.push_back(ToInteger<Integer>(item));
  }
  return values;
}
}

#endif
