// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMapper
 * @brief   draw a cube surface light field with any vtkActor
 *
 * The input is the image data of a whole light field, as produced by vtkCSLFSampler, vtkCSLFDecoder
 * or vtkCSLFImageReader. If it is connected directly to a vtkCSLFDecoder, the file is not decoded
 * completely: the mapper requests the viewpoints that the camera can use, and needs no other memory
 * than the decoder's CacheSize for viewpoints in transit. The mapper draws the field's cube and
 * looks up, for each pixel, the light ray that arrives at the eye (Ai, Wang, Kou: CSLF, 2021,
 * section 3.4 and algorithm 1). The depth lookup uses the mean of four rays, for smooth
 * silhouettes. If the cube is so far away that texels are smaller than pixels, the mean of more
 * rays is used. The cost of a picture does not depend on the scene that was sampled.
 *
 * The field takes part in the scene like any other opaque object. Its coverage becomes opacity, so
 * objects behind it are visible around its silhouettes. If the field has a depth channel, the depth
 * of its surfaces is written, so other actors intersect it and are hidden by it correctly. Pixels
 * that the field covers partly are drawn in the translucent pass, with or without depth peeling. If
 * the field is the last of a renderer's visible props, and the others are opaque actors, all of it
 * is drawn in the opaque pass, which is faster.
 *
 * The actor's transform (with rotation, and a separate scale along each axis), its opacity and its
 * ForceOpaque and ForceTranslucent apply. The other settings of its vtkProperty have no effect,
 * except for the diffuse colour with ScalarVisibility off: the light is part of the field, and
 * there are no polygons to show as lines or points. Lookup tables and ranges of scalars apply to
 * surfaces whose geometry has scalars: see CreateDefaultLookupTable. Clipping planes cut the
 * picture: the surface that the lookup finds for a pixel is drawn unless it lies on the negative
 * side of a plane. The field does not know what is behind that surface.
 *
 * Any camera can be used: perspective or parallel projection, stereo, a tile of a large picture, or
 * the camera of a light that casts shadows. A field casts shadows and takes part in ambient
 * occlusion (vtkShadowMapPass, vtkSSAOPass), but does not receive shadows.
 *
 * Viewing is defined for eyes outside the cube, where all light rays are known. From inside, each
 * line of sight is extended backwards out of the cube and looked up from there. If the first
 * surface on it lies in front of the eye, it is what the eye sees, and it is drawn. If it lies
 * behind the eye, nothing is known about the part in front of the eye, and nothing is drawn. The
 * mapper warns of this once for each field. A field without a depth channel cannot distinguish the
 * two cases and draws everything.
 *
 * Pickers that use the graphics hardware find the field: vtkPropPicker and vtkWorldPointPicker
 * return the point on its surface, exactly if the field is drawn with its geometry, and
 * vtkHardwareSelector returns as the cell the face of the cube, from +X, -X to +Z, -Z, through
 * which the line of sight enters. Pickers that intersect a mapper's input themselves
 * (vtkCellPicker, vtkPointPicker) find the image data that holds the samples, which lies elsewhere.
 * To find the triangle under a pixel, let them search the geometry.
 *
 * Of a field that changes over time, the mapper draws the time that is requested of its input
 * (UPDATE_TIME_STEP), for example by vtkCSLFSeriesReader::SetTime.
 *
 * With StaticOn, the input is not updated, as in other mappers: a mapper of a vtkCSLFDecoder draws
 * the file that the decoder has open, also after its file name has changed, until the decoder's
 * UpdateInformation or Update opens the other one.
 *
 * Several actors can share a mapper, in one or more renderers, assemblies and windows. Each window
 * keeps the samples that its actors use together in its own graphics memory until its resources are
 * released, and a picture for each actor, renderer, camera and eye, up to 256 MiB. Pictures that
 * are not drawn in 32 frames are freed.
 *
 * @sa vtkCSLFSampler vtkCSLFDecoder vtkCSLFSeriesReader vtkCSLFToneMapping
 */
#ifndef vtkCSLFMapper_h
#define vtkCSLFMapper_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageData.h"  // for SetInputData
#include "vtkMapper.h"
#include "vtkPolyData.h"     // for SetGeometryData
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <memory> // for the internals
#include <string> // for names

class vtkCSLFCubeMapper;
class vtkCSLFToneMapping;

namespace cslf
{
class FieldStore;
class ShownMaps;
struct MapChoice;
struct ShownGeometry;
}

class VTKCSLF_EXPORT vtkCSLFMapper : public vtkMapper
{
public:
  static vtkCSLFMapper* New();
  vtkTypeMacro(vtkCSLFMapper, vtkMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Includes the modification time of the tone mapping.
   */
  vtkMTimeType GetMTime() override;

  /**
   * The method of looking up a light ray in the samples.
   */
  enum LookupType
  {
    NEAREST = 0,  ///< nearest viewpoint, nearest texel
    LINEAR = 1,   ///< nearest viewpoint, interpolated texels
    BILINEAR = 2, ///< both interpolated; sharp on the far faces of the cube
    FOCAL = 3,    ///< both interpolated, aimed at the focal point: sharp there
    DEPTH = 4,    ///< aimed at the surface found by the depth channel: sharp everywhere
    GEOMETRY = 5, ///< aimed at the field's geometry, seen by all viewpoints that see it: sharpest
    NUMBER_OF_LOOKUPS
  };

  ///@{
  /**
   * The lookup. Without geometry, or if that lost more than a fifth of the surfaces (see
   * vtkCSLFSampler and vtkCSLFGeometryFilter), GEOMETRY is drawn as DEPTH. If the field has no
   * depth channel, both are drawn as FOCAL about the cube's centre. Default: GEOMETRY.
   */
  void SetLookup(int lookup);
  vtkGetMacro(Lookup, int);
  /** The nearest viewpoint, and the nearest texel. */
  void SetLookupToNearest() { this->SetLookup(NEAREST); }
  /** The nearest viewpoint, and interpolated texels. */
  void SetLookupToLinear() { this->SetLookup(LINEAR); }
  /** Interpolates viewpoints and texels: sharp on the far faces of the cube. */
  void SetLookupToBilinear() { this->SetLookup(BILINEAR); }
  /** Interpolates both, aimed at the focal point: sharp there. */
  void SetLookupToFocal() { this->SetLookup(FOCAL); }
  /** Aimed at the surface that the depth channel tells: sharp everywhere. */
  void SetLookupToDepth() { this->SetLookup(DEPTH); }
  /** Aimed at the field's geometry, seen by all viewpoints that see it: the sharpest. */
  void SetLookupToGeometry() { this->SetLookup(GEOMETRY); }
  const char* GetLookupAsString();
  ///@}

  /**
   * The name of a lookup in lower case, such as "bilinear"; null if there is no such lookup.
   */
  static const char* GetLookupName(int lookup);

  ///@{
  /**
   * Whether the focal lookup chooses its focal point automatically instead of using FocalPoint. The
   * automatic point of each entry face lies at the median depth seen from the face's middle towards
   * the opposite face, but no nearer than the cube's centre. If the field has no depth channel, it
   * is the centre. Default: on.
   */
  vtkSetMacro(AutomaticFocalPoint, bool);
  vtkGetMacro(AutomaticFocalPoint, bool);
  vtkBooleanMacro(AutomaticFocalPoint, bool);
  ///@}

  ///@{
  /**
   * The focal point of the focal lookup, in the field's world coordinates (before the actor's
   * transform). It is used only if AutomaticFocalPoint is off. Default: the origin.
   */
  vtkSetVector3Macro(FocalPoint, double);
  vtkGetVector3Macro(FocalPoint, double);
  ///@}

  ///@{
  /**
   * Whether to trace fewer rays if rays for all pixels would take longer than the window's desired
   * update rate allows, for example while the camera moves with an interactor. The number of rays
   * is adapted to the time available, down to one ray per 4 x 4 pixels, and colours are
   * interpolated between them. A geometry that alone shows the field gets fewer triangles before
   * there are fewer rays than pixels; another thread makes them when they are needed first. With
   * Streaming, the first still picture has these triangles, too, and the next one all of them. If
   * the desired rate is below one picture per second, as for still views or if no rate is set, all
   * rays are traced. Default: on.
   */
  vtkSetMacro(AutoAdjustResolution, bool);
  vtkGetMacro(AutoAdjustResolution, bool);
  vtkBooleanMacro(AutoAdjustResolution, bool);
  ///@}

  ///@{
  /**
   * The minimum number of rays along each side of a pixel for the depth and geometry lookups while
   * the view is still and complete, from 1 to 4. With 1, the ray goes through the middle of the
   * pixel. With 2, the mean of 2 x 2 rays gives smooth silhouettes, as in a path-traced picture,
   * and takes about 2.5 times as long as 1. Pictures with more than 1 are refined: they become the
   * mean of five such sets, whose rays go through different places of the pixels, at once or, with
   * Streaming, one more with each Render. Other lookups are not sharp enough to benefit and use 1.
   * If texels are smaller than pixels, all lookups use more. Default: 2.
   */
  void SetPixelSamples(int samples);
  vtkGetMacro(PixelSamples, int);
  ///@}

  ///@{
  /**
   * The exposure and tone mapping of the displayed radiance. Null selects a new one with the
   * default values, which displays colours unchanged.
   */
  virtual void SetToneMapping(vtkCSLFToneMapping* toneMapping);
  vtkCSLFToneMapping* GetToneMapping();
  ///@}

  ///@{
  /**
   * Whether Render draws from the viewpoints that are loaded instead of waiting for all viewpoints
   * that the camera can use. If on, it waits only for the coarsest viewpoints. During a few
   * milliseconds of each picture, further viewpoints are loaded into graphics memory, beginning
   * with those near the middle of the view. When all are loaded, each Render refines still views
   * (PixelSamples). While viewpoints or rays are missing, UpdateDataEvent is invoked at the end of
   * Render, and IsComplete returns false: the application must render again to show them, but not
   * within the event. Default: off, for pictures that are drawn once.
   */
  vtkSetMacro(Streaming, bool);
  vtkGetMacro(Streaming, bool);
  vtkBooleanMacro(Streaming, bool);
  ///@}

  /**
   * Whether the last picture in each window was drawn from all viewpoints that its cameras can use,
   * within TextureMemoryLimit, and has all rays that it should have. Windows that do not show the
   * field, because they were destroyed or have released their resources, or because its actor was
   * removed or hidden before the last picture, do not count: without others, the result is true.
   */
  bool IsComplete();

  ///@{
  /**
   * The maximum number of bytes of graphics memory for the samples in each window, which all actors
   * that share the mapper use together. At least the
   * samples of four viewpoints are always kept. A camera outside the cube can use at most 30 % of a
   * field: the viewpoints on the visible faces, and what they see of the other faces. If this
   * exceeds the limit, the grid of viewpoints is fine around the middle of the view and coarser
   * elsewhere. From inside the cube, the whole field is used. Default: 2 GiB.
   */
  void SetTextureMemoryLimit(vtkTypeInt64 bytes);
  vtkGetMacro(TextureMemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * The light field, or null. In a pipeline, use SetInputConnection instead.
   */
  void SetInputData(vtkImageData* field) { this->SetInputDataInternal(0, field); }
  vtkImageData* GetInput();
  ///@}

  /**
   * The graphics memory allocated for the field's samples, in bytes, in all windows together. It is
   * 0 before the first Render and after ReleaseGraphicsResources.
   */
  vtkTypeInt64 GetTextureBytes();

  ///@{
  /**
   * The field's geometry, which is optional: where its surfaces are, in the field's world
   * coordinates. Its triangles are drawn with the colours of the viewpoints that see them, so they
   * need not be those of the sampled scene, but each must lie on its surfaces. Point data `Color`,
   * as the field has it, is for what no viewpoint sees, and where `ExactColor` is above 0 (two
   * components, of the front and the back), in place of the viewpoints. `BackColor`, if there is
   * one of the same type, is that of the side where corners run clockwise. In a pipeline, use
   * SetInputConnection with port 1.
   */
  void SetGeometryData(vtkPolyData* geometry) { this->SetInputDataInternal(1, geometry); }
  vtkPolyData* GetGeometry();
  ///@}

  ///@{
  /**
   * The range of scalars over which colours are shown, if the geometry has scalars; see
   * GetLookupTable. Until it is set, each array has that with which the field was sampled, and the
   * function returns that of the first array that is selected. With UseLookupTableScalarRange on
   * and a table that was set, the table's range counts instead. As in VTK's other mappers, it does
   * not change vtkColorTransferFunction, which has a range of its own. Where it is empty, or not
   * positive for a logarithmic scale, the mapper warns and keeps the field's colours.
   */
  void SetScalarRange(double lowest, double highest) override;
  using vtkMapper::SetScalarRange;
  double* GetScalarRange() VTK_SIZEHINT(2) override;
  VTK_WRAPEXCLUDE
  void GetScalarRange(double range[2]) override
  {
    const double* found = this->GetScalarRange();
    range[0] = found[0];
    range[1] = found[1];
  }
  ///@}

  /**
   * Called by GetLookupTable if no table was set, and only then: makes one that maps like the
   * field, as far as its geometry is known.
   *
   * With the lookup GEOMETRY, surfaces whose geometry has scalars and light (point data
   * `CSLF:ColorMap` and `CSLF:Light`) are shown in any lookup table, as by VTK's other mappers:
   *
   *     mapper.SelectColorArray("Speed")  # all arrays, if none is selected, in any ScalarMode
   *     mapper.SetLookupTable(table)
   *     mapper.SetScalarRange(0, 20)
   *
   * The next picture has the new colours. Nothing is decoded, sampled or built again for it. The
   * table is not changed. Until one is set, or again after SetLookupTable with null, they have the
   * colours with which the field was sampled, and GetLookupTable returns a table of them: it
   * remains the same object, so a vtkScalarBarActor may have it, and changing it counts as setting
   * it. Tables of categories (IndexedLookup) are refused with a warning, and their opacity is
   * ignored. With ScalarVisibility off, these surfaces have the diffuse colour of the actor's
   * property instead. Scalars are always interpolated before they are mapped, whatever
   * InterpolateScalarsBeforeMapping is.
   *
   * Light that was reflected by coloured surfaces onto others keeps the colours with which it was
   * sampled, and so does all that the geometry alone does not show: reflections, translucent
   * objects, and surfaces whose `ExactColor` is 0. The mapper warns once for each geometry if a
   * table or a range is set that does not show, or only in part.
   */
  void CreateDefaultLookupTable() override;

  VTK_WRAPEXCLUDE
  /**
   * What the geometry shows of an actor with this mapper, for exporters, whatever the lookup is.
   * False if there is no valid field or no geometry that is used.
   */
  bool FindShownGeometry(vtkActor* actor, cslf::ShownGeometry& shown);

  using vtkMapper::GetBounds;
  /**
   * The bounds of what is drawn: with the lookup GEOMETRY those of geometry that has all surfaces,
   * unless the field shows its environment, and otherwise those of the field's cube. Uninitialized
   * if there is no valid field.
   */
  double* GetBounds() VTK_SIZEHINT(6) override;

  ///@{
  /**
   * The field covers some pixels fully and some partly. The second function returns false if the
   * last opaque pass has also drawn the partly covered pixels. It returns true before the first
   * Render.
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
   * Takes the parameters and the input of another mapper, and shares its tone mapping.
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
  void UpdateGeometry();
  bool ReadGeometry();
  void TellScalars();
  std::string GetSelectedArray();
  vtkScalarsToColors* GetUserTable() const;
  void UpdateScalarRange();
  cslf::MapChoice GetMapSelection();
  std::shared_ptr<const cslf::ShownMaps> ChooseMaps(vtkActor* actor);
  void WarnOfMaps(const cslf::MapChoice& choice, const std::string& problem);
  void Draw(vtkRenderer* renderer, vtkActor* actor);
  std::shared_ptr<cslf::FieldStore> OpenImage(vtkImageData* image);
  void ReportDamage(int damaged, int undamaged);
  vtkCSLFCubeMapper* GetCubeMapper(vtkWindow* window);

  int Lookup;
  bool AutomaticFocalPoint;
  bool AutoAdjustResolution;
  double FocalPoint[3];
  int PixelSamples;
  vtkSmartPointer<vtkCSLFToneMapping> ToneMapping;
  bool Streaming = false;
  vtkTypeInt64 TextureMemoryLimit;
  bool HasScalarRange = false;    // that was set
  bool HasTranslucentPart = true; // after the opaque pass that was drawn last

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
