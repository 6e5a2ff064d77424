// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A hash that identifies a scene.
 */
#ifndef cslfFingerprint_h
#define cslfFingerprint_h

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

class vtkAbstractArray;
class vtkFieldData;

namespace cslf
{
struct LightSet;
struct Mesh;

/// Adds everything in order. Equal contents give equal text in every process.
class Fingerprint
{
public:
  Fingerprint();
  ~Fingerprint();
  Fingerprint(const Fingerprint&) = delete;
  Fingerprint& operator=(const Fingerprint&) = delete;

  /// All arrays.
  void Add(vtkFieldData* fields);

  void Add(const Mesh& mesh);
  void Add(const LightSet& lights);

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
  void AddArray(vtkAbstractArray* array);
  void AddBytes(const void* bytes, std::size_t count);

  struct State;
  std::unique_ptr<State> Hash;
};
}

#endif
