// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A glTF 2.0 file: its JSON and its bytes.
 */
#ifndef cslfGLTFDocument_h
#define cslfGLTFDocument_h

#include "cslfGLTFValue.h"
#include "cslfJSON.h"

#include <cstddef>
#include <map>
#include <string>

namespace cslf
{
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
