// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTilePool.h"

#include "cslfOpenGL.h"

#include <vtkDataArray.h>

#include <algorithm>
#include <vector>

namespace cslf
{
namespace
{
/// The corners of a cell.
constexpr int LeastSlots = 4;

struct Format
{
  GLint Internal;
  GLenum Components;
  GLenum Type;
  int Bytes; ///< of a texel in graphics memory
};

Format ColorFormat(const Channel& channel)
{
  return channel.Type == VTK_UNSIGNED_CHAR ? Format{ GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4 }
                                           : Format{ GL_RGBA16F, GL_RGBA, GL_FLOAT, 8 };
}

Format DepthFormat(const Channel& channel)
{
  return channel.Type == VTK_UNSIGNED_SHORT ? Format{ GL_R16, GL_RED, GL_UNSIGNED_SHORT, 2 }
                                            : Format{ GL_R32F, GL_RED, GL_FLOAT, 4 };
}

std::int64_t CountTileBytes(const Description& field)
{
  const Channel* depth = field.FindChannel(DepthName);
  const int texel =
    ColorFormat(*field.FindChannel(ColorName)).Bytes + (depth ? DepthFormat(*depth).Bytes : 0);
  return std::int64_t{ texel } * field.Grid.GetResolution() * field.Grid.GetResolution();
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
  this->Field = field;
  this->Blocks = blocks;
  int slots = mostSlots;
  while (slots > LeastSlots && !(this->ChooseLayers(slots) && this->CountBytes() <= limit))
  {
    --slots;
  }
  while (slots >= LeastSlots && this->ChooseLayers(slots))
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

std::int64_t TilePool::CountBytes() const
{
  return CountTileBytes(this->Field) * this->TilesPerLayer *
    (1 + this->Blocks * this->LayersPerBlock);
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
  this->Color = CreateTexture(
    ColorFormat(*this->Field.FindChannel(ColorName)), GL_LINEAR, side, height, layers);
  if (const Channel* depth = this->Field.FindChannel(DepthName))
  {
    this->Depth = CreateTexture(DepthFormat(*depth), GL_NEAREST, side, height, layers);
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
  const Channel* channels[] = { this->Field.FindChannel(ColorName),
    this->Field.FindChannel(DepthName) };
  this->BeginUploads();
  glPixelStorei(GL_UNPACK_ROW_LENGTH, side);
  for (const Channel* channel : channels)
  {
    if (channel)
    {
      const bool isColor = channel == channels[0];
      const Format format = isColor ? ColorFormat(*channel) : DepthFormat(*channel);
      glBindTexture(GL_TEXTURE_2D_ARRAY, isColor ? this->Color : this->Depth);
      glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, side, height, 1, format.Components,
        format.Type, zeros.data());
    }
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
  const auto upload = [&](Handle handle, const Format& format, vtkDataArray* array)
  {
    const vtkIdType first = (samples.First + tile * side) * array->GetNumberOfComponents();
    glBindTexture(GL_TEXTURE_2D_ARRAY, handle);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, row, layer, side, side, 1, format.Components,
      format.Type, array->GetVoidPointer(first));
  };
  upload(this->Color, ColorFormat(*this->Field.FindChannel(ColorName)), samples.Color);
  if (this->Depth)
  {
    upload(this->Depth, DepthFormat(*this->Field.FindChannel(DepthName)), samples.Depth);
  }
}

void TilePool::EndUploads()
{
  glPixelStorei(GL_UNPACK_ALIGNMENT, this->Alignment);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, this->RowLength);
}

void TilePool::Free()
{
  glDeleteTextures(1, &this->Color);
  glDeleteTextures(1, &this->Depth);
  this->Color = 0;
  this->Depth = 0;
  this->Bytes = 0;
}
}
