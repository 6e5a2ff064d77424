// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The OpenGL textures that hold a light field's samples.
 */
#ifndef cslfFieldTexture_h
#define cslfFieldTexture_h

#include "cslfDescription.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>

class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace cslf
{
/// For each entry face a 2D array texture of colour and one of depth, a small texture that finds
/// the viewpoints around a coordinate, and the scene's grid. A layer holds one or more slices, one
/// above the other, since drivers limit the number of layers (2048 is usual) more than their size.
/// Belongs to one render window's context at a time.
class FieldTexture
{
public:
  FieldTexture() = default;
  ~FieldTexture() = default;
  FieldTexture(const FieldTexture&) = delete;
  FieldTexture& operator=(const FieldTexture&) = delete;

  /// Copies a whole field to the window's graphics memory. On failure nothing is kept and `error`
  /// says why, in one line.
  bool Upload(vtkOpenGLRenderWindow* window, const Description& description, vtkImageData* image,
    std::string& error);

  /// Whether Upload succeeded for this window and nothing was released or outdated since.
  bool IsUploadedTo(vtkOpenGLRenderWindow* window) const
  {
    return this->Valid && window == this->Window;
  }

  /// Says that the samples in graphics memory are outdated.
  void Invalidate() { this->Valid = false; }

  /// A number that changes with every Upload.
  unsigned int GetUploads() const { return this->Uploads; }

  const Description& GetField() const { return this->Field; }

  /// The graphics memory that the samples take, in bytes.
  std::int64_t GetBytes() const { return this->Bytes; }

  /// Binds the textures of an entry face to texture units, until Deactivate.
  void Activate(int entryFace);
  void Deactivate();

  /// Sets the uniforms of cslfField.glsl and cslfSceneGrid.glsl. The textures must be active.
  void SetUniforms(vtkShaderProgram* program) const;

  /// Frees the textures if they belong to this window, whose context must be current.
  void Release(vtkWindow* window);

private:
  using Handle = unsigned int;

  bool ChooseLayers(std::string& error);
  void UploadFace(int face, vtkImageData* image);
  void UploadNodes();
  void UploadSceneGrid(vtkImageData* image);
  void Free();

  vtkOpenGLRenderWindow* Window = nullptr; ///< whose context the textures belong to
  bool Valid = false;
  unsigned int Uploads = 0;
  Description Field;
  int SlicesPerLayer = 1;
  int Layers = 0;
  std::int64_t Bytes = 0;
  std::array<Handle, FaceCount> Colors{};
  std::array<Handle, FaceCount> Depths{};
  Handle Nodes = 0;
  Handle Grid = 0;
  glm::vec3 SceneMinimum{ -1.0f };
  glm::vec3 SceneMaximum{ 1.0f };
  std::array<int, 4> Units{ -1, -1, -1, -1 }; ///< colour, depth, nodes, grid
};
}

#endif
