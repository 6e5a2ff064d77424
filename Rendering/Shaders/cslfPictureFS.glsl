//VTK::System::Dec
#extension GL_ARB_texture_gather : enable
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Looks up the ray from the eye through each fragment (paper, algorithm 1). cslfMapperFS.glsl puts
// the results into the scene.

//VTK::Output::Dec

in vec2 positionVSOutput;

uniform vec4 EyeFC; // w = 1: the eye; w = 0: the direction of parallel projection
uniform mat4 FCDCMatrix;
uniform mat4 DCFCMatrix;
uniform bool IsEyeInside;
uniform vec3 FocalPointFC;

//CSLF::Cube::Dec
//CSLF::Field::Dec
//CSLF::SceneGrid::Dec
//CSLF::Lookup::Dec

void main()
{
  vec3 point = vec3(positionVSOutput, 0.0);
  if (IsEyeInside)
  {
    vec4 displayed = DCFCMatrix * vec4(positionVSOutput, 0.0, 1.0);
    point = displayed.xyz / displayed.w;
  }
  vec3 direction = EyeFC.w > 0.0 ? point - EyeFC.xyz : EyeFC.xyz;
  vec2 entry = point.xy - direction.xy * (point.z / direction.z);
  if (direction.z <= 0.0 || any(greaterThan(abs(entry), vec2(1.0))))
  {
    discard;
  }
  Ray ray = CastRay(point, direction);
  LookupResult result;
  //CSLF::Lookup::Impl
  gl_FragData[0] = result.Color;
  vec4 hitDC = FCDCMatrix * vec4(ray.Entry + result.Fraction * ray.Chord, 1.0);
  gl_FragData[1] = vec4(hitDC.z / hitDC.w);
}
