//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Colour and depth of the ball that a ray meets, as cslfGeometryFS.glsl writes those of triangles.

//VTK::Output::Dec

in vec3 pointBCVSOutput;
flat in vec4 sphereVSOutput;
flat in vec2 squareVSOutput;

uniform mat4 BCDCMatrix;
uniform vec4 EyeBC; // w = 1: the eye; w = 0: the direction of parallel projection
uniform int Side;   // of a square of colours without rim
uniform sampler2D Colors;

// The place of a direction in an octahedral map, from -1 to 1.
vec2 FindPlace(vec3 direction)
{
  vec3 sides = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  vec2 folded = (1.0 - abs(sides.yx)) * vec2(sides.x < 0.0 ? -1.0 : 1.0, sides.y < 0.0 ? -1.0 : 1.0);
  return sides.z < 0.0 ? folded : sides.xy;
}

void main()
{
  vec3 direction = EyeBC.w > 0.0 ? pointBCVSOutput - EyeBC.xyz : EyeBC.xyz;
  vec3 center = sphereVSOutput.xyz - pointBCVSOutput;
  // The nearest point of the ray to the centre, and how far before it the ray enters.
  float square = dot(direction, direction);
  float middle = dot(center, direction) / square;
  vec3 off = middle * direction - center;
  float inside = sphereVSOutput.w * sphereVSOutput.w - dot(off, off);
  if (inside < 0.0)
  {
    discard;
  }
  vec3 normal = off - sqrt(inside / square) * direction;
  vec4 pointDC = BCDCMatrix * vec4(sphereVSOutput.xyz + normal, 1.0);
  float z = pointDC.z / pointDC.w;
  vec2 texel = squareVSOutput + (0.5 * FindPlace(normal) + 0.5) * float(Side);
  gl_FragData[0] = vec4(textureLod(Colors, texel / vec2(textureSize(Colors, 0)), 0.0).rgb, 1.0);
  gl_FragData[1] = vec4(z);
  gl_FragDepth = 0.5 * z + 0.5;
}
