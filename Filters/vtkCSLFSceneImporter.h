// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFSceneImporter
 * @brief   converts the scene of a renderer to data that can be path-traced
 *
 * This source converts the visible actors of a vtkRenderer to a vtkMultiBlockDataSet of their
 * surfaces, in world coordinates, with their materials as defined by vtkCSLFMaterial. A last block
 * holds the lights as defined by vtkCSLFLight, and one point, so that VTK's writers keep it.
 * vtkCSLFPathTracer::SetRenderer uses the same conversion. Nothing is drawn, no window is needed,
 * and the renderer is not changed.
 *
 * Actors, also in assemblies:
 * - Geometry is the input of the mapper, after its pipeline: polygonal data, the surface of any
 * other data set, or composite data of these, with the visibility, colour and opacity of blocks. It
 * is placed by the actor's matrix and those of its assemblies.
 * - The material is that of the property (see vtkCSLFMaterial::SetFromProperty) and the actor's
 * texture. Material arrays in the field data of the geometry take precedence over the property, so
 * data can define features that a vtkProperty lacks, such as glass.
 * - Scalars become colours as in the mapper: visibility, mode, array, component, colour mode,
 * lookup table and range. If the mapper interpolates scalars before mapping, the table becomes a
 * texture, as in the window. Otherwise, or if the actor has a texture, colours are those of points.
 * The table itself is not changed. The output is marked as data with finished colours, see
 * vtkCSLFMaterial, so no other array colours it.
 * - Lights, reflectances and emissions are chosen such that a surface that faces the light is
 * traced with the colour that the window shows, plus indirect light, see
 * Documentation/Materials.md.
 * - Wireframes and visible edges (also those inside triangle strips), points that cells use, and
 * visible vertices become lines and vertices. PixelSize converts their width to world units.
 * - vtkMoleculeMapper becomes spheres and tubes with the radii and colours of its mode,
 * vtkGraphMapper lines and vertices, and vtkPointGaussianMapper, vtkOpenGLSphereMapper and
 * vtkOpenGLStickMapper spheres and tubes. The actor does not scale radii, as in the window.
 * - Grids of several levels (vtkUniformGridAMR) become the surface of their visible cells.
 * - vtkLODProp3D is represented by its selected level, or else by the finest.
 * - vtkGlyph3DMapper becomes instances that share one copy of the geometry: scale mode and factor,
 * range and clamping, orientation mode, masking, source indexing, and a colour for each instance.
 *
 * Lights that are switched on:
 * - Scene lights and camera lights become directional lights, point lights and spot lights. Camera
 * lights keep their current position. They move with the camera at the next update, but not while
 * the renderer shows what was made of its own scene: who looks around there does not want it to be
 * made again for each picture.
 * - A headlight is at the eye, and a light field has eyes everywhere. With HeadlightsAllAround, it
 * becomes a uniform environment in which a diffuse surface shows, from all directions, the colour
 * that the headlight gives it head-on. A renderer without lights that creates one is treated as if
 * it had a headlight.
 * - An environment texture (lat-long) lights the scene if UseImageBasedLighting is on, with the
 * renderer's EnvironmentUp and EnvironmentRight.
 * - The background does not light the scene, as in VTK.
 *
 * GetLimitName lists the differences between a window and its bake, which is also the table of
 * Documentation/WindowAndBake.md. One warning names those that an import has found.
 *
 * @sa vtkCSLFMaterial vtkCSLFLight vtkCSLFPathTracer
 */
#ifndef vtkCSLFSceneImporter_h
#define vtkCSLFSceneImporter_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkSmartPointer.h" // for the scene of a deleted renderer
#include "vtkWeakPointer.h"  // for the renderer

class vtkDataArraySelection;
class vtkProp;
class vtkRenderer;

class VTKCSLF_EXPORT vtkCSLFSceneImporter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCSLFSceneImporter* New();
  vtkTypeMacro(vtkCSLFSceneImporter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The time of the last change of anything that is imported: props, mappers, properties, lights,
   * and the output of their pipelines, which are updated for this purpose.
   */
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * The renderer. Required. It is not kept alive, so that it can show what becomes of the scene: an
   * actor of the light field may be added to it. When the renderer is deleted, another one takes
   * its place, with the same actors, lights and settings, except for actors whose pipelines begin
   * with an importer or tracer of the deleted renderer. GetRenderer then returns that one.
   */
  virtual void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /**
   * Whether headlights become light from all around. If off, they stay at the current position of
   * the camera. Default: on.
   */
  vtkSetMacro(HeadlightsAllAround, bool);
  vtkGetMacro(HeadlightsAllAround, bool);
  vtkBooleanMacro(HeadlightsAllAround, bool);
  ///@}

  ///@{
  /**
   * Whether colours of points and in textures are interpolated as in the window: in classic
   * shading, as displayed values. If off, they are interpolated as light, which is brighter in the
   * middle between different colours. See vtkCSLFMaterial::SetDisplayedWhite. Default: on.
   */
  vtkSetMacro(InterpolateDisplayedColors, bool);
  vtkGetMacro(InterpolateDisplayedColors, bool);
  vtkBooleanMacro(InterpolateDisplayedColors, bool);
  ///@}

  ///@{
  /**
   * Whether materials have the colours of scalars, textures and properties themselves, for
   * vtkCSLFPathTracer::SetColorsToExact, which sets it for its renderer. Otherwise, they have the
   * colours with which the lights make what the window shows. If on, coefficients of properties and
   * the renderer's lights are left out. Default: off.
   */
  vtkSetMacro(ExactColors, bool);
  vtkGetMacro(ExactColors, bool);
  vtkBooleanMacro(ExactColors, bool);
  ///@}

  ///@{
  /**
   * The arrays of point data that surfaces keep besides what gives them their colours, by name:
   * vtkCSLFSampler sets its SurfaceArraySelection for its renderer. Null for none. Default: null.
   */
  void SetSurfaceArraySelection(vtkDataArraySelection* selection);
  vtkDataArraySelection* GetSurfaceArraySelection();
  ///@}

  ///@{
  /**
   * The size of a pixel of a line's width or a point's size in the world, as a fraction of the
   * diagonal of the scene's bounding box. Range: 1e-9 to 1. Default: 0.001.
   */
  void SetPixelSize(double size);
  vtkGetMacro(PixelSize, double);
  ///@}

  ///@{
  /**
   * The radius of points in the world, instead of the point size of the property and PixelSize:
   * 0 for those, -1 for half of the distance between neighbouring points, as of clouds without a
   * point size (see vtkCSLFMaterial). Radii in the data take precedence. Range: -1 to 1e30.
   * Default: 0.
   */
  void SetPointRadius(double radius);
  vtkGetMacro(PointRadius, double);
  void SetPointRadiusFromSpacing() { this->SetPointRadius(-1.0); }
  ///@}

  ///@{
  /**
   * The list of differences between VTK's window and a bake: the name of each difference, what the
   * window shows, what is baked, and whether the import of such a scene gives a warning.
   * Differences without a warning exist in every scene. The first has the number 0. Null or false
   * for a number that is out of range.
   */
  static int GetNumberOfLimits();
  static const char* GetLimitName(int limit);
  static const char* GetLimitInWindow(int limit);
  static const char* GetLimitInBake(int limit);
  static bool GetLimitWarned(int limit);
  ///@}

protected:
  vtkCSLFSceneImporter();
  ~vtkCSLFSceneImporter() override;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /**
   * Whether one of the renderer's props is part of the scene, for subclasses to decide. All are.
   */
  virtual bool IsOfScene(vtkProp* prop);

private:
  vtkCSLFSceneImporter(const vtkCSLFSceneImporter&) = delete;
  void operator=(const vtkCSLFSceneImporter&) = delete;

  void KeepScene();

  vtkWeakPointer<vtkRenderer> Renderer;
  unsigned long DeleteObserver = 0;
  vtkSmartPointer<vtkRenderer> KeptRenderer; // with the scene of a deleted renderer
  vtkMTimeType KeptTime = 0;                 // of the deleted renderer
  bool HeadlightsAllAround = true;
  bool InterpolateDisplayedColors;
  bool ExactColors = false;
  vtkSmartPointer<vtkDataArraySelection> SurfaceArraySelection;
  double PixelSize = 0.001;
  double PointRadius;
  bool FindingTime = false; // where the importer's own output is among what it looks at
};

#endif
