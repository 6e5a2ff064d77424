// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLookupPicture.h"

#include "cslfCubeGLSL.h"
#include "cslfFaceSpace.h"
#include "cslfFaceUniforms.h"
#include "cslfFieldGLSL.h"
#include "cslfFieldTexture.h"
#include "cslfLookupGLSL.h"
#include "cslfOpenGL.h"
#include "cslfPictureFS.h"
#include "cslfPictureVS.h"
#include "cslfSceneGridGLSL.h"

#include <vtkMatrix4x4.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace cslf
{
namespace
{
/// No picture is looked up with fewer than one pixel for so many along each side.
constexpr int MostDivisor = 4;
/// Whoever has as many seconds for a picture is not moving it.
constexpr double StillSeconds = 1.0;
/// The depth lookup's guesses come from a picture with one pixel for so many along each side.
constexpr int GuessDivisor = 4;
/// In the order of vtkCSLFMapper::LookupType.
constexpr int DepthLookup = 4;
/// The depth of pixels where nothing is seen, as in cslfPictureFS.glsl.
constexpr float NothingDC = 1.0e30F;
}

bool LookupPicture::View::operator==(const View& other) const
{
  return this->Lookup == other.Lookup && this->CCDC == other.CCDC && this->EyeCC == other.EyeCC &&
    this->IsEyeInside == other.IsEyeInside && this->EntryFaces == other.EntryFaces &&
    this->FocalPointsCC == other.FocalPointsCC;
}

LookupPicture::LookupPicture() = default;

LookupPicture::~LookupPicture() = default;

int LookupPicture::ChooseDivisor(
  const View& view, const std::array<int, 4>& viewport, double seconds) const
{
  if (seconds >= StillSeconds)
  {
    return 1;
  }
  // What the last lookup took says nothing of another one.
  if (this->PixelSeconds == 0.0 || view.Lookup != this->Current.Lookup)
  {
    return 2;
  }
  const double all = this->PixelSeconds * viewport[2] * viewport[3];
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(all / seconds))), 1, MostDivisor);
}

void LookupPicture::Draw(
  vtkOpenGLRenderWindow* window, const View& view, FieldTexture& field, double seconds)
{
  if (this->Window && this->Window != window)
  {
    vtkOpenGLRenderWindow* previous = this->Window;
    previous->MakeCurrent();
    this->Release(previous);
    window->MakeCurrent();
  }
  std::array<int, 4> viewport{};
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport.data());
  // While the view moves, all passes of a picture share what the first has looked up.
  const bool isCurrent = this->Window == window && this->Viewport == viewport &&
    this->Current == view && this->Changes == field.GetChanges() &&
    (this->Divisor == 1 || seconds < StillSeconds);
  if (!isCurrent)
  {
    const int divisor = this->ChooseDivisor(view, viewport, seconds);
    this->Window = window;
    this->Viewport = viewport;
    this->Current = view;
    this->Changes = field.GetChanges();
    this->Divisor = divisor;
    this->Size = { std::max(1, (viewport[2] + divisor - 1) / divisor),
      std::max(1, (viewport[3] + divisor - 1) / divisor) };
    this->HasGuess = view.Lookup == DepthLookup && !view.IsEyeInside &&
      field.GetField().FindChannel(DepthName) != nullptr;
    this->Allocate(field);
    this->BuildProgram(field);
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    this->DrawPicture(field);
    if (seconds < StillSeconds)
    {
      glFinish();
      this->PixelSeconds = std::chrono::duration<double>(Clock::now() - start).count() /
        (static_cast<double>(this->Size[0]) * this->Size[1]);
    }
  }
  this->Picture.Colors->Activate();
  this->Picture.Depths->Activate();
}

void LookupPicture::Target::Allocate(
  vtkOpenGLRenderWindow* window, const std::array<int, 2>& size, int colorType, bool hasMarks)
{
  this->Size = size;
  const auto width = static_cast<unsigned int>(size[0]);
  const auto height = static_cast<unsigned int>(size[1]);
  const auto allocate = [&](vtkTextureObject* texture, int type, const auto& allocateTexels)
  {
    const bool fits = texture->GetHandle() != 0 && texture->GetWidth() == width &&
      texture->GetHeight() == height && (type == VTK_VOID || texture->GetVTKDataType() == type);
    if (!fits)
    {
      texture->ReleaseGraphicsResources(window);
      texture->SetContext(window);
      texture->ResetFormatAndType();
      texture->SetMinificationFilter(vtkTextureObject::Nearest);
      texture->SetMagnificationFilter(vtkTextureObject::Nearest);
      allocateTexels();
    }
  };
  allocate(this->Colors, colorType, [&] { this->Colors->Allocate2D(width, height, 4, colorType); });
  allocate(this->Depths, VTK_FLOAT, [&] { this->Depths->Allocate2D(width, height, 1, VTK_FLOAT); });
  if (hasMarks)
  {
    allocate(this->Marks, VTK_VOID,
      [&] { this->Marks->AllocateDepth(width, height, vtkTextureObject::Fixed16); });
  }
}

void LookupPicture::Target::Release(vtkWindow* window)
{
  this->Colors->ReleaseGraphicsResources(window);
  this->Depths->ReleaseGraphicsResources(window);
  this->Marks->ReleaseGraphicsResources(window);
}

void LookupPicture::Allocate(const FieldTexture& field)
{
  this->Framebuffer->ReleaseGraphicsResources(this->Window);
  const bool isByte = field.GetField().FindChannel(ColorName)->Type == VTK_UNSIGNED_CHAR;
  const int colorType = isByte ? VTK_UNSIGNED_CHAR : VTK_FLOAT;
  this->Picture.Allocate(this->Window, this->Size, colorType, this->HasGuess);
  if (this->HasGuess)
  {
    this->Guess.Allocate(this->Window,
      { (this->Size[0] + GuessDivisor - 1) / GuessDivisor,
        (this->Size[1] + GuessDivisor - 1) / GuessDivisor },
      colorType, false);
  }
}

// Branches cost their time even where nothing takes them, so each program knows what it looks up.
void LookupPicture::BuildProgram(const FieldTexture& field)
{
  static const char* const lookups[] = { "LookupNearest", "LookupLinear", "LookupBilinear",
    "LookupFocal", "LookupDepth" };
  const bool hasDepth = field.GetField().FindChannel(DepthName) != nullptr;
  std::string fragment = cslfPictureFS;
  vtkShaderProgram::Substitute(fragment, "//CSLF::Cube::Dec", cslfCubeGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::Field::Dec", cslfFieldGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::SceneGrid::Dec", cslfSceneGridGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::Lookup::Dec",
    std::string("const bool HasDepth = ") + (hasDepth ? "true" : "false") + ";\n" + cslfLookupGLSL);
  if (this->Search && fragment == this->Source && this->Current.Lookup == this->SourceLookup &&
    (this->Check != nullptr) == this->HasGuess)
  {
    return;
  }
  this->Source = fragment;
  this->SourceLookup = this->Current.Lookup;
  const auto build = [&](const std::string& lookup)
  {
    std::string source = fragment;
    vtkShaderProgram::Substitute(source, "//CSLF::Lookup::Impl", lookup);
    return std::make_unique<vtkOpenGLQuadHelper>(this->Window, cslfPictureVS, source.c_str(), "");
  };
  this->Search = build(std::string("result = ") + lookups[this->Current.Lookup] + "(ray);");
  this->Check = this->HasGuess
    ? build("if (!LookupGuessed(ray, GuessPlane(FCDCMatrix), result)) { discard; }")
    : nullptr;
}

void LookupPicture::SetViewUniforms(vtkShaderProgram* program, int entryFace) const
{
  SetFaceUniforms(program, entryFace);
  const glm::vec3 focalPoint(CubeToFaceSpace(entryFace, this->Current.FocalPointsCC[entryFace]));
  program->SetUniform3f("FocalPointFC", &focalPoint.x);
  program->SetUniformi("IsEyeInside", this->Current.IsEyeInside);

  const glm::dvec3 eyeCC(this->Current.EyeCC);
  const glm::dvec3 eye = this->Current.EyeCC.w > 0.0
    ? CubeToFaceSpace(entryFace, eyeCC)
    : CubeToFaceSpace(entryFace, eyeCC) - CubeToFaceSpace(entryFace, glm::dvec3(0.0));
  const float eyeFC[4] = { static_cast<float>(eye.x), static_cast<float>(eye.y),
    static_cast<float>(eye.z), static_cast<float>(this->Current.EyeCC.w) };
  program->SetUniform4f("EyeFC", eyeFC);

  vtkNew<vtkMatrix4x4> ccdc;
  ccdc->DeepCopy(&this->Current.CCDC[0].x);
  vtkNew<vtkMatrix4x4> fcdc;
  for (int column = 0; column < 4; ++column)
  {
    glm::dvec3 unit(0.0);
    if (column < 3)
    {
      unit[column] = 1.0;
    }
    const glm::dvec3 origin = FaceSpaceToCube(entryFace, glm::dvec3(0.0));
    const glm::dvec3 axis = column < 3 ? FaceSpaceToCube(entryFace, unit) - origin : origin;
    const double in[4] = { axis.x, axis.y, axis.z, column < 3 ? 0.0 : 1.0 };
    double out[4];
    ccdc->MultiplyPoint(in, out);
    for (int row = 0; row < 4; ++row)
    {
      fcdc->SetElement(row, column, out[row]);
    }
  }
  // GLSL's matrices are stored by columns.
  vtkNew<vtkMatrix4x4> dcfc;
  vtkMatrix4x4::Invert(fcdc, dcfc);
  dcfc->Transpose();
  fcdc->Transpose();
  program->SetUniformMatrix("FCDCMatrix", fcdc);
  program->SetUniformMatrix("DCFCMatrix", dcfc);
  program->SetUniformf("MarkDC", this->Check && program == this->Check->Program ? -1.0F : 0.0F);
  if (this->Check && program == this->Check->Program)
  {
    const float size[2] = { static_cast<float>(this->Size[0]), static_cast<float>(this->Size[1]) };
    program->SetUniformi("GuessDepth", this->Guess.Depths->GetTextureUnit());
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
  if (this->HasGuess)
  {
    this->Begin(this->Guess, false);
    this->DrawFaces(field, *this->Search);
    this->Guess.Depths->Activate();
    this->Begin(this->Picture, true);
    // What the guess does not hold for is searched: early depth tests spare all else.
    state->vtkglEnable(GL_DEPTH_TEST);
    this->DrawFaces(field, *this->Check);
    this->DrawFaces(field, *this->Search);
    this->Guess.Depths->Deactivate();
  }
  else
  {
    this->Begin(this->Picture, false);
    this->DrawFaces(field, *this->Search);
  }
  state->PopFramebufferBindings();
}

// All targets share one framebuffer object: vtkOpenGLState takes the draw buffers of two for the
// same.
void LookupPicture::Begin(Target& target, bool marks)
{
  vtkOpenGLState* state = this->Window->GetState();
  this->Framebuffer->SetContext(this->Window);
  this->Framebuffer->Bind();
  this->Framebuffer->AddColorAttachment(0, target.Colors);
  this->Framebuffer->AddColorAttachment(1, target.Depths);
  this->Framebuffer->RemoveDepthAttachment();
  if (marks)
  {
    this->Framebuffer->AddDepthAttachment(target.Marks);
  }
  this->Framebuffer->ActivateDrawBuffers(2);
  state->vtkglViewport(0, 0, target.Size[0], target.Size[1]);
  state->vtkglScissor(0, 0, target.Size[0], target.Size[1]);
  const float noColor[4] = { 0.0F, 0.0F, 0.0F, 0.0F };
  const float noDepth[4] = { NothingDC, 0.0F, 0.0F, 0.0F };
  glClearBufferfv(GL_COLOR, 0, noColor);
  glClearBufferfv(GL_COLOR, 1, noDepth);
  if (marks)
  {
    const float noMark = 1.0F;
    glClearBufferfv(GL_DEPTH, 0, &noMark);
  }
}

void LookupPicture::DrawFaces(FieldTexture& field, vtkOpenGLQuadHelper& quad)
{
  vtkShaderProgram* program = quad.Program;
  this->Window->GetShaderCache()->ReadyShaderProgram(program);
  for (int face = 0; face < FaceCount; ++face)
  {
    if (this->Current.EntryFaces[face])
    {
      field.Activate(face);
      field.SetUniforms(program, face);
      this->SetViewUniforms(program, face);
      quad.Render();
    }
  }
  field.Deactivate();
}

void LookupPicture::SetUniforms(vtkShaderProgram* program) const
{
  program->SetUniformi("PictureColor", this->Picture.Colors->GetTextureUnit());
  program->SetUniformi("PictureDepth", this->Picture.Depths->GetTextureUnit());
  const float origin[2] = { static_cast<float>(this->Viewport[0]),
    static_cast<float>(this->Viewport[1]) };
  program->SetUniform2f("PictureOrigin", origin);
  const float scale[2] = { static_cast<float>(this->Size[0]) /
      static_cast<float>(this->Viewport[2]),
    static_cast<float>(this->Size[1]) / static_cast<float>(this->Viewport[3]) };
  program->SetUniform2f("PictureScale", scale);
  const float pixelSize[2] = { 2.0F / static_cast<float>(this->Viewport[2]),
    2.0F / static_cast<float>(this->Viewport[3]) };
  program->SetUniform2f("PixelSizeDC", pixelSize);
}

void LookupPicture::Deactivate()
{
  this->Picture.Colors->Deactivate();
  this->Picture.Depths->Deactivate();
}

void LookupPicture::Release(vtkWindow* window)
{
  if (this->Window && this->Window == window)
  {
    this->Search.reset();
    this->Check.reset();
    this->Framebuffer->ReleaseGraphicsResources(window);
    this->Picture.Release(window);
    this->Guess.Release(window);
    this->Window = nullptr;
  }
}
}
