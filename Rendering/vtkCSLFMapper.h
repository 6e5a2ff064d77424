// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMapper
 * @brief   draw a cube surface light field with any vtkActor
 *
 * The input is the image data of a whole light field, as vtkCSLFSampler, vtkCSLFDecoder or
 * vtkCSLFImageReader make it. The mapper draws the field's cube and looks up, for each pixel, the
 * light ray that comes to the eye (Ai, Wang, Kou: CSLF, 2021, section 3.4 and algorithm 1). The
 * cost of a picture does not depend on the scene that was sampled.
 *
 * The field takes part in the scene like any other opaque object: its coverage becomes opacity, so
 * that what lies behind it shows around its silhouettes, and where the field has a depth channel
 * the surfaces' depth is written, so that other actors pierce it and are hidden by it correctly.
 * Pixels that the field covers in part are drawn in the translucent pass. The actor's transform and
 * opacity apply; its colour and lighting do not, since the light is in the field already.
 *
 * Viewing is defined for eyes outside the cube; from inside, each pixel shows what the whole line
 * of sight sees from where it enters the cube.
 *
 * Fields of `float` colour are shown clamped and sRGB-encoded.
 *
 * @sa vtkCSLFSampler vtkCSLFDecoder
 */
#ifndef vtkCSLFMapper_h
#define vtkCSLFMapper_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageData.h"  // for SetInputData
#include "vtkMapper.h"

#include <memory> // for the internals

class VTKCSLF_EXPORT vtkCSLFMapper : public vtkMapper
{
public:
  static vtkCSLFMapper* New();
  vtkTypeMacro(vtkCSLFMapper, vtkMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * How a light ray is looked up in the samples.
   */
  enum LookupType
  {
    NEAREST = 0,  ///< nearest viewpoint, nearest texel
    LINEAR = 1,   ///< nearest viewpoint, interpolated texels
    BILINEAR = 2, ///< both interpolated; sharp on the far faces of the cube
    FOCAL = 3,    ///< both interpolated, re-aimed: sharp at the focal point
    DEPTH = 4     ///< re-aimed at the surface found from the depth channel: sharp everywhere
  };

  ///@{
  /**
   * The lookup. Default: DEPTH. Where the field has no depth channel, DEPTH draws as FOCAL about
   * the cube's centre.
   */
  vtkSetClampMacro(Lookup, int, NEAREST, DEPTH);
  vtkGetMacro(Lookup, int);
  void SetLookupToNearest() { this->SetLookup(NEAREST); }
  void SetLookupToLinear() { this->SetLookup(LINEAR); }
  void SetLookupToBilinear() { this->SetLookup(BILINEAR); }
  void SetLookupToFocal() { this->SetLookup(FOCAL); }
  void SetLookupToDepth() { this->SetLookup(DEPTH); }
  const char* GetLookupAsString();
  ///@}

  ///@{
  /**
   * Whether the focal lookup finds its point by itself, rather than by FocalPoint: for the rays
   * that enter by each face, at the median depth seen from the face's middle towards the opposite
   * face, but no nearer than the cube's centre; the centre where the field has no depth channel.
   * Default: on.
   */
  vtkSetMacro(AutomaticFocalPoint, bool);
  vtkGetMacro(AutomaticFocalPoint, bool);
  vtkBooleanMacro(AutomaticFocalPoint, bool);
  ///@}

  ///@{
  /**
   * The focal lookup's point, in the field's world coordinates (before the actor's transform), used
   * where AutomaticFocalPoint is off. Default: the origin.
   */
  vtkSetVector3Macro(FocalPoint, double);
  vtkGetVector3Macro(FocalPoint, double);
  ///@}

  ///@{
  /**
   * Whether fewer rays are looked up where those of all pixels would take longer than the window's
   * desired update rate allows, as while the camera is moved with an interactor: one for each
   * square of 2 x 2 to 4 x 4 pixels. At less than one picture a second, as where nothing moves and
   * where nobody has set a rate, all are looked up. Default: on.
   */
  vtkSetMacro(AutoAdjustResolution, bool);
  vtkGetMacro(AutoAdjustResolution, bool);
  vtkBooleanMacro(AutoAdjustResolution, bool);
  ///@}

  ///@{
  /**
   * The light field drawn, or null. For a pipeline use SetInputConnection.
   */
  void SetInputData(vtkImageData* field) { this->SetInputDataInternal(0, field); }
  vtkImageData* GetInput();
  ///@}

  /**
   * The graphics memory that the field's samples take, in bytes: 0 before the first Render and
   * after ReleaseGraphicsResources.
   */
  vtkTypeInt64 GetTextureBytes();

  ///@{
  /**
   * The bounds of the field's cube; uninitialised where there is no valid field.
   */
  using vtkMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  ///@{
  /**
   * The field covers some pixels wholly and some in part.
   */
  bool HasOpaqueGeometry() override { return true; }
  bool HasTranslucentPolygonalGeometry() override { return true; }
  ///@}

  ///@{
  /**
   * Hardware selection finds the actor; its cells are the faces of the cube.
   */
  bool GetSupportsSelection() override { return true; }
  void ProcessSelectorPixelBuffers(
    vtkHardwareSelector* selector, std::vector<unsigned int>& pixelOffsets, vtkProp* prop) override;
  ///@}

  ///@{
  /**
   * Called by actors and windows.
   */
  void Render(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  ///@}

  void ShallowCopy(vtkAbstractMapper* mapper) override;

protected:
  vtkCSLFMapper();
  ~vtkCSLFMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkCSLFMapper(const vtkCSLFMapper&) = delete;
  void operator=(const vtkCSLFMapper&) = delete;

  bool UpdateField();

  int Lookup = DEPTH;
  bool AutomaticFocalPoint = true;
  bool AutoAdjustResolution = true;
  double FocalPoint[3] = { 0.0, 0.0, 0.0 };

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
