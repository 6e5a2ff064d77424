// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A picture of a field's geometry: where each ray meets it first.
 */
#ifndef cslfSurfacePicture_h
#define cslfSurfacePicture_h

#include "cslfGeometryMesh.h"
#include "cslfViewFrustum.h"

#include <vtkNew.h>
#include <vtkOpenGLHelper.h>
#include <vtkSmartPointer.h>

#include <glm/vec4.hpp>

#include <array>
#include <memory>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace cslf
{
/// Textures with the points and colours of cslfSurface.glsl. Belongs to one render
/// window's context at a time.
class SurfacePicture
{
public:
  SurfacePicture();
  ~SurfacePicture();
  SurfacePicture(const SurfacePicture&) = delete;
  SurfacePicture& operator=(const SurfacePicture&) = delete;

  /// Draws a mesh, except where any of the planes is negative. Closed parts hide their backs if the
  /// eye is outside of the cube. Colours have that type. Binds the framebuffer.
  void Draw(vtkOpenGLRenderWindow* window, vtkOpenGLFramebufferObject* framebuffer,
    const std::shared_ptr<const GeometryMesh>& mesh, const DisplayRows& ccdc, bool isEyeInside,
    const std::vector<glm::dvec4>& planesCC, const std::array<int, 2>& size, int colorType);

  /// Binds the textures to texture units, until Deactivate.
  void Activate();
  void Deactivate();

  /// Sets the uniforms of cslfSurface.glsl. The textures must be active.
  void SetUniforms(vtkShaderProgram* program) const;

  /// Frees everything. The window's context must be current.
  void Release(vtkWindow* window);

private:
  void Allocate(vtkOpenGLRenderWindow* window, const std::array<int, 2>& size, int colorType);
  void Upload();
  void Build(vtkOpenGLRenderWindow* window, std::size_t planes);
  void DrawTriangles(vtkOpenGLState* state, bool hidesBacks);

  std::shared_ptr<const GeometryMesh> Mesh; ///< that was uploaded
  std::array<int, 2> Size{ 0, 0 };
  std::size_t Planes = 0; ///< of the program
  vtkNew<vtkTextureObject> Points;
  vtkNew<vtkTextureObject> Colors;
  vtkNew<vtkTextureObject> Depths;
  vtkNew<vtkOpenGLBufferObject> PointBuffer;
  vtkNew<vtkOpenGLBufferObject> ColorBuffer;
  vtkNew<vtkOpenGLBufferObject> BackColorBuffer;
  vtkOpenGLHelper Triangles;
};
}

#endif
