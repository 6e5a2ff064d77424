// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLookupTools.h"

#include "cslfColorGLSL.h"
#include "cslfCubeGLSL.h"
#include "cslfDescription.h"
#include "cslfEntryGLSL.h"
#include "cslfFieldGLSL.h"
#include "cslfFlatUniforms.h"
#include "cslfGuessGLSL.h"
#include "cslfLookupConstantsGLSL.h"
#include "cslfLookupGLSL.h"
#include "cslfMeanFS.h"
#include "cslfNormalsGLSL.h"
#include "cslfPictureFS.h"
#include "cslfPictureVS.h"
#include "cslfSceneGridGLSL.h"
#include "cslfSurfaceFS.h"
#include "cslfSurfaceGLSL.h"
#include "cslfToneMappingGLSL.h"
#include "vtkCSLFMapper.h"

#include <vtkDataArray.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <iterator>
#include <string>

namespace cslf
{
void LookupTarget::Allocate(
  vtkOpenGLRenderWindow* window, const std::array<int, 2>& size, int colorType, bool hasMarks)
{
  this->Size = size;
  const auto width = static_cast<unsigned int>(size[0]);
  const auto height = static_cast<unsigned int>(size[1]);
  const auto allocate =
    [&](vtkTextureObject* texture, int type, int filter, const auto& allocateTexels)
  {
    const bool fits = texture->GetHandle() != 0 && texture->GetWidth() == width &&
      texture->GetHeight() == height && (type == VTK_VOID || texture->GetVTKDataType() == type);
    if (!fits)
    {
      texture->ReleaseGraphicsResources(window);
      texture->SetContext(window);
      texture->ResetFormatAndType();
      texture->SetMinificationFilter(filter);
      texture->SetMagnificationFilter(filter);
      texture->SetWrapS(vtkTextureObject::ClampToEdge);
      texture->SetWrapT(vtkTextureObject::ClampToEdge);
      allocateTexels();
    }
  };
  allocate(this->Colors, colorType, vtkTextureObject::Linear,
    [&] { this->Colors->Allocate2D(width, height, 4, colorType); });
  allocate(this->Depths, VTK_FLOAT, vtkTextureObject::Nearest,
    [&] { this->Depths->Allocate2D(width, height, 1, VTK_FLOAT); });
  if (hasMarks)
  {
    allocate(this->Marks, VTK_VOID, vtkTextureObject::Nearest,
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
  const std::int64_t color = 4 * vtkDataArray::GetDataTypeSize(this->Colors->GetVTKDataType());
  const std::int64_t mark = this->Marks->GetHandle() != 0 ? 2 : 0;
  return (color + static_cast<std::int64_t>(sizeof(float)) + mark) * this->Size[0] * this->Size[1];
}

LookupTools::LookupTools() = default;

LookupTools::~LookupTools() = default;

bool LookupTools::Method::operator==(const Method& other) const
{
  return this->Lookup == other.Lookup && this->IsSearched == other.IsSearched &&
    this->IsOnGeometry == other.IsOnGeometry && this->IsOpaque == other.IsOpaque;
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
  if (this->Search && method == this->Built && traits == this->BuiltFor)
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
  if (method.IsOnGeometry)
  {
    std::string point = cslfSurfaceFS;
    vtkShaderProgram::Substitute(
      point, "//CSLF::Lookup::Dec", functions + cslfNormalsGLSL + cslfSurfaceGLSL);
    this->OnSurface = build(point, "LookupOwn", "\n#define ONLY_MARK");
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
  else if (method.IsSearched)
  {
    this->GuessSearch = build(ray, "LookupGuess", "\n#define DEPTH_ONLY");
    this->Miss = build(ray, "LookupMiss");
    this->Check = build(ray, "LookupGuessed");
  }
  this->Search = build(ray, method.IsSearched ? "LookupSeen" : lookups[method.Lookup]);
  if (method.IsSearched)
  {
    this->Rest = build(ray, "LookupUnseen");
  }
  std::string mean = cslfMeanFS;
  vtkShaderProgram::Substitute(mean, "//CSLF::Constants::Dec", cslfLookupConstantsGLSL);
  vtkShaderProgram::Substitute(mean, "//CSLF::ToneMapping::Dec", cslfToneMappingGLSL);
  this->Mean = build(mean, "", isLinear ? "\n#define LINEAR_COLOR" : "");
}

void LookupTools::ReleasePrograms()
{
  for (auto* program : { &this->Search, &this->Miss, &this->Check, &this->GuessSearch, &this->Rest,
         &this->Mean, &this->OnSurface, &this->Front, &this->Close, &this->Around, &this->Near,
         &this->Far, &this->Other, &this->Own })
  {
    program->reset();
  }
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
