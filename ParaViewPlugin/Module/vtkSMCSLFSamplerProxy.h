// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMCSLFSamplerProxy
 * @brief   the sampler's proxy: finds the lookup table that ParaView shows an array with
 *
 * Unless a LookupTable is set, it uses the session's table for the array that colours the inputs,
 * and another one when another array is chosen. A table that was not used before gets the array's
 * range.
 */
#ifndef vtkSMCSLFSamplerProxy_h
#define vtkSMCSLFSamplerProxy_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkSMSourceProxy.h"
#include "vtkWeakPointer.h" // for the table of the array

class vtkPVArrayInformation;

class VTKCSLFPARAVIEW_EXPORT vtkSMCSLFSamplerProxy : public vtkSMSourceProxy
{
public:
  static vtkSMCSLFSamplerProxy* New();
  vtkTypeMacro(vtkSMCSLFSamplerProxy, vtkSMSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void UpdateVTKObjects() override;

protected:
  vtkSMCSLFSamplerProxy() = default;
  ~vtkSMCSLFSamplerProxy() override = default;

private:
  vtkSMCSLFSamplerProxy(const vtkSMCSLFSamplerProxy&) = delete;
  void operator=(const vtkSMCSLFSamplerProxy&) = delete;

  vtkPVArrayInformation* FindColorArray();
  void ResetMissingArray();

  vtkWeakPointer<vtkSMProxy> TableOfArray; // which LookupTable was set to, unless it was chosen
};

#endif
