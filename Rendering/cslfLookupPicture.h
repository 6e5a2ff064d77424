// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The result of all rays of a view, looked up once for all passes that draw it.
 */
#ifndef cslfLookupPicture_h
#define cslfLookupPicture_h

#include "cslfCube.h"
#include "cslfLookupTools.h"
#include "cslfViewFrustum.h"

#include <vtkType.h>

#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace cslf
{
class FieldTexture;

/// A texture of colours and one of depths (z of DC) for the viewport. VTK draws an actor several
/// times, at least twice if it is opaque with partly covered pixels. Lookups cost more than reading
/// their results. Each view of a field has one. Belongs to one render window's context.
class LookupPicture
{
public:
  /// The view, and how it is looked up.
  struct View
  {
    int Lookup = 0;  ///< vtkCSLFMapper::LookupType
    int Samples = 1; ///< the fewest rays along each side of a pixel, for depth lookups in still
                     ///< views: if more than 1, the picture may be refined
    DisplayRows CCDC{};
    glm::dvec4 EyeCC{ 0.0 };  ///< w = 1: the eye; w = 0: the direction of a parallel projection
    bool IsEyeInside = false; ///< of the cube
    std::array<bool, FaceCount> EntryFaces{};
    std::array<glm::dvec3, FaceCount> FocalPointsCC{};
    std::shared_ptr<const GeometryMesh> Geometry; ///< null if there is none
    std::shared_ptr<const ShownMaps> Maps;        ///< of its mapped points, or null
    std::vector<glm::dvec4> ClippingPlanesCC;     ///< that cut the geometry

    bool operator==(const View& other) const;
  };

  /// How much is looked up at once.
  struct Pace
  {
    double Seconds = VTK_DOUBLE_MAX; ///< that looking up may take
    bool Keeps =
      false; ///< another pass of the same picture, even if the field has got more samples
    enum class Refinements
    {
      None,
      Detail, ///< of a preview, but no more rays
      One,    ///< if the picture has the view already
      All
    };
    Refinements Refinement = Refinements::None;
  };

  LookupPicture();
  ~LookupPicture();
  LookupPicture(const LookupPicture&) = delete;
  LookupPicture& operator=(const LookupPicture&) = delete;

  /// Looks up the view for the current viewport, unless the picture has it already, and binds the
  /// textures until Deactivate. The picture has several pixels for each of the viewport if the
  /// field has more texels than the viewport has pixels for them, and for depth lookups in still
  /// views. It has fewer if all would take longer than the time for it. Pictures of still views by
  /// depth are refined: they become the mean of several sets of rays through other places of the
  /// pixels. The field must be uploaded to this window.
  void Draw(vtkOpenGLRenderWindow* window, const View& view, FieldTexture& field,
    LookupTools& tools, const Pace& pace);

  /// Compiles the programs for such pictures.
  void Compile(
    vtkOpenGLRenderWindow* window, const View& view, FieldTexture& field, LookupTools& tools);

  /// Whether the picture has fewer pixels than the viewport, to be interpolated.
  bool IsCoarse() const { return this->Share < 1.0; }

  /// Whether the picture has all rays that it should have.
  bool IsRefined() const { return this->Sets >= this->WantedSets && !this->IsPreview(); }

  /// Sets the picture's uniforms of cslfMapperFS.glsl.
  void SetUniforms(vtkShaderProgram* program) const;

  void Deactivate();

  /// The graphics memory that the picture takes, in bytes.
  std::int64_t GetBytes() const
  {
    return this->Pictures[0].GetBytes() + this->Pictures[1].GetBytes();
  }

  /// Frees the textures. The window's context must be current.
  void Release(vtkWindow* window);

private:
  void Look(vtkOpenGLRenderWindow* window, const View& asked, FieldTexture& field, const Pace& pace,
    int mostSamples);
  /// Looks up one more set of rays.
  void DrawSet(FieldTexture& field);
  void ChooseSize(const View& view, int wantedSamples, double seconds);
  /// Whether there is probably time for all rays of the pixels while the view moves.
  bool HasTimeForAll(int wantedSamples) const;
  /// The level of the geometry for the next moving view, by the seconds that this one took.
  void ChooseLevel(double seconds);
  /// Whether the picture of a still view has less detail than it should have.
  bool IsPreview() const { return this->Level > 0 && !this->IsMoving; }
  void Allocate(const FieldTexture& field);
  void DrawPicture(FieldTexture& field);
  void DrawAlone();
  void DrawSurfaces(FieldTexture& field);
  void DrawPoints(FieldTexture& field);
  void DrawSearched(FieldTexture& field);

  /// Clears a target and draws to it from now on, perhaps with its marks.
  void Begin(LookupTarget& target, bool marks);

  /// Where the next set of rays goes, together with what is shown.
  LookupTarget& GetTarget()
  {
    return this->Pictures[this->Sets > 0 ? 1 - this->Shown : this->Shown];
  }

  /// Where rays are looked up: in the picture, unless pixels are means of several rays.
  LookupTarget& GetRays() { return this->Samples > 1 ? this->Tools->Rays : this->GetTarget(); }

  /// The view for the current set of rays of the picture's area.
  DisplayRows GetRows() const;
  SurfacePicture::View GetSurfaceView() const;

  /// The picture's pixels from their rays, also the earlier ones.
  void DrawMeans();
  void DrawMarks(vtkOpenGLQuadHelper& quad, float markDC);
  void DrawFaces(FieldTexture& field, vtkOpenGLQuadHelper& quad, float markDC, bool isWhole = false,
    bool offSurfaces = false);
  void SetViewUniforms(vtkShaderProgram* program, int entryFace) const;

  vtkOpenGLRenderWindow* Window = nullptr; ///< that has the textures
  LookupTools* Tools = nullptr;            ///< of the window, during Draw
  View Current;
  unsigned int Changes = 0; ///< of the field that the picture shows
  std::array<int, 4> Viewport{ 0, 0, 0, 0 };
  std::array<int, 4> Area{ 0, 0, 0, 0 }; ///< of the viewport that the picture covers: x, y, size
  int Samples = 1;    ///< the number of rays along a side of a pixel of the viewport
  double Share = 1.0; ///< the same, as far as there is time while the view moves
  int Sets = 0;       ///< of as many rays that the picture is the mean of
  int WantedSets = 0;
  bool IsMoving = false;           ///< the view, when the picture was drawn
  std::array<int, 2> Size{ 1, 1 }; ///< the number of rays
  double PixelSeconds = 0.0;       ///< for a pixel at the last measurement; 0 before
  double FullRaySeconds = 0.0; ///< for a ray, when a moving view had all rays of its pixels; or 0
  double WantedSeconds = 0.0;  ///< for a picture of a moving view
  bool IsSearched = false;     ///< by depth or geometry, which takes several passes
  bool IsOnGeometry = false;   ///< rays that meet the geometry are not searched
  bool IsAlone = false;        ///< the geometry shows the field
  std::size_t Level = 0;       ///< of its detail: 0 for all of it
  std::size_t MovingLevel = 0; ///< the same, as far as there is time while the view moves
  bool CanCoarsen = false;     ///< whether there is a level after that
  std::array<LookupTarget, 2> Pictures; ///< one is shown, the other replaces it when it is refined
  std::size_t Shown = 0;
};
}

#endif
