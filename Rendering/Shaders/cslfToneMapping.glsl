// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Converts radiance to colour, as in Rendering/vtkCSLFToneMapping.cxx, whose header explains the
// curves, and Module/cslfColor.h.

vec3 LinearToSRGB(vec3 linear)
{
  vec3 clamped = clamp(linear, 0.0, 1.0);
  return mix(12.92 * clamped, 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055,
    step(vec3(0.0031308), clamped));
}

vec3 SRGBToLinear(vec3 encoded)
{
  return mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)),
    step(vec3(0.04045), encoded));
}

#ifdef TONE_MAPPING
uniform float Exposure;

vec3 MapTone(vec3 radiance)
{
  vec3 exposed = Exposure * max(radiance, 0.0);
#if TONE_MAPPING == 1
  return exposed / (1.0 + dot(exposed, vec3(0.2126, 0.7152, 0.0722)));
#elif TONE_MAPPING == 2
  return exposed * (2.51 * exposed + 0.03) / (exposed * (2.43 * exposed + 0.59) + 0.14);
#else
  return exposed;
#endif
}
#endif
