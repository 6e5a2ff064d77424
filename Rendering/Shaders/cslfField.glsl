// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The field's samples: the twin of Module/cslfLayout.cxx and of the readers in cslfLookup.cxx.
// A layer of the textures holds SlicesPerLayer slices, one above the other.

uniform sampler2DArray ColorTexture; // linear filter
uniform sampler2DArray DepthTexture; // nearest filter
uniform sampler2D NodeTexture;       // per cell of the base grid: index, lower, upper coordinate
uniform vec2 LayerSize;              // in texels
uniform int SlicesPerLayer;
uniform int Viewpoints;              // M
uniform int BaseNodes;               // M0
uniform int Resolution;              // N
uniform bool HasDepth;
uniform vec3 SceneMinimum;           // CC
uniform vec3 SceneMaximum;           // CC

const float LeastDepth = 1.0 / 4096.0;
const float SurfaceStep = 0.1;

struct NodeBracket
{
  int Lower;
  float LowerCoordinate;
  float UpperCoordinate;
  float Weight;
};

int TileOf(int entryFace, int exitFace)
{
  return exitFace < entryFace ? exitFace : exitFace - 1;
}

int ExitFaceOf(int entryFace, int tile)
{
  return tile < entryFace ? tile : tile + 1;
}

// Within the entry face, whose slices a texture holds.
int SliceOf(int i, int j)
{
  return j * Viewpoints + i;
}

NodeBracket FindNodes(float coordinate)
{
  float node = 0.5 * (clamp(coordinate, -1.0, 1.0) + 1.0) * float(BaseNodes - 1);
  int cell = min(int(node), BaseNodes - 2);
  vec3 stored = texelFetch(NodeTexture, ivec2(cell, 0), 0).xyz;
  NodeBracket bracket;
  bracket.Lower = int(stored.x + 0.5);
  bracket.LowerCoordinate = stored.y;
  bracket.UpperCoordinate = stored.z;
  bracket.Weight =
    clamp((coordinate - stored.y) / (stored.z - stored.y), 0.0, 1.0);
  return bracket;
}

// From texels of a tile to texels of the layer.
vec2 TileCorner(int slice, int tile)
{
  return vec2(tile * Resolution, slice % SlicesPerLayer * Resolution);
}

vec2 TexelPosition(vec2 coordinates)
{
  return 0.5 * (coordinates + 1.0) * float(Resolution);
}

vec4 ReadNearestColor(int slice, int tile, vec2 coordinates)
{
  vec2 texel = clamp(floor(TexelPosition(coordinates)), 0.0, float(Resolution - 1));
  ivec3 address =
    ivec3(ivec2(TileCorner(slice, tile) + texel), slice / SlicesPerLayer);
  return texelFetch(ColorTexture, address, 0);
}

vec4 ReadColor(int slice, int tile, vec2 coordinates)
{
  vec2 position = clamp(TexelPosition(coordinates), 0.5, float(Resolution) - 0.5);
  return textureLod(ColorTexture,
    vec3((TileCorner(slice, tile) + position) / LayerSize, float(slice / SlicesPerLayer)), 0.0);
}

float ReadNearestInverseDepth(int slice, int tile, vec2 coordinates)
{
  vec2 texel = clamp(floor(TexelPosition(coordinates)), 0.0, float(Resolution - 1));
  ivec3 address =
    ivec3(ivec2(TileCorner(slice, tile) + texel), slice / SlicesPerLayer);
  return 1.0 / max(texelFetch(DepthTexture, address, 0).r, LeastDepth);
}

// Within one surface interpolated, which is exact for planes; across an edge the nearer surface's.
float ReadInverseDepth(int slice, int tile, vec2 coordinates)
{
  vec2 position = clamp(TexelPosition(coordinates) - 0.5, 0.0, float(Resolution - 1));
  vec2 base = max(min(floor(position), float(Resolution - 2)), 0.0);
  vec2 weight = position - base;
#ifdef GL_ARB_texture_gather
  vec4 depth = textureGather(DepthTexture,
    vec3((TileCorner(slice, tile) + base + 1.0) / LayerSize, float(slice / SlicesPerLayer)));
#else
  ivec3 address = ivec3(ivec2(TileCorner(slice, tile) + base), slice / SlicesPerLayer);
  vec4 depth = vec4(texelFetch(DepthTexture, address + ivec3(0, 1, 0), 0).r,
    texelFetch(DepthTexture, address + ivec3(1, 1, 0), 0).r,
    texelFetch(DepthTexture, address + ivec3(1, 0, 0), 0).r,
    texelFetch(DepthTexture, address, 0).r);
#endif
  vec4 inverse = 1.0 / max(depth, LeastDepth);
  float least = min(min(inverse.x, inverse.y), min(inverse.z, inverse.w));
  float most = max(max(inverse.x, inverse.y), max(inverse.z, inverse.w));
  if (most - least > SurfaceStep * most)
  {
    return most;
  }
  return mix(
    mix(inverse.w, inverse.z, weight.x), mix(inverse.x, inverse.y, weight.x), weight.y);
}
