// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The numbers of a glTF file's accessors.
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

/// How integers are taken.
enum class GLTFIntegers
{
  AsDeclared, ///< as parts of the largest integer of their type where the accessor says so
  Normalized  ///< always so
};

/// Reads an accessor of scalars or vectors, sparse ones too. Throws a GLTFError where its bytes are
/// not all there.
GLTFNumbers ReadAccessor(
  GLTFDocument& document, std::size_t index, GLTFIntegers integers = GLTFIntegers::AsDeclared);

/// Reads an accessor of indices, which are unsigned integers.
std::vector<std::uint32_t> ReadIndices(GLTFDocument& document, std::size_t index);
}

#endif
