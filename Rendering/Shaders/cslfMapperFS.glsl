//VTK::System::Dec
#extension GL_ARB_texture_gather : enable
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Casts the ray from the eye through each fragment of the cube's far faces and looks it up
// (paper, algorithm 1).

//VTK::CustomUniforms::Dec
//VTK::PositionVC::Dec
//VTK::Camera::Dec
//VTK::Picking::Dec
//VTK::DepthPeeling::Dec
//VTK::Output::Dec

in vec3 positionCCVSOutput;

uniform int PrimitiveIDOffset;
uniform vec4 EyeCC;            // w = 1: the eye; w = 0: the direction of parallel projection
uniform mat4 CCDCMatrix;
uniform int EntryFacePass;     // the entry face being drawn
uniform int LookupMode;        // vtkCSLFMapper::LookupType
uniform vec3 FocalPointCC;
uniform bool LinearColor;      // the field holds linear values, otherwise sRGB-encoded ones
uniform float Opacity;
uniform int CoveragePass;      // 0: all, 1: what covers its pixel, 2: what covers a part of it

//CSLF::Cube::Dec
//CSLF::Field::Dec
//CSLF::Lookup::Dec

// Coverage from which on a fragment counts as opaque.
const float OpaqueCoverage = 254.5 / 255.0;

LookupResult LookUp(RayCoordinates ray)
{
  switch (LookupMode)
  {
    case 0:
      return LookupNearest(ray);
    case 1:
      return LookupLinear(ray);
    case 2:
      return LookupBilinear(ray);
    case 3:
      return LookupFocal(ray, FocalPointCC);
    default:
      return LookupDepth(ray);
  }
}

vec3 LinearToSRGB(vec3 linear)
{
  vec3 clamped = clamp(linear, 0.0, 1.0);
  return mix(12.92 * clamped, 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055,
    step(vec3(0.0031308), clamped));
}

void main()
{
  //VTK::PositionVC::Impl

  vec3 direction = EyeCC.w > 0.0 ? positionCCVSOutput - EyeCC.xyz : EyeCC.xyz;
  vec3 origin = EyeCC.w > 0.0 ? EyeCC.xyz : positionCCVSOutput;
  RayCoordinates ray = RayToCoordinates(origin, direction);

  // Each ray is drawn once, where it leaves the cube.
  vec3 exit = FaceToCube(ray.Exit.Face, ray.Exit.Coordinates);
  vec3 entry = FaceToCube(ray.Entry.Face, ray.Entry.Coordinates);
  if (!ray.Hits || ray.Entry.Face != EntryFacePass ||
    distance(positionCCVSOutput, exit) > distance(positionCCVSOutput, entry))
  {
    discard;
  }

  LookupResult result = LookUp(ray);
  float alpha = result.Color.a;
  bool covers = alpha >= OpaqueCoverage;
  if (alpha <= 0.0 || (CoveragePass == 1 && !covers) || (CoveragePass == 2 && covers))
  {
    discard;
  }

  vec4 hitDC = CCDCMatrix * vec4(mix(entry, exit, result.Fraction), 1.0);
  gl_FragDepth = clamp(0.5 * hitDC.z / hitDC.w + 0.5, 0.0, 1.0);

  //VTK::DepthPeeling::PreColor

  vec3 color = result.Color.rgb / alpha;
  gl_FragData[0] = vec4(LinearColor ? LinearToSRGB(color) : color, alpha * Opacity);

  //VTK::DepthPeeling::Impl
  //VTK::Picking::Impl
}
