// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFViewScene
 * @brief   the surfaces and lights of a ParaView render view, for path tracing
 *
 * A source of the surfaces of all visible representations of a render view, with their colours and
 * materials, and of the view's lights in a last block: see vtkCSLFSceneImporter. It is a capture:
 * it does not change with the view until Capture is called. Representations without surfaces or
 * volumes (light fields) are left out, and so are the view's decorations.
 *
 * The view must have been rendered. On several ranks each captures what it draws.
 *
 * A state file contains the captured scene, except on several ranks. The last block also has the
 * legends of the captured colours.
 *
 * @sa vtkCSLFSceneImporter vtkCSLFSampler
 */
#ifndef vtkCSLFViewScene_h
#define vtkCSLFViewScene_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkNew.h"         // for vtkNew
#include "vtkWeakPointer.h" // for the view

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkView;

class VTKCSLFPARAVIEW_EXPORT vtkCSLFViewScene : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCSLFViewScene* New();
  vtkTypeMacro(vtkCSLFViewScene, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The view, a vtkPVRenderView. Default: none, which means the active view, if this process is
   * also the client.
   */
  void SetView(vtkView* view);
  vtkView* GetView();
  ///@}

  ///@{
  /**
   * Whether the view's lights are captured. If not, the sampler's environment lights the scene.
   * Default: on.
   */
  void SetCaptureLights(bool capture);
  vtkGetMacro(CaptureLights, bool);
  vtkBooleanMacro(CaptureLights, bool);
  ///@}

  ///@{
  /**
   * Whether colours between points are interpolated like in the view, or as light: see
   * vtkCSLFSceneImporter. Default: on.
   */
  void SetInterpolateDisplayedColors(bool interpolate);
  vtkGetMacro(InterpolateDisplayedColors, bool);
  vtkBooleanMacro(InterpolateDisplayedColors, bool);
  ///@}

  ///@{
  /**
   * Whether surfaces get their own colours, as the scalar bar shows them, instead of those that
   * make what the view shows with its lights, and no lights are captured. For a sampler whose
   * colours are exact, too: see vtkCSLFPathTracer::SetColorsToExact. Default: off.
   */
  void SetExactColors(bool exact);
  vtkGetMacro(ExactColors, bool);
  vtkBooleanMacro(ExactColors, bool);
  ///@}

  /**
   * Makes the next update capture the current view.
   */
  void Capture();

  ///@{
  /**
   * The captured scene as text, for state files: empty if nothing has been captured, on several
   * ranks, and, with a warning, if it would take more than 64 MiB. Setting it replaces what was
   * captured; an empty text changes nothing, and a damaged one is an error.
   */
  void SetCapturedScene(const char* text);
  const char* GetCapturedScene();
  ///@}

  /**
   * The array whose colours in the view are no longer those that were captured, or "its surfaces"
   * if it is another colour or opacity that has changed. Empty if none has, or after a state file
   * was loaded.
   */
  std::string FindChange();

protected:
  vtkCSLFViewScene();
  ~vtkCSLFViewScene() override;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFViewScene(const vtkCSLFViewScene&) = delete;
  void operator=(const vtkCSLFViewScene&) = delete;

  bool CaptureNow();

  vtkWeakPointer<vtkView> View;
  bool CaptureLights = true;
  bool InterpolateDisplayedColors = true;
  bool ExactColors = false;
  bool MustCapture = true;
  vtkNew<vtkMultiBlockDataSet> Scene; // the captured scene
  std::string SceneText;

  struct vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
