//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Writes where the geometry is, its normal and its own colour, for cslfSurface.glsl; or, if it
// alone shows the field, what is seen.

// Options:
//   ALONE            it alone shows the field: all colours are exact
//   BACK_COLORS      its back has other colours
//   BRIGHT           some colours are above 1
//   CLIPPING_PLANES  how many planes cut it
//   COLOR_MAPS       some points have light instead of a colour, and a place on a map
//   IMAGES           some maps are images
//   LINEAR_COLOR     the field holds linear values, otherwise sRGB-encoded ones
//CSLF::Options::Dec

//VTK::Output::Dec

in vec3 pointCCVSOutput;
in vec4 colorVSOutput;

#ifdef BACK_COLORS
in vec4 backColorVSOutput;
uniform int IsMirrored; // whether what is counterclockwise appears clockwise
#endif

#ifdef CLIPPING_PLANES
uniform vec4 ClippingPlanesCC[CLIPPING_PLANES]; // visible parts lie where they are positive
#endif

//CSLF::Normals::Dec

#ifdef COLOR_MAPS
// The column, and 1 for values that are not numbers; or the place on an image.
in vec2 placeVSOutput;
flat in float mapVSOutput; // negative without one
uniform sampler2D MapColors;

//CSLF::Encoding::Dec

const float NanShare = 0.02; // ColorMap::NanShare

#ifdef IMAGES
uniform sampler2D MapPixels; // ShownMaps::GetPixels

vec3 GetPixel(vec2 pixel, vec4 extent, vec4 style)
{
  vec2 repeated = pixel - extent.zw * floor(pixel / extent.zw);
  vec2 wrapped = clamp(mix(pixel, repeated, style.xy), vec2(0.0), extent.zw - 1.0);
  return RayToLinear(texelFetch(MapPixels, ivec2(extent.xy + wrapped), 0).rgb);
}

// MapImage::GetColor
vec3 GetImageColor(vec4 extent, vec4 style)
{
  if (style.z == 0.0)
  {
    return GetPixel(floor(placeVSOutput), extent, style);
  }
  vec2 first = floor(placeVSOutput - 0.5);
  vec2 share = placeVSOutput - 0.5 - first;
  vec3 lower = mix(GetPixel(first, extent, style),
    GetPixel(first + vec2(1.0, 0.0), extent, style), share.x);
  vec3 upper = mix(GetPixel(first + vec2(0.0, 1.0), extent, style),
    GetPixel(first + 1.0, extent, style), share.x);
  return mix(lower, upper, share.y);
}
#endif

// ColorMap::GetColor
vec3 GetMapColor()
{
  int map = 2 * int(mapVSOutput);
#ifdef IMAGES
  vec4 style = texelFetch(MapColors, ivec2(0, map + 1), 0);
  if (style.w > 1.5) // others are colours, whose alpha is 1
  {
    return GetImageColor(texelFetch(MapColors, ivec2(0, map), 0), style);
  }
#endif
  int column = clamp(int(placeVSOutput.x), 0, textureSize(MapColors, 0).x - 1);
  int row = map + (placeVSOutput.y > NanShare ? 1 : 0);
  return texelFetch(MapColors, ivec2(column, row), 0).rgb;
}

// ShowLight of cslfColorMap.h, also brighter than white.
vec3 ShowLight(vec3 light)
{
  vec3 linear = RayToLinear(light) * GetMapColor();
#ifdef LINEAR_COLOR
  return linear;
#else
  return RayFromLinear(linear);
#endif
}
#endif

#ifdef BRIGHT
const float BrightOffset = 5e-6; // of the depth buffer's range: some 80 of its steps
#endif

void main()
{
#ifdef CLIPPING_PLANES
  for (int i = 0; i < CLIPPING_PLANES; ++i)
  {
    if (dot(ClippingPlanesCC[i], vec4(pointCCVSOutput, 1.0)) < 0.0)
    {
      discard;
    }
  }
#endif
  vec4 color = colorVSOutput;
#ifdef BACK_COLORS
  color = gl_FrontFacing == (IsMirrored == 0) ? colorVSOutput : backColorVSOutput;
#endif
#ifdef COLOR_MAPS
  if (mapVSOutput >= 0.0)
  {
    color.rgb = color.a * ShowLight(color.rgb);
  }
#endif
#ifdef ALONE
  gl_FragData[0] = vec4(color.rgb, 1.0);
  gl_FragData[1] = vec4(2.0 * gl_FragCoord.z - 1.0); // z in DC
#else
  vec3 normal = cross(dFdx(pointCCVSOutput), dFdy(pointCCVSOutput));
  gl_FragData[0] = vec4(pointCCVSOutput, PackNormal(normal));
  gl_FragData[1] = color;
#endif
#ifdef BRIGHT
  // Where what is bright touches the back of something dark, as a lamp does the roof above it, both
  // are as deep, and a single ray that met the former would make the pixel white.
  bool isBright = max(color.r, max(color.g, color.b)) > 1.0;
  gl_FragDepth = gl_FragCoord.z + (isBright ? BrightOffset : 0.0);
#endif
}
