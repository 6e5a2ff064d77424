// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// JSON texts from files: limits of size and depth, and whole numbers that are in range or refused.
#include "Files/cslfJSONFile.h"
#include "cslfJSONText.h"
#include "cslfTesting.h"

#include <cstdint>

namespace
{
using JSON = nlohmann::json;

std::string Nest(int depth, const std::string& open, const std::string& close)
{
  std::string text;
  for (int k = 0; k < depth; ++k)
  {
    text += open;
  }
  text += "1";
  for (int k = 0; k < depth; ++k)
  {
    text += close;
  }
  return text;
}

void CheckRefused(const std::string& text, const char* reason)
{
  std::string error;
  CSLF_CHECK(cslf::ParseJSON(text, &error).is_discarded());
  CSLF_CHECK(error.find(reason) != std::string::npos);
  CSLF_CHECK(cslf::ParseJSON(text).is_discarded());
}

void TestLimits()
{
  constexpr int limit = cslf::MaximumJSONDepth;
  CSLF_CHECK(cslf::ParseJSON(Nest(limit, "[", "]")).is_array());
  CSLF_CHECK(cslf::ParseJSON(Nest(limit, "{\"a\":", "}")).is_object());
  CheckRefused(Nest(limit + 1, "[", "]"), "deeper than 32");
  CheckRefused(Nest(limit + 1, "{\"a\":", "}"), "deeper than 32");
  // Far more than a stack can hold, and never closed.
  CheckRefused(Nest(1000000, "[", "]"), "deeper than 32");
  CheckRefused(Nest(1000000, "{\"a\":", ""), "deeper than 32");
  CheckRefused("", "not JSON");
  CheckRefused("{\"a\":1,}", "not JSON");
  CheckRefused("1e999", "not JSON");
  CheckRefused("\"\xff\"", "not JSON");

  std::string text = "[1" + std::string(cslf::MaximumJSONBytes - 3, ' ') + "]";
  CSLF_CHECK(cslf::ParseJSON(text) == JSON({ 1 }));
  text += " ";
  CheckRefused(text, "longer than 16777216 bytes");
  std::string error;
  CSLF_CHECK(cslf::ReadJSON("/nowhere/at/all", &error).is_discarded() && error == "not readable");
  CSLF_CHECK(cslf::ReadJSON("/", &error).is_discarded() && error == "not readable");
}

template <typename Integer>
void CheckInteger(const char* text, bool isOne)
{
  const JSON json = cslf::ParseJSON(text);
  CSLF_CHECK(cslf::IsInteger<Integer>(json) == isOne);
  bool hasThrown = false;
  try
  {
    CSLF_CHECK(std::to_string(cslf::ToInteger<Integer>(json)) == text);
  }
  catch (const std::invalid_argument&)
  {
    hasThrown = true;
  }
  CSLF_CHECK(hasThrown == !isOne);
}

void TestIntegers()
{
  CheckInteger<int>("0", true);
  CheckInteger<int>("-2147483648", true);
  CheckInteger<int>("2147483647", true);
  CheckInteger<int>("2147483648", false);
  CheckInteger<int>("-2147483649", false);
  CheckInteger<int>("4294967301", false); // 5, were it wrapped
  CheckInteger<int>("1.5", false);
  CheckInteger<int>("true", false);
  CheckInteger<int>("null", false);
  CheckInteger<int>("\"1\"", false);
  CheckInteger<std::uint32_t>("4294967295", true);
  CheckInteger<std::uint32_t>("4294967296", false);
  CheckInteger<std::uint32_t>("-1", false);
  CheckInteger<std::int64_t>("9223372036854775807", true);
  CheckInteger<std::int64_t>("9223372036854775808", false);
  CheckInteger<std::uint64_t>("18446744073709551615", true);

  const JSON object = cslf::ParseJSON(R"({"a":3,"b":"x","c":[1,2],"d":[1,4294967301]})");
  CSLF_CHECK(cslf::ToInteger(object, "a", 1) == 3);
  CSLF_CHECK(cslf::ToInteger(object, "b", 1) == 1);
  CSLF_CHECK(cslf::ToInteger(object, "none", 1) == 1);
  CSLF_CHECK(cslf::ToIntegers(object["c"]) == std::vector<int>({ 1, 2 }));
  for (const char* name : { "a", "d" })
  {
    bool hasThrown = false;
    try
    {
      cslf::ToIntegers(object[name]);
    }
    catch (const std::invalid_argument&)
    {
      hasThrown = true;
    }
    CSLF_CHECK(hasThrown);
  }
}
}

int TestCSLFJSONText(int, char*[])
{
  TestLimits();
  TestIntegers();
  return cslf::testing::Result();
}
