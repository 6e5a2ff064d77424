// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The colour at the places that a lookup returns, as in cslfChannelReader.cxx.

uniform sampler2DArray ColorTexture; // with linear filter

vec4 ReadNearestColor(Place place)
{
  return texelFetch(ColorTexture, NearestTexel(place), 0);
}

vec4 ReadColor(Place place)
{
  vec2 position = clamp(TexelPosition(place), 0.5, Resolution - 0.5);
  return textureLod(ColorTexture, TextureCoordinates(place, position), 0.0);
}

vec4 ReadColor(Place place, bool isNearest)
{
  return isNearest ? ReadNearestColor(place) : ReadColor(place);
}

// The mean of what the views see, over those that see anything. With associated alpha.
vec4 BlendColor(LookupResult result)
{
  vec4 weights = result.Weights *
    vec4(IsKept(result.Place00), IsKept(result.Place10), IsKept(result.Place01),
      IsKept(result.Place11));
  vec4 color = weights.x * ReadColor(result.Place00, result.IsNearest) +
    weights.y * ReadColor(result.Place10, result.IsNearest) +
    weights.z * ReadColor(result.Place01, result.IsNearest) +
    weights.w * ReadColor(result.Place11, result.IsNearest);
  return color / max(weights.x + weights.y + weights.z + weights.w, MinimumWeight);
}
