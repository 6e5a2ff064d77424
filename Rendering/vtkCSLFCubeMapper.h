// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFCubeMapper
 * @brief   the polydata mapper inside vtkCSLFMapper
 *
 * Draws the faces of a light field's cube with the shaders of Rendering/Shaders in place of VTK's
 * own, from a picture of what all rays see. Belongs to one render window, whose actors share the
 * samples in graphics memory and have a picture for each of their views. Not for use by itself.
 */
#ifndef vtkCSLFCubeMapper_h
#define vtkCSLFCubeMapper_h

#include "cslfDescription.h"
#include "cslfDrawnViews.h"
#include "cslfFieldTexture.h"
#include "cslfLookupPicture.h"
#include "cslfLookupTools.h"
#include "vtkCSLFToneMapping.h"

#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkMatrix4x4;

class vtkCSLFCubeMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkCSLFCubeMapper* New();
  vtkTypeMacro(vtkCSLFCubeMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The field to draw; its samples go to graphics memory as Render needs them.
  void SetStore(const std::shared_ptr<cslf::FieldStore>& store);

  /// vtkCSLFMapper::Streaming and TextureMemoryLimit.
  void SetStreaming(bool streaming, std::int64_t limit)
  {
    this->Streaming = streaming;
    this->TextureMemoryLimit = limit;
  }

  /// vtkCSLFMapper::LookupType.
  void SetLookup(int lookup) { this->View.Lookup = lookup; }

  /// The least rays along each side of a pixel, by depth in still views that are complete.
  void SetPixelSamples(int samples) { this->PixelSamples = samples; }

  /// The seconds that drawing may take: where all rays would take longer, fewer are looked up.
  void SetDrawSeconds(double seconds) { this->DrawSeconds = seconds; }

  /// The focal lookup's point, for the rays that enter by each face.
  void SetFocalPointsCC(const std::array<glm::dvec3, cslf::FaceCount>& pointsCC)
  {
    this->View.FocalPointsCC = pointsCC;
  }

  /// The planes that cut the picture: what is drawn lies where they are positive.
  void SetClippingPlanesCC(const std::vector<glm::dvec4>& planesCC)
  {
    this->View.ClippingPlanesCC = planesCC;
  }

  /// The field's geometry, or null, and the maps in which its mapped points are shown, if any.
  void SetGeometry(const std::shared_ptr<const cslf::GeometryMesh>& geometry,
    const std::shared_ptr<const cslf::ShownMaps>& maps)
  {
    this->View.Geometry = geometry;
    this->View.Maps = maps;
    this->Texture.SetSurfaces(geometry ? geometry->Cells : nullptr);
  }

  /// How radiance becomes colour.
  void SetToneMapping(vtkCSLFToneMapping* toneMapping) { this->ToneMapping = toneMapping; }

  /// What the last picture's camera saw of the cube.
  const cslf::ViewFrustum& GetFrustum() const { return this->Frustum; }

  /// Whether the opaque pass that was drawn last left nothing for the translucent one.
  bool IsDrawnAtOnce() const { return this->DrawnAtOnce; }

  /// Whether a window has resources of this.
  bool HasWindow() const { return this->Window != nullptr; }

  /// Whether nothing is missing from what the window shows, as far as it fits: no viewpoints, and
  /// no rays of still views. A window that has
  /// released its resources, or whose last frame did not contain the field, shows nothing.
  bool IsComplete() const
  {
    return !this->Views.AreShown() || this->TextureFailed ||
      (this->Texture.IsComplete() && this->Views.AreRefined());
  }

  /// Whether all required viewpoints are missing, which was known before.
  bool LacksAll() const { return this->Texture.LacksAll(); }

  /// How many viewpoints turned out to be damaged, and how many not.
  int GetNumberOfDamagedViewpoints() const { return this->Texture.GetNumberOfDamagedViewpoints(); }
  int GetNumberOfViewpoints() const { return this->Texture.GetNumberOfViewpoints(); }

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

  ///@{
  /**
   * The cube is drawn as a surface whatever the property's representation, without VTK's lighting,
   * and each pixel's cell is the face by which its ray enters.
   */
  void BuildIBO(vtkRenderer* renderer, vtkActor* actor, vtkPolyData* cube) override;
  void ReplaceShaderLight(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderPicking(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  ///@}

private:
  vtkCSLFCubeMapper(const vtkCSLFCubeMapper&) = delete;
  void operator=(const vtkCSLFCubeMapper&) = delete;

  void SetWindow(vtkRenderWindow* window);
  void HandleFrame(vtkObject*, unsigned long event, void*);
  void UpdateCamera(vtkRenderer* renderer, vtkActor* actor);
  void UpdateTexture(vtkRenderer* renderer, vtkActor* actor);
  std::string MakeOptions() const;
  void SetClippingUniforms(vtkShaderProgram* program);
  void DrawFaces(vtkRenderer* renderer, vtkActor* actor, int coveragePass);
  int ChooseCoveragePass(vtkRenderer* renderer, vtkActor* actor) const;
  static bool IsLastProp(vtkRenderer* renderer, vtkActor* actor);
  static bool IsSorted(vtkRenderer* renderer);
  static bool IsInRenderPass(vtkActor* actor);

  std::shared_ptr<cslf::FieldStore> Store;
  cslf::FieldTexture Texture;
  cslf::LookupTools Tools;
  cslf::DrawnViews Views;
  bool Streaming = false;
  std::int64_t TextureMemoryLimit = 0;
  vtkWeakPointer<vtkRenderWindow> Window; ///< whose memory holds resources of this
  std::array<unsigned long, 2> Observers{};
  bool TextureFailed = false;
  int PixelSamples = 2;
  double DrawSeconds = 0.0;
  vtkSmartPointer<vtkCSLFToneMapping> ToneMapping; ///< never null when drawing
  std::string Options;                             ///< the shader's, for the picture being drawn

  // For the picture being drawn.
  int Face = 0;             ///< of the cube, in turn
  int CoveragePass = 0;     ///< of cslfMapperFS.glsl
  bool DrawnAtOnce = false; ///< what covers its pixels in part follows in the opaque pass
  cslf::DrawnView* Drawn = nullptr;
  bool IsAnotherPass = false; ///< of a view that this frame has already drawn
  cslf::ViewFrustum Frustum;
  cslf::LookupPicture::View View;
  vtkNew<vtkMatrix4x4> VCDCMatrix;
};

#endif
