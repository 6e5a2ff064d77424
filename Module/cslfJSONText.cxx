// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfJSONText.h"

namespace cslf
{
namespace
{
using JSON = nlohmann::json;

struct TooDeep
{
};

/// Parses with a limit on the depth, which counts the values around a value.
JSON ParseToDepth(const std::string& text)
{
  const auto watch = [](int depth, JSON::parse_event_t event, const JSON&)
  {
    const bool opens =
      event == JSON::parse_event_t::object_start || event == JSON::parse_event_t::array_start;
    if (opens && depth >= MaximumJSONDepth)
    {
      throw TooDeep();
    }
    return true;
  };
  constexpr bool withExceptions = false;
  return JSON::parse(text, watch, withExceptions);
}

std::string TooLong()
{
  return "longer than " + std::to_string(MaximumJSONBytes) + " bytes";
}

JSON Refuse(const std::string& why, std::string* error)
{
  if (error)
  {
    *error = why;
  }
  return JSON(JSON::value_t::discarded);
}
}

JSON ParseJSON(const std::string& text, std::string* error)
{
  if (text.size() > MaximumJSONBytes)
  {
    return Refuse(TooLong(), error);
  }
  try
  {
    JSON json = ParseToDepth(text);
    return json.is_discarded() ? Refuse("not JSON", error) : json;
  }
  catch (const TooDeep&)
  {
    return Refuse("nested deeper than " + std::to_string(MaximumJSONDepth) + " levels", error);
  }
}

std::string DescribeException(const std::exception& exception)
{
  const std::string text = exception.what();
  const std::size_t end = text.find("] ");
  const bool hasPrefix = dynamic_cast<const JSON::exception*>(&exception) != nullptr;
  return hasPrefix && end != std::string::npos ? text.substr(end + 2) : text;
}
}
