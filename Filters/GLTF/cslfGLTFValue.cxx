// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFValue.h"

#include "cslfJSON.h"

#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
// JSON's numbers are exact integers up to this one.
constexpr double LargestIndex = 9007199254740992.0;
}

GLTFValue::GLTFValue(const nlohmann::json* value, std::string path)
  : Value(value)
  , Path(std::move(path))
{
}

void GLTFValue::Fail(const std::string& what) const
{
  throw GLTFError((this->Path.empty() ? "the document" : this->Path) + " " + what);
}

GLTFValue GLTFValue::operator[](const char* name) const
{
  GLTFValue member(nullptr, this->Path.empty() ? name : this->Path + "." + name);
  if (this->Value)
  {
    if (!this->Value->is_object())
    {
      this->Fail("is not an object");
    }
    const auto found = this->Value->find(name);
    member.Value = found != this->Value->end() ? &*found : nullptr;
  }
  return member;
}

std::size_t GLTFValue::GetCount() const
{
  if (this->Value && !this->Value->is_array())
  {
    this->Fail("is not an array");
  }
  return this->Value ? this->Value->size() : 0;
}

GLTFValue GLTFValue::At(std::size_t index) const
{
  GLTFValue element(nullptr, this->Path + "[" + std::to_string(index) + "]");
  if (index >= this->GetCount())
  {
    element.Fail("does not exist");
  }
  element.Value = &(*this->Value)[index];
  return element;
}

std::optional<std::size_t> GLTFValue::GetIndex() const
{
  if (!this->Value)
  {
    return std::nullopt;
  }
  const double number = this->Value->is_number() ? this->Value->get<double>() : -1.0;
  if (!(number >= 0.0) || number > LargestIndex || number != std::floor(number))
  {
    this->Fail("is not a non-negative integer");
  }
  return static_cast<std::size_t>(number);
}

std::size_t GLTFValue::GetIndex(std::size_t fallback) const
{
  return this->GetIndex().value_or(fallback);
}

double GLTFValue::GetNumber(double fallback) const
{
  if (this->Value && !this->Value->is_number())
  {
    this->Fail("is not a number");
  }
  return this->Value ? this->Value->get<double>() : fallback;
}

bool GLTFValue::GetBool(bool fallback) const
{
  if (this->Value && !this->Value->is_boolean())
  {
    this->Fail("is not true or false");
  }
  return this->Value ? this->Value->get<bool>() : fallback;
}

std::string GLTFValue::GetText(const std::string& fallback) const
{
  if (this->Value && !this->Value->is_string())
  {
    this->Fail("is not a string");
  }
  return this->Value ? this->Value->get<std::string>() : fallback;
}
}
