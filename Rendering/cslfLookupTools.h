// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What looks up the pictures of a window: programs, and textures for intermediate results.
 */
#ifndef cslfLookupTools_h
#define cslfLookupTools_h

#include <glm/vec4.hpp>
#include <vtkNew.h>
#include <vtkOpenGLHelper.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "cslfGeometryMesh.h"
#include "cslfShownMaps.h"
#include "cslfViewFrustum.h"

class vtkOpenGLFramebufferObject;
class vtkOpenGLIndexBufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

class vtkOpenGLBufferObject;
class vtkOpenGLState;
class vtkShaderProgram;

namespace cslf
{
/// How fine the steps of a texture's colours are.
enum class ColorSteps
{
  Bytes,
  Halves, ///< half floats, for means of several pictures and for what is brighter than white
  Floats
};

struct LookupTarget;

/// Draws a field's geometry: its points and colours to textures for cslfSurface.glsl or, if it
/// alone shows the field, what is seen. Belongs to one render window's context at a time.
class SurfacePicture
{
public:
  SurfacePicture();
  ~SurfacePicture();
  SurfacePicture(const SurfacePicture&) = delete;
  SurfacePicture& operator=(const SurfacePicture&) = delete;

  /// How a mesh is seen.
  struct View
  {
    DisplayRows CCDC{};
    bool IsEyeInside = false;              ///< of the cube; if not, closed parts hide their backs
    std::vector<glm::dvec4> PlanesCC;      ///< where any is negative, nothing is drawn
    glm::dvec4 EyeCC{ 0.0 };               ///< w = 1: the eye; w = 0: the direction of a projection
    std::size_t Level = 0;                 ///< of detail: 0 for all triangles
    std::shared_ptr<const ShownMaps> Maps; ///< of mapped points; null if there are none
  };

  /// Draws a mesh to textures that a target of that size needs. Binds the framebuffer.
  void Draw(vtkOpenGLRenderWindow* window, vtkOpenGLFramebufferObject* framebuffer,
    const std::shared_ptr<const GeometryMesh>& mesh, const View& view, const LookupTarget& target);

  /// Draws a mesh that alone shows the field to a target that the framebuffer has, and that was
  /// cleared. Needs no textures.
  void DrawAlone(vtkOpenGLRenderWindow* window, vtkOpenGLFramebufferObject* framebuffer,
    const std::shared_ptr<const GeometryMesh>& mesh, const View& view, const LookupTarget& target);

  /// Binds the textures to texture units, until Deactivate.
  void Activate();
  void Deactivate();

  /// Sets the uniforms of cslfSurface.glsl. The textures must be active.
  void SetUniforms(vtkShaderProgram* program) const;

  /// Frees everything. The window's context must be current.
  void Release(vtkWindow* window);

private:
  void Allocate(vtkOpenGLRenderWindow* window, const LookupTarget& target);
  void AllocateDepths(vtkOpenGLRenderWindow* window, const std::array<int, 2>& size);
  /// Uploads the mesh and its maps, and builds the program, unless they are there.
  void Prepare(vtkOpenGLRenderWindow* window, const std::shared_ptr<const GeometryMesh>& mesh,
    const View& view);
  void Upload(vtkOpenGLRenderWindow* window);
  /// Uploads what is shown in maps, as far as it differs from earlier ones, if there are any.
  void UploadMaps(vtkOpenGLRenderWindow* window, const ShownMaps* earlier);
  void Build(vtkOpenGLRenderWindow* window);
  /// Makes the depths those of the framebuffer, and clears them.
  void ClearDepths(vtkOpenGLRenderWindow* window, vtkOpenGLFramebufferObject* framebuffer,
    const std::array<int, 2>& size);
  void DrawMesh(vtkOpenGLRenderWindow* window, const View& view);
  void DrawTriangles(vtkOpenGLState* state, std::size_t level, bool hidesBacks, bool showsBalls);

  std::shared_ptr<const GeometryMesh> Mesh; ///< that was uploaded
  std::shared_ptr<const ShownMaps> Maps;    ///< likewise
  std::array<int, 2> Size{ 0, 0 };
  ColorSteps Steps = ColorSteps::Bytes;
  std::size_t Planes = 0; ///< of the program
  vtkNew<vtkTextureObject> Points;
  vtkNew<vtkTextureObject> Colors;
  vtkNew<vtkTextureObject> Depths;
  vtkNew<vtkTextureObject> MapColors;
  vtkNew<vtkTextureObject> MapPixels;
  vtkNew<vtkOpenGLBufferObject> PlaceBuffer;
  vtkNew<vtkOpenGLBufferObject> PointBuffer;
  vtkNew<vtkOpenGLBufferObject> ColorBuffer;
  vtkNew<vtkOpenGLBufferObject> BackColorBuffer;
  vtkOpenGLHelper Triangles;
  vtkNew<vtkOpenGLIndexBufferObject> CoarseTriangles; ///< of all levels but the finest
  BallPicture Spheres;
};

struct Description;

/// Textures that a lookup draws to.
struct LookupTarget
{
  std::array<int, 2> Size{ 1, 1 };
  vtkNew<vtkTextureObject> Colors;
  vtkNew<vtkTextureObject> Depths;
  vtkNew<vtkTextureObject> Marks; ///< a depth buffer: 1 where nothing was drawn yet
  ColorSteps Steps = ColorSteps::Bytes;

  /// Allocates the textures again if they have another size or type.
  void Allocate(
    vtkOpenGLRenderWindow* window, const std::array<int, 2>& size, ColorSteps steps, bool hasMarks);

  /// The graphics memory that the textures take, in bytes.
  std::int64_t GetBytes() const;

  void Release(vtkWindow* window);
};

/// All pictures of a window share one, because a picture needs it only while it is looked up.
/// Belongs to one render window's context at a time.
struct LookupTools
{
  LookupTools();
  ~LookupTools();
  LookupTools(const LookupTools&) = delete;
  LookupTools& operator=(const LookupTools&) = delete;

  /// How rays are looked up. Each way needs programs of its own.
  struct Method
  {
    int Lookup = -1;           ///< vtkCSLFMapper::LookupType
    bool IsSearched = false;   ///< by depth or geometry, which takes several passes
    bool IsOnGeometry = false; ///< rays that meet the geometry are not searched
    bool IsOpaque = false;     ///< except for what they meet before, which the geometry lacks
    bool IsAlone = false;      ///< the geometry shows the field: no ray is looked up

    bool operator==(const Method& other) const;
  };

  /// Builds the programs of a method for a field, unless they are there.
  void Build(vtkOpenGLRenderWindow* window, const Method& method, const Description& field);

  /// The program for the mean of the rays of a pixel, with that many along each side, and perhaps
  /// of an earlier picture. Branches and loops in it would take half of a picture's time.
  vtkOpenGLQuadHelper& GetMean(vtkOpenGLRenderWindow* window, int raysPerSide, bool hasEarlier);

  /// Frees everything. The window's context must be current.
  void Release(vtkWindow* window);

  LookupTarget Rays; ///< if there are several for each pixel
  LookupTarget Guess;
  SurfacePicture Surfaces;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;

  std::unique_ptr<vtkOpenGLQuadHelper> GuessSearch; ///< a small picture's depths
  std::unique_ptr<vtkOpenGLQuadHelper> Miss;        ///< where they and the grid have nothing
  std::unique_ptr<vtkOpenGLQuadHelper>
    Check; ///< looks up surfaces that a small picture's depths suggest
  std::unique_ptr<vtkOpenGLQuadHelper> Search; ///< remaining pixels; without depth, all
  std::unique_ptr<vtkOpenGLQuadHelper>
    Rest; ///< pixels for which the search found no visible surface
  std::unique_ptr<vtkOpenGLQuadHelper> OnSurface; ///< marks these rays
  std::unique_ptr<vtkOpenGLQuadHelper> Around;    ///< what it lacks, by views farther around
  std::unique_ptr<vtkOpenGLQuadHelper> Front;     ///< what it lacks in front of it
  std::unique_ptr<vtkOpenGLQuadHelper> Close;     ///< the same, close to it
  std::unique_ptr<vtkOpenGLQuadHelper> Exact;     ///< points of the geometry, by exact colours
  std::unique_ptr<vtkOpenGLQuadHelper> Near;      ///< points of the geometry, by the views around
  std::unique_ptr<vtkOpenGLQuadHelper> Far;       ///< by others of the entry face
  std::unique_ptr<vtkOpenGLQuadHelper> Other;     ///< by those of other faces
  std::unique_ptr<vtkOpenGLQuadHelper> Own;       ///< by its own colours

private:
  void ReleasePrograms();

  std::map<std::pair<int, bool>, std::unique_ptr<vtkOpenGLQuadHelper>> Means;
  bool IsBuilt = false;
  Method Built;
  std::array<bool, 3> BuiltFor{}; ///< whether the field has depth, linear colours, an environment
};
}

#endif
