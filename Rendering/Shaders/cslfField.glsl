// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The field's samples: the twin of Module/cslfLayout.cxx and of the readers in cslfLookup.cxx.
// A layer of the textures holds SlicesPerLayer slices, one above the other.

uniform sampler2DArray ColorTexture; // linear filter
uniform sampler2DArray DepthTexture; // nearest filter
uniform sampler2D NodeTexture;       // per cell of the base grid: index, lower, upper coordinate
uniform float SlicesPerLayer;
uniform float Viewpoints;            // M
uniform float BaseNodes;             // M0
uniform float Resolution;            // N
uniform vec2 InverseLayerSize;       // of a texel in a layer

const float LeastDepth = 1.0 / 4096.0;
const float SurfaceStep = 0.1;

struct NodeBracket
{
  float Lower;
  float LowerCoordinate;
  float UpperCoordinate;
  float Weight;
};

// Where a slice lies in the textures.
struct SlicePlace
{
  float Layer;
  float Row; // in slices
};

NodeBracket FindNodes(float coordinate)
{
  float node = 0.5 * (coordinate + 1.0) * (BaseNodes - 1.0);
  int cell = int(min(node, BaseNodes - 1.5));
  vec3 stored = texelFetch(NodeTexture, ivec2(cell, 0), 0).xyz;
  NodeBracket bracket;
  bracket.Lower = stored.x;
  bracket.LowerCoordinate = stored.y;
  bracket.UpperCoordinate = stored.z;
  bracket.Weight = clamp((coordinate - stored.y) / (stored.z - stored.y), 0.0, 1.0);
  return bracket;
}

// Within the entry face, whose slices a texture holds.
SlicePlace FindSlice(float i, float j)
{
  float slice = j * Viewpoints + i;
  SlicePlace place;
  place.Layer = floor((slice + 0.5) / SlicesPerLayer);
  place.Row = slice - place.Layer * SlicesPerLayer;
  return place;
}

// In texels of a tile.
vec2 TexelPosition(vec2 coordinates)
{
  return 0.5 * (coordinates + 1.0) * Resolution;
}

// Texture coordinates of a position in a tile.
vec3 TextureCoordinates(SlicePlace slice, float tile, vec2 position)
{
  return vec3((vec2(tile, slice.Row) * Resolution + position) * InverseLayerSize, slice.Layer);
}

ivec3 NearestTexel(SlicePlace slice, float tile, vec2 coordinates)
{
  vec2 texel = clamp(floor(TexelPosition(coordinates)), 0.0, Resolution - 1.0);
  return ivec3(vec3(vec2(tile, slice.Row) * Resolution + texel, slice.Layer) + 0.5);
}

vec4 ReadNearestColor(SlicePlace slice, float tile, vec2 coordinates)
{
  return texelFetch(ColorTexture, NearestTexel(slice, tile, coordinates), 0);
}

vec4 ReadColor(SlicePlace slice, float tile, vec2 coordinates)
{
  vec2 position = clamp(TexelPosition(coordinates), 0.5, Resolution - 0.5);
  return textureLod(ColorTexture, TextureCoordinates(slice, tile, position), 0.0);
}

float ReadNearestDepth(SlicePlace slice, float tile, vec2 coordinates)
{
  return texelFetch(DepthTexture, NearestTexel(slice, tile, coordinates), 0).r;
}

// Within one surface interpolated, which is exact for planes; across an edge the nearer surface's.
float ReadInverseDepth(SlicePlace slice, float tile, vec2 coordinates)
{
  vec2 position = TexelPosition(coordinates) - 0.5;
  vec2 base = clamp(floor(position), 0.0, max(Resolution - 2.0, 0.0));
  vec2 weight = clamp(position - base, 0.0, 1.0);
#ifdef GL_ARB_texture_gather
  vec4 depth = textureGather(DepthTexture, TextureCoordinates(slice, tile, base + 1.0));
#else
  ivec3 address = ivec3(vec3(vec2(tile, slice.Row) * Resolution + base, slice.Layer) + 0.5);
  vec4 depth = vec4(texelFetch(DepthTexture, address + ivec3(0, 1, 0), 0).r,
    texelFetch(DepthTexture, address + ivec3(1, 1, 0), 0).r,
    texelFetch(DepthTexture, address + ivec3(1, 0, 0), 0).r,
    texelFetch(DepthTexture, address, 0).r);
#endif
  vec4 inverse = 1.0 / max(depth, LeastDepth);
  float least = min(min(inverse.x, inverse.y), min(inverse.z, inverse.w));
  float most = max(max(inverse.x, inverse.y), max(inverse.z, inverse.w));
  float between = mix(
    mix(inverse.w, inverse.z, weight.x), mix(inverse.x, inverse.y, weight.x), weight.y);
  return most - least > SurfaceStep * most ? most : between;
}
