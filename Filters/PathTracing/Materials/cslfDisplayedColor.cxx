// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDisplayedColor.h"

#include "cslfColor.h"

#include <array>
#include <cmath>

namespace cslf
{
namespace
{
constexpr int Steps = 1024;
using Table = std::array<float, Steps + 1>;

Table MakeTable()
{
  Table table{};
  for (int i = 0; i <= Steps; ++i)
  {
    table[i] = static_cast<float>(SRGBToLinear(static_cast<double>(i) / Steps));
  }
  return table;
}

float Decode(const Table& table, float displayed)
{
  if (!(displayed > 0.0f))
  {
    return 0.0f;
  }
  if (!(displayed < 1.0f))
  {
    return static_cast<float>(SRGBToLinear(displayed));
  }
  const float position = displayed * Steps;
  const int lower = static_cast<int>(position);
  const float weight = position - static_cast<float>(lower);
  return (1.0f - weight) * table[lower] + weight * table[lower + 1];
}

float Encode(float light)
{
  return light < 1.0f ? static_cast<float>(LinearToSRGB(light))
                      : 1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f;
}
}

glm::vec3 ToDisplayed(const glm::vec3& light)
{
  return { Encode(light.x), Encode(light.y), Encode(light.z) };
}

glm::vec3 FromDisplayed(const glm::vec3& displayed)
{
  static const Table table = MakeTable();
  return { Decode(table, displayed.x), Decode(table, displayed.y), Decode(table, displayed.z) };
}
}
