// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Where the field's samples are, and their depth, as in cslfChannelReader.cxx and the readers in
// cslfLookup.cxx. A layer of the textures contains TilesPerLayer tiles, one above the other.

uniform sampler2DArray DepthTexture; // with nearest filter
uniform sampler2D CellTexture;       // two texels for each cell of the base grid: Residency::Table
uniform float TilesPerLayer;
uniform float BaseNodes;             // M0
uniform float Resolution;            // N
uniform vec2 InverseLayerSize;       // of a texel in a layer

// Where the tiles of the opposite face, and of those towards +x, -x and +y, -y, are stored: the
// first layers of their blocks, or numbers far below 0 if they are not stored.
uniform float OppositeBlock;
uniform vec2 SideXBlocks;
uniform vec2 SideYBlocks;

// The viewpoints around a coordinate: at the lower corner, at upper u, at upper v and at both.
struct Cell
{
  vec4 Slots;
  vec2 Lower;  // their coordinates
  vec2 Upper;
};

// The place of a viewpoint's tiles within a block.
struct SlicePlace
{
  float Layer;
  float Row; // in tiles
};

// A place in the samples of a viewpoint: a tile, by its block, and (s,t).
struct Place
{
  SlicePlace Slice;
  float Block;
  vec2 Coordinates;
};

Cell FindCell(vec2 coordinates)
{
  vec2 node = 0.5 * (coordinates + 1.0) * (BaseNodes - 1.0);
  ivec2 texel = ivec2(2, 1) * ivec2(min(node, vec2(BaseNodes - 1.5)));
  vec4 corners = texelFetch(CellTexture, texel + ivec2(1, 0), 0);
  Cell cell;
  cell.Slots = texelFetch(CellTexture, texel, 0);
  cell.Lower = corners.xy;
  cell.Upper = corners.zw;
  return cell;
}

SlicePlace FindSlice(float slot)
{
  SlicePlace place;
  place.Layer = floor((slot + 0.5) / TilesPerLayer);
  place.Row = slot - place.Layer * TilesPerLayer;
  return place;
}

// 1 if a place's tile is stored. Otherwise its layer is negative, which is read as layer 0: colour
// and depth are 0, so that the view sees nothing.
float IsKept(Place place)
{
  return step(0.0, place.Slice.Layer + place.Block);
}

// Position in a tile, in texels.
vec2 TexelPosition(Place place)
{
  return 0.5 * (place.Coordinates + 1.0) * Resolution;
}

// Texture coordinates of a position in a place's tile.
vec3 TextureCoordinates(Place place, vec2 position)
{
  vec2 inLayer = vec2(position.x, place.Slice.Row * Resolution + position.y);
  return vec3(inLayer * InverseLayerSize, max(place.Slice.Layer + place.Block, 0.0));
}

// The texel of a position in a place's tile, for texelFetch.
ivec3 TexelAddress(Place place, vec2 texel)
{
  return ivec3(vec3(texel.x, place.Slice.Row * Resolution + texel.y,
                 max(place.Slice.Layer + place.Block, 0.0)) + 0.5);
}

ivec3 NearestTexel(Place place)
{
  return TexelAddress(place, clamp(floor(TexelPosition(place)), 0.0, Resolution - 1.0));
}

float ReadNearestDepth(Place place)
{
  return texelFetch(DepthTexture, NearestTexel(place), 0).r;
}

// At four texels from `base` on: 01, 11, 10 and 00, in the order of textureGather.
vec4 GatherInverseDepths(Place place, vec2 base)
{
#ifdef GL_ARB_texture_gather
  vec4 depth = textureGather(DepthTexture, TextureCoordinates(place, base + 1.0));
#else
  ivec3 address = TexelAddress(place, base);
  vec4 depth = vec4(texelFetch(DepthTexture, address + ivec3(0, 1, 0), 0).r,
    texelFetch(DepthTexture, address + ivec3(1, 1, 0), 0).r,
    texelFetch(DepthTexture, address + ivec3(1, 0, 0), 0).r,
    texelFetch(DepthTexture, address, 0).r);
#endif
  return 1.0 / max(depth, MinimumDepth);
}

// The inverse depths of the four texels around a place, in the order of GatherInverseDepths, the
// largest of them, and whether they are not on one surface.
vec4 FetchCorners(Place place, out vec2 weight, out float most, out bool isEdge)
{
  vec2 position = TexelPosition(place) - 0.5;
  vec2 base = clamp(floor(position), 0.0, max(Resolution - 2.0, 0.0));
  weight = clamp(position - base, 0.0, 1.0);
  vec4 inverse = GatherInverseDepths(place, base);
  float least = min(min(inverse.x, inverse.y), min(inverse.z, inverse.w));
  most = max(max(inverse.x, inverse.y), max(inverse.z, inverse.w));
  isEdge = most - least > SurfaceStep * most;
  return inverse;
}

// Within one surface, interpolates, which is exact for planes. Across an edge, takes the nearer
// surface.
float ReadInverseDepth(Place place)
{
  vec2 weight;
  float most;
  bool isEdge;
  vec4 inverse = FetchCorners(place, weight, most, isEdge);
  float between = mix(
    mix(inverse.w, inverse.z, weight.x), mix(inverse.x, inverse.y, weight.x), weight.y);
  return isEdge ? most : between;
}

// How much the inverse depth of a surface changes with the coordinates; 0 across an edge.
vec2 ReadSlope(Place place)
{
  vec2 weight;
  float most;
  bool isEdge;
  vec4 inverse = FetchCorners(place, weight, most, isEdge);
  vec2 slope = vec2(inverse.z - inverse.w + inverse.y - inverse.x,
    inverse.x - inverse.w + inverse.y - inverse.z);
  return isEdge ? vec2(0.0) : 0.25 * Resolution * slope;
}
