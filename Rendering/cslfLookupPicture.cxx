// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLookupPicture.h"

#include "Lookup/cslfFaceSpace.h"
#include "Lookup/cslfLookupConstants.h"
#include "cslfFieldTexture.h"
#include "cslfFlatUniforms.h"
#include "cslfOpenGL.h"
#include "vtkCSLFMapper.h"

#include <vtkMatrix4x4.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
/// The share of the drawing time for looking up; the rest is for uploads and for putting the
/// picture into the scene. With this share, 30 frames per second are reached if 30 are requested.
constexpr double LookupShare = 0.7;
/// While the view moves, a picture has at least this share of the viewport's pixels along each
/// side, in this many steps up to 1. A share that changes with every frame would flicker, so it
/// stays while there is time for it but not for two steps more.
constexpr double MinimumShare = 0.25;
constexpr double ShareSteps = 16.0;
/// The most rays along each side of a pixel.
constexpr int MaximumSamples = 16;
/// Refined pictures have this many sets of rays, whose places are a lattice without a preferred
/// direction: the first ray goes through the middle of its square, and each further one is shifted
/// by these shares of its edges, up to half an edge.
constexpr int RefinedSets = 5;
constexpr double SetShiftX = 0.2;
constexpr double SetShiftY = 0.4;
/// A level of detail takes at most this many times as long as the next, which has half of the
/// triangles; with room, so that levels do not change to and fro.
constexpr double MaximumSlowing = 2.5;
/// How many times as long all rays of the pixels take as one of each, if that is not known.
constexpr double ProbedSlowing = 2.0;
/// Fewer rays for each triangle than this save little time, and neither do fewer triangles for each
/// pixel.
constexpr double UsefulRays = 0.5;
constexpr double UsefulTriangles = 0.25;
/// If this many seconds are available for a picture, the view is not moving.
constexpr double StillSeconds = 1.0;
/// The depth lookup's guesses come from a picture with fewer pixels. Along each side, one pixel
/// replaces about as many as cover a texel in the middle of the cube, within these limits.
constexpr double MinimumGuessDivisor = 3.0;
constexpr double MaximumGuessDivisor = 12.0;
/// The marks of the depth lookup's passes on their pixels, as z of DC. Each pass skips pixels
/// marked by an earlier one.
constexpr float MissMark = -1.0F;
constexpr float CheckMark = -0.5F;
constexpr float SearchMark = 0.0F;
constexpr float RestMark = 0.5F;
/// Pixels on the geometry are marked first, so that the passes above skip them. Then the passes for
/// them skip the others: each draws only behind this mark, and in front of what is drawn.
constexpr float SurfaceMark = -0.9F;
constexpr float EmptyMark = -0.8F;
constexpr float FrontMark = -0.8F;
constexpr float ExactMark = -0.805F;
constexpr float NearMark = -0.81F;
constexpr float FarMark = -0.82F;
constexpr float OtherMark = -0.83F;
constexpr float CloseMark = -0.84F;
constexpr float OwnMark = -0.85F;
constexpr float SeenMark = -0.86F;
constexpr float UnseenMark = -0.87F;
/// The depth of pixels that no pass has drawn.
constexpr auto UnknownDC = static_cast<float>(2.0 * lookup::MissDC);

/// The length in pixels of an edge of the cube at its centre, seen from the side. 0 if the centre
/// is behind the eye.
double FindEdge(const LookupPicture::View& view, const std::array<int, 4>& viewport)
{
  if (view.CCDC[3].w <= 0.0)
  {
    return 0.0;
  }
  const double width = glm::length(glm::dvec3(view.CCDC[0])) * viewport[2];
  const double height = glm::length(glm::dvec3(view.CCDC[1])) * viewport[3];
  return std::max(0.5 * (width + height) / view.CCDC[3].w, 1.0);
}

/// The part of the viewport that shows the cube: x, y, width, height; all of it if the eye is too
/// near.
std::array<int, 4> FindArea(const LookupPicture::View& view, const std::array<int, 4>& viewport)
{
  const glm::dvec2 size(viewport[2], viewport[3]);
  glm::dvec2 low(size);
  glm::dvec2 high(0.0);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec4 point(
      corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0, 1.0);
    const double w = glm::dot(view.CCDC[3], point);
    if (w <= 0.0)
    {
      return { 0, 0, viewport[2], viewport[3] };
    }
    const glm::dvec2 pointDC(glm::dot(view.CCDC[0], point), glm::dot(view.CCDC[1], point));
    const glm::dvec2 pixel = 0.5 * (pointDC / w + 1.0) * size;
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  // One more pixel around the edges, because they are rasterised with less precision.
  const glm::ivec2 first(glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), size - 1.0));
  const glm::ivec2 last(glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(first) + 1.0, size));
  return { first.x, first.y, last.x - first.x, last.y - first.y };
}

/// Rays along each side of a pixel: about as many rays as texels, within a limit on the total.
int CountSamples(int resolution, double edge, const std::array<int, 4>& area)
{
  if (edge <= 0.0)
  {
    return 1;
  }
  const int fitting = 2 * resolution / std::max(area[2], area[3]);
  const double wanted = std::min(resolution / edge + 0.5, static_cast<double>(fitting));
  return static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(MaximumSamples)));
}

/// The same view for an area of the viewport.
DisplayRows CutOut(
  const DisplayRows& ccdc, const std::array<int, 4>& viewport, const std::array<int, 4>& area)
{
  DisplayRows rows = ccdc;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double size = area[2 + axis];
    const double shift = (viewport[2 + axis] - 2.0 * area[axis]) / size - 1.0;
    rows[axis] = ccdc[axis] * (viewport[2 + axis] / size) + ccdc[3] * shift;
  }
  return rows;
}
}

bool LookupPicture::View::operator==(const View& other) const
{
  return this->Lookup == other.Lookup && this->Samples == other.Samples &&
    this->CCDC == other.CCDC && this->EyeCC == other.EyeCC &&
    this->IsEyeInside == other.IsEyeInside && this->EntryFaces == other.EntryFaces &&
    this->FocalPointsCC == other.FocalPointsCC && this->Geometry == other.Geometry &&
    this->Maps == other.Maps && this->ClippingPlanesCC == other.ClippingPlanesCC;
}

LookupPicture::LookupPicture() = default;

LookupPicture::~LookupPicture() = default;

// While the view moves, as many rays as the time allows, but before there are fewer than pixels,
// the geometry gets fewer triangles.
void LookupPicture::ChooseSize(const View& view, int wantedSamples, double seconds)
{
  const double previous = this->Share;
  this->Share = 1.0;
  this->Samples = wantedSamples;
  if (seconds < StillSeconds)
  {
    // The time of the last lookup says nothing about another kind of lookup.
    const bool isKnown = this->PixelSeconds > 0.0 && view.Lookup == this->Current.Lookup;
    const double all = this->PixelSeconds * this->Area[2] * this->Area[3];
    this->WantedSeconds = LookupShare * seconds;
    double side = isKnown ? std::sqrt(this->WantedSeconds / all) : 0.5;
    if (this->IsAlone)
    {
      const double rays = this->CanCoarsen
        ? VTK_DOUBLE_MAX
        : UsefulRays * view.Geometry->CountTriangles(this->MovingLevel);
      side = std::max(side, std::min(1.0, std::sqrt(rays / (this->Area[2] * this->Area[3]))));
      side = this->MovingLevel > 0 ? std::min(side, 1.0) : side;
      side = isKnown && side >= 1.0 && this->HasTimeForAll(wantedSamples) ? wantedSamples : side;
    }
    this->Samples = std::clamp(static_cast<int>(side), 1, wantedSamples);
    const bool isKept = side >= previous && side < previous + 2.0 / ShareSteps;
    this->Share =
      isKept ? previous : std::clamp(std::floor(side * ShareSteps) / ShareSteps, MinimumShare, 1.0);
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    const double pixels = this->Area[2 + axis] * this->Samples * this->Share;
    this->Size[axis] = static_cast<int>(std::ceil(pixels));
  }
}

// Several rays of a pixel take less time than as many pixels, because triangles take some, too.
bool LookupPicture::HasTimeForAll(int wantedSamples) const
{
  const double pixels = static_cast<double>(this->Area[2]) * this->Area[3];
  const double all = this->FullRaySeconds > 0.0
    ? this->FullRaySeconds * pixels * wantedSamples * wantedSamples
    : ProbedSlowing * this->PixelSeconds * pixels;
  return this->MovingLevel == 0 && all < this->WantedSeconds;
}

void LookupPicture::ChooseLevel(double seconds)
{
  if (!this->IsAlone)
  {
    return;
  }
  const bool isSlow = seconds > this->WantedSeconds;
  const GeometryMesh& geometry = *this->Current.Geometry;
  const double pixels = static_cast<double>(this->Area[2]) * this->Area[3];
  const auto canCoarsen = [&]
  {
    return geometry.CountTriangles(this->MovingLevel) > UsefulTriangles * pixels &&
      this->MovingLevel < geometry.CountLevels();
  };
  if (isSlow && canCoarsen())
  {
    ++this->MovingLevel;
  }
  else if (this->MovingLevel > 0 && MaximumSlowing * seconds < this->WantedSeconds)
  {
    --this->MovingLevel;
  }
  this->CanCoarsen = (isSlow || this->MovingLevel > 0) && canCoarsen();
}

void LookupPicture::Draw(vtkOpenGLRenderWindow* window, const View& view, FieldTexture& field,
  LookupTools& tools, const Pace& pace)
{
  this->Tools = &tools;
  this->Look(window, view, field, pace, MaximumSamples);
  this->Pictures[this->Shown].Colors->Activate();
  this->Pictures[this->Shown].Depths->Activate();
}

void LookupPicture::Compile(
  vtkOpenGLRenderWindow* window, const View& view, FieldTexture& field, LookupTools& tools)
{
  this->Tools = &tools;
  this->Look(window, view, field, Pace{}, 1);
}

void LookupPicture::Look(vtkOpenGLRenderWindow* window, const View& asked, FieldTexture& field,
  const Pace& pace, int mostSamples)
{
  const bool hasDepth = field.GetField().FindChannel(KnownChannel::Depth) != nullptr;
  View view = asked;
  const bool isOnGeometry = asked.Lookup == vtkCSLFMapper::GEOMETRY && asked.Geometry && hasDepth;
  if (asked.Lookup == vtkCSLFMapper::GEOMETRY && !isOnGeometry)
  {
    view.Lookup = vtkCSLFMapper::DEPTH;
  }
  const bool isSearched = view.Lookup >= vtkCSLFMapper::DEPTH && hasDepth;
  view.Samples = isSearched ? asked.Samples : 1;
  std::array<int, 4> viewport{};
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport.data());
  const std::array<int, 4> area = FindArea(view, viewport);
  const int fitting = vtkTextureObject::GetMaximumTextureSize(window) / std::max(area[2], area[3]);
  const int ofTexels = view.IsEyeInside
    ? 1
    : CountSamples(field.GetField().Grid.GetResolution(), FindEdge(view, viewport), area);
  const int wantedSamples =
    std::clamp(std::min(std::max(ofTexels, view.Samples), fitting), 1, mostSamples);
  // While the view moves, all passes of a picture share the result of the first.
  const bool isComplete =
    this->Share == 1.0 && this->Samples == wantedSamples && !(this->IsMoving && this->IsOnGeometry);
  const bool isCurrent = this->Window == window && this->Viewport == viewport &&
    this->Current == view && (this->Changes == field.GetChanges() || pace.Keeps) &&
    (isComplete || pace.Seconds < StillSeconds);
  using Refinements = Pace::Refinements;
  if (!isCurrent)
  {
    this->Window = window;
    this->Viewport = viewport;
    this->Area = wantedSamples > 1 ? area : std::array<int, 4>{ 0, 0, viewport[2], viewport[3] };
    this->IsMoving = pace.Seconds < StillSeconds;
    this->FullRaySeconds = this->IsMoving ? this->FullRaySeconds : 0.0;
    this->IsAlone = isOnGeometry && view.Geometry->IsAlone;
    if (this->Current.Geometry != view.Geometry || this->Current.Lookup != view.Lookup)
    {
      this->MovingLevel = 0;
      this->CanCoarsen = false;
    }
    this->ChooseSize(view, wantedSamples, pace.Seconds);
    this->Current = view;
    this->Changes = field.GetChanges();
    this->IsSearched = isSearched;
    this->IsOnGeometry = isOnGeometry;
    // What moved is shown at once as it moved, and in full by the next picture.
    const bool isFirst = this->IsMoving || pace.Refinement == Refinements::One;
    this->Level = this->IsAlone && isFirst ? this->MovingLevel : 0;
    this->Sets = 0;
    const bool mayRefine = pace.Refinement >= Refinements::One && !this->IsMoving;
    this->WantedSets = mayRefine && view.Samples > 1 && this->Samples > 1 ? RefinedSets : 1;
    this->DrawSet(field);
  }
  else if (pace.Refinement != Refinements::None && pace.Seconds >= StillSeconds &&
    this->IsPreview())
  {
    this->Level = 0;
    this->Sets = 0;
    this->WantedSets = pace.Refinement >= Refinements::One ? this->WantedSets : 1;
    this->DrawSet(field);
  }
  else if (pace.Refinement == Refinements::One && !this->IsRefined())
  {
    this->DrawSet(field);
  }
  while (pace.Refinement == Refinements::All && !this->IsRefined())
  {
    this->DrawSet(field);
  }
}

void LookupPicture::DrawSet(FieldTexture& field)
{
  this->Allocate(field);
  const bool isOpaque = this->IsOnGeometry && this->Current.Geometry->Cells;
  this->Tools->Build(this->Window,
    { this->Current.Lookup, this->IsSearched, this->IsOnGeometry, isOpaque, this->IsAlone },
    field.GetField());
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  this->DrawPicture(field);
  ++this->Sets;
  if (this->IsMoving)
  {
    glFinish();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    // The first picture takes uploads and compilation, too.
    const bool isFirst = this->PixelSeconds == 0.0;
    this->PixelSeconds = seconds / (static_cast<double>(this->Size[0]) * this->Size[1]);
    if (this->IsAlone && this->Samples > 1)
    {
      // If that took too long, the next picture has one ray for each pixel.
      this->FullRaySeconds = this->PixelSeconds;
    }
    else if (!isFirst)
    {
      this->ChooseLevel(seconds);
    }
  }
  if (this->IsRefined())
  {
    this->Pictures[1 - this->Shown].Release(this->Window);
  }
}

void LookupPicture::Allocate(const FieldTexture& field)
{
  this->Tools->Framebuffer->ReleaseGraphicsResources(this->Window);
  const bool isByte = field.GetField().FindChannel(KnownChannel::Color)->Type == VTK_UNSIGNED_CHAR;
  const bool isBright = this->IsOnGeometry && this->Current.Geometry->IsBright;
  const ColorSteps steps = !isByte ? ColorSteps::Floats
    : isBright                     ? ColorSteps::Halves
                                   : ColorSteps::Bytes;
  const bool isMean = this->Samples > 1;
  const bool hasMarks = this->IsSearched && !this->IsAlone;
  this->GetTarget().Allocate(this->Window,
    isMean ? std::array<int, 2>{ this->Area[2], this->Area[3] } : this->Size,
    isByte && this->Sets > 0 ? ColorSteps::Halves : steps, hasMarks && !isMean);
  if (isMean)
  {
    this->Tools->Rays.Allocate(this->Window, this->Size, steps, hasMarks);
  }
  if (this->IsSearched && !this->IsOnGeometry)
  {
    const double edge = FindEdge(this->Current, this->Viewport) * this->Samples * this->Share;
    const int divisor =
      static_cast<int>(std::clamp(std::ceil(edge / field.GetField().Grid.GetResolution()),
        MinimumGuessDivisor, MaximumGuessDivisor));
    this->Tools->Guess.Allocate(this->Window,
      { (this->Size[0] + divisor - 1) / divisor, (this->Size[1] + divisor - 1) / divisor }, steps,
      false);
  }
}

DisplayRows LookupPicture::GetRows() const
{
  DisplayRows rows = CutOut(this->Current.CCDC, this->Viewport, this->Area);
  const glm::dvec2 shares(SetShiftX * this->Sets, SetShiftY * this->Sets);
  const glm::dvec2 shift = shares - glm::round(shares);
  for (int axis = 0; axis < 2; ++axis)
  {
    rows[axis] += rows[3] * (2.0 * shift[axis] / this->Size[axis]);
  }
  return rows;
}

SurfacePicture::View LookupPicture::GetSurfaceView() const
{
  return { this->GetRows(), this->Current.IsEyeInside, this->Current.ClippingPlanesCC,
    this->Current.EyeCC, this->Level, this->Current.Maps };
}

void LookupPicture::SetViewUniforms(vtkShaderProgram* program, int entryFace) const
{
  SetFaceUniforms(program, entryFace);
  const glm::vec3 focalPoint(CubeToFaceSpace(entryFace, this->Current.FocalPointsCC[entryFace]));
  program->SetUniform3f("FocalPointFC", &focalPoint.x);
  const glm::dvec3 eyeCC(this->Current.EyeCC);
  const glm::dvec3 eye = this->Current.EyeCC.w > 0.0
    ? CubeToFaceSpace(entryFace, eyeCC)
    : CubeToFaceSpace(entryFace, eyeCC) - CubeToFaceSpace(entryFace, glm::dvec3(0.0));
  const float eyeFC[4] = { static_cast<float>(eye.x), static_cast<float>(eye.y),
    static_cast<float>(eye.z), static_cast<float>(this->Current.EyeCC.w) };
  program->SetUniform4f("EyeFC", eyeFC);

  const DisplayRows rows = this->GetRows();
  vtkNew<vtkMatrix4x4> ccdc;
  ccdc->DeepCopy(&rows[0].x);
  vtkNew<vtkMatrix4x4> fccc;
  GetFaceToCube(entryFace, fccc);
  vtkNew<vtkMatrix4x4> fcdc;
  vtkMatrix4x4::Multiply4x4(ccdc, fccc, fcdc);
  // GLSL's matrices are stored by columns.
  vtkNew<vtkMatrix4x4> dcfc;
  vtkMatrix4x4::Invert(fcdc, dcfc);
  dcfc->Transpose();
  fcdc->Transpose();
  program->SetUniformMatrix("FCDCMatrix", fcdc);
  program->SetUniformMatrix("DCFCMatrix", dcfc);
  if (this->IsOnGeometry)
  {
    this->Tools->Surfaces.SetUniforms(program);
  }
  if (this->Tools->Check &&
    (program == this->Tools->Check->Program || program == this->Tools->Miss->Program))
  {
    const float size[2] = { static_cast<float>(this->Size[0]), static_cast<float>(this->Size[1]) };
    program->SetUniformi("GuessDepth", this->Tools->Guess.Depths->GetTextureUnit());
    program->SetUniform2f("PictureSize", size);
  }
}

void LookupPicture::DrawPicture(FieldTexture& field)
{
  vtkOpenGLState* state = this->Window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  vtkOpenGLState::ScopedglColorMask colorMask(state);
  vtkOpenGLState::ScopedglDepthMask depthMask(state);
  vtkOpenGLState::ScopedglDepthFunc depthFunc(state);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  state->PushFramebufferBindings();
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  if (this->IsAlone)
  {
    this->DrawAlone();
  }
  else if (this->IsOnGeometry)
  {
    this->DrawSurfaces(field);
  }
  else if (this->IsSearched)
  {
    this->DrawSearched(field);
  }
  else
  {
    this->Begin(this->GetRays(), false);
    this->DrawFaces(field, *this->Tools->Search, SearchMark);
  }
  if (this->Samples > 1)
  {
    this->DrawMeans();
  }
  state->PopFramebufferBindings();
}

// Each ray shows the geometry that it meets.
void LookupPicture::DrawAlone()
{
  this->Begin(this->GetRays(), false);
  this->Tools->Surfaces.DrawAlone(this->Window, this->Tools->Framebuffer, this->Current.Geometry,
    this->GetSurfaceView(), this->GetRays());
}

// Rays that meet the geometry are looked up there, others are searched.
void LookupPicture::DrawSurfaces(FieldTexture& field)
{
  this->Tools->Surfaces.Draw(this->Window, this->Tools->Framebuffer, this->Current.Geometry,
    this->GetSurfaceView(), this->GetRays());
  this->Tools->Surfaces.Activate();
  this->Begin(this->GetRays(), true);
  this->DrawMarks(*this->Tools->OnSurface, SurfaceMark);
  const bool isOpaque = this->Current.Geometry->Cells != nullptr;
  if (isOpaque)
  {
    this->Window->GetState()->vtkglDepthFunc(GL_GREATER);
    this->DrawFaces(field, *this->Tools->Front, FrontMark, false, true);
    this->Window->GetState()->vtkglDepthFunc(GL_LESS);
  }
  const bool showsEnvironment = field.GetField().MayShowEnvironment();
  if (!this->Current.Geometry->IsComplete || showsEnvironment)
  {
    // What is hidden from the four views around such a ray is more often nothing than a surface.
    this->DrawFaces(field, *this->Tools->Miss, EmptyMark, false, isOpaque);
    this->DrawFaces(field, *this->Tools->Search, SearchMark, false, isOpaque);
  }
  if (showsEnvironment)
  {
    this->DrawFaces(field, *this->Tools->Rest, RestMark);
  }
  else if (isOpaque)
  {
    this->DrawFaces(field, *this->Tools->Around, RestMark, false, true);
  }
  this->DrawPoints(field);
  this->Tools->Surfaces.Deactivate();
}

// Each pass looks up the marked pixels that earlier ones have left.
void LookupPicture::DrawPoints(FieldTexture& field)
{
  this->Window->GetState()->vtkglDepthFunc(GL_GREATER);
  if (this->Current.Geometry->HasExactColors)
  {
    this->DrawFaces(field, *this->Tools->Exact, ExactMark, true);
  }
  const auto& faces = this->Current.EntryFaces;
  this->DrawFaces(field, *this->Tools->Near, NearMark);
  this->DrawFaces(field, *this->Tools->Far, FarMark);
  if (!this->IsMoving && std::count(faces.begin(), faces.end(), true) > 1)
  {
    this->DrawFaces(field, *this->Tools->Other, OtherMark, true);
  }
  if (this->Current.Geometry->Cells)
  {
    this->DrawFaces(field, *this->Tools->Close, CloseMark);
  }
  this->DrawFaces(field, *this->Tools->Own, OwnMark, true);
  if (!this->Current.Geometry->HasColors)
  {
    this->DrawFaces(field, *this->Tools->Search, SeenMark);
    this->DrawFaces(field, *this->Tools->Rest, UnseenMark);
  }
}

void LookupPicture::DrawSearched(FieldTexture& field)
{
  const bool hasGuess = !this->Current.IsEyeInside;
  if (hasGuess)
  {
    this->Begin(this->Tools->Guess, false);
    this->DrawFaces(field, *this->Tools->GuessSearch, SearchMark);
    this->Tools->Guess.Depths->Activate();
  }
  this->Begin(this->GetRays(), true);
  // Later passes skip the results of earlier ones: early depth tests cull them.
  if (hasGuess)
  {
    this->DrawFaces(field, *this->Tools->Miss, MissMark);
    this->DrawFaces(field, *this->Tools->Check, CheckMark);
    this->Tools->Guess.Depths->Deactivate();
  }
  this->DrawFaces(field, *this->Tools->Search, SearchMark);
  this->DrawFaces(field, *this->Tools->Rest, RestMark);
}

void LookupPicture::DrawMeans()
{
  this->Begin(this->GetTarget(), false);
  const bool hasEarlier = this->Sets > 0;
  std::vector<const LookupTarget*> targets{ &this->Tools->Rays };
  if (hasEarlier)
  {
    targets.push_back(&this->Pictures[this->Shown]);
  }
  for (const LookupTarget* target : targets)
  {
    target->Colors->Activate();
    target->Depths->Activate();
  }
  vtkOpenGLQuadHelper& mean = this->Tools->GetMean(this->Window, this->Samples, hasEarlier);
  vtkShaderProgram* program = mean.Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  program->SetUniformi("RayColors", this->Tools->Rays.Colors->GetTextureUnit());
  program->SetUniformi("RayDepths", this->Tools->Rays.Depths->GetTextureUnit());
  if (hasEarlier)
  {
    program->SetUniformi("EarlierColors", targets.back()->Colors->GetTextureUnit());
    program->SetUniformi("EarlierDepths", targets.back()->Depths->GetTextureUnit());
    program->SetUniformi("EarlierSets", this->Sets);
  }
  program->SetUniformi("IsWhole", true);
  program->SetUniformf("MarkDC", 0.0F);
  mean.Render();
  for (const LookupTarget* target : targets)
  {
    target->Colors->Deactivate();
    target->Depths->Deactivate();
  }
  if (this->Sets > 0)
  {
    this->Shown = 1 - this->Shown;
  }
}

// All targets share one framebuffer object, because vtkOpenGLState confuses the draw buffers of
// two.
void LookupPicture::Begin(LookupTarget& target, bool marks)
{
  vtkOpenGLState* state = this->Window->GetState();
  this->Tools->Framebuffer->SetContext(this->Window);
  this->Tools->Framebuffer->Bind();
  this->Tools->Framebuffer->AddColorAttachment(0, target.Colors);
  this->Tools->Framebuffer->AddColorAttachment(1, target.Depths);
  this->Tools->Framebuffer->RemoveDepthAttachment();
  if (marks)
  {
    this->Tools->Framebuffer->AddDepthAttachment(target.Marks);
  }
  state->SetEnumState(GL_DEPTH_TEST, marks);
  state->vtkglDepthFunc(GL_LESS);
  this->Tools->Framebuffer->ActivateDrawBuffers(2);
  state->vtkglViewport(0, 0, target.Size[0], target.Size[1]);
  state->vtkglScissor(0, 0, target.Size[0], target.Size[1]);
  const float noColor[4] = { 0.0F, 0.0F, 0.0F, 0.0F };
  const float noDepth[4] = { UnknownDC, 0.0F, 0.0F, 0.0F };
  glClearBufferfv(GL_COLOR, 0, noColor);
  glClearBufferfv(GL_COLOR, 1, noDepth);
  if (marks)
  {
    const float noMark = 1.0F;
    glClearBufferfv(GL_DEPTH, 0, &noMark);
  }
}

// Marks pixels of the whole picture.
void LookupPicture::DrawMarks(vtkOpenGLQuadHelper& quad, float markDC)
{
  vtkShaderProgram* program = quad.Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  this->Tools->Surfaces.SetUniforms(program);
  program->SetUniformi("IsWhole", true);
  program->SetUniformf("MarkDC", markDC);
  quad.Render();
}

// Over each entry face, or each time over the whole picture.
void LookupPicture::DrawFaces(
  FieldTexture& field, vtkOpenGLQuadHelper& quad, float markDC, bool isWhole, bool offSurfaces)
{
  vtkShaderProgram* program = quad.Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  for (int face = 0; face < FaceCount; ++face)
  {
    if (this->Current.EntryFaces[face])
    {
      field.Activate(face, offSurfaces);
      field.SetUniforms(program, face);
      this->SetViewUniforms(program, face);
      program->SetUniformi("IsWhole", isWhole || this->Current.IsEyeInside);
      program->SetUniformf("MarkDC", markDC);
      quad.Render();
    }
  }
  field.Deactivate();
}

void LookupPicture::SetUniforms(vtkShaderProgram* program) const
{
  const LookupTarget& picture = this->Pictures[this->Shown];
  program->SetUniformi("PictureColor", picture.Colors->GetTextureUnit());
  program->SetUniformi("PictureDepth", picture.Depths->GetTextureUnit());
  const float viewport[2] = { static_cast<float>(this->Viewport[0]),
    static_cast<float>(this->Viewport[1]) };
  program->SetUniform2f("ViewportOrigin", viewport);
  const float pixelSize[2] = { 2.0F / static_cast<float>(this->Viewport[2]),
    2.0F / static_cast<float>(this->Viewport[3]) };
  program->SetUniform2f("PixelSizeDC", pixelSize);
  const float origin[2] = { static_cast<float>(this->Viewport[0] + this->Area[0]),
    static_cast<float>(this->Viewport[1] + this->Area[1]) };
  program->SetUniform2f("PictureOrigin", origin);
  const std::array<int, 2>& size = picture.Size;
  const float scale[2] = { static_cast<float>(size[0]) / static_cast<float>(this->Area[2]),
    static_cast<float>(size[1]) / static_cast<float>(this->Area[3]) };
  program->SetUniform2f("PictureScale", scale);
}

void LookupPicture::Deactivate()
{
  this->Pictures[this->Shown].Colors->Deactivate();
  this->Pictures[this->Shown].Depths->Deactivate();
}

void LookupPicture::Release(vtkWindow* window)
{
  for (LookupTarget& picture : this->Pictures)
  {
    picture.Release(window);
  }
  this->Window = nullptr;
}
}
