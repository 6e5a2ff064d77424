// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMapper
 * @brief   draw a cube surface light field with any vtkActor
 *
 * The input is the image data of a whole light field, as vtkCSLFSampler, vtkCSLFDecoder or
 * vtkCSLFImageReader make it. Where it comes right from a vtkCSLFDecoder, the mapper does not have
 * the field decoded as a whole: it asks for the viewpoints that the camera can use, and no other
 * memory than the decoder's CacheSize holds them on their way. The mapper draws the field's cube
 * and looks up, for each pixel, the light ray that comes to the eye (Ai, Wang, Kou: CSLF, 2021,
 * section 3.4 and algorithm 1); in the depth lookup the mean of four, for smooth silhouettes, and
 * where the cube is so far away that texels are smaller than pixels the mean of more. The cost of a
 * picture does not depend on the scene that was sampled.
 *
 * The field takes part in the scene like any other opaque object: its coverage becomes opacity, so
 * that what lies behind it shows around its silhouettes, and where the field has a depth channel
 * the surfaces' depth is written, so that other actors pierce it and are hidden by it correctly.
 * Pixels that the field covers in part are drawn in the translucent pass, with depth peeling or
 * without. Where the field is the last of a renderer's visible props, and the others are opaque
 * actors, it is drawn at once, which is faster.
 *
 * The actor's transform (with a rotation, or a scale of its own along each axis), its opacity and
 * its ForceOpaque and ForceTranslucent apply. The other settings of its vtkProperty have no meaning
 * and change nothing: the light is in the field already, and there are no polygons to show as lines
 * or points. Clipping planes cut the picture: of each pixel the surface that the lookup finds is
 * drawn unless it lies on a plane's negative side. What lies behind it the field does not know.
 *
 * The camera may be of any kind: in perspective or parallel, stereo, one tile of a large picture,
 * the camera of a light that casts shadows. A field casts shadows and takes part in ambient
 * occlusion (vtkShadowMapPass, vtkSSAOPass), but receives no shadows.
 *
 * Viewing is defined for eyes outside the cube, where all light rays are known. From inside, each
 * line of sight is followed back out of the cube, and looked up from there: where the first surface
 * on it lies before the eye, that is what the eye sees, and it is drawn; where it lies behind the
 * eye, nothing is known of what is before it, and nothing is drawn. The mapper warns of this once
 * for each field. A field without depth channel cannot tell the two apart and draws all.
 *
 * Pickers that ask the graphics hardware find the field: vtkPropPicker and vtkWorldPointPicker give
 * the point of its surface, vtkHardwareSelector the cell: the face of the cube, from +X, -X to +Z,
 * -Z, by which the line of sight enters. Pickers that intersect a mapper's input by themselves
 * (vtkCellPicker, vtkPointPicker) find the image data that holds the samples, which lies elsewhere.
 *
 * A mapper may be drawn in several windows. Each has the samples in graphics memory of its own,
 * until its resources are released.
 *
 * @sa vtkCSLFSampler vtkCSLFDecoder
 */
#ifndef vtkCSLFMapper_h
#define vtkCSLFMapper_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageData.h"  // for SetInputData
#include "vtkMapper.h"

#include <memory> // for the internals

class vtkCSLFCubeMapper;
class vtkCSLFDecoder;

namespace cslf
{
class ViewpointSource;
}

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
    DEPTH = 4,    ///< re-aimed at the surface found from the depth channel: sharp everywhere
    NUMBER_OF_LOOKUPS
  };

  /**
   * How radiance is brought into the range that a display shows, as in vtkToneMappingPass.
   */
  enum ToneMappingType
  {
    CLAMP = 0,    ///< what is brighter than white is white
    REINHARD = 1, ///< divided by one more than its luminance
    ACES = 2      ///< the curve of film: a fit of the ACES transforms by K. Narkowicz
  };

  ///@{
  /**
   * The lookup. Default: DEPTH. Where the field has no depth channel, DEPTH draws as FOCAL about
   * the cube's centre.
   */
  vtkSetClampMacro(Lookup, int, NEAREST, NUMBER_OF_LOOKUPS - 1);
  vtkGetMacro(Lookup, int);
  void SetLookupToNearest() { this->SetLookup(NEAREST); }
  void SetLookupToLinear() { this->SetLookup(LINEAR); }
  void SetLookupToBilinear() { this->SetLookup(BILINEAR); }
  void SetLookupToFocal() { this->SetLookup(FOCAL); }
  void SetLookupToDepth() { this->SetLookup(DEPTH); }
  const char* GetLookupAsString();
  ///@}

  /**
   * The name of a lookup in lower case, such as "bilinear"; null if there is no such lookup.
   */
  static const char* GetLookupName(int lookup);

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
   * desired update rate allows, as while the camera is moved with an interactor: as many as there
   * is time for, down to one for 4 x 4 pixels, and interpolated between. At less than one picture a
   * second, as where nothing moves and where nobody has set a rate, all are looked up. Default: on.
   */
  vtkSetMacro(AutoAdjustResolution, bool);
  vtkGetMacro(AutoAdjustResolution, bool);
  vtkBooleanMacro(AutoAdjustResolution, bool);
  ///@}

  ///@{
  /**
   * How many rays along each side of a pixel the depth lookup draws with at least while the view
   * is still and complete, from 1 to 4. The mean of 2 x 2 has smooth silhouettes, as a path-traced
   * picture, and takes some 2.5 times as long as one. Other lookups are not sharp enough to gain
   * by it and have one. Where texels are smaller than pixels all have more anyway. Default: 2.
   */
  vtkSetClampMacro(PixelSamples, int, 1, 4);
  vtkGetMacro(PixelSamples, int);
  ///@}

  ///@{
  /**
   * What radiance is multiplied by when it is drawn, besides the exposure that the field was
   * sampled with. Acts on linear values, also where the field holds sRGB-encoded ones, but cannot
   * bring back what those were clamped to: sample in `float` to choose the exposure at view time.
   * Default: 1; at least 0.
   */
  vtkSetClampMacro(Exposure, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * What becomes of radiance times exposure before it is sRGB-encoded. Default: CLAMP, with which
   * the field looks as its path-traced truth.
   */
  vtkSetClampMacro(ToneMapping, int, CLAMP, ACES);
  vtkGetMacro(ToneMapping, int);
  void SetToneMappingToClamp() { this->SetToneMapping(CLAMP); }
  void SetToneMappingToReinhard() { this->SetToneMapping(REINHARD); }
  void SetToneMappingToACES() { this->SetToneMapping(ACES); }
  const char* GetToneMappingAsString();
  ///@}

  ///@{
  /**
   * Whether Render draws what is there rather than wait for all that the camera can use. It waits
   * for the coarsest viewpoints only; in a few milliseconds of each picture others are brought to
   * graphics memory, those near to what the camera looks at first. Where some are missing,
   * UpdateDataEvent is invoked at the end of Render, and IsComplete is false: whoever wants to see
   * them has to draw again, but not from within the event. Default: off, for pictures that are
   * drawn once.
   */
  vtkSetMacro(Streaming, bool);
  vtkGetMacro(Streaming, bool);
  vtkBooleanMacro(Streaming, bool);
  ///@}

  /**
   * Whether the last picture, in each window, was drawn from all viewpoints that its camera can
   * use, as far as TextureMemoryLimit allows.
   */
  bool IsComplete();

  ///@{
  /**
   * How many bytes of graphics memory the samples may take in each window, at least those of four
   * viewpoints. A camera outside the cube can use no more than 30 % of a field: the viewpoints on
   * the faces that it sees, and what they see of the others. Where that is too much, the grid of
   * viewpoints is fine around what the camera looks at, and coarser elsewhere. From inside the cube
   * all of the field is used. Default: 2 GiB.
   */
  vtkSetClampMacro(TextureMemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(TextureMemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * The light field drawn, or null. For a pipeline use SetInputConnection.
   */
  void SetInputData(vtkImageData* field) { this->SetInputDataInternal(0, field); }
  vtkImageData* GetInput();
  ///@}

  /**
   * The graphics memory set aside for the field's samples, in bytes, in all windows together: 0
   * before the first Render and after ReleaseGraphicsResources.
   */
  vtkTypeInt64 GetTextureBytes();

  using vtkMapper::GetBounds;
  /**
   * The bounds of the field's cube; uninitialised where there is no valid field.
   */
  double* GetBounds() VTK_SIZEHINT(6) override;

  ///@{
  /**
   * The field covers some pixels wholly and some in part. The second is false where the opaque pass
   * that was drawn last has drawn these, too; it is true before the first Render.
   */
  bool HasOpaqueGeometry() override { return true; }
  bool HasTranslucentPolygonalGeometry() override { return this->HasTranslucentPart; }
  ///@}

  ///@{
  /**
   * Hardware selection finds the actor; its cells are the faces of the cube.
   */
  bool GetSupportsSelection() override { return true; }
  ///@}

  ///@{
  /**
   * Called by actors and windows.
   */
  void Render(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  ///@}

  /**
   * Takes over the parameters and the input of another mapper.
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

protected:
  vtkCSLFMapper();
  ~vtkCSLFMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkCSLFMapper(const vtkCSLFMapper&) = delete;
  void operator=(const vtkCSLFMapper&) = delete;

  bool UpdateField();
  std::shared_ptr<cslf::ViewpointSource> OpenDecoder(vtkCSLFDecoder* decoder);
  std::shared_ptr<cslf::ViewpointSource> OpenImage(vtkImageData* image);
  void ReportDamage(int damaged, int undamaged);
  vtkCSLFCubeMapper* GetCubeMapper(vtkWindow* window);

  int Lookup = DEPTH;
  bool AutomaticFocalPoint = true;
  bool AutoAdjustResolution = true;
  double FocalPoint[3] = { 0.0, 0.0, 0.0 };
  int PixelSamples = 2;
  double Exposure = 1.0;
  int ToneMapping = CLAMP;
  bool Streaming = false;
  vtkTypeInt64 TextureMemoryLimit = vtkTypeInt64(2) << 30;
  bool HasTranslucentPart = true; // after the opaque pass that was drawn last

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
