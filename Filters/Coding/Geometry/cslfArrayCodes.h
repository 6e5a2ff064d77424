// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arrays of a geometry's points, as files store them.
 */
#ifndef cslfArrayCodes_h
#define cslfArrayCodes_h

#include "Pipeline/cslfSurfaceArray.h"
#include "cslfJSONForward.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cslf
{
/// The values of a component are numbers of equal steps over its range, from 0 on, and one more for
/// what is not a number. Steps are at most a thousandth of the range. If most values are integers,
/// each integer is one of them.
class ArrayCodes
{
public:
  ArrayCodes() = default;
  explicit ArrayCodes(const SurfaceArray& array);

  ///@{
  /// What the header says of it, and the opposite. Throws std::exception.
  nlohmann::json Describe() const;
  static ArrayCodes Read(const nlohmann::json& header);
  ///@}

  /// The bytes of a point: its numbers, and bytes that are 0 up to a multiple of four.
  std::size_t GetPointSize() const;

  const std::string& GetName() const { return this->Name; }

  /// The array of the points. Throws std::exception.
  SurfaceArray GetArray() const;

  std::vector<unsigned char> Points; ///< of GetPointSize bytes

private:
  struct Component
  {
    std::string Name;
    double First = 0.0;
    double Last = 0.0;
    std::uint32_t Steps = 1;

    std::uint32_t ToCode(double value) const;
    double ToValue(std::uint32_t code) const;
  };

  /// The bytes of a number.
  std::size_t GetCodeSize() const;

  std::string Name;
  std::vector<Component> Components;
  bool IsInteger = false;
};
}

#endif
