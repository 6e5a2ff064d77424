// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFSceneImporter
 * @brief   what a renderer shows, as data that can be path-traced
 *
 * A source whose output, a vtkMultiBlockDataSet, holds the surfaces of all visible actors of a
 * vtkRenderer, in the world, with their materials as vtkCSLFMaterial has them, and in a last block
 * the lights as vtkCSLFLight has them. It is the input that vtkCSLFPathTracer::SetRenderer makes.
 * Nothing is drawn, no window is needed, and the renderer is not changed.
 *
 * Actors, also in assemblies:
 * - Geometry is the input of the mapper, after its pipeline: polygonal data, the surface of any
 *   other data set, or composite data of such, with the visibility, colour and opacity of blocks.
 *   It is placed by the actor's matrix, and by those of its assemblies.
 * - The material is that of the property (see vtkCSLFMaterial::SetFromProperty), and the actor's
 *   texture. Material arrays in the field data of the geometry come before the property, so glass,
 *   say, which a vtkProperty does not know, can be set there.
 * - Scalars become colours as the mapper has it: visibility, mode, array, component, colour mode,
 *   lookup table and range. Where it interpolates scalars before mapping, the table becomes a
 *   texture, as it does in the window; else, or where the actor has a texture, colours are of
 *   points. The table itself is not changed.
 * - Lights, reflectances and emissions are such that a surface which faces the light is traced as
 *   the window shows it, plus the light that bounces: Documentation/Materials.md tells how.
 * - Wireframes, visible edges, points and visible vertices become lines and vertices. Their width
 * in pixels is taken for a width in the world by PixelSize.
 * - vtkMoleculeMapper becomes spheres and tubes of the atoms' and bonds' radii and colours in its
 *   mode, vtkGraphMapper lines and vertices, vtkPointGaussianMapper, vtkOpenGLSphereMapper and
 *   vtkOpenGLStickMapper spheres and tubes. Radii are not scaled by the actor, as in the window.
 * - Grids of several levels (vtkUniformGridAMR) become the surface of their visible cells.
 * - Of vtkLODProp3D the selected level is taken, or else the finest.
 * - vtkGlyph3DMapper becomes instances, which share one copy of the geometry: scale mode and
 * factor, range and clamping, orientation mode, masking, source indexing, and a colour for each
 * instance.
 *
 * Lights that are switched on:
 * - Scene lights and camera lights become lights of a direction, point lights and spot lights,
 *   camera lights where they stand now.
 * - A headlight shines from wherever the eye is, and a light field has eyes everywhere. With
 *   HeadlightsAllAround it becomes an even environment, in which a matte surface shows the same
 *   colour from everywhere as it does by the headlight straight ahead. A renderer without lights
 *   that creates one is taken to have a headlight.
 * - An environment texture (lat-long) lights the scene where UseImageBasedLighting is on, with the
 *   renderer's EnvironmentUp and EnvironmentRight.
 * - The background does not light, as in VTK.
 *
 * What a window shows and what is baked differ in what GetLimitName lists, which is also the table
 * of Documentation/WindowAndBake.md. One warning names what an import has met of it.
 *
 * @sa vtkCSLFMaterial vtkCSLFLight vtkCSLFPathTracer
 */
#ifndef vtkCSLFSceneImporter_h
#define vtkCSLFSceneImporter_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkSmartPointer.h" // for the renderer

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
   * and what their pipelines yield, which are updated for it.
   */
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * The renderer. Required.
   */
  virtual void SetRenderer(vtkRenderer* renderer);
  vtkRenderer* GetRenderer();
  ///@}

  ///@{
  /**
   * Whether headlights shine from everywhere, or from where the camera is now. Default: on.
   */
  vtkSetMacro(HeadlightsAllAround, bool);
  vtkGetMacro(HeadlightsAllAround, bool);
  vtkBooleanMacro(HeadlightsAllAround, bool);
  ///@}

  ///@{
  /**
   * Whether colours of points and in textures are interpolated as the window does: as displayed
   * values, in classic shading. Off, they are interpolated as light, which is brighter in the
   * middle between unlike colours. See vtkCSLFMaterial::SetDisplayedWhite. Default: on.
   */
  vtkSetMacro(InterpolateDisplayedColors, bool);
  vtkGetMacro(InterpolateDisplayedColors, bool);
  vtkBooleanMacro(InterpolateDisplayedColors, bool);
  ///@}

  ///@{
  /**
   * What a pixel of a line's width or a point's size is in the world, as a part of the diagonal of
   * the scene's bounding box. Positive. Default: 0.001.
   */
  vtkSetClampMacro(PixelSize, double, 1e-9, 1.0);
  vtkGetMacro(PixelSize, double);
  ///@}

  ///@{
  /**
   * The list of what a light field shows differently from VTK's window: the name of each
   * difference, what the window shows, what is baked, and whether the import of such a scene warns
   * of it; what it does not warn of is so in every scene. The first limit has the number 0. Null or
   * false for a number that is out of range.
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

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Whether one of the renderer's props is part of the scene, for subclasses to decide. All are.
   */
  virtual bool IsOfScene(vtkProp* prop);

private:
  vtkCSLFSceneImporter(const vtkCSLFSceneImporter&) = delete;
  void operator=(const vtkCSLFSceneImporter&) = delete;

  vtkSmartPointer<vtkRenderer> Renderer;
  bool HeadlightsAllAround = true;
  bool InterpolateDisplayedColors = true;
  double PixelSize = 0.001;
  bool FindingTime = false; // where the importer's own output is among what it looks at
};

#endif
