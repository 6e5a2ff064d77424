// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads the numbers of a glTF file's accessors.
 */
#ifndef cslfGLTFAccessor_h
#define cslfGLTFAccessor_h

#include "cslfGLTFDocument.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/// Tuples of numbers.
struct GLTFNumbers
{
  int Components = 1;
  std::vector<double> Values;

  std::size_t GetCount() const { return this->Values.size() / this->Components; }
};

/// How integers are converted.
enum class GLTFIntegers
{
  AsDeclared, ///< divided by the largest integer of their type if the accessor is normalized
  Normalized  ///< always divided by it
};

/// Reads an accessor of scalars or vectors, which may be sparse. Throws a GLTFError if bytes are
/// missing.
GLTFNumbers ReadAccessor(
  GLTFDocument& document, std::size_t index, GLTFIntegers integers = GLTFIntegers::AsDeclared);

/// Reads an accessor of indices, which are unsigned integers.
std::vector<std::uint32_t> ReadIndices(GLTFDocument& document, std::size_t index);
}

#endif
