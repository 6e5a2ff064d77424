// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMCSLFViewSceneProxy
 * @brief   the proxy of a captured scene: states contain the scene
 *
 * When a state is loaded, the view may not show what was captured, for example because the light
 * field has replaced it. So the state has the value of vtkCSLFViewScene::GetCapturedScene for the
 * property CapturedScene, which is empty otherwise.
 */
#ifndef vtkSMCSLFViewSceneProxy_h
#define vtkSMCSLFViewSceneProxy_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkSMSourceProxy.h"

class VTKCSLFPARAVIEW_EXPORT vtkSMCSLFViewSceneProxy : public vtkSMSourceProxy
{
public:
  static vtkSMCSLFViewSceneProxy* New();
  vtkTypeMacro(vtkSMCSLFViewSceneProxy, vtkSMSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkSMSourceProxy::SaveXMLState;
  vtkPVXMLElement* SaveXMLState(vtkPVXMLElement* root, vtkSMPropertyIterator* iter) override;

  /**
   * Sets the scene before anything else, because the view, which is loaded with this proxy, may
   * already show what is made of the scene, and again after the properties that would make the next
   * update capture the view.
   */
  int LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator) override;

protected:
  vtkSMCSLFViewSceneProxy() = default;
  ~vtkSMCSLFViewSceneProxy() override = default;

private:
  vtkSMCSLFViewSceneProxy(const vtkSMCSLFViewSceneProxy&) = delete;
  void operator=(const vtkSMCSLFViewSceneProxy&) = delete;
};

#endif
