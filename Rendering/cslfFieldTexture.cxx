// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldTexture.h"

#include "cslfOpenGL.h"
#include "cslfSceneGrid.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkShaderProgram.h>
#include <vtkTextureUnitManager.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

namespace cslf
{
namespace
{
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

GLuint CreateTexture(GLenum target, GLenum filter)
{
  GLuint handle = 0;
  glGenTextures(1, &handle);
  glBindTexture(target, handle);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
  return handle;
}

/// The targets of the textures, in the order of the units.
constexpr std::array<GLenum, 4> Targets{ GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D,
  GL_TEXTURE_3D };
}

bool FieldTexture::ChooseLayers(std::string& error)
{
  GLint mostTexels = 0;
  GLint mostLayers = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostTexels);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &mostLayers);
  const Layout& grid = this->Field.Grid;
  const int slices = grid.GetViewpoints() * grid.GetViewpoints();
  this->SlicesPerLayer = (slices + mostLayers - 1) / mostLayers;
  this->Layers = (slices + this->SlicesPerLayer - 1) / this->SlicesPerLayer;
  if (grid.GetStripWidth() > mostTexels || this->SlicesPerLayer * grid.GetResolution() > mostTexels)
  {
    error = "The field's resolution is too large for this graphics driver's textures.";
    return false;
  }
  return true;
}

void FieldTexture::UploadFace(int face, vtkImageData* image)
{
  const Layout& grid = this->Field.Grid;
  const int slices = grid.GetViewpoints() * grid.GetViewpoints();
  const int width = grid.GetStripWidth();
  const int height = grid.GetResolution();
  const auto upload = [&](const Channel* channel, const Format& format, GLenum filter) -> Handle
  {
    const Handle handle = CreateTexture(GL_TEXTURE_2D_ARRAY, filter);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, format.Internal, width, height * this->SlicesPerLayer,
      this->Layers, 0, format.Components, format.Type, nullptr);
    this->Bytes +=
      std::int64_t{ width } * height * this->SlicesPerLayer * this->Layers * format.Bytes;
    vtkDataArray* array = image->GetPointData()->GetArray(channel->Name.c_str());
    for (int i = 0; i < slices; ++i)
    {
      const vtkIdType texel = static_cast<vtkIdType>(face * slices + i) * width * height;
      glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, i % this->SlicesPerLayer * height,
        i / this->SlicesPerLayer, width, height, 1, format.Components, format.Type,
        array->GetVoidPointer(texel * channel->Components));
    }
    return handle;
  };
  const Channel* color = this->Field.FindChannel(ColorName);
  this->Colors[face] = upload(color, ColorFormat(*color), GL_LINEAR);
  if (const Channel* depth = this->Field.FindChannel(DepthName))
  {
    this->Depths[face] = upload(depth, DepthFormat(*depth), GL_NEAREST);
  }
}

void FieldTexture::UploadNodes()
{
  const Layout& grid = this->Field.Grid;
  const int cells = grid.GetBaseNodes() - 1;
  std::vector<float> texels;
  for (int cell = 0; cell < cells; ++cell)
  {
    const NodeBracket bracket = grid.FindNodes(-1.0 + 2.0 * (cell + 0.5) / cells);
    texels.push_back(static_cast<float>(bracket.Lower));
    texels.push_back(static_cast<float>(grid.NodeCoordinate(bracket.Lower)));
    texels.push_back(static_cast<float>(grid.NodeCoordinate(bracket.Upper)));
  }
  this->Nodes = CreateTexture(GL_TEXTURE_2D, GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, cells, 1, 0, GL_RGB, GL_FLOAT, texels.data());
}

void FieldTexture::UploadSceneGrid(vtkImageData* image)
{
  std::vector<int> slices(this->Field.Grid.GetSlices());
  std::iota(slices.begin(), slices.end(), 0);
  const SceneGrid grid(this->Field, image, slices);
  this->SceneMinimum = glm::vec3(grid.GetMinimum());
  this->SceneMaximum = glm::vec3(grid.GetMaximum());
  this->Grid = CreateTexture(GL_TEXTURE_3D, GL_NEAREST);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R8, SceneGrid::Cells, SceneGrid::Cells, SceneGrid::Cells, 0,
    GL_RED, GL_UNSIGNED_BYTE, grid.GetRings().data());
}

bool FieldTexture::Upload(vtkOpenGLRenderWindow* window, const Description& description,
  vtkImageData* image, std::string& error)
{
  if (this->Window)
  {
    vtkOpenGLRenderWindow* previous = this->Window;
    previous->MakeCurrent();
    this->Free();
    window->MakeCurrent();
  }
  this->Field = description;
  ++this->Uploads;
  if (!this->ChooseLayers(error))
  {
    return false;
  }
  while (glGetError() != GL_NO_ERROR)
  {
  }
  vtkOpenGLState::ScopedglActiveTexture activeTexture(window->GetState());
  const int unit = window->GetTextureUnitManager()->Allocate();
  window->GetState()->vtkglActiveTexture(GL_TEXTURE0 + unit);
  GLint alignment = 4;
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (int face = 0; face < FaceCount; ++face)
  {
    this->UploadFace(face, image);
  }
  this->UploadNodes();
  this->UploadSceneGrid(image);
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
  for (const GLenum target : Targets)
  {
    glBindTexture(target, 0);
  }
  window->GetTextureUnitManager()->Free(unit);
  if (glGetError() != GL_NO_ERROR)
  {
    this->Free();
    error = "The field does not fit the graphics driver's texture memory.";
    return false;
  }
  this->Window = window;
  this->Valid = true;
  return true;
}

void FieldTexture::Activate(int entryFace)
{
  vtkOpenGLState* state = this->Window->GetState();
  const std::array<Handle, 4> handles{ this->Colors[entryFace], this->Depths[entryFace],
    this->Nodes, this->Grid };
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    if (this->Units[i] < 0)
    {
      this->Units[i] = this->Window->GetTextureUnitManager()->Allocate();
    }
    state->vtkglActiveTexture(GL_TEXTURE0 + this->Units[i]);
    glBindTexture(Targets[i], handles[i]);
  }
}

void FieldTexture::Deactivate()
{
  vtkOpenGLState* state = this->Window->GetState();
  for (std::size_t i = 0; i < this->Units.size(); ++i)
  {
    if (this->Units[i] >= 0)
    {
      state->vtkglActiveTexture(GL_TEXTURE0 + this->Units[i]);
      glBindTexture(Targets[i], 0);
      this->Window->GetTextureUnitManager()->Free(this->Units[i]);
      this->Units[i] = -1;
    }
  }
}

void FieldTexture::SetUniforms(vtkShaderProgram* program) const
{
  const Layout& grid = this->Field.Grid;
  program->SetUniformi("ColorTexture", this->Units[0]);
  program->SetUniformi("DepthTexture", this->Units[1]);
  program->SetUniformi("NodeTexture", this->Units[2]);
  program->SetUniformi("SceneGridTexture", this->Units[3]);
  program->SetUniformf("SlicesPerLayer", static_cast<float>(this->SlicesPerLayer));
  program->SetUniformf("Viewpoints", static_cast<float>(grid.GetViewpoints()));
  program->SetUniformf("BaseNodes", static_cast<float>(grid.GetBaseNodes()));
  program->SetUniformf("Resolution", static_cast<float>(grid.GetResolution()));
  const float inverseLayerSize[2] = { 1.0f / static_cast<float>(grid.GetStripWidth()),
    1.0f / static_cast<float>(grid.GetResolution() * this->SlicesPerLayer) };
  program->SetUniform2f("InverseLayerSize", inverseLayerSize);
  program->SetUniform3f("SceneMinimum", &this->SceneMinimum.x);
  program->SetUniform3f("SceneMaximum", &this->SceneMaximum.x);
}

void FieldTexture::Free()
{
  glDeleteTextures(static_cast<GLsizei>(this->Colors.size()), this->Colors.data());
  glDeleteTextures(static_cast<GLsizei>(this->Depths.size()), this->Depths.data());
  glDeleteTextures(1, &this->Nodes);
  glDeleteTextures(1, &this->Grid);
  this->Colors.fill(0);
  this->Depths.fill(0);
  this->Nodes = 0;
  this->Grid = 0;
  this->Bytes = 0;
  this->Window = nullptr;
  this->Valid = false;
}

void FieldTexture::Release(vtkWindow* window)
{
  if (this->Window && this->Window == window)
  {
    this->Window->MakeCurrent();
    this->Free();
  }
}
}
