//VTK::System::Dec
//CSLF::Options::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Puts what was looked up into the scene: each fragment of the cube's faces takes its result from
// the picture that cslfPictureFS.glsl has drawn.

// Options, defined only where they apply:
//   LINEAR_COLOR     the field holds linear values, otherwise sRGB-encoded ones
//   CLIPPING_PLANES  how many planes cut the picture
//   PICTURE_COARSE   the picture has fewer pixels than the window, to be interpolated
//   TONE_MAPPING     vtkCSLFToneMapping::Curves, unless colours are shown as they are
//   RENDER_PASS      a render pass may ask for the surface's position and normal

//VTK::CustomUniforms::Dec
//VTK::Camera::Dec
//VTK::Light::Dec
//VTK::Picking::Dec
//VTK::DepthPeeling::Dec
//VTK::Output::Dec

uniform int PrimitiveIDOffset;
uniform int FacePass;           // the face being drawn
uniform sampler2D PictureColor;
uniform sampler2D PictureDepth; // z in DC
uniform vec2 ViewportOrigin;    // in the window, in pixels
uniform vec2 PixelSizeDC;       // of the window's pixels
uniform vec2 PictureOrigin;     // of the picture in the window, in pixels
uniform vec2 PictureScale;      // pixels of the picture along each side of one of the window
uniform float Opacity;
uniform int CoveragePass;       // 0: all, 1: fully covered pixels, 2: partly covered pixels
#ifdef CLIPPING_PLANES
uniform vec4 ClippingPlanesDC[CLIPPING_PLANES]; // visible parts lie where they are positive
#endif
#ifdef RENDER_PASS
uniform mat4 DCVCMatrix;
#endif

//CSLF::Constants::Dec
//CSLF::ToneMapping::Dec

// Coverage from which a fragment counts as opaque.
const float OpaqueCoverage = 254.5 / 255.0;

bool IsClipped(vec3 pointDC)
{
#ifdef CLIPPING_PLANES
  for (int i = 0; i < CLIPPING_PLANES; ++i)
  {
    if (dot(ClippingPlanesDC[i], vec4(pointDC, 1.0)) < 0.0)
    {
      return true;
    }
  }
#endif
  return false;
}

vec3 GetDisplayColor(vec3 color)
{
#if defined(TONE_MAPPING) && defined(LINEAR_COLOR)
  return LinearToSRGB(MapTone(color));
#elif defined(TONE_MAPPING)
  return LinearToSRGB(MapTone(SRGBToLinear(color)));
#elif defined(LINEAR_COLOR)
  return LinearToSRGB(color);
#else
  return color;
#endif
}

// The picture's colour and z of DC for the fragment.
vec4 ReadPicture(out float z)
{
  vec2 position = gl_FragCoord.xy - PictureOrigin;
#ifdef PICTURE_COARSE
  vec2 inPicture = position * PictureScale;
  ivec2 last = textureSize(PictureColor, 0) - 1;
  ivec2 low = max(ivec2(inPicture - 0.5), 0);
  ivec2 high = min(low + 1, last);
  z = min(min(texelFetch(PictureDepth, low, 0).r, texelFetch(PictureDepth, high, 0).r),
    min(texelFetch(PictureDepth, ivec2(high.x, low.y), 0).r,
      texelFetch(PictureDepth, ivec2(low.x, high.y), 0).r));
  return textureLod(PictureColor, inPicture / vec2(last + 1), 0.0);
#else
  ivec2 texel = ivec2(position * PictureScale);
  z = texelFetch(PictureDepth, texel, 0).r;
  return texelFetch(PictureColor, texel, 0);
#endif
}

void main()
{
  float z;
  vec4 color = ReadPicture(z);
  float alpha = color.a;
  bool covers = alpha >= OpaqueCoverage;
  if (alpha <= 0.0 || (CoveragePass == 1 && !covers) || (CoveragePass == 2 && covers))
  {
    discard;
  }

  // The clipping range cuts the surfaces, not the cube. This also removes what lies behind an eye
  // inside the cube.
  vec3 hitDC = vec3((gl_FragCoord.xy - ViewportOrigin) * PixelSizeDC - 1.0, z);
  if (abs(hitDC.z) > 1.0 || IsClipped(hitDC))
  {
    discard;
  }
  gl_FragDepth = 0.5 * hitDC.z + 0.5;

  //VTK::DepthPeeling::PreColor

  gl_FragData[0] = vec4(GetDisplayColor(color.rgb / alpha), alpha * Opacity);

#ifdef RENDER_PASS
  // Render passes know them by these names.
  vec4 vertexVC = DCVCMatrix * vec4(hitDC, 1.0);
  vertexVC /= vertexVC.w;
  vec3 across = cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz));
  vec3 normalVCVSOutput = length(across) > 0.0 ? normalize(across) : vec3(0.0, 0.0, 1.0);
  //VTK::Light::Impl
#endif

  //VTK::DepthPeeling::Impl
  //VTK::Picking::Impl
}
