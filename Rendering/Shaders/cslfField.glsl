// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// The field's samples: the twin of Module/cslfLayout.cxx and of the readers in cslfLookup.cxx.
// A layer of the textures holds SlicesPerLayer slices, one above the other.

uniform sampler2DArray ColorTexture; // linear filter
uniform sampler2DArray DepthTexture; // nearest filter
uniform sampler2D CellTexture;       // two texels for each cell of the base grid, see Residency
uniform float TileLayers[5];         // the first layer of each tile's block
uniform float TilesPerLayer;
uniform int BaseNodes;               // M0
uniform float Resolution;            // N
uniform bool HasDepth;
uniform vec3 SceneMinimum;           // CC
uniform vec3 SceneMaximum;           // CC

const float LeastDepth = 1.0 / 4096.0;
const float SurfaceStep = 0.1;

// The viewpoints around a coordinate: at the lower corner, at upper u, at upper v and at both.
struct Cell
{
  vec4 Slots;
  vec2 Lower;  // their coordinates
  vec2 Upper;
  vec2 Weight; // of the upper ones
};

int TileOf(int entryFace, int exitFace)
{
  return exitFace < entryFace ? exitFace : exitFace - 1;
}

int ExitFaceOf(int entryFace, int tile)
{
  return tile < entryFace ? tile : tile + 1;
}

Cell FindCell(vec2 coordinates)
{
  vec2 node = 0.5 * (clamp(coordinates, -1.0, 1.0) + 1.0) * float(BaseNodes - 1);
  ivec2 texel = min(ivec2(node), BaseNodes - 2) * ivec2(2, 1);
  vec4 corners = texelFetch(CellTexture, texel + ivec2(1, 0), 0);
  Cell cell;
  cell.Slots = texelFetch(CellTexture, texel, 0);
  cell.Lower = corners.xy;
  cell.Upper = corners.zw;
  cell.Weight = clamp((coordinates - cell.Lower) / (cell.Upper - cell.Lower), 0.0, 1.0);
  return cell;
}

// Where a slot's tile begins: the row, in tiles, and the layer. What is not there is in layers below
// 0, which samplers take for layer 0, where colour and depth are 0: hidden from the view.
vec2 FindTile(float slot, int tile)
{
  float layer = floor((slot + 0.5) / TilesPerLayer);
  return vec2(slot - layer * TilesPerLayer, max(layer + TileLayers[tile], 0.0));
}

vec2 TexelPosition(vec2 coordinates)
{
  return 0.5 * (coordinates + 1.0) * Resolution;
}

// Texture coordinates of a position in a tile, in texels.
vec3 TextureCoordinates(float slot, int tile, vec2 position)
{
  vec2 place = FindTile(slot, tile);
  vec2 texel = position / Resolution;
  return vec3(texel.x, (place.x + texel.y) / TilesPerLayer, place.y);
}

vec4 ReadNearestColor(float slot, int tile, vec2 coordinates)
{
  vec2 texel = clamp(floor(TexelPosition(coordinates)), 0.0, Resolution - 1.0);
  vec2 place = FindTile(slot, tile);
  ivec3 address = ivec3(ivec2(texel + vec2(0.0, place.x * Resolution)), int(place.y));
  return texelFetch(ColorTexture, address, 0);
}

vec4 ReadColor(float slot, int tile, vec2 coordinates)
{
  vec2 position = clamp(TexelPosition(coordinates), 0.5, Resolution - 0.5);
  return textureLod(ColorTexture, TextureCoordinates(slot, tile, position), 0.0);
}

float ReadNearestInverseDepth(float slot, int tile, vec2 coordinates)
{
  vec2 texel = clamp(floor(TexelPosition(coordinates)), 0.0, Resolution - 1.0);
  vec2 place = FindTile(slot, tile);
  ivec3 address = ivec3(ivec2(texel + vec2(0.0, place.x * Resolution)), int(place.y));
  return 1.0 / max(texelFetch(DepthTexture, address, 0).r, LeastDepth);
}

// Within one surface interpolated, which is exact for planes; across an edge the nearer surface's.
float ReadInverseDepth(float slot, int tile, vec2 coordinates)
{
  vec2 position = clamp(TexelPosition(coordinates) - 0.5, 0.0, Resolution - 1.0);
  vec2 base = max(min(floor(position), Resolution - 2.0), 0.0);
  vec2 weight = position - base;
#ifdef GL_ARB_texture_gather
  vec4 depth = textureGather(DepthTexture, TextureCoordinates(slot, tile, base + 1.0));
#else
  vec2 place = FindTile(slot, tile);
  ivec3 address = ivec3(ivec2(base + vec2(0.0, place.x * Resolution)), int(place.y));
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
