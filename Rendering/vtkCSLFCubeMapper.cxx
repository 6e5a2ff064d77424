// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFCubeMapper.h"

#include "cslfCubeGLSL.h"
#include "cslfFaceSpace.h"
#include "cslfFieldGLSL.h"
#include "cslfLookupGLSL.h"
#include "cslfMapperFS.h"
#include "cslfMapperVS.h"
#include "cslfOpenGL.h"
#include "cslfSceneGridGLSL.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>

#include <cmath>
#include <string>

namespace
{
constexpr const char* FaceName = "faceCC";

// The cube as six quads, with each point's position in CC and face as a vertex attribute.
vtkSmartPointer<vtkPolyData> MakeCube(const cslf::Cube& box)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> positions;
  positions->SetName(FaceName);
  positions->SetNumberOfComponents(4);
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
      positions->InsertNextTuple4(pointCC.x, pointCC.y, pointCC.z, face);
    }
  }
  auto cube = vtkSmartPointer<vtkPolyData>::New();
  cube->SetPoints(points);
  cube->SetPolys(quads);
  cube->GetPointData()->AddArray(positions);
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
vtkCSLFCubeMapper::~vtkCSLFCubeMapper() = default;

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::SetField(const cslf::Description& field, vtkImageData* image)
{
  this->Field = field;
  this->Image = image;
  this->TextureFailed = false;
  this->Modified();
  this->Texture.Invalidate();
  this->SetInputDataObject(MakeCube(field.Box));
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texture.Release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::RenderPieceStart(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->TextureFailed && !this->Texture.IsUploadedTo(window))
  {
    std::string error;
    this->TextureFailed = !this->Texture.Upload(window, this->Field, this->Image, error);
    if (this->TextureFailed)
    {
      vtkErrorMacro(<< error);
    }
  }
  this->Superclass::RenderPieceStart(renderer, actor);
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::UpdateCamera(vtkRenderer* renderer, vtkActor* actor)
{
  vtkMatrix4x4* wcdc = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0);
  vtkNew<vtkMatrix4x4> ccmc;
  for (int axis = 0; axis < 3; ++axis)
  {
    ccmc->SetElement(axis, axis, 0.5 * this->Field.Box.Edges[axis]);
    ccmc->SetElement(axis, 3, this->Field.Box.Center[axis]);
  }
  vtkMatrix4x4::Multiply4x4(wcdc, actor->GetMatrix(), this->CCDCMatrix);
  vtkMatrix4x4::Multiply4x4(this->CCDCMatrix, ccmc, this->CCDCMatrix);

  // The eye is where all lines along the display's z meet: for a parallel projection at infinity.
  vtkNew<vtkMatrix4x4> dccc;
  vtkMatrix4x4::Invert(this->CCDCMatrix, dccc);
  const double along[4] = { 0.0, 0.0, 1.0, 0.0 };
  double eye[4];
  dccc->MultiplyPoint(along, eye);
  const double length = std::sqrt(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]);
  if (std::abs(eye[3]) > 1e-9 * length)
  {
    this->EyeCC = { eye[0] / eye[3], eye[1] / eye[3], eye[2] / eye[3], 1.0 };
  }
  else
  {
    this->EyeCC = { eye[0] / length, eye[1] / length, eye[2] / length, 0.0 };
  }
}

//------------------------------------------------------------------------------
// Whether some line of sight can enter the cube by a face. From inside all of them can.
bool vtkCSLFCubeMapper::CanEnter(int face) const
{
  const double along = cslf::FaceSign(face) * this->EyeCC[cslf::FaceAxis(face)];
  return this->EyeCC.w == 0.0 ? along < 0.0 : this->IsEyeInside() || along > 1.0;
}

//------------------------------------------------------------------------------
bool vtkCSLFCubeMapper::IsEyeInside() const
{
  return this->EyeCC.w != 0.0 && std::abs(this->EyeCC.x) <= 1.0 && std::abs(this->EyeCC.y) <= 1.0 &&
    std::abs(this->EyeCC.z) <= 1.0;
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  if (this->TextureFailed)
  {
    return;
  }
  this->UpdateCamera(renderer, actor);
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglActiveTexture activeTexture(state);
  vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  state->vtkglDisable(GL_CULL_FACE);
  // The picture's depth is that of what is seen: the camera's clipping range does not cut the
  // faces.
  glEnable(GL_DEPTH_CLAMP);
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    if (this->CanEnter(face))
    {
      this->EntryFace = face;
      this->Texture.Activate(face);
      this->Superclass::RenderPieceDraw(renderer, actor);
    }
  }
  glDisable(GL_DEPTH_CLAMP);
  this->Texture.Deactivate();
}

//------------------------------------------------------------------------------
// Branches cost their time even where nothing takes them, so each program knows what it looks up.
std::string vtkCSLFCubeMapper::MakeFragmentShader() const
{
  static const char* const lookups[] = { "LookupNearest", "LookupLinear", "LookupBilinear",
    "LookupFocal", "LookupDepth" };
  const bool hasDepth = this->Field.FindChannel(cslf::DepthName) != nullptr;
  std::string fragment = cslfMapperFS;
  vtkShaderProgram::Substitute(fragment, "//CSLF::Cube::Dec", cslfCubeGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::Field::Dec", cslfFieldGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::SceneGrid::Dec", cslfSceneGridGLSL);
  vtkShaderProgram::Substitute(fragment, "//CSLF::Lookup::Dec",
    std::string("const bool HasDepth = ") + (hasDepth ? "true" : "false") + ";\n" + cslfLookupGLSL);
  vtkShaderProgram::Substitute(
    fragment, "//CSLF::Lookup::Impl", std::string("result = ") + lookups[this->Lookup] + "(ray);");
  return fragment;
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  shaders[vtkShader::Vertex]->SetSource(cslfMapperVS);
  shaders[vtkShader::Fragment]->SetSource(this->MakeFragmentShader());
  shaders[vtkShader::Geometry]->SetSource("");
}

//------------------------------------------------------------------------------
// The uniforms that go with the entry face.
void vtkCSLFCubeMapper::SetFaceSpaceUniforms(vtkShaderProgram* program)
{
  const int face = this->EntryFace;
  vtkNew<vtkMatrix4x4> ccfc;
  vtkNew<vtkMatrix4x4> fccc;
  const glm::dvec3 originFC = cslf::CubeToFaceSpace(face, glm::dvec3(0.0));
  const glm::dvec3 originCC = cslf::FaceSpaceToCube(face, glm::dvec3(0.0));
  for (int column = 0; column < 4; ++column)
  {
    glm::dvec3 unit(0.0);
    if (column < 3)
    {
      unit[column] = 1.0;
    }
    const glm::dvec3 pointFC = cslf::CubeToFaceSpace(face, unit) - (column < 3 ? originFC : unit);
    const glm::dvec3 pointCC = cslf::FaceSpaceToCube(face, unit) - (column < 3 ? originCC : unit);
    // GLSL's matrices are stored by columns.
    for (int row = 0; row < 3; ++row)
    {
      ccfc->SetElement(column, row, pointFC[row]);
      fccc->SetElement(column, row, pointCC[row]);
    }
  }
  program->SetUniformMatrix("CCFCMatrix", ccfc);
  program->SetUniformMatrix("FCCCMatrix", fccc);
  const glm::vec3 focalPoint(cslf::CubeToFaceSpace(face, this->FocalPointsCC[face]));
  program->SetUniform3f("FocalPointFC", &focalPoint.x);

  const auto frames = cslf::ListExitFrames(face);
  const auto setAxes = [&](const char* name, const cslf::ExitFrame& frame, int first, int second)
  {
    const float axes[4] = { static_cast<float>(frame.S[first]), static_cast<float>(frame.T[first]),
      static_cast<float>(frame.S[second]), static_cast<float>(frame.T[second]) };
    program->SetUniform4f(name, axes);
  };
  setAxes("OppositeAxes", frames[0], 0, 1);
  setAxes("SideXAxes", frames[1], 1, 2);
  setAxes("SideYAxes", frames[3], 0, 2);
  const auto setSides =
    [&](const std::string& name, const cslf::ExitFrame& positive, const cslf::ExitFrame& negative)
  {
    const float flip[2] = { positive.S == negative.S ? 1.0f : -1.0f,
      positive.T == negative.T ? 1.0f : -1.0f };
    const float tiles[2] = { static_cast<float>(positive.Tile), static_cast<float>(negative.Tile) };
    program->SetUniform2f((name + "Flip").c_str(), flip);
    program->SetUniform2f((name + "Tiles").c_str(), tiles);
  };
  setSides("SideX", frames[1], frames[2]);
  setSides("SideY", frames[3], frames[4]);
  program->SetUniformf("OppositeTile", static_cast<float>(frames[0].Tile));
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);

  vtkShaderProgram* program = cellBO.Program;
  this->Texture.SetUniforms(program);
  const float eye[4] = { static_cast<float>(this->EyeCC.x), static_cast<float>(this->EyeCC.y),
    static_cast<float>(this->EyeCC.z), static_cast<float>(this->EyeCC.w) };
  program->SetUniform4f("EyeCC", eye);
  // GLSL's matrices are stored by columns.
  vtkNew<vtkMatrix4x4> transposed;
  vtkMatrix4x4::Transpose(this->CCDCMatrix, transposed);
  program->SetUniformMatrix("CCDCMatrix", transposed);
  program->SetUniformi("EntryFacePass", this->EntryFace);
  program->SetUniformi("DrawsExits", this->IsEyeInside());
  this->SetFaceSpaceUniforms(program);
  program->SetUniformi(
    "LinearColor", this->Field.FindChannel(cslf::ColorName)->Encoding == cslf::LinearEncoding);

  // An opaque actor draws twice: what covers its pixels, then, with the translucent geometry, what
  // covers them in part.
  const double opacity = actor->GetProperty()->GetOpacity();
  const bool translucentPass = actor->IsRenderingTranslucentPolygonalGeometry();
  const bool all = opacity < 1.0 || renderer->GetSelector();
  program->SetUniformf("Opacity", static_cast<float>(opacity));
  program->SetUniformi("CoveragePass", all ? 0 : (translucentPass ? 2 : 1));
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lookup: " << this->Lookup << "\n";
  for (const glm::dvec3& point : this->FocalPointsCC)
  {
    os << indent << "FocalPointCC: (" << point.x << ", " << point.y << ", " << point.z << ")\n";
  }
}
