// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Encoded colours of rays, which may be brighter than white, as in Module/cslfColor.h.

// SRGBToLinear by polynomials, because each ray is converted, and powers would take a third of the
// time of a picture. They were fitted to the least maximum error: 1/80 of a step of 8 bits below 1,
// and 0.3 % of the light from 1 to 6.
vec3 RayToLinear(vec3 encoded)
{
  vec3 middle = 0.00091689 + encoded * (0.03274608 + encoded * (0.51938206 +
    encoded * (0.66716010 + encoded * (-0.30737669 + encoded * 0.08728190))));
  vec3 above = encoded - 1.0;
  vec3 bright = 1.0 + above * (2.23753 + above * (1.61821 + above * 0.11029));
  return mix(mix(encoded / 12.92, middle, step(vec3(0.04045), encoded)), bright,
    step(vec3(1.0), encoded));
}

// EncodeLight, the opposite.
vec3 RayFromLinear(vec3 linear)
{
  return mix(12.92 * linear, 1.055 * pow(max(linear, 0.0), vec3(1.0 / 2.4)) - 0.055,
    step(vec3(0.0031308), linear));
}
