//VTK::System::Dec
//CSLF::Options::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Puts what was looked up into the scene: casts the ray from the eye through each fragment of the
// cube's faces and takes its result from the picture that cslfPictureFS.glsl has drawn.

// Options, defined only where they apply:
//   CLIPPING_PLANES  how many planes cut the picture
//   TONE_MAPPING     vtkCSLFMapper::ToneMappingType, unless colours are shown as they are
//   RENDER_PASS      a render pass may ask for the surface's position and normal

//VTK::CustomUniforms::Dec
//VTK::Camera::Dec
//VTK::Light::Dec
//VTK::Picking::Dec
//VTK::DepthPeeling::Dec
//VTK::Output::Dec

in vec3 positionCCVSOutput;

uniform int PrimitiveIDOffset;
uniform vec4 EyeCC;            // w = 1: the eye; w = 0: the direction of parallel projection
uniform mat4 CCDCMatrix;
uniform int EntryFacePass;     // the face by which the rays enter
uniform bool DrawsExits;       // the fragments are where rays leave the cube
uniform sampler2D PictureColor;
uniform sampler2D PictureFraction;
uniform vec2 PictureOrigin;    // of the picture in the window, in pixels
uniform bool LinearColor;      // the field holds linear values, otherwise sRGB-encoded ones
uniform float Opacity;
uniform int CoveragePass;      // 0: all, 1: what covers its pixel, 2: what covers a part of it
#ifdef CLIPPING_PLANES
uniform vec4 ClippingPlanesCC[CLIPPING_PLANES]; // what is drawn lies where they are positive
#endif
#ifdef RENDER_PASS
uniform mat4 CCVCMatrix;
#endif

//CSLF::Cube::Dec
//CSLF::ToneMapping::Dec

// Coverage from which on a fragment counts as opaque.
const float OpaqueCoverage = 254.5 / 255.0;

LookupResult ReadPicture()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy - PictureOrigin);
  return LookupResult(
    texelFetch(PictureColor, pixel, 0), texelFetch(PictureFraction, pixel, 0).r);
}

bool IsClipped(vec3 pointCC)
{
#ifdef CLIPPING_PLANES
  for (int i = 0; i < CLIPPING_PLANES; ++i)
  {
    if (dot(ClippingPlanesCC[i], vec4(pointCC, 1.0)) < 0.0)
    {
      return true;
    }
  }
#endif
  return false;
}

vec3 GetDisplayColor(vec3 color)
{
#ifdef TONE_MAPPING
  return LinearToSRGB(MapTone(LinearColor ? color : SRGBToLinear(color)));
#else
  return LinearColor ? LinearToSRGB(color) : color;
#endif
}

void main()
{
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

  // The surfaces are cut by the clipping range, not the cube; this also leaves out what lies behind
  // an eye inside the cube.
  vec3 hitCC = mix(entry, exit, result.Fraction);
  vec4 hitDC = CCDCMatrix * vec4(hitCC, 1.0);
  if (abs(hitDC.z) > hitDC.w || IsClipped(hitCC))
  {
    discard;
  }
  gl_FragDepth = 0.5 * hitDC.z / hitDC.w + 0.5;

  //VTK::DepthPeeling::PreColor

  gl_FragData[0] = vec4(GetDisplayColor(result.Color.rgb / alpha), alpha * Opacity);

#ifdef RENDER_PASS
  // By these names render passes know them.
  vec4 vertexVC = CCVCMatrix * vec4(hitCC, 1.0);
  vec3 across = cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz));
  vec3 normalVCVSOutput = length(across) > 0.0 ? normalize(across) : vec3(0.0, 0.0, 1.0);
  //VTK::Light::Impl
#endif

  //VTK::DepthPeeling::Impl
  //VTK::Picking::Impl
}
