//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Puts what was looked up into the scene: each fragment of the cube's faces takes its result from
// the picture that cslfPictureFS.glsl has drawn.

// Defines LINEAR_COLOR where the field holds linear values, otherwise sRGB-encoded ones.
//CSLF::Options::Dec

//VTK::CustomUniforms::Dec
//VTK::PositionVC::Dec
//VTK::Camera::Dec
//VTK::Picking::Dec
//VTK::DepthPeeling::Dec
//VTK::Output::Dec

uniform int PrimitiveIDOffset;
uniform sampler2D PictureColor;
uniform sampler2D PictureDepth; // z of DC
uniform vec2 PictureOrigin;     // of the picture in the window, in pixels
uniform vec2 PictureScale;      // its pixels along a side of one of the window
uniform float Opacity;
uniform int CoveragePass;       // 0: all, 1: what covers its pixel, 2: what covers a part of it

// Coverage from which on a fragment counts as opaque.
const float OpaqueCoverage = 254.5 / 255.0;

#ifdef LINEAR_COLOR
vec3 EncodeColor(vec3 linear)
{
  vec3 clamped = clamp(linear, 0.0, 1.0);
  return mix(12.92 * clamped, 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055,
    step(vec3(0.0031308), clamped));
}
#else
vec3 EncodeColor(vec3 encoded)
{
  return encoded;
}
#endif

void main()
{
  //VTK::PositionVC::Impl

  ivec2 pixel = ivec2((gl_FragCoord.xy - PictureOrigin) * PictureScale);
  vec4 color = texelFetch(PictureColor, pixel, 0);
  float alpha = color.a;
  bool covers = alpha >= OpaqueCoverage;
  if (alpha <= 0.0 || (CoveragePass == 1 && !covers) || (CoveragePass == 2 && covers))
  {
    discard;
  }

  gl_FragDepth = clamp(0.5 * texelFetch(PictureDepth, pixel, 0).r + 0.5, 0.0, 1.0);

  //VTK::DepthPeeling::PreColor

  gl_FragData[0] = vec4(EncodeColor(color.rgb / alpha), alpha * Opacity);

  //VTK::DepthPeeling::Impl
  //VTK::Picking::Impl
}
