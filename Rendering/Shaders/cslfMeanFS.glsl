//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Averages the rays of a pixel: colour and coverage by their mean, depth by the nearest. A picture
// that was drawn before, of other rays, counts, too.

// Options:
//   RAYS_PER_SIDE of a pixel
//   HAS_EARLIER   defined if there is such an earlier picture
//   LINEAR_COLOR  defined if the field holds linear values, otherwise sRGB-encoded ones
//CSLF::Options::Dec

//VTK::Output::Dec

uniform sampler2D RayColors;
uniform sampler2D RayDepths; // z in DC
#ifdef HAS_EARLIER
uniform sampler2D EarlierColors;
uniform sampler2D EarlierDepths;
uniform int EarlierSets; // of as many rays for each pixel, that the earlier picture is the mean of
#endif

//CSLF::Constants::Dec
//CSLF::ToneMapping::Dec
//CSLF::Encoding::Dec

// A pixel is the mean of the light of its rays, with associated alpha.
#ifdef LINEAR_COLOR
vec4 ToLight(vec4 color)
{
  return color;
}

vec4 FromLight(vec4 light)
{
  return light;
}
#else
vec4 ToLight(vec4 color)
{
  return vec4(color.a * RayToLinear(color.rgb / max(color.a, 0.001)), color.a);
}

vec4 FromLight(vec4 light)
{
  return vec4(light.a * LinearToSRGB(light.rgb / max(light.a, 0.001)), light.a);
}
#endif

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 first = pixel * RAYS_PER_SIDE;
  vec4 sum = vec4(0.0);
  float z = MissDC;
  for (int y = 0; y < RAYS_PER_SIDE; ++y)
  {
    for (int x = 0; x < RAYS_PER_SIDE; ++x)
    {
      sum += ToLight(texelFetch(RayColors, first + ivec2(x, y), 0));
      z = min(z, texelFetch(RayDepths, first + ivec2(x, y), 0).r);
    }
  }
  vec4 mean = sum / float(RAYS_PER_SIDE * RAYS_PER_SIDE);
#ifdef HAS_EARLIER
  vec4 earlier = ToLight(texelFetch(EarlierColors, pixel, 0));
  mean = mix(earlier, mean, 1.0 / float(EarlierSets + 1));
  z = min(z, texelFetch(EarlierDepths, pixel, 0).r);
#endif
  gl_FragData[0] = FromLight(mean);
  gl_FragData[1] = vec4(z);
}
