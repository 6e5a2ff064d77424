//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws a square around each ball, in the plane through its centre that faces the eye. Coordinates
// are those of the balls (BC): cube coordinates times half of the cube's edges.

in vec4 sphere; // centre and radius
out vec3 pointBCVSOutput;
flat out vec4 sphereVSOutput;
flat out vec2 squareVSOutput; // of the colours: its first texel within the rim

uniform mat4 BCDCMatrix;
uniform vec4 EyeBC; // w = 1: the eye; w = 0: the direction of parallel projection
uniform float Growth; // of the radius
uniform int Side;     // of a square of colours without rim
uniform int SquaresPerRow;

void main()
{
  int ball = gl_VertexID >> 2;
  vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0;
  vec3 toEye = EyeBC.w > 0.0 ? EyeBC.xyz - sphere.xyz : -EyeBC.xyz;
  vec3 facing = normalize(toEye);
  vec3 across =
    normalize(cross(facing, abs(facing.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  // The cone from the eye around the ball is wider than the ball at its centre.
  float radius = Growth * sphere.w;
  float square = dot(toEye, toEye);
  float away = square - radius * radius;
  float size = EyeBC.w > 0.0 ? radius * sqrt(square / max(away, 0.01 * square)) : radius;
  pointBCVSOutput = sphere.xyz + size * (corner.x * across + corner.y * cross(facing, across));
  sphereVSOutput = vec4(sphere.xyz, radius);
  squareVSOutput = vec2(ball % SquaresPerRow, ball / SquaresPerRow) * float(Side + 2) + 1.0;
  gl_Position = BCDCMatrix * vec4(pointBCVSOutput, 1.0);
}
