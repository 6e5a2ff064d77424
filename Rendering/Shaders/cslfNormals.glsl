// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// A direction as one number above 0, which a float can hold: its octahedral coordinates (Meyer et
// al., "On Floating-Point Normal Vectors", 2010), in steps.

const float NormalSteps = 2000.0;

vec2 Fold(vec2 coordinates)
{
  return (1.0 - abs(coordinates.yx)) *
    vec2(coordinates.x < 0.0 ? -1.0 : 1.0, coordinates.y < 0.0 ? -1.0 : 1.0);
}

float PackNormal(vec3 normal)
{
  vec3 sides = normal / max(abs(normal.x) + abs(normal.y) + abs(normal.z), 1.0e-30);
  vec2 coordinates = sides.z < 0.0 ? Fold(sides.xy) : sides.xy;
  vec2 steps = floor((0.5 * coordinates + 0.5) * NormalSteps + 0.5);
  return 1.0 + steps.x + (NormalSteps + 1.0) * steps.y;
}

vec3 UnpackNormal(float number)
{
  float row = floor((number - 0.5) / (NormalSteps + 1.0));
  vec2 steps = vec2(number - 1.0 - row * (NormalSteps + 1.0), row);
  vec2 coordinates = 2.0 * steps / NormalSteps - 1.0;
  float z = 1.0 - abs(coordinates.x) - abs(coordinates.y);
  return normalize(vec3(z < 0.0 ? Fold(coordinates) : coordinates, z));
}
