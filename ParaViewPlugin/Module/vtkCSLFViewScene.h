// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFViewScene
 * @brief   what a render view of ParaView shows, to be path-traced
 *
 * A source whose output holds the surfaces of all visible representations of a render view, with
 * their colours and materials, and in a last block the view's lights: see vtkCSLFSceneImporter. It
 * is a capture: it stays as it was when the view moves on, until Capture is called. Representations
 * that are no polygons (volumes, light fields) are left out, and so are the view's own decorations.
 *
 * The view must have been rendered. On several ranks each captures what it draws.
 *
 * @sa vtkCSLFSceneImporter vtkCSLFSampler
 */
#ifndef vtkCSLFViewScene_h
#define vtkCSLFViewScene_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkNew.h"         // for vtkNew
#include "vtkTimeStamp.h"   // for vtkTimeStamp
#include "vtkWeakPointer.h" // for the view

class vtkView;

class VTKCSLFPARAVIEW_EXPORT vtkCSLFViewScene : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCSLFViewScene* New();
  vtkTypeMacro(vtkCSLFViewScene, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The view, a vtkPVRenderView. Default: none, which stands for the active view, if this process
   * is the client, too.
   */
  void SetView(vtkView* view);
  vtkView* GetView();
  ///@}

  ///@{
  /**
   * Whether the view's lights are captured; if not, the scene is lit by the environment that the
   * sampler has. Default: on.
   */
  vtkSetMacro(CaptureLights, bool);
  vtkGetMacro(CaptureLights, bool);
  vtkBooleanMacro(CaptureLights, bool);
  ///@}

  ///@{
  /**
   * Whether colours between points are interpolated as the view does, or as light: see
   * vtkCSLFSceneImporter. Default: on.
   */
  vtkSetMacro(InterpolateDisplayedColors, bool);
  vtkGetMacro(InterpolateDisplayedColors, bool);
  vtkBooleanMacro(InterpolateDisplayedColors, bool);
  ///@}

  /**
   * Has the next update capture the view as it is then.
   */
  void Capture();

protected:
  vtkCSLFViewScene();
  ~vtkCSLFViewScene() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFViewScene(const vtkCSLFViewScene&) = delete;
  void operator=(const vtkCSLFViewScene&) = delete;

  bool CaptureNow();

  vtkWeakPointer<vtkView> View;
  bool CaptureLights = true;
  bool InterpolateDisplayedColors = true;
  vtkNew<vtkMultiBlockDataSet> Scene; // what was captured
  vtkTimeStamp CaptureTime;
};

#endif
