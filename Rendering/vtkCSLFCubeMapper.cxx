// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFCubeMapper.h"

#include "cslfFlatUniforms.h"
#include "cslfGeometryMesh.h"
#include "cslfLookupConstantsGLSL.h"
#include "cslfMapperFS.h"
#include "cslfMapperVS.h"
#include "cslfOpenGL.h"
#include "cslfToneMappingGLSL.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkCuller.h>
#include <vtkCullerCollection.h>
#include <vtkFloatArray.h>
#include <vtkFrustumCoverageCuller.h>
#include <vtkInformation.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLActor.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLIndexBufferObject.h>
#include <vtkOpenGLRenderPass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <string>

namespace
{
constexpr const char* FaceName = "face";

/// The share of a picture's time for uploading samples to graphics memory, and its limits in
/// seconds: a few milliseconds while something moves.
constexpr double UploadShare = 0.1;
constexpr double MinimumUpload = 0.002;
constexpr double MaximumUpload = 0.05;

/// Pixels along each side of a picture that is drawn to compile programs: enough for all programs
/// of a large one.
constexpr int CompilingSize = 16;
/// CoveragePass of cslfMapperFS.glsl.
constexpr int AllCoverage = 0;
constexpr int FullCoverage = 1;
constexpr int PartialCoverage = 2;

// The cube as six quads, with each point's face as a vertex attribute.
vtkSmartPointer<vtkPolyData> MakeCube(const cslf::Cube& box)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> faces;
  faces->SetName(FaceName);
  vtkNew<vtkCellArray> quads;
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    quads->InsertNextCell(4);
    for (const glm::dvec2& corner :
      { glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1) })
    {
      const glm::dvec3 pointCC = cslf::FaceToCube(face, corner);
      const glm::dvec3 pointWC = box.PointToWorld(pointCC);
      quads->InsertCellPoint(points->InsertNextPoint(pointWC.x, pointWC.y, pointWC.z));
      faces->InsertNextValue(static_cast<float>(face));
    }
  }
  auto cube = vtkSmartPointer<vtkPolyData>::New();
  cube->SetPoints(points);
  cube->SetPolys(quads);
  cube->GetPointData()->AddArray(faces);
  return cube;
}
}

vtkStandardNewMacro(vtkCSLFCubeMapper);

//------------------------------------------------------------------------------
vtkCSLFCubeMapper::vtkCSLFCubeMapper()
{
  this->ScalarVisibilityOff();
  this->MapDataArrayToVertexAttribute(
    FaceName, FaceName, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
}

//------------------------------------------------------------------------------
vtkCSLFCubeMapper::~vtkCSLFCubeMapper()
{
  if (this->Window)
  {
    this->ReleaseGraphicsResources(this->Window);
  }
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::SetStore(const std::shared_ptr<cslf::FieldStore>& store)
{
  this->Store = store;
  this->TextureFailed = false;
  this->Texture.SetStore(store);
  this->SetInputDataObject(MakeCube(store->GetDescription().Box));
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texture.Release(window);
  this->Views.Release(window);
  this->Tools.Release(window);
  this->Drawn = nullptr;
  this->SetWindow(nullptr);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
// The window tells when its frames begin and end.
void vtkCSLFCubeMapper::SetWindow(vtkRenderWindow* window)
{
  if (this->Window == window)
  {
    return;
  }
  constexpr unsigned long events[] = { vtkCommand::StartEvent, vtkCommand::EndEvent };
  for (std::size_t i = 0; i < this->Observers.size(); ++i)
  {
    if (this->Window)
    {
      this->Window->RemoveObserver(this->Observers[i]);
    }
    this->Observers[i] =
      window ? window->AddObserver(events[i], this, &vtkCSLFCubeMapper::HandleFrame) : 0;
  }
  this->Window = window;
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::HandleFrame(vtkObject*, unsigned long event, void*)
{
  if (event == vtkCommand::StartEvent)
  {
    this->Views.BeginFrame(this->Window);
    this->Drawn = nullptr;
  }
  else
  {
    this->Views.EndFrame(this->Window);
  }
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::RenderPieceStart(vtkRenderer* renderer, vtkActor* actor)
{
  this->SetWindow(renderer->GetRenderWindow());
  if (!actor->IsRenderingTranslucentPolygonalGeometry())
  {
    this->DrawnAtOnce =
      this->ChooseCoveragePass(renderer, actor) == FullCoverage && IsLastProp(renderer, actor);
  }
  this->UpdateCamera(renderer, actor);
  this->UpdateTexture(renderer, actor);
  this->Superclass::RenderPieceStart(renderer, actor);
}

//------------------------------------------------------------------------------
// Loads what the camera can use, but nothing between the two passes of one picture.
void vtkCSLFCubeMapper::UpdateTexture(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (this->TextureFailed)
  {
    return;
  }
  cslf::TexturePace pace;
  pace.Limit = this->TextureMemoryLimit;
  pace.Waits = !this->Streaming;
  pace.Seconds =
    std::clamp(UploadShare * actor->GetAllocatedRenderTime(), MinimumUpload, MaximumUpload);
  pace.Keeps = this->ChooseCoveragePass(renderer, actor) == PartialCoverage;
  std::string error;
  const cslf::Description& field = this->Store->GetDescription();
  const bool isAlone = this->View.Lookup == vtkCSLFMapper::GEOMETRY && this->View.Geometry &&
    this->View.Geometry->IsAlone && field.FindChannel(cslf::KnownChannel::Depth);
  using Frustums = std::vector<cslf::ViewFrustum>;
  const auto update = [&]
  {
    return this->Texture.Update(window, isAlone ? Frustums() : this->Views.GetExpectedFrustums(),
      isAlone ? Frustums() : this->Views.GetFrustums(), pace, error);
  };
  // The driver compiles the lookup's programs at the first drawing. A small hidden picture triggers
  // this while viewpoints are decoded.
  pace.Begins = this->Streaming && this->Texture.IsEmpty();
  if (pace.Begins && update())
  {
    vtkOpenGLState::ScopedglActiveTexture activeTexture(window->GetState());
    vtkOpenGLState::ScopedglViewport viewport(window->GetState());
    window->GetState()->vtkglViewport(0, 0, CompilingSize, CompilingSize);
    this->Drawn->Picture.Compile(window, this->View, this->Texture, this->Tools);
    pace.Begins = false;
  }
  this->TextureFailed = !update();
  if (this->TextureFailed)
  {
    vtkErrorMacro(<< error);
  }
}

//------------------------------------------------------------------------------
// Takes the camera's and the actor's matrices as VTK's mappers do, so that stereo, tiles and head-
// mounted displays come out like other actors.
void vtkCSLFCubeMapper::UpdateCamera(vtkRenderer* renderer, vtkActor* actor)
{
  vtkMatrix4x4* wcvc;
  vtkMatrix4x4* vcdc;
  vtkMatrix4x4* wcdc;
  vtkMatrix4x4* mcwc;
  vtkMatrix3x3* normals;
  static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera())
    ->GetKeyMatrices(renderer, wcvc, normals, vcdc, wcdc);
  static_cast<vtkOpenGLActor*>(actor)->GetKeyMatrices(mcwc, normals);
  const cslf::Cube& box = this->Store->GetDescription().Box;
  vtkNew<vtkMatrix4x4> ccmc;
  for (int axis = 0; axis < 3; ++axis)
  {
    ccmc->SetElement(axis, axis, 0.5 * box.Edges[axis]);
    ccmc->SetElement(axis, 3, box.Center[axis]);
  }
  // Key matrices are transposed.
  ccmc->Transpose();
  vtkNew<vtkMatrix4x4> ccwc;
  vtkMatrix4x4::Multiply4x4(ccmc, mcwc, ccwc);
  this->VCDCMatrix->DeepCopy(vcdc);
  vtkNew<vtkMatrix4x4> ccdc;
  vtkMatrix4x4::Multiply4x4(ccwc, wcdc, ccdc);

  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      this->View.CCDC[row][column] = ccdc->GetElement(column, row);
    }
  }
  const cslf::SceneGrid& scene = this->Texture.GetScene();
  this->Frustum = cslf::ViewFrustum(this->View.CCDC, scene.GetMinimum(), scene.GetMaximum());
  glm::dmat4 place;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      place[row][column] = ccwc->GetElement(row, column);
    }
  }
  this->Drawn = &this->Views.Find(renderer, actor, place);
  this->Drawn->Frustum = this->Frustum;
  this->IsAnotherPass = this->Views.SetDrawn(*this->Drawn);
  this->View.EyeCC = this->Frustum.GetEye();
  this->View.IsEyeInside = this->Frustum.IsInside();
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    this->View.EntryFaces[face] = this->Frustum.CanEnter(face);
  }
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  if (this->TextureFailed)
  {
    return;
  }
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglActiveTexture activeTexture(state);
  const int coveragePass = this->ChooseCoveragePass(renderer, actor);
  using Pace = cslf::LookupPicture::Pace;
  Pace pace;
  pace.Seconds = this->DrawSeconds;
  pace.Keeps = this->IsAnotherPass && coveragePass == PartialCoverage;
  if (!pace.Keeps)
  {
    // An incomplete picture will be drawn again.
    this->Drawn->Samples = this->Texture.IsComplete() ? this->PixelSamples : 1;
  }
  this->View.Samples = this->Drawn->Samples;
  // All passes of a frame draw the same picture.
  if (!this->IsAnotherPass && !renderer->GetSelector())
  {
    pace.Refinement = !this->Streaming ? Pace::Refinements::All
      : this->Drawn->IsCrowded         ? Pace::Refinements::Detail
                                       : Pace::Refinements::One;
  }
  this->Drawn->Picture.Draw(window, this->View, this->Texture, this->Tools, pace);
  this->Views.LimitPictures(window, *this->Drawn);
  const std::string options = this->MakeOptions();
  if (options != this->Options)
  {
    this->Options = options;
    this->Modified(); // makes VTK build the shader again
  }
  vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  state->vtkglDisable(GL_CULL_FACE);
  // Surfaces within the clipping range are drawn even if the cube's faces are beyond it.
  const bool clampsDepth = glIsEnabled(GL_DEPTH_CLAMP) == GL_TRUE;
  glEnable(GL_DEPTH_CLAMP);
  this->DrawFaces(renderer, actor, coveragePass);
  if (this->DrawnAtOnce && coveragePass == FullCoverage)
  {
    vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
    vtkOpenGLState::ScopedglDepthMask depthMask(state);
    state->vtkglEnable(GL_BLEND);
    state->vtkglBlendFuncSeparate(
      GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    state->vtkglDepthMask(GL_FALSE);
    this->DrawFaces(renderer, actor, PartialCoverage);
  }
  if (!clampsDepth)
  {
    glDisable(GL_DEPTH_CLAMP);
  }
  this->Drawn->Picture.Deactivate();
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::DrawFaces(vtkRenderer* renderer, vtkActor* actor, int coveragePass)
{
  this->CoveragePass = coveragePass;
  vtkOpenGLHelper& triangles = this->Primitives[PrimitiveTris];
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    if (this->Frustum.CanEnter(face))
    {
      this->Face = face;
      this->UpdateShaders(triangles, renderer, actor);
      triangles.IBO->Bind();
      glDrawElements(
        GL_TRIANGLES, static_cast<GLsizei>(triangles.IBO->IndexCount), GL_UNSIGNED_INT, nullptr);
      triangles.IBO->Release();
    }
  }
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::BuildIBO(vtkRenderer*, vtkActor*, vtkPolyData*)
{
  std::vector<unsigned int> indices;
  for (unsigned int face = 0; face < cslf::FaceCount; ++face)
  {
    for (const unsigned int corner : { 0, 1, 2, 0, 2, 3 })
    {
      indices.push_back(4 * face + corner);
    }
  }
  vtkOpenGLIndexBufferObject* triangles = this->Primitives[PrimitiveTris].IBO;
  triangles->Upload(indices, vtkOpenGLBufferObject::ElementArrayBuffer);
  triangles->IndexCount = indices.size();
}

//------------------------------------------------------------------------------
// What cslfMapperFS.glsl leaves out unless it is needed.
std::string vtkCSLFCubeMapper::MakeOptions() const
{
  std::string options;
  const cslf::Description& field = this->Store->GetDescription();
  if (field.FindChannel(cslf::KnownChannel::Color)->Encoding == cslf::LinearEncoding)
  {
    options += "#define LINEAR_COLOR\n";
  }
  if (!this->View.ClippingPlanesCC.empty())
  {
    options +=
      "#define CLIPPING_PLANES " + std::to_string(this->View.ClippingPlanesCC.size()) + "\n";
  }
  if (this->Drawn->Picture.IsCoarse())
  {
    options += "#define PICTURE_COARSE\n";
  }
  if (!this->ToneMapping->IsIdentity())
  {
    options += "#define TONE_MAPPING " + std::to_string(this->ToneMapping->GetCurve()) + "\n";
  }
  return options;
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor* actor)
{
  std::string fragment = cslfMapperFS;
  vtkShaderProgram::Substitute(fragment, "//CSLF::Options::Dec",
    this->Options + (IsInRenderPass(actor) ? "#define RENDER_PASS\n" : ""));
  vtkShaderProgram::Substitute(fragment, "//CSLF::Constants::Dec", cslfLookupConstantsGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::ToneMapping::Dec", cslfToneMappingGLSL);
  std::string vertex = cslfMapperVS;
  if (cslf::ReadsUniformsByLane())
  {
    cslf::HandUniformsOn(vertex, fragment);
  }
  shaders[vtkShader::Vertex]->SetSource(vertex);
  shaders[vtkShader::Fragment]->SetSource(fragment);
  shaders[vtkShader::Geometry]->SetSource("");
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::ReplaceShaderLight(
  std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*)
{
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::ReplaceShaderPicking(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::ReplaceShaderPicking(shaders, renderer, actor);
  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(fragment, "gl_PrimitiveID", "FacePass");
  shaders[vtkShader::Fragment]->SetSource(fragment);
}

//------------------------------------------------------------------------------
bool vtkCSLFCubeMapper::IsInRenderPass(vtkActor* actor)
{
  vtkInformation* keys = actor->GetPropertyKeys();
  return keys && keys->Has(vtkOpenGLRenderPass::RenderPasses());
}

//------------------------------------------------------------------------------
// Whether a renderer's props are drawn in another order than theirs.
bool vtkCSLFCubeMapper::IsSorted(vtkRenderer* renderer)
{
  vtkCollectionSimpleIterator cookie;
  renderer->GetCullers()->InitTraversal(cookie);
  while (vtkCuller* culler = renderer->GetCullers()->GetNextCuller(cookie))
  {
    auto* byCoverage = vtkFrustumCoverageCuller::SafeDownCast(culler);
    if (!byCoverage || byCoverage->GetSortingStyle() != VTK_CULLER_SORT_NONE)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Whether an actor is the last prop that a renderer draws, in the order of its props, and all
// others are opaque actors: then nothing can come behind its pixels any more.
bool vtkCSLFCubeMapper::IsLastProp(vtkRenderer* renderer, vtkActor* actor)
{
  if (renderer->GetPass() || IsInRenderPass(actor) || renderer->GetUseHiddenLineRemoval() ||
    IsSorted(renderer))
  {
    return false;
  }
  vtkProp* last = nullptr;
  vtkCollectionSimpleIterator cookie;
  renderer->GetViewProps()->InitTraversal(cookie);
  while (vtkProp* prop = renderer->GetViewProps()->GetNextProp(cookie))
  {
    if (!prop->GetVisibility() || prop->IsA("vtkActor2D"))
    {
      continue;
    }
    const bool isSurface = vtkActor::SafeDownCast(prop) != nullptr;
    if (prop != actor && (!isSurface || prop->HasTranslucentPolygonalGeometry()))
    {
      return false;
    }
    last = prop;
  }
  return last == actor;
}

//------------------------------------------------------------------------------
// An opaque actor draws twice: what covers its pixels, then, at once or with the translucent
// geometry, what covers them in part. An actor that is drawn once only draws all.
int vtkCSLFCubeMapper::ChooseCoveragePass(vtkRenderer* renderer, vtkActor* actor) const
{
  const bool once = actor->GetProperty()->GetOpacity() < 1.0 || actor->GetForceOpaque() ||
    actor->GetForceTranslucent() || renderer->GetSelector();
  if (once)
  {
    return AllCoverage;
  }
  return actor->IsRenderingTranslucentPolygonalGeometry() ? PartialCoverage : FullCoverage;
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);

  vtkShaderProgram* program = cellBO.Program;
  this->Drawn->Picture.SetUniforms(program);
  program->SetUniformi("FacePass", this->Face);
  if (program->IsUniformUsed("DCVCMatrix"))
  {
    vtkNew<vtkMatrix4x4> dcvc;
    vtkMatrix4x4::Invert(this->VCDCMatrix, dcvc);
    program->SetUniformMatrix("DCVCMatrix", dcvc);
  }
  program->SetUniformf("Opacity", static_cast<float>(actor->GetProperty()->GetOpacity()));
  program->SetUniformi("CoveragePass", this->CoveragePass);
  if (!this->ToneMapping->IsIdentity())
  {
    program->SetUniformf("Exposure", static_cast<float>(this->ToneMapping->GetExposure()));
  }
  this->SetClippingUniforms(program);
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::SetClippingUniforms(vtkShaderProgram* program)
{
  if (this->View.ClippingPlanesCC.empty())
  {
    return;
  }
  // Planes are transformed by the transposed inverse of the points' matrix. GLM reads its rows as
  // columns.
  const cslf::DisplayRows& ccdc = this->View.CCDC;
  const glm::dmat4 inverse = glm::inverse(glm::dmat4(ccdc[0], ccdc[1], ccdc[2], ccdc[3]));
  std::vector<std::array<float, 4>> planes;
  for (const glm::dvec4& plane : this->View.ClippingPlanesCC)
  {
    const glm::vec4 planeDC(inverse * plane);
    planes.push_back({ planeDC.x, planeDC.y, planeDC.z, planeDC.w });
  }
  program->SetUniform4fv("ClippingPlanesDC", static_cast<int>(planes.size()),
    reinterpret_cast<const float(*)[4]>(planes.data()));
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lookup: " << this->View.Lookup << "\n";
  for (const glm::dvec3& point : this->View.FocalPointsCC)
  {
    os << indent << "FocalPointCC: (" << point.x << ", " << point.y << ", " << point.z << ")\n";
  }
}
