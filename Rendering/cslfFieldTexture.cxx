// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldTexture.h"

#include "Lookup/cslfFaceSpace.h"
#include "cslfLayout.h"
#include "cslfOpenGL.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureUnitManager.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace cslf
{
namespace
{
/// Space for cameras that see more than one camera can from outside: for several of them, then for
/// all faces, as from inside the cube.
constexpr int AllBlocks = FaceCount * TileCount;
constexpr int BlockSteps[] = { Residency::MinimumBlocks, 18, AllBlocks };

/// The targets of the textures, in the order of the texture units.
constexpr GLenum Targets[] = { GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D,
  GL_TEXTURE_3D };

/// The number of viewpoints along a side of a face that is enough to find all surfaces.
constexpr int MaximumSceneNodes = 25;

/// Texels of a table per cell.
constexpr int TableTexels = 2;

std::vector<int> ListSlices(const std::vector<WantedTiles>& wanted)
{
  std::vector<int> slices;
  slices.reserve(wanted.size());
  for (const WantedTiles& tiles : wanted)
  {
    slices.push_back(tiles.Slice);
  }
  return slices;
}

void SetNearest(GLenum target)
{
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
}
}

void FieldTexture::SetStore(std::shared_ptr<FieldStore> store)
{
  this->Store = std::move(store);
  this->Present = Residency();
  this->Scene = SceneGrid(this->Store->GetDescription());
  this->IsSceneNew = true;
  this->OffSurfaces.reset();
  this->Surfaces.reset();
  this->HasLoaded = false;
  this->Damaged = 0;
  this->UploadedViewpoints = 0;
}

void FieldTexture::SetSurfaces(const std::shared_ptr<const SurfaceCells>& surfaces)
{
  if (this->Surfaces == surfaces)
  {
    return;
  }
  this->Surfaces = surfaces;
  this->OffSurfaces.reset();
  if (surfaces)
  {
    this->Present = Residency();
    this->IsSceneNew = true;
    this->OffSurfaces.emplace(this->Store->GetDescription(), surfaces);
  }
}

//------------------------------------------------------------------------------
// Loading samples

bool FieldTexture::Update(vtkOpenGLRenderWindow* window, const std::vector<ViewFrustum>& frustums,
  const std::vector<ViewFrustum>& recent, const TexturePace& pace, std::string& error)
{
  this->Window = window;
  if ((this->IsComplete() || pace.Keeps) && frustums == this->Frustums &&
    this->Present.GetBlocks() > 0 && this->Limit == pace.Limit)
  {
    return true;
  }
  vtkOpenGLState::ScopedglActiveTexture activeTexture(window->GetState());
  const int unit = window->GetTextureUnitManager()->Allocate();
  window->GetState()->vtkglActiveTexture(GL_TEXTURE0 + unit);
  const bool hasRoom = this->MakeRoom(frustums, recent, pace);
  if (hasRoom)
  {
    const bool isAimed = frustums != this->Frustums;
    this->Frustums = frustums;
    this->Present.Aim(frustums);
    this->Pool.BeginUploads();
    pace.Waits ? this->LoadAll() : this->LoadSome(pace);
    this->Pool.EndUploads();
    const bool isChanged = std::exchange(this->IsChanged, false);
    if (isChanged || isAimed)
    {
      const bool isTableChanged = this->MakeTables();
      const bool isSceneNew = std::exchange(this->IsSceneNew, false);
      MakeSceneTexture(this->Scene, isSceneNew, this->SceneTexture);
      if (this->OffSurfaces)
      {
        MakeSceneTexture(*this->OffSurfaces, isSceneNew, this->OffSurfacesTexture);
      }
      this->Changes += isChanged || isTableChanged ? 1 : 0;
    }
  }
  for (const GLenum target : Targets)
  {
    glBindTexture(target, 0);
  }
  window->GetTextureUnitManager()->Free(unit);
  if (!hasRoom)
  {
    this->Free();
    error = "The field does not fit the graphics driver's texture memory.";
  }
  return hasRoom;
}

// The blocks that these cameras need, and recent ones if all samples fit then.
int FieldTexture::ChooseBlocks(const std::vector<ViewFrustum>& frustums,
  const std::vector<ViewFrustum>& recent, const TexturePace& pace) const
{
  const auto choose = [](int needed)
  {
    return *std::find_if(std::begin(BlockSteps), std::end(BlockSteps) - 1,
      [needed](int most) { return needed <= most; });
  };
  const Description& field = this->Store->GetDescription();
  const int viewpoints = field.Grid.GetViewpoints() * field.Grid.GetViewpoints();
  const int blocks = choose(std::max(1, Residency::CountBlocks(frustums)));
  const int more = choose(std::max(1, Residency::CountBlocks(recent)));
  return more > blocks && TilePool::CountBytes(field, more, viewpoints) <= pace.Limit ? more
                                                                                      : blocks;
}

// Allocates again if there is too little space, or far too much. Drivers may take long to allocate
// much memory, so the first picture, if nobody waits for it, begins with little.
bool FieldTexture::MakeRoom(const std::vector<ViewFrustum>& frustums,
  const std::vector<ViewFrustum>& recent, const TexturePace& pace)
{
  const bool isSmall = (!pace.Waits && this->IsEmpty()) || frustums.empty();
  const int blocks = isSmall ? std::max(1, Residency::CountBlocks(frustums))
                             : this->ChooseBlocks(frustums, recent, pace);
  if (this->Present.GetBlocks() == blocks && this->Limit == pace.Limit && this->IsSmall == isSmall)
  {
    return true;
  }
  this->Limit = pace.Limit;
  this->IsSmall = isSmall;
  this->IsChanged = true;
  const Description& field = this->Store->GetDescription();
  const int side = isSmall ? static_cast<int>(CoarsestNodes(field.Grid.GetViewpoints()).size())
                           : field.Grid.GetViewpoints();
  if (!this->Pool.Create(field, blocks, side * side, pace.Limit))
  {
    return false;
  }
  this->Present = Residency(field.Grid, blocks, this->Pool.GetSlots());
  for (int slice : this->Store->GetMissing())
  {
    this->Present.SetDamaged(slice);
  }
  return true;
}

void FieldTexture::Load(const WantedTiles& wanted)
{
  const ViewpointSamples samples = this->Store->Get(wanted.Slice);
  this->IsChanged = true;
  if (samples.IsEmpty())
  {
    this->Present.SetDamaged(wanted.Slice);
    ++this->Damaged;
    return;
  }
  const int face = this->Store->GetDescription().Grid.ViewpointOf(wanted.Slice).Face;
  for (int tile = 0; tile < TileCount; ++tile)
  {
    if (wanted.Tiles & (1 << tile))
    {
      this->Pool.Upload(
        samples, tile, this->Present.GetBlock(face, tile), this->Present.GetSlot(wanted.Slice));
    }
  }
  ++this->UploadedViewpoints;
  this->Present.SetPresent(wanted.Slice, wanted.Tiles);
  if (this->Present.CountNodes(wanted.Level) <= MaximumSceneNodes)
  {
    this->Scene.Add(wanted.Slice, samples, wanted.Tiles);
    if (this->OffSurfaces)
    {
      this->OffSurfaces->Add(wanted.Slice, samples, wanted.Tiles);
    }
  }
}

void FieldTexture::LoadAll()
{
  std::vector<WantedTiles> missing = this->Present.ListMissing();
  while (!missing.empty())
  {
    std::vector<int> slices = ListSlices(missing);
    this->Store->Sort(slices);
    this->Store->Prefetch(slices);
    this->Store->Wait();
    bool isAnyReady = false;
    for (const WantedTiles& wanted : missing)
    {
      if (this->Store->IsReady(wanted.Slice))
      {
        isAnyReady = true;
        this->Load(wanted);
      }
    }
    // A store without enough memory keeps nothing ready.
    if (!isAnyReady)
    {
      this->Load(missing.front());
    }
    missing = this->Present.ListMissing();
  }
  this->HasLoaded = true;
  this->Missing = 0;
}

void FieldTexture::LoadSome(const TexturePace& pace)
{
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(pace.Seconds);
  const std::vector<WantedTiles> missing = this->Present.ListMissing();
  const auto finer = std::find_if(
    missing.begin(), missing.end(), [](const WantedTiles& wanted) { return wanted.Level > 0; });
  const std::vector<WantedTiles> coarsest(missing.begin(), finer);
  if (!coarsest.empty())
  {
    this->Store->Prefetch(ListSlices(coarsest));
    if (pace.Begins)
    {
      return;
    }
    this->Store->Wait();
  }
  this->Store->Prefetch(ListSlices(missing));
  for (const WantedTiles& wanted : missing)
  {
    if (wanted.Level > 0 && Clock::now() > end)
    {
      break;
    }
    if (wanted.Level == 0 || this->Store->IsReady(wanted.Slice))
    {
      this->Load(wanted);
    }
  }
  this->HasLoaded = true;
  this->Missing = this->Present.ListMissing().size();
}

// Returns whether any has changed.
bool FieldTexture::MakeTables()
{
  bool isAnyChanged = false;
  const int cells = this->Store->GetDescription().Grid.GetBaseNodes() - 1;
  for (int face = 0; face < FaceCount; ++face)
  {
    const bool isSeen = std::any_of(this->Frustums.begin(), this->Frustums.end(),
      [face](const ViewFrustum& frustum) { return frustum.CanEnter(face); });
    if (!isSeen)
    {
      continue;
    }
    Residency::Table table = this->Present.MakeTable(face);
    isAnyChanged = std::exchange(this->Tiles[face], table.Tiles) != table.Tiles || isAnyChanged;
    if (this->Tables[face] != 0 && this->Cells[face] == table.Cells)
    {
      continue;
    }
    isAnyChanged = true;
    if (this->Tables[face] == 0)
    {
      glGenTextures(1, &this->Tables[face]);
    }
    this->Cells[face] = std::move(table.Cells);
    glBindTexture(GL_TEXTURE_2D, this->Tables[face]);
    SetNearest(GL_TEXTURE_2D);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, TableTexels * cells, cells, 0, GL_RGBA, GL_FLOAT,
      this->Cells[face].data());
  }
  return isAnyChanged;
}

void FieldTexture::MakeSceneTexture(SceneGrid& scene, bool isNew, Handle& texture)
{
  if (!scene.Spread() && !isNew && texture != 0)
  {
    return;
  }
  if (texture == 0)
  {
    glGenTextures(1, &texture);
  }
  GLint alignment = 4;
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glBindTexture(GL_TEXTURE_3D, texture);
  SetNearest(GL_TEXTURE_3D);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R8, SceneGrid::Cells, SceneGrid::Cells, SceneGrid::Cells, 0,
    GL_RED, GL_UNSIGNED_BYTE, scene.GetRings().data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
}

//------------------------------------------------------------------------------
// Drawing

void FieldTexture::Activate(int entryFace, bool offSurfaces)
{
  vtkOpenGLState* state = this->Window->GetState();
  const Handle handles[] = { this->Pool.GetTexture(KnownChannel::Color),
    this->Pool.GetTexture(KnownChannel::Depth), this->Tables[entryFace],
    offSurfaces ? this->OffSurfacesTexture : this->SceneTexture };
  for (std::size_t i = 0; i < this->Units.size(); ++i)
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

void FieldTexture::SetUniforms(vtkShaderProgram* program, int entryFace) const
{
  const Layout& grid = this->Store->GetDescription().Grid;
  const glm::vec3 minimum(this->Scene.GetMinimum());
  const glm::vec3 maximum(this->Scene.GetMaximum());
  program->SetUniformi("ColorTexture", this->Units[0]);
  program->SetUniformi("DepthTexture", this->Units[1]);
  program->SetUniformi("CellTexture", this->Units[2]);
  program->SetUniformi("SceneGridTexture", this->Units[3]);
  program->SetUniformf("TilesPerLayer", static_cast<float>(this->Pool.GetTilesPerLayer()));
  program->SetUniformf("BaseNodes", static_cast<float>(grid.GetBaseNodes()));
  program->SetUniformf("Resolution", static_cast<float>(grid.GetResolution()));
  program->SetUniform3f("SceneMinimum", &minimum.x);
  const float inverseSide = 1.0F / static_cast<float>(grid.GetResolution());
  const float inverseLayerSize[2] = { inverseSide,
    inverseSide / static_cast<float>(this->Pool.GetTilesPerLayer()) };
  program->SetUniform2f("InverseLayerSize", inverseLayerSize);
  program->SetUniform3f("SceneMaximum", &maximum.x);

  const auto frames = ListExitFrames(entryFace);
  std::array<float, TileCount> layers;
  for (std::size_t exit = 0; exit < frames.size(); ++exit)
  {
    layers[exit] = static_cast<float>(this->FindFirstLayer(entryFace, frames[exit].Tile));
  }
  program->SetUniformf("OppositeBlock", layers[0]);
  program->SetUniform2f("SideXBlocks", &layers[1]);
  program->SetUniform2f("SideYBlocks", &layers[3]);
}

int FieldTexture::FindFirstLayer(int entryFace, int tile) const
{
  return this->Tiles[entryFace] & (1 << tile)
    ? this->Pool.GetFirstLayer(this->Present.GetBlock(entryFace, tile))
    : Residency::Absent;
}

void FieldTexture::Free()
{
  this->Pool.Free();
  glDeleteTextures(static_cast<GLsizei>(this->Tables.size()), this->Tables.data());
  glDeleteTextures(1, &this->SceneTexture);
  glDeleteTextures(1, &this->OffSurfacesTexture);
  this->Tables.fill(0);
  this->SceneTexture = 0;
  this->OffSurfacesTexture = 0;
  this->Present = Residency();
  this->Missing = 0;
  this->IsSmall = false;
  this->Window = nullptr;
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
