// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLookupTools.h"

#include "cslfColorGLSL.h"
#include "cslfCubeGLSL.h"
#include "cslfDescription.h"
#include "cslfEncodingGLSL.h"
#include "cslfEntryGLSL.h"
#include "cslfFieldGLSL.h"
#include "cslfFlatUniforms.h"
#include "cslfGeometryFS.h"
#include "cslfGeometryVS.h"
#include "cslfGuessGLSL.h"
#include "cslfLookupConstantsGLSL.h"
#include "cslfLookupGLSL.h"
#include "cslfMeanFS.h"
#include "cslfNormalsGLSL.h"
#include "cslfOpenGL.h"
#include "cslfPictureFS.h"
#include "cslfPictureVS.h"
#include "cslfSceneGridGLSL.h"
#include "cslfSurfaceFS.h"
#include "cslfSurfaceGLSL.h"
#include "cslfToneMappingGLSL.h"
#include "vtkCSLFMapper.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vtkDataArray.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLIndexBufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

namespace cslf
{
namespace
{
/// Whether the near side of the display may cut the mesh open.
bool IsCut(const DisplayRows& ccdc, const GeometryMesh& mesh)
{
  const glm::dvec3 ends[] = { mesh.MinimumCC, mesh.MaximumCC };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec4 point(
      ends[corner & 1].x, ends[corner >> 1 & 1].y, ends[corner >> 2 & 1].z, 1.0);
    if (glm::dot(ccdc[2] + ccdc[3], point) < 0.0)
    {
      return true;
    }
  }
  return false;
}

void AllocateColors(
  vtkTextureObject* texture, unsigned int width, unsigned int height, ColorSteps steps)
{
  if (steps == ColorSteps::Halves)
  {
    texture->SetInternalFormat(GL_RGBA16F);
  }
  texture->Allocate2D(width, height, 4, steps == ColorSteps::Bytes ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
}

/// Frees a texture's memory, to be allocated again.
void Renew(vtkTextureObject* texture, vtkOpenGLRenderWindow* window, int filter)
{
  texture->ReleaseGraphicsResources(window);
  texture->SetContext(window);
  texture->ResetFormatAndType();
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
}

/// Whether what is counterclockwise appears clockwise. Display coordinates are left-handed.
bool IsMirrored(const DisplayRows& ccdc)
{
  return glm::determinant(glm::dmat4(ccdc[0], ccdc[1], ccdc[2], ccdc[3])) > 0.0;
}
}

SurfacePicture::SurfacePicture() = default;

SurfacePicture::~SurfacePicture() = default;

void SurfacePicture::Allocate(vtkOpenGLRenderWindow* window, const LookupTarget& target)
{
  const auto width = static_cast<unsigned int>(target.Size[0]);
  const auto height = static_cast<unsigned int>(target.Size[1]);
  const bool fits = this->Points->GetHandle() != 0 && this->Points->GetWidth() == width &&
    this->Points->GetHeight() == height && this->Steps == target.Steps;
  if (!fits)
  {
    this->Steps = target.Steps;
    Renew(this->Points, window, vtkTextureObject::Nearest);
    this->Points->Allocate2D(width, height, 4, VTK_FLOAT);
    Renew(this->Colors, window, vtkTextureObject::Nearest);
    AllocateColors(this->Colors, width, height, this->Steps);
  }
  this->AllocateDepths(window, target.Size);
}

void SurfacePicture::AllocateDepths(vtkOpenGLRenderWindow* window, const std::array<int, 2>& size)
{
  const auto width = static_cast<unsigned int>(size[0]);
  const auto height = static_cast<unsigned int>(size[1]);
  const bool fits = this->Depths->GetHandle() != 0 && this->Depths->GetWidth() == width &&
    this->Depths->GetHeight() == height;
  if (!fits)
  {
    Renew(this->Depths, window, vtkTextureObject::Nearest);
    this->Depths->AllocateDepth(width, height, vtkTextureObject::Float32);
  }
}

void SurfacePicture::Upload(vtkOpenGLRenderWindow* window)
{
  this->Spheres.Upload(window, this->Mesh->Balls);
  this->PointBuffer->Upload(&this->Mesh->PointsCC.front().x, 3 * this->Mesh->PointsCC.size(),
    vtkOpenGLBufferObject::ArrayBuffer);
  this->ColorBuffer->Upload(&this->Mesh->Colors.front().x, 4 * this->Mesh->Colors.size(),
    vtkOpenGLBufferObject::ArrayBuffer);
  if (!this->Mesh->BackColors.empty())
  {
    this->BackColorBuffer->Upload(&this->Mesh->BackColors.front().x,
      4 * this->Mesh->BackColors.size(), vtkOpenGLBufferObject::ArrayBuffer);
  }
  std::vector<std::uint32_t> corners = this->Mesh->Corners;
  corners.insert(corners.end(), this->Mesh->BallCorners.begin(), this->Mesh->BallCorners.end());
  this->Triangles.IBO->Upload(corners, vtkOpenGLBufferObject::ElementArrayBuffer);
  this->Triangles.IBO->IndexCount = corners.size();
  this->CoarseTriangles->IndexCount = 0;
}

void SurfacePicture::UploadMaps(vtkOpenGLRenderWindow* window, const ShownMaps* earlier)
{
  const GeometryMesh& mesh = *this->Mesh;
  this->Spheres.Paint(mesh.Balls, { mesh.Colors, mesh.Mapped, this->Maps.get() });
  if (!this->Maps)
  {
    return;
  }
  if (!earlier || !this->Maps->HasPlacesOf(*earlier))
  {
    const std::vector<glm::vec3> places = this->Maps->ListPlaces(mesh.Mapped);
    this->PlaceBuffer->Upload(
      &places.front().x, 3 * places.size(), vtkOpenGLBufferObject::ArrayBuffer);
  }
  std::vector<glm::vec4> image = this->Maps->GetImage();
  Renew(this->MapColors, window, vtkTextureObject::Nearest);
  this->MapColors->Create2DFromRaw(static_cast<unsigned int>(this->Maps->GetWidth()),
    static_cast<unsigned int>(this->Maps->GetHeight()), 4, VTK_FLOAT, image.data());
  const std::vector<MapImage::Pixel>& pixels = this->Maps->GetPixels();
  if (!pixels.empty() && !(earlier && earlier->GetPixels() == pixels))
  {
    std::vector<MapImage::Pixel> copy = pixels; // VTK wants them to be variable
    Renew(this->MapPixels, window, vtkTextureObject::Nearest);
    this->MapPixels->Create2DFromRaw(static_cast<unsigned int>(this->Maps->GetPixelWidth()),
      static_cast<unsigned int>(this->Maps->GetPixelHeight()), 4, VTK_UNSIGNED_CHAR, copy.data());
  }
}

void SurfacePicture::Build(vtkOpenGLRenderWindow* window)
{
  const bool hasBackColors = !this->Mesh->BackColors.empty();
  const std::string options = std::string(hasBackColors ? "#define BACK_COLORS\n" : "") +
    (this->Mesh->IsBright ? "#define BRIGHT\n" : "") +
    (this->Mesh->IsAlone ? "#define ALONE\n" : "") + (this->Maps ? "#define COLOR_MAPS\n" : "") +
    (this->Maps && !this->Maps->GetPixels().empty() ? "#define IMAGES\n" : "") +
    (this->Maps && this->Mesh->IsLinear ? "#define LINEAR_COLOR\n" : "") +
    (this->Planes > 0 ? "#define CLIPPING_PLANES " + std::to_string(this->Planes) : "");
  std::string vertex = cslfGeometryVS;
  std::string fragment = cslfGeometryFS;
  vtkShaderProgram::Substitute(vertex, "//CSLF::Options::Dec", options);
  vtkShaderProgram::Substitute(fragment, "//CSLF::Options::Dec", options);
  vtkShaderProgram::Substitute(fragment, "//CSLF::Normals::Dec", cslfNormalsGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::Encoding::Dec", cslfEncodingGLSL);
  this->Triangles.Program =
    window->GetShaderCache()->ReadyShaderProgram(vertex.c_str(), fragment.c_str(), "");
  this->Triangles.VAO->Bind();
  this->PointBuffer->Bind();
  this->Triangles.VAO->AddAttributeArray(this->Triangles.Program, this->PointBuffer, "vertexCC", 0,
    3 * sizeof(float), VTK_FLOAT, 3, false);
  this->Triangles.VAO->AddAttributeArray(this->Triangles.Program, this->ColorBuffer, "vertexColor",
    0, 4 * sizeof(float), VTK_FLOAT, 4, false);
  if (hasBackColors)
  {
    this->Triangles.VAO->AddAttributeArray(this->Triangles.Program, this->BackColorBuffer,
      "vertexBackColor", 0, 4 * sizeof(float), VTK_FLOAT, 4, false);
  }
  if (this->Maps)
  {
    this->Triangles.VAO->AddAttributeArray(this->Triangles.Program, this->PlaceBuffer,
      "vertexPlace", 0, 3 * sizeof(float), VTK_FLOAT, 3, false);
  }
}

void SurfacePicture::Prepare(
  vtkOpenGLRenderWindow* window, const std::shared_ptr<const GeometryMesh>& mesh, const View& view)
{
  const bool isNew = std::exchange(this->Mesh, mesh) != mesh;
  const auto earlier = std::exchange(this->Maps, view.Maps);
  if (isNew)
  {
    this->Upload(window);
  }
  if (isNew || this->Maps != earlier)
  {
    this->UploadMaps(window, isNew ? nullptr : earlier.get());
  }
  if (isNew || !this->Triangles.Program || this->Planes != view.PlanesCC.size())
  {
    this->Planes = view.PlanesCC.size();
    this->Triangles.VAO->ReleaseGraphicsResources();
    this->Build(window);
  }
  window->GetShaderCache()->ReadyShaderProgram(this->Triangles.Program);
}

void SurfacePicture::Draw(vtkOpenGLRenderWindow* window, vtkOpenGLFramebufferObject* framebuffer,
  const std::shared_ptr<const GeometryMesh>& mesh, const View& view, const LookupTarget& target)
{
  this->Allocate(window, target);
  this->Prepare(window, mesh, view);
  framebuffer->SetContext(window);
  framebuffer->Bind();
  framebuffer->AddColorAttachment(0, this->Points);
  framebuffer->AddColorAttachment(1, this->Colors);
  framebuffer->ActivateDrawBuffers(2);
  this->ClearDepths(window, framebuffer, target.Size);
  const float nothing[4] = { 0.0F, 0.0F, 0.0F, 0.0F };
  glClearBufferfv(GL_COLOR, 0, nothing);
  this->DrawMesh(window, view);
}

void SurfacePicture::DrawAlone(vtkOpenGLRenderWindow* window,
  vtkOpenGLFramebufferObject* framebuffer, const std::shared_ptr<const GeometryMesh>& mesh,
  const View& view, const LookupTarget& target)
{
  this->AllocateDepths(window, target.Size);
  this->Prepare(window, mesh, view);
  this->ClearDepths(window, framebuffer, target.Size);
  this->DrawMesh(window, view);
}

void SurfacePicture::ClearDepths(vtkOpenGLRenderWindow* window,
  vtkOpenGLFramebufferObject* framebuffer, const std::array<int, 2>& size)
{
  vtkOpenGLState* state = window->GetState();
  framebuffer->RemoveDepthAttachment();
  framebuffer->AddDepthAttachment(this->Depths);
  state->vtkglViewport(0, 0, size[0], size[1]);
  state->vtkglScissor(0, 0, size[0], size[1]);
  const float farthest = 1.0F;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void SurfacePicture::DrawMesh(vtkOpenGLRenderWindow* window, const View& view)
{
  vtkOpenGLState* state = window->GetState();
  state->vtkglEnable(GL_DEPTH_TEST);
  vtkShaderProgram* program = this->Triangles.Program;
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(&view.CCDC[0].x);
  matrix->Transpose(); // GLSL's matrices are stored by columns.
  program->SetUniformMatrix("CCDCMatrix", matrix);
  if (!this->Mesh->BackColors.empty())
  {
    program->SetUniformi("IsMirrored", IsMirrored(view.CCDC) ? 1 : 0);
  }
  std::vector<std::array<float, 4>> planes;
  planes.reserve(view.PlanesCC.size());
  for (const glm::dvec4& planeCC : view.PlanesCC)
  {
    const glm::vec4 plane(planeCC);
    planes.push_back({ plane.x, plane.y, plane.z, plane.w });
  }
  if (!planes.empty())
  {
    program->SetUniform4fv("ClippingPlanesCC", static_cast<int>(planes.size()),
      reinterpret_cast<const float(*)[4]>(planes.data()));
  }
  if (this->Maps)
  {
    this->MapColors->Activate();
    program->SetUniformi("MapColors", this->MapColors->GetTextureUnit());
    if (!this->Maps->GetPixels().empty())
    {
      this->MapPixels->Activate();
      program->SetUniformi("MapPixels", this->MapPixels->GetTextureUnit());
    }
  }
  const bool isWhole = !view.IsEyeInside && view.PlanesCC.empty() && !IsCut(view.CCDC, *this->Mesh);
  this->DrawTriangles(state, view.Level, isWhole && !IsMirrored(view.CCDC), !isWhole);
  if (this->Maps)
  {
    this->MapColors->Deactivate();
    if (!this->Maps->GetPixels().empty())
    {
      this->MapPixels->Deactivate();
    }
  }
  if (isWhole)
  {
    this->Spheres.Draw(window, view.CCDC, view.EyeCC, view.Level);
  }
  state->vtkglDisable(GL_DEPTH_TEST);
}

// Half of the triangles of closed parts face away from the eye.
void SurfacePicture::DrawTriangles(
  vtkOpenGLState* state, std::size_t level, bool hidesBacks, bool showsBalls)
{
  this->Triangles.VAO->Bind();
  const bool isCoarse = this->Mesh->IsCoarse(level);
  if (isCoarse && this->CoarseTriangles->IndexCount == 0)
  {
    const std::vector<std::uint32_t>& corners = this->Mesh->FindLevels()->Corners;
    this->CoarseTriangles->Upload(corners, vtkOpenGLBufferObject::ElementArrayBuffer);
    this->CoarseTriangles->IndexCount = corners.size();
  }
  vtkOpenGLIndexBufferObject* buffer = isCoarse ? this->CoarseTriangles.Get() : this->Triangles.IBO;
  buffer->Bind();
  const MeshLevel drawn = this->Mesh->GetLevel(level);
  const std::size_t closed = hidesBacks ? drawn.ClosedEnd : drawn.First;
  const auto draw = [](std::size_t first, std::size_t end)
  {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(end - first), GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
  };
  state->vtkglCullFace(GL_BACK);
  state->vtkglEnable(GL_CULL_FACE);
  draw(drawn.First, closed);
  state->vtkglDisable(GL_CULL_FACE);
  draw(closed, drawn.End);
  buffer->Release();
  if (showsBalls)
  {
    this->Triangles.IBO->Bind();
    draw(this->Mesh->Corners.size(), this->Triangles.IBO->IndexCount);
    this->Triangles.IBO->Release();
  }
  this->Triangles.VAO->Release();
}

void SurfacePicture::Activate()
{
  this->Points->Activate();
  this->Colors->Activate();
}

void SurfacePicture::Deactivate()
{
  this->Points->Deactivate();
  this->Colors->Deactivate();
}

void SurfacePicture::SetUniforms(vtkShaderProgram* program) const
{
  program->SetUniformi("SurfacePoints", this->Points->GetTextureUnit());
  program->SetUniformi("SurfaceColors", this->Colors->GetTextureUnit());
}

void SurfacePicture::Release(vtkWindow* window)
{
  this->Points->ReleaseGraphicsResources(window);
  this->Colors->ReleaseGraphicsResources(window);
  this->Depths->ReleaseGraphicsResources(window);
  this->MapColors->ReleaseGraphicsResources(window);
  this->MapPixels->ReleaseGraphicsResources(window);
  this->PlaceBuffer->ReleaseGraphicsResources();
  this->PointBuffer->ReleaseGraphicsResources();
  this->ColorBuffer->ReleaseGraphicsResources();
  this->BackColorBuffer->ReleaseGraphicsResources();
  this->Triangles.ReleaseGraphicsResources(window);
  this->CoarseTriangles->ReleaseGraphicsResources();
  this->Spheres.Release(window);
  this->Triangles.Program = nullptr;
  this->Mesh.reset();
  this->Maps.reset();
}

void LookupTarget::Allocate(
  vtkOpenGLRenderWindow* window, const std::array<int, 2>& size, ColorSteps steps, bool hasMarks)
{
  this->Size = size;
  const auto width = static_cast<unsigned int>(size[0]);
  const auto height = static_cast<unsigned int>(size[1]);
  const auto allocate =
    [&](vtkTextureObject* texture, bool isOfType, int filter, const auto& allocateTexels)
  {
    const bool fits = texture->GetHandle() != 0 && texture->GetWidth() == width &&
      texture->GetHeight() == height && isOfType;
    if (!fits)
    {
      Renew(texture, window, filter);
      allocateTexels();
    }
  };
  allocate(this->Colors, this->Steps == steps, vtkTextureObject::Linear,
    [&]
    {
      AllocateColors(this->Colors, width, height, steps);
      this->Steps = steps;
    });
  allocate(this->Depths, true, vtkTextureObject::Nearest,
    [&] { this->Depths->Allocate2D(width, height, 1, VTK_FLOAT); });
  if (hasMarks)
  {
    allocate(this->Marks, true, vtkTextureObject::Nearest,
      [&] { this->Marks->AllocateDepth(width, height, vtkTextureObject::Fixed16); });
  }
}

void LookupTarget::Release(vtkWindow* window)
{
  this->Colors->ReleaseGraphicsResources(window);
  this->Depths->ReleaseGraphicsResources(window);
  this->Marks->ReleaseGraphicsResources(window);
}

std::int64_t LookupTarget::GetBytes() const
{
  if (this->Colors->GetHandle() == 0)
  {
    return 0;
  }
  const std::int64_t color = this->Steps == ColorSteps::Bytes ? 4
    : this->Steps == ColorSteps::Halves                       ? 8
                                                              : 16;
  const std::int64_t mark = this->Marks->GetHandle() != 0 ? 2 : 0;
  return (color + static_cast<std::int64_t>(sizeof(float)) + mark) * this->Size[0] * this->Size[1];
}

LookupTools::LookupTools() = default;

LookupTools::~LookupTools() = default;

bool LookupTools::Method::operator==(const Method& other) const
{
  return this->Lookup == other.Lookup && this->IsSearched == other.IsSearched &&
    this->IsOnGeometry == other.IsOnGeometry && this->IsOpaque == other.IsOpaque &&
    this->IsAlone == other.IsAlone;
}

// Branches cost time even if they are not taken, so each program has only its own lookup.
void LookupTools::Build(
  vtkOpenGLRenderWindow* window, const Method& method, const Description& field)
{
  const bool hasDepth = field.FindChannel(KnownChannel::Depth) != nullptr;
  const bool isLinear = field.FindChannel(KnownChannel::Color)->Encoding == LinearEncoding;
  // Indexed by vtkCSLFMapper::LookupType. The last two are for fields without depth; others are
  // searched.
  static const char* const lookups[] = { "LookupNearest", "LookupLinear", "LookupBilinear",
    "LookupFocal", "LookupFocal", "LookupFocal" };
  static_assert(
    std::size(lookups) == vtkCSLFMapper::NUMBER_OF_LOOKUPS, "each lookup needs a function");
  const bool showsEnvironment = field.MayShowEnvironment();
  const std::array<bool, 3> traits{ hasDepth, isLinear, showsEnvironment };
  if (this->IsBuilt && method == this->Built && traits == this->BuiltFor)
  {
    return;
  }
  this->Built = method;
  this->BuiltFor = traits;
  const std::string functions = std::string(cslfLookupConstantsGLSL) + cslfEntryGLSL +
    cslfCubeGLSL + cslfFieldGLSL + cslfSceneGridGLSL + cslfLookupGLSL + cslfGuessGLSL +
    cslfColorGLSL;
  const auto build =
    [&](std::string fragment, const std::string& lookup, const std::string& more = std::string())
  {
    vtkShaderProgram::Substitute(fragment, "//CSLF::Options::Dec",
      "#define LOOKUP " + lookup + (hasDepth ? "\n#define HAS_DEPTH" : "") +
        (showsEnvironment ? "\n#define SHOWS_ENVIRONMENT" : "") + more);
    std::string vertex = cslfPictureVS;
    if (ReadsUniformsByLane())
    {
      HandUniformsOn(vertex, fragment);
    }
    return std::make_unique<vtkOpenGLQuadHelper>(window, vertex.c_str(), fragment.c_str(), "");
  };
  std::string ray = cslfPictureFS;
  vtkShaderProgram::Substitute(ray, "//CSLF::Lookup::Dec", functions);
  this->ReleasePrograms();
  this->IsBuilt = true;
  if (method.IsOnGeometry && !method.IsAlone)
  {
    std::string point = cslfSurfaceFS;
    vtkShaderProgram::Substitute(
      point, "//CSLF::Lookup::Dec", functions + cslfNormalsGLSL + cslfSurfaceGLSL);
    this->OnSurface = build(point, "LookupOwn", "\n#define ONLY_MARK");
    this->Exact = build(point, "LookupExact", "\n#define ANY_FACE");
    this->Near = build(point, "LookupNear");
    this->Far = build(point, "LookupFar");
    this->Other = build(point, "LookupFar", "\n#define OTHER_FACE");
    this->Own = build(point, "LookupOwn", "\n#define ANY_FACE");
    this->Miss = build(ray, "LookupEmpty");
    if (method.IsOpaque)
    {
      std::string front = cslfPictureFS;
      vtkShaderProgram::Substitute(
        front, "//CSLF::Lookup::Dec", functions + cslfNormalsGLSL + cslfSurfaceGLSL);
      this->Front = build(front, "LookupInFront");
      this->Close = build(front, "LookupClose");
      this->Around = build(ray, "LookupAround");
    }
  }
  else if (method.IsSearched && !method.IsAlone)
  {
    this->GuessSearch = build(ray, "LookupGuess", "\n#define DEPTH_ONLY");
    this->Miss = build(ray, "LookupMiss");
    this->Check = build(ray, "LookupGuessed");
  }
  if (!method.IsAlone)
  {
    this->Search = build(ray, method.IsSearched ? "LookupSeen" : lookups[method.Lookup]);
  }
  if (method.IsSearched && !method.IsAlone)
  {
    this->Rest = build(ray, "LookupUnseen");
  }
}

vtkOpenGLQuadHelper& LookupTools::GetMean(
  vtkOpenGLRenderWindow* window, int raysPerSide, bool hasEarlier)
{
  std::unique_ptr<vtkOpenGLQuadHelper>& mean = this->Means[{ raysPerSide, hasEarlier }];
  if (!mean)
  {
    std::string fragment = cslfMeanFS;
    const bool isLinear = this->BuiltFor[1];
    vtkShaderProgram::Substitute(fragment, "//CSLF::Options::Dec",
      "#define RAYS_PER_SIDE " + std::to_string(raysPerSide) +
        (hasEarlier ? "\n#define HAS_EARLIER" : "") + (isLinear ? "\n#define LINEAR_COLOR" : ""));
    vtkShaderProgram::Substitute(fragment, "//CSLF::Constants::Dec", cslfLookupConstantsGLSL);
    vtkShaderProgram::Substitute(fragment, "//CSLF::ToneMapping::Dec", cslfToneMappingGLSL);
    vtkShaderProgram::Substitute(fragment, "//CSLF::Encoding::Dec", cslfEncodingGLSL);
    mean = std::make_unique<vtkOpenGLQuadHelper>(window, cslfPictureVS, fragment.c_str(), "");
  }
  return *mean;
}

void LookupTools::ReleasePrograms()
{
  for (auto* program : { &this->Search, &this->Miss, &this->Check, &this->GuessSearch, &this->Rest,
         &this->OnSurface, &this->Front, &this->Close, &this->Around, &this->Exact, &this->Near,
         &this->Far, &this->Other, &this->Own })
  {
    program->reset();
  }
  this->Means.clear();
  this->IsBuilt = false;
}

void LookupTools::Release(vtkWindow* window)
{
  this->ReleasePrograms();
  this->Surfaces.Release(window);
  this->Framebuffer->ReleaseGraphicsResources(window);
  this->Rays.Release(window);
  this->Guess.Release(window);
}
}
