// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A glTF 2.0 file: its JSON and its bytes.
 */
#ifndef cslfGLTFDocument_h
#define cslfGLTFDocument_h

#include "cslfJSON.h"
#include "cslfJSONForward.h"
#include "cslfJoin.h"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

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

class GLTFErrors
{
public:
  std::set<std::string> Omitted; ///< names of unsupported features

  /// Does a part of the work. Records a GLTFError in it, and continues.
  template <typename Work>
  void Attempt(const Work& work)
  {
    try
    {
      work();
    }
    catch (const GLTFError& error)
    {
      this->Add(error.what());
    }
  }

  /// Adds an error, once.
  void Add(const std::string& error)
  {
    if (this->Known.insert(error).second && this->Errors.size() < MaximumErrors)
    {
      this->Errors.push_back(error);
    }
  }

  /// Records an unsupported feature, if the file has it.
  void Omit(bool present, const char* what)
  {
    if (present)
    {
      this->Omitted.insert(what);
    }
  }

  /// The first errors in the file, in the order in which they were found.
  std::string ListErrors() const
  {
    const std::string text = Join(this->Errors, "; ");
    const std::size_t more = this->Known.size() - this->Errors.size();
    return more > 0 ? text + "; and " + std::to_string(more) + " more" : text;
  }

private:
  static constexpr std::size_t MaximumErrors = 4;

  std::vector<std::string> Errors;
  std::set<std::string> Known;
};

/// Bytes of a buffer. They belong to the document.
struct GLTFBytes
{
  const unsigned char* Data = nullptr;
  std::size_t Size = 0;
  std::size_t Stride = 0; ///< between elements; 0 if they are contiguous
};

class GLTFDocument
{
public:
  /// Reads a `.gltf` or `.glb` file. Throws a GLTFError if it is not glTF 2.0 or requires an
  /// unsupported extension to read its meshes.
  explicit GLTFDocument(const std::string& fileName);

  GLTFValue GetRoot() const { return { &this->Root, "" }; }

  /// An element of an array of the document. Throws a GLTFError if it does not exist.
  GLTFValue GetElement(const char* array, std::size_t index) const;

  /// Bytes of a buffer view, which all lie within its buffer.
  GLTFBytes GetBufferView(std::size_t index);

  /// Counts the elements that the file makes. A few bytes can make many, if accessors and meshes
  /// are used repeatedly. Throws a GLTFError beyond a limit that grows with the bytes read.
  void CountElements(std::size_t elements);

  /// Counts elements of accessors without bytes. Throws a GLTFError if the file has too many.
  void CountZeros(std::size_t elements);

  /// The contents of a URI: a file in the folder of the document or below it, or data within the
  /// URI.
  std::string ReadResource(const GLTFValue& uri) const;

private:
  void ReadBinary(const std::string& bytes);
  void Parse(const std::string& text);
  void CheckVersion() const;
  void CheckRequired() const;
  const std::string& GetBuffer(std::size_t index);

  std::string FileName;
  nlohmann::json Root;
  std::string BinaryChunk;
  bool HasBinaryChunk = false;
  std::map<std::size_t, std::string> Buffers; // that were read
  std::size_t BytesRead = 0;
  std::size_t Elements = 0;
  std::size_t Zeros = 0;
};
}

#endif
