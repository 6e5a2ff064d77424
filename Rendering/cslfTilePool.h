// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The graphics memory for tiles of a light field.
 */
#ifndef cslfTilePool_h
#define cslfTilePool_h

#include "Pipeline/cslfFieldStore.h"
#include "cslfDescription.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cslf
{
/// An array texture of colour and one of depth. A layer contains one or more tiles, one above the
/// other, because drivers limit the number of layers (2048 is usual) more than their size. The
/// first layer is empty: colour and depth are 0. Then follow the blocks of Residency, each in its
/// own layers. All calls need the window's context.
class TilePool
{
public:
  using Handle = unsigned int;

  TilePool() = default;
  ~TilePool() = default;
  TilePool(const TilePool&) = delete;
  TilePool& operator=(const TilePool&) = delete;

  /// Allocates `blocks` blocks of up to `mostSlots` slots: as many as fit into `limit` bytes and
  /// the driver's memory, but at least 4. False if these do not fit in the driver's memory.
  bool Create(const Description& field, int blocks, int mostSlots, std::int64_t limit);
  void Free();

  /// The bytes that so many blocks of so many slots would take; the greatest number if the driver
  /// has no textures of that size.
  static std::int64_t CountBytes(const Description& field, int blocks, int slots);

  bool IsCreated() const { return this->GetTexture(KnownChannel::Color) != 0; }
  int GetBlocks() const { return this->Blocks; }
  int GetSlots() const { return this->Slots; }
  int GetTilesPerLayer() const { return this->TilesPerLayer; }
  std::int64_t GetBytes() const { return this->Bytes; }

  /// The texture of a channel, or 0 if the field does not have it.
  Handle GetTexture(ChannelId id) const { return this->Textures[id.GetPlace()]; }

  /// The first layer of a block.
  int GetFirstLayer(int block) const { return 1 + block * this->LayersPerBlock; }

  /// Copies tiles to a slot. Call it only between BeginUploads and EndUploads.
  void BeginUploads();
  void Upload(const ViewpointSamples& samples, int tile, int block, int slot);
  void EndUploads();

private:
  Handle& TextureOf(ChannelId id) { return this->Textures[id.GetPlace()]; }
  void SetField(const Description& field, int blocks);
  bool ChooseLayers(int slots);
  std::int64_t CountBytes() const;
  bool Allocate();
  void ClearFirstLayer();

  Description Field; ///< with its known channels only
  int Blocks = 0;
  int Slots = 0;
  int TilesPerLayer = 1;
  int LayersPerBlock = 0;
  std::int64_t Bytes = 0;
  std::array<Handle, ChannelIdCount> Textures{};
  int Alignment = 4;
  int RowLength = 0;
};
}

#endif
