// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Checked access to the JSON values of a glTF file.
 */
#ifndef cslfGLTFValue_h
#define cslfGLTFValue_h

#include "cslfJSONForward.h"

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

namespace cslf
{
/// Describes what is invalid in a part of a file.
struct GLTFError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// A value that may be absent, and its path in the document. Values of an unexpected type throw a
/// GLTFError that names the path; absent ones do not. It refers to the document, which must outlive
/// it.
class GLTFValue
{
public:
  GLTFValue(const nlohmann::json* value, std::string path);

  bool IsPresent() const { return this->Value != nullptr; }
  const std::string& GetPath() const { return this->Path; }

  /// A member; absent if this value is absent.
  GLTFValue operator[](const char* name) const;

  /// The number of elements; 0 if this value is absent.
  std::size_t GetCount() const;

  /// An element. Throws a GLTFError if it does not exist.
  GLTFValue At(std::size_t index) const;

  /// A non-negative integer.
  std::optional<std::size_t> GetIndex() const;
  std::size_t GetIndex(std::size_t fallback) const;

  double GetNumber(double fallback) const;
  bool GetBool(bool fallback) const;
  std::string GetText(const std::string& fallback) const;

  /// As many numbers as the fallback contains.
  template <std::size_t Size>
  std::array<double, Size> GetNumbers(const std::array<double, Size>& fallback) const
  {
    std::array<double, Size> numbers = fallback;
    if (this->IsPresent())
    {
      if (this->GetCount() != Size)
      {
        this->Fail("must have " + std::to_string(Size) + " numbers");
      }
      for (std::size_t i = 0; i < Size; ++i)
      {
        numbers[i] = this->At(i).GetNumber(0.0);
      }
    }
    return numbers;
  }

  /// Throws a GLTFError with the path and the error.
  [[noreturn]] void Fail(const std::string& what) const;

private:
  const nlohmann::json* Value;
  std::string Path;
};
}

#endif
