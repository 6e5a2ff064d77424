// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTilePool.h"

#include "cslfOpenGL.h"

#include <vtkDataArray.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace cslf
{
namespace
{
/// The corners of a cell.
constexpr int MinimumSlots = 4;

struct Format
{
  GLint Internal;
  GLenum Components;
  GLenum Type;
  int Bytes; ///< of a texel in graphics memory
};

/// The format of a known channel.
Format FormatOf(const Channel& channel)
{
  switch (FindForm(channel)->Kind)
  {
    case SampleKind::ByteColor:
      return { GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4 };
    case SampleKind::FloatColor:
      return { GL_RGBA16F, GL_RGBA, GL_FLOAT, 8 };
    case SampleKind::Number16:
      return { GL_R16, GL_RED, GL_UNSIGNED_SHORT, 2 };
    case SampleKind::FloatNumber:
      break;
  }
  return { GL_R32F, GL_RED, GL_FLOAT, 4 };
}

GLint GetLimit(GLenum name)
{
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLuint CreateTexture(const Format& format, GLenum filter, int width, int height, int layers)
{
  GLuint handle = 0;
  glGenTextures(1, &handle);
  glBindTexture(GL_TEXTURE_2D_ARRAY, handle);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, format.Internal, width, height, layers, 0, format.Components,
    format.Type, nullptr);
  return handle;
}
}

bool TilePool::Create(const Description& field, int blocks, int mostSlots, std::int64_t limit)
{
  this->Free();
  this->SetField(field, blocks);
  int slots = mostSlots;
  while (slots > MinimumSlots && !(this->ChooseLayers(slots) && this->CountBytes() <= limit))
  {
    --slots;
  }
  while (slots >= MinimumSlots && this->ChooseLayers(slots))
  {
    if (this->Allocate())
    {
      return true;
    }
    this->Free();
    slots = 3 * slots / 4;
  }
  return false;
}

void TilePool::SetField(const Description& field, int blocks)
{
  this->Field = field;
  this->Field.Channels.clear();
  for (const Channel& channel : field.Channels)
  {
    if (FindForm(channel))
    {
      this->Field.Channels.push_back(channel);
    }
  }
  this->Blocks = blocks;
}

std::int64_t TilePool::CountBytes(const Description& field, int blocks, int slots)
{
  TilePool pool;
  pool.SetField(field, blocks);
  return pool.ChooseLayers(slots) ? pool.CountBytes() : std::numeric_limits<std::int64_t>::max();
}

std::int64_t TilePool::CountBytes() const
{
  std::int64_t texel = 0;
  for (const Channel& channel : this->Field.Channels)
  {
    texel += FormatOf(channel).Bytes;
  }
  const int side = this->Field.Grid.GetResolution();
  return texel * side * side * this->TilesPerLayer * (1 + this->Blocks * this->LayersPerBlock);
}

bool TilePool::ChooseLayers(int slots)
{
  const int most = (GetLimit(GL_MAX_ARRAY_TEXTURE_LAYERS) - 1) / this->Blocks;
  const int side = this->Field.Grid.GetResolution();
  this->Slots = slots;
  this->TilesPerLayer = (slots + most - 1) / std::max(most, 1);
  this->LayersPerBlock = (slots + this->TilesPerLayer - 1) / this->TilesPerLayer;
  return most > 0 && side * this->TilesPerLayer <= GetLimit(GL_MAX_TEXTURE_SIZE);
}

bool TilePool::Allocate()
{
  while (glGetError() != GL_NO_ERROR)
  {
  }
  const int side = this->Field.Grid.GetResolution();
  const int height = side * this->TilesPerLayer;
  const int layers = 1 + this->Blocks * this->LayersPerBlock;
  for (const Channel& channel : this->Field.Channels)
  {
    const ChannelForm& form = *FindForm(channel);
    const GLenum filter = form.Interpolate == Interpolation::Linear ? GL_LINEAR : GL_NEAREST;
    this->TextureOf(*FindKnownChannel(channel.Name)) =
      CreateTexture(FormatOf(channel), filter, side, height, layers);
  }
  this->Bytes = this->CountBytes();
  this->ClearFirstLayer();
  glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
  return glGetError() == GL_NO_ERROR;
}

void TilePool::ClearFirstLayer()
{
  const int side = this->Field.Grid.GetResolution();
  const int height = side * this->TilesPerLayer;
  const std::vector<float> zeros(4 * static_cast<std::size_t>(side) * height, 0.0F);
  this->BeginUploads();
  glPixelStorei(GL_UNPACK_ROW_LENGTH, side);
  for (const Channel& channel : this->Field.Channels)
  {
    const Format& format = FormatOf(channel);
    glBindTexture(GL_TEXTURE_2D_ARRAY, this->TextureOf(*FindKnownChannel(channel.Name)));
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, side, height, 1, format.Components,
      format.Type, zeros.data());
  }
  this->EndUploads();
}

void TilePool::BeginUploads()
{
  this->Alignment = GetLimit(GL_UNPACK_ALIGNMENT);
  this->RowLength = GetLimit(GL_UNPACK_ROW_LENGTH);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, this->Field.Grid.GetStripWidth());
}

void TilePool::Upload(const ViewpointSamples& samples, int tile, int block, int slot)
{
  const int side = this->Field.Grid.GetResolution();
  const int row = slot % this->TilesPerLayer * side;
  const int layer = this->GetFirstLayer(block) + slot / this->TilesPerLayer;
  for (const Channel& channel : this->Field.Channels)
  {
    const ChannelId id = *FindKnownChannel(channel.Name);
    const Format& format = FormatOf(channel);
    vtkDataArray* array = samples.GetArray(id);
    const vtkIdType first = (samples.GetFirst() + tile * side) * array->GetNumberOfComponents();
    glBindTexture(GL_TEXTURE_2D_ARRAY, this->TextureOf(id));
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, row, layer, side, side, 1, format.Components,
      format.Type, array->GetVoidPointer(first));
  }
}

void TilePool::EndUploads()
{
  glPixelStorei(GL_UNPACK_ALIGNMENT, this->Alignment);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, this->RowLength);
}

void TilePool::Free()
{
  glDeleteTextures(static_cast<GLsizei>(this->Textures.size()), this->Textures.data());
  this->Textures.fill(0);
  this->Bytes = 0;
}
}
