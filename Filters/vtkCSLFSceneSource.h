// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFSceneSource
 * @brief   scenes for examples, tests and measurements
 *
 * Scenes that are made when they are needed, without files or downloads: the Cornell box (see
 * vtkCSLFCornellBoxSource) and scenes as in scientific visualization, with isosurfaces,
 * streamlines, glyphs, molecules and others. GetNumberOfScenes, GetSceneName and
 * GetSceneDescription list them. They are always the same.
 *
 * The output is a vtkMultiBlockDataSet of polygonal data with materials (vtkCSLFMaterial), and with
 * instances (vtkCSLFInstances) or lights (vtkCSLFLight) where a scene has them. All but the Cornell
 * box are converted by vtkCSLFSceneImporter from the actors that AddToRenderer adds.
 *
 * @sa vtkCSLFSampler vtkCSLFViewTracer vtkCSLFCornellBoxSource
 */
#ifndef vtkCSLFSceneSource_h
#define vtkCSLFSceneSource_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <string> // for SceneName

class vtkCSLFEnvironment;
class vtkRenderer;

class VTKCSLF_EXPORT vtkCSLFSceneSource : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCSLFSceneSource* New();
  vtkTypeMacro(vtkCSLFSceneSource, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The name of the scene. A name that is not in the list is an error. Default: cornell-box.
   */
  vtkSetStdStringFromCharMacro(SceneName);
  vtkGetCharFromStdStringMacro(SceneName);
  ///@}

  ///@{
  /**
   * The list of scenes: their names, and a sentence about each. The first has the number 0. Null
   * for a number that is out of range.
   */
  static int GetNumberOfScenes();
  static const char* GetSceneName(int scene);
  static const char* GetSceneDescription(int scene);
  ///@}

  /**
   * Whether there is a scene of this name.
   */
  static bool HasScene(const char* name);

  /**
   * Sets the mode of an environment to the one that suits the scene: constant, gradient, or none
   * if the scene has its own lights. Does nothing if there is no scene of that name.
   */
  void SetUpEnvironment(vtkCSLFEnvironment* environment);

  /**
   * Adds the scene's actors, and its lights if it has any, to a renderer, for a picture in a
   * window. Returns whether there is such a scene; the Cornell box has no actors.
   */
  bool AddToRenderer(vtkRenderer* renderer);

protected:
  vtkCSLFSceneSource();
  ~vtkCSLFSceneSource() override = default;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFSceneSource(const vtkCSLFSceneSource&) = delete;
  void operator=(const vtkCSLFSceneSource&) = delete;

  std::string SceneName;
};

#endif
