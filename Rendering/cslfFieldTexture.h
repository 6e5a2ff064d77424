// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The OpenGL textures with the drawn samples of a light field.
 */
#ifndef cslfFieldTexture_h
#define cslfFieldTexture_h

#include "Lookup/cslfSceneGrid.h"
#include "Pipeline/cslfFieldStore.h"
#include "cslfDescription.h"
#include "cslfResidency.h"
#include "cslfTilePool.h"
#include "cslfViewFrustum.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace cslf
{
/// How samples are uploaded to graphics memory.
struct TexturePace
{
  std::int64_t Limit = 0; ///< bytes of graphics memory
  bool Waits = true;      ///< until everything is there; otherwise only for the coarsest viewpoints
  double Seconds = 0.0;   ///< for uploads of ready samples in other cases
  bool Keeps = false;     ///< another pass of the same picture: changes nothing
  bool Begins = false;    ///< only requests the coarsest viewpoints
};

/// The samples that cameras can use, and for each entry face a small texture that finds the
/// viewpoints around a coordinate. Belongs to one render window.
class FieldTexture
{
public:
  FieldTexture() = default;
  ~FieldTexture() = default;
  FieldTexture(const FieldTexture&) = delete;
  FieldTexture& operator=(const FieldTexture&) = delete;

  /// Sets the field. Samples in graphics memory become outdated.
  void SetStore(std::shared_ptr<FieldStore> store);

  /// Sets where a geometry is that has only the opaque surfaces, or null. Samples in graphics
  /// memory become outdated if it changes, because what they see elsewhere is not known then.
  void SetSurfaces(const std::shared_ptr<const SurfaceCells>& surfaces);

  /// Uploads the samples that these cameras can use, if there are any, to the window's graphics
  /// memory. Those that `recent` cameras have used stay if all of them fit. On failure nothing is
  /// kept and `error` gives the reason in one line.
  bool Update(vtkOpenGLRenderWindow* window, const std::vector<ViewFrustum>& frustums,
    const std::vector<ViewFrustum>& recent, const TexturePace& pace, std::string& error);

  /// Whether all samples for the cameras of the last Update are there, as far as they fit.
  bool IsComplete() const
  {
    return this->Missing == 0 && (!this->IsSmall || this->Frustums.empty());
  }

  /// Whether nothing was loaded since the store was set.
  bool IsEmpty() const { return !this->HasLoaded; }

  /// Whether all required viewpoints are among those that are known to be missing.
  bool LacksAll() const
  {
    return this->HasLoaded && this->UploadedViewpoints == 0 && !this->Store->GetMissing().empty();
  }

  /// How many required viewpoints turned out to be damaged, and how many intact.
  int GetNumberOfDamagedViewpoints() const { return this->Damaged; }
  int GetNumberOfViewpoints() const { return this->UploadedViewpoints; }

  /// What is known about the positions of the scene's surfaces, after a store was set.
  const SceneGrid& GetScene() const { return this->Scene; }

  /// A number that changes with the uploaded samples.
  unsigned int GetChanges() const { return this->Changes; }

  const Description& GetField() const { return this->Store->GetDescription(); }

  /// The size of the samples in graphics memory, in bytes.
  std::int64_t GetBytes() const { return this->Pool.GetBytes(); }

  /// Binds the textures of an entry face to texture units, until Deactivate. The scene's grid has
  /// all surfaces, or only those that are not where the geometry is.
  void Activate(int entryFace, bool offSurfaces = false);
  void Deactivate();

  /// Sets the uniforms of cslfField.glsl and cslfSceneGrid.glsl. The textures must be active.
  void SetUniforms(vtkShaderProgram* program, int entryFace) const;

  /// Frees the textures if they belong to this window, whose context must be current.
  void Release(vtkWindow* window);

private:
  using Handle = unsigned int;

  bool MakeRoom(const std::vector<ViewFrustum>& frustums, const std::vector<ViewFrustum>& recent,
    const TexturePace& pace);
  int ChooseBlocks(const std::vector<ViewFrustum>& frustums, const std::vector<ViewFrustum>& recent,
    const TexturePace& pace) const;
  void LoadAll();
  void LoadSome(const TexturePace& pace);
  void Load(const WantedTiles& wanted);
  bool MakeTables();
  static void MakeSceneTexture(SceneGrid& scene, bool isNew, Handle& texture);
  int FindFirstLayer(int entryFace, int tile) const;
  void Free();

  std::shared_ptr<FieldStore> Store;
  vtkOpenGLRenderWindow* Window = nullptr; ///< the context to which the textures belong
  std::int64_t Limit = 0;
  bool IsSmall = false; ///< there is space only for the coarsest viewpoints
  TilePool Pool;
  Residency Present;
  SceneGrid Scene;
  std::shared_ptr<const SurfaceCells> Surfaces;
  std::optional<SceneGrid> OffSurfaces; ///< if there are surfaces
  bool IsSceneNew = false;              ///< since the textures of both were made
  std::vector<ViewFrustum> Frustums;
  std::size_t Missing = 0;
  bool HasLoaded = false; ///< since the store was set
  int Damaged = 0;
  int UploadedViewpoints = 0;
  bool IsChanged = false; ///< since the tables were made
  unsigned int Changes = 0;
  std::array<Handle, FaceCount> Tables{};
  std::array<std::vector<float>, FaceCount> Cells; ///< of the tables
  std::array<TileSet, FaceCount> Tiles{};          ///< that can be looked up
  Handle SceneTexture = 0;
  Handle OffSurfacesTexture = 0;
  std::array<int, 4> Units{ -1, -1, -1, -1 }; ///< colour, depth, table, scene
};
}

#endif
