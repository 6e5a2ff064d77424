// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFAccessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

namespace cslf
{
namespace
{
// Component types are OpenGL's numbers: glTF 2.0, section 3.6.2.2.
enum ComponentType
{
  Byte = 5120,
  UnsignedByte = 5121,
  Short = 5122,
  UnsignedShort = 5123,
  UnsignedInt = 5125,
  Float = 5126
};

std::size_t GetSize(const GLTFValue& type)
{
  switch (type.GetIndex(0))
  {
    case Byte:
    case UnsignedByte:
      return 1;
    case Short:
    case UnsignedShort:
      return 2;
    case UnsignedInt:
    case Float:
      return 4;
    default:
      type.Fail("is not a component type");
  }
}

int GetComponents(const GLTFValue& type)
{
  const std::string name = type.GetText("");
  if (name == "SCALAR")
  {
    return 1;
  }
  if (name == "VEC2" || name == "VEC3" || name == "VEC4")
  {
    return name[3] - '0';
  }
  type.Fail("is not SCALAR, VEC2, VEC3 or VEC4");
}

/// The number in little-endian bytes.
double ReadComponent(const unsigned char* bytes, std::size_t type)
{
  const auto at = [bytes](int i) { return static_cast<std::uint32_t>(bytes[i]); };
  switch (type)
  {
    case Byte:
      return static_cast<std::int8_t>(at(0));
    case UnsignedByte:
      return at(0);
    case Short:
      return static_cast<std::int16_t>(at(0) | at(1) << 8);
    case UnsignedShort:
      return at(0) | at(1) << 8;
    default:
      break;
  }
  const std::uint32_t bits = at(0) | at(1) << 8 | at(2) << 16 | at(3) << 24;
  if (type == UnsignedInt)
  {
    return bits;
  }
  float number;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

/// The integer that stands for 1: glTF 2.0, section 3.6.2.2.
double GetUnit(std::size_t type)
{
  switch (type)
  {
    case Byte:
      return std::numeric_limits<std::int8_t>::max();
    case UnsignedByte:
      return std::numeric_limits<std::uint8_t>::max();
    case Short:
      return std::numeric_limits<std::int16_t>::max();
    case UnsignedShort:
      return std::numeric_limits<std::uint16_t>::max();
    default:
      return 1.0;
  }
}

/// Reads tuples of numbers from a buffer view, all of which must lie within it.
std::vector<double> ReadView(GLTFDocument& document, const GLTFValue& owner,
  const GLTFValue& componentType, std::size_t count, int components)
{
  const std::optional<std::size_t> index = owner["bufferView"].GetIndex();
  if (!index)
  {
    owner.Fail("has no bufferView");
  }
  const GLTFBytes view = document.GetBufferView(*index);
  const std::size_t offset = owner["byteOffset"].GetIndex(0);
  const std::size_t type = componentType.GetIndex(0);
  const std::size_t size = GetSize(componentType);
  const std::size_t tuple = size * components;
  const std::size_t stride = view.Stride > 0 ? view.Stride : tuple;
  if (stride < tuple)
  {
    owner.Fail("has elements that are larger than its byteStride");
  }
  // Written so that it cannot overflow.
  if (count > 0 &&
    (offset > view.Size || tuple > view.Size - offset ||
      count - 1 > (view.Size - offset - tuple) / stride))
  {
    owner.Fail("exceeds its bufferView");
  }
  std::vector<double> values;
  values.reserve(count * components);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      values.push_back(ReadComponent(view.Data + offset + i * stride + c * size, type));
    }
  }
  return values;
}

/// Replaces the elements that a sparse accessor lists.
void ReplaceSparse(GLTFDocument& document, const GLTFValue& accessor, GLTFNumbers& numbers)
{
  const GLTFValue sparse = accessor["sparse"];
  if (!sparse.IsPresent())
  {
    return;
  }
  const std::size_t count = sparse["count"].GetIndex(0);
  const GLTFValue indices = sparse["indices"];
  const std::vector<double> places =
    ReadView(document, indices, indices["componentType"], count, 1);
  const std::vector<double> values =
    ReadView(document, sparse["values"], accessor["componentType"], count, numbers.Components);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!(places[i] >= 0.0) || places[i] >= static_cast<double>(numbers.GetCount()))
    {
      sparse.Fail("has indices of missing elements");
    }
    std::copy_n(values.begin() + i * numbers.Components, numbers.Components,
      numbers.Values.begin() + static_cast<std::size_t>(places[i]) * numbers.Components);
  }
}
}

GLTFNumbers ReadAccessor(GLTFDocument& document, std::size_t index, GLTFIntegers integers)
{
  const GLTFValue accessor = document.GetElement("accessors", index);
  const std::size_t count = accessor["count"].GetIndex(0);
  const GLTFValue componentType = accessor["componentType"];
  GLTFNumbers numbers;
  numbers.Components = GetComponents(accessor["type"]);
  if (accessor["bufferView"].IsPresent())
  {
    numbers.Values = ReadView(document, accessor, componentType, count, numbers.Components);
    document.CountElements(count);
  }
  else
  {
    document.CountZeros(count);
    numbers.Values.assign(count * numbers.Components, 0.0);
  }
  ReplaceSparse(document, accessor, numbers);
  if (integers == GLTFIntegers::Normalized || accessor["normalized"].GetBool(false))
  {
    const double unit = GetUnit(componentType.GetIndex(0));
    for (double& value : numbers.Values)
    {
      value = unit == 1.0 ? value : std::max(value / unit, -1.0);
    }
  }
  return numbers;
}

std::vector<std::uint32_t> ReadIndices(GLTFDocument& document, std::size_t index)
{
  const GLTFValue accessor = document.GetElement("accessors", index);
  const std::size_t type = accessor["componentType"].GetIndex(0);
  if (type != UnsignedByte && type != UnsignedShort && type != UnsignedInt)
  {
    accessor.Fail("has indices that are not unsigned integers");
  }
  const GLTFNumbers numbers = ReadAccessor(document, index);
  if (numbers.Components != 1)
  {
    accessor.Fail("has indices that are not scalars");
  }
  std::vector<std::uint32_t> indices;
  indices.reserve(numbers.Values.size());
  for (double value : numbers.Values)
  {
    indices.push_back(static_cast<std::uint32_t>(value));
  }
  return indices;
}
}
