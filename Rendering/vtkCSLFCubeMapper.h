// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFCubeMapper
 * @brief   the polydata mapper inside vtkCSLFMapper
 *
 * Draws the faces of a light field's cube with the shaders of Rendering/Shaders in place of VTK's
 * own, from a picture of what all rays see.
 * Not for use by itself.
 */
#ifndef vtkCSLFCubeMapper_h
#define vtkCSLFCubeMapper_h

#include "cslfDescription.h"
#include "cslfFieldTexture.h"
#include "cslfLookupPicture.h"

#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

class vtkImageData;
class vtkMatrix4x4;
class vtkOpenGLRenderWindow;

class vtkCSLFCubeMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkCSLFCubeMapper* New();
  vtkTypeMacro(vtkCSLFCubeMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The field to draw; its samples go to graphics memory at the next Render.
  void SetField(const cslf::Description& field, vtkImageData* image);

  /// vtkCSLFMapper::LookupType.
  void SetLookup(int lookup) { this->Lookup = lookup; }

  /// The seconds that looking up a picture may take; with less it has fewer pixels.
  void SetLookupSeconds(double seconds) { this->LookupSeconds = seconds; }

  /// The focal lookup's point, for the rays that enter by each face.
  void SetFocalPointsCC(const std::array<glm::dvec3, cslf::FaceCount>& pointsCC)
  {
    this->FocalPointsCC = pointsCC;
  }

  /// The graphics memory that the samples take, in bytes; 0 before the first Render.
  std::int64_t GetTextureBytes() const { return this->Texture.GetBytes(); }

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkCSLFCubeMapper();
  ~vtkCSLFCubeMapper() override;

  void RenderPieceStart(vtkRenderer* renderer, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void GetShaderTemplate(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* renderer, vtkActor* actor) override;

private:
  vtkCSLFCubeMapper(const vtkCSLFCubeMapper&) = delete;
  void operator=(const vtkCSLFCubeMapper&) = delete;

  void UpdateCamera(vtkRenderer* renderer, vtkActor* actor);
  bool CanEnter(int face) const;
  bool IsEyeInside() const;
  void UpdatePicture(vtkOpenGLRenderWindow* window);

  cslf::Description Field;
  vtkSmartPointer<vtkImageData> Image;
  cslf::FieldTexture Texture;
  cslf::LookupPicture Picture;
  bool TextureFailed = false;
  int Lookup = 0;
  double LookupSeconds = 0.0;
  std::array<glm::dvec3, cslf::FaceCount> FocalPointsCC{};

  // For the picture being drawn.
  int Face = 0;            ///< of the cube, in turn
  glm::dvec4 EyeCC{ 0.0 }; ///< w = 1: the eye; w = 0: the direction of a parallel projection
  vtkNew<vtkMatrix4x4> CCDCMatrix;
};

#endif
