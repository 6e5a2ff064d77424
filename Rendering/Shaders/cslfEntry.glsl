// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Where the ray from the eye through a fragment enters the cube, for what cslfPictureVS.glsl draws,
// and z of DC.

in vec4 pointVSOutput;

uniform vec4 EyeFC; // w = 1: the eye; w = 0: the direction of parallel projection
uniform mat4 FCDCMatrix;

struct EyeRay
{
  vec3 Point;    // of the fragment
  vec3 Direction;
  vec2 Entry;    // in the plane of the entry face
  bool IsInward; // otherwise it leaves the cube there
  bool IsOnFace; // whether it meets the plane within the face
};

EyeRay FindEyeRay()
{
  EyeRay ray;
  ray.Point = pointVSOutput.xyz / pointVSOutput.w;
  ray.Direction = EyeFC.w > 0.0 ? ray.Point - EyeFC.xyz : EyeFC.xyz;
  ray.Entry = ray.Point.xy - ray.Direction.xy * (ray.Point.z / ray.Direction.z);
  ray.IsInward = ray.Direction.z > 0.0;
  ray.IsOnFace = all(lessThanEqual(abs(ray.Entry), vec2(1.0)));
  return ray;
}

float ToDisplayDepth(vec3 point)
{
  vec4 pointDC = FCDCMatrix * vec4(point, 1.0);
  return pointDC.z / pointDC.w;
}
