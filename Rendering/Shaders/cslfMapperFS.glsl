//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Puts what was looked up into the scene: casts the ray from the eye through each fragment of the
// cube's faces and takes its result from the picture that cslfPictureFS.glsl has drawn.

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
uniform bool DrawsExits;       // the fragments are where rays leave the cube
uniform sampler2D PictureColor;
uniform sampler2D PictureFraction;
uniform vec2 PictureOrigin;    // of the picture in the window, in pixels
uniform bool LinearColor;      // the field holds linear values, otherwise sRGB-encoded ones
uniform float Opacity;
uniform int CoveragePass;      // 0: all, 1: what covers its pixel, 2: what covers a part of it

//CSLF::Cube::Dec

// Coverage from which on a fragment counts as opaque.
const float OpaqueCoverage = 254.5 / 255.0;

LookupResult ReadPicture()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy - PictureOrigin);
  return LookupResult(
    texelFetch(PictureColor, pixel, 0), texelFetch(PictureFraction, pixel, 0).r);
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
  vec3 directionFC = mat3(CCFCMatrix) * direction;
  Ray ray = CastRay((CCFCMatrix * vec4(positionCCVSOutput, 1.0)).xyz, directionFC);

  // Each ray is drawn once.
  if (directionFC.z <= 0.0 || (DrawsExits && any(greaterThanEqual(abs(ray.Entry.xy), vec2(1.0)))))
  {
    discard;
  }
  vec3 entry = (FCCCMatrix * vec4(ray.Entry, 1.0)).xyz;
  vec3 exit = (FCCCMatrix * vec4(ray.Entry + ray.Chord, 1.0)).xyz;

  LookupResult result = ReadPicture();
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
