// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The result of all rays of a view, looked up once for all passes that draw it.
 */
#ifndef cslfLookupPicture_h
#define cslfLookupPicture_h

#include "cslfCube.h"
#include "cslfSurfacePicture.h"
#include "cslfViewFrustum.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <glm/vec4.hpp>

#include <array>
#include <memory>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace cslf
{
struct Description;
class FieldTexture;

/// A texture of colours and one of depths (z of DC) for the viewport. VTK draws an actor several
/// times, at least twice if it is opaque with partly covered pixels. Lookups cost more than reading
/// their results. Belongs to one render window's context at a time.
class LookupPicture
{
public:
  /// The view, and how it is looked up.
  struct View
  {
    int Lookup = 0; ///< vtkCSLFMapper::LookupType
    int Samples =
      1; ///< the fewest rays along each side of a pixel, for depth lookups in still views
    DisplayRows CCDC{};
    glm::dvec4 EyeCC{ 0.0 };  ///< w = 1: the eye; w = 0: the direction of a parallel projection
    bool IsEyeInside = false; ///< of the cube
    std::array<bool, FaceCount> EntryFaces{};
    std::array<glm::dvec3, FaceCount> FocalPointsCC{};
    std::shared_ptr<const GeometryMesh> Geometry; ///< null if there is none
    std::vector<glm::dvec4> ClippingPlanesCC;     ///< that cut the geometry

    bool operator==(const View& other) const;
  };

  LookupPicture();
  ~LookupPicture();
  LookupPicture(const LookupPicture&) = delete;
  LookupPicture& operator=(const LookupPicture&) = delete;

  /// Looks up the view for the current viewport, unless the picture has it already, and binds the
  /// textures until Deactivate. The picture has several pixels for each of the viewport if the
  /// field has more texels than the viewport has pixels for them, and for depth lookups in still
  /// views. It has fewer if all would take longer than `seconds`. The field must be uploaded to
  /// this window.
  void Draw(vtkOpenGLRenderWindow* window, const View& view, FieldTexture& field, double seconds);

  /// Compiles the programs for such pictures.
  void Compile(vtkOpenGLRenderWindow* window, const View& view, FieldTexture& field);

  /// Whether the picture has fewer pixels than the viewport, to be interpolated.
  bool IsCoarse() const { return this->Share < 1.0; }

  /// Sets the picture's uniforms of cslfMapperFS.glsl.
  void SetUniforms(vtkShaderProgram* program) const;

  void Deactivate();

  /// Frees the textures if they belong to this window, whose context must be current.
  void Release(vtkWindow* window);

private:
  /// A target of lookups.
  struct Target
  {
    std::array<int, 2> Size{ 1, 1 };
    vtkNew<vtkTextureObject> Colors;
    vtkNew<vtkTextureObject> Depths;
    vtkNew<vtkTextureObject> Marks; ///< a depth buffer: 1 where nothing was drawn yet

    void Allocate(
      vtkOpenGLRenderWindow* window, const std::array<int, 2>& size, int colorType, bool hasMarks);

    void Release(vtkWindow* window);
  };

  void Look(vtkOpenGLRenderWindow* window, const View& asked, FieldTexture& field, double seconds,
    int mostSamples);
  void ChooseSize(int lookup, int wantedSamples, double seconds);
  void Allocate(const FieldTexture& field);
  void BuildPrograms(const Description& field, bool hasDepth);
  void ReleasePrograms();
  void DrawPicture(FieldTexture& field);
  void DrawSurfaces(FieldTexture& field);
  void DrawPoints(FieldTexture& field);
  void DrawSearched(FieldTexture& field);

  /// Clears a target and draws to it from now on, perhaps with its marks.
  void Begin(Target& target, bool marks);

  /// Where rays are looked up: in the picture, unless pixels are means of several rays.
  Target& GetRays() { return this->Samples > 1 ? this->Rays : this->Picture; }

  /// The picture's pixels from their rays.
  void DrawMeans();
  void DrawMarks(vtkOpenGLQuadHelper& quad, float markDC);
  void DrawFaces(
    FieldTexture& field, vtkOpenGLQuadHelper& quad, float markDC, bool isWhole = false);
  void SetViewUniforms(vtkShaderProgram* program, int entryFace) const;

  vtkOpenGLRenderWindow* Window = nullptr; ///< the context to which the textures belong
  View Current;
  unsigned int Changes = 0; ///< of the field that the picture shows
  std::array<int, 4> Viewport{ 0, 0, 0, 0 };
  std::array<int, 4> Area{ 0, 0, 0, 0 }; ///< of the viewport that the picture covers: x, y, size
  int Samples = 1;                 ///< the number of rays along a side of a pixel of the viewport
  double Share = 1.0;              ///< the same, as far as there is time while the view moves
  bool IsMoving = false;           ///< the view, when the picture was drawn
  std::array<int, 2> Size{ 1, 1 }; ///< the number of rays
  double PixelSeconds = 0.0;       ///< for a pixel at the last measurement; 0 before
  bool IsSearched = false;         ///< by depth or geometry, which takes several passes
  bool IsOnGeometry = false;       ///< rays that meet the geometry are not searched
  std::array<int, 4> Built{ -1, 0, 0, 0 }; ///< lookup, and whether depth, linear and environment
  Target Picture;
  Target Rays; ///< if there are several for each pixel
  Target Guess;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  std::unique_ptr<vtkOpenGLQuadHelper> GuessSearch; ///< a small picture's depths
  std::unique_ptr<vtkOpenGLQuadHelper> Miss;        ///< where they and the grid have nothing
  std::unique_ptr<vtkOpenGLQuadHelper>
    Check; ///< looks up surfaces that a small picture's depths suggest
  std::unique_ptr<vtkOpenGLQuadHelper> Search; ///< remaining pixels; without depth, all
  std::unique_ptr<vtkOpenGLQuadHelper>
    Rest; ///< pixels for which the search found no visible surface
  SurfacePicture Surfaces;
  std::unique_ptr<vtkOpenGLQuadHelper> Mean;      ///< the rays of a pixel
  std::unique_ptr<vtkOpenGLQuadHelper> OnSurface; ///< marks these rays
  std::unique_ptr<vtkOpenGLQuadHelper> Near;      ///< points of the geometry, by the views around
  std::unique_ptr<vtkOpenGLQuadHelper> Far;       ///< by others of the entry face
  std::unique_ptr<vtkOpenGLQuadHelper> Other;     ///< by those of other faces
  std::unique_ptr<vtkOpenGLQuadHelper> Own;       ///< by its own colours
};
}

#endif
