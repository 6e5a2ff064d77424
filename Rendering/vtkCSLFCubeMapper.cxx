// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFCubeMapper.h"

#include "cslfMapperFS.h"
#include "cslfMapperVS.h"
#include "cslfOpenGL.h"

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

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
constexpr const char* FaceName = "face";

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
vtkCSLFCubeMapper::~vtkCSLFCubeMapper() = default;

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::SetField(const cslf::Description& field, vtkImageData* image)
{
  this->Field = field;
  this->Image = image;
  this->TextureFailed = false;
  this->Texture.Invalidate();
  this->SetInputDataObject(MakeCube(field.Box));
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texture.Release(window);
  this->Picture.Release(window);
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
// Looks up what is seen, unless that was done for an earlier pass or picture of the same view.
void vtkCSLFCubeMapper::UpdatePicture(vtkOpenGLRenderWindow* window)
{
  cslf::LookupPicture::View view;
  view.Lookup = this->Lookup;
  view.EyeCC = this->EyeCC;
  view.IsEyeInside = this->IsEyeInside();
  std::copy_n(this->CCDCMatrix->GetData(), view.CCDC.size(), view.CCDC.begin());
  view.FocalPointsCC = this->FocalPointsCC;
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    view.EntryFaces[face] = this->CanEnter(face);
  }
  this->Picture.Draw(window, view, this->Texture, this->LookupSeconds);
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
  this->UpdatePicture(window);
  vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  state->vtkglDisable(GL_CULL_FACE);
  // The picture's depth is that of what is seen: the camera's clipping range does not cut the
  // faces.
  glEnable(GL_DEPTH_CLAMP);
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    if (this->CanEnter(face))
    {
      this->Face = face;
      this->Superclass::RenderPieceDraw(renderer, actor);
    }
  }
  glDisable(GL_DEPTH_CLAMP);
  this->Picture.Deactivate();
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  std::string fragment = cslfMapperFS;
  const bool isLinear = this->Field.FindChannel(cslf::ColorName)->Encoding == cslf::LinearEncoding;
  vtkShaderProgram::Substitute(
    fragment, "//CSLF::Options::Dec", isLinear ? "#define LINEAR_COLOR" : "");
  shaders[vtkShader::Vertex]->SetSource(cslfMapperVS);
  shaders[vtkShader::Fragment]->SetSource(fragment);
  shaders[vtkShader::Geometry]->SetSource("");
}

//------------------------------------------------------------------------------
void vtkCSLFCubeMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, renderer, actor);

  vtkShaderProgram* program = cellBO.Program;
  this->Picture.SetUniforms(program);
  program->SetUniformi("FacePass", this->Face);

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
