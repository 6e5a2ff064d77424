// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A hash that identifies a scene.
 */
#ifndef cslfFingerprint_h
#define cslfFingerprint_h

#include "Pipeline/cslfSurfaceArray.h"

#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

class vtkAbstractArray;
class vtkDataArray;
class vtkFieldData;

namespace cslf
{
struct LightSet;
struct Mesh;
struct VolumeData;

/// The hashes of large arrays such as textures, whose memory many blocks share. It must not change.
class ArrayHashes
{
public:
  const std::string& Find(vtkDataArray* array);

private:
  struct Entry
  {
    vtkSmartPointer<vtkDataArray> Holder; ///< keeps the memory
    std::string Hash;
  };
  std::map<std::pair<const void*, std::size_t>, Entry> Known; ///< by the memory and its size
};

/// Adds everything in order. Equal contents give equal text in every process.
class Fingerprint
{
public:
  Fingerprint();
  ~Fingerprint();
  Fingerprint(const Fingerprint&) = delete;
  Fingerprint& operator=(const Fingerprint&) = delete;

  /// All arrays. Large ones are added by their hashes.
  void Add(vtkFieldData* fields, ArrayHashes& hashes);

  void Add(const Mesh& mesh);
  void Add(const std::vector<SurfaceArray>& arrays);
  void Add(const LightSet& lights);
  void Add(const VolumeData& volume);

  /// Numbers, after how many there are.
  template <typename Value>
  void Add(const std::vector<Value>& values)
  {
    static_assert(std::is_trivially_copyable<Value>::value, "its bytes must be its content");
    const std::size_t count = values.size();
    this->AddBytes(&count, sizeof(count));
    this->AddBytes(values.data(), count * sizeof(Value));
  }

  /// The hash, in hexadecimal digits. Nothing can be added afterwards.
  std::string Finish();

private:
  friend class ArrayHashes;

  void AddArray(vtkAbstractArray* array, ArrayHashes& hashes);
  void AddBytes(const void* bytes, std::size_t count);

  struct State;
  std::unique_ptr<State> Hash;
};
}

#endif
