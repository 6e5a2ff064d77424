// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMCSLFSamplerProxy.h"

#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMTransferFunctionManager.h>
#include <vtkSMTransferFunctionProxy.h>

#include <string>

vtkStandardNewMacro(vtkSMCSLFSamplerProxy);

//------------------------------------------------------------------------------
// The array that colours the first input: the chosen one, or else the active scalars of its points
// or cells.
vtkPVArrayInformation* vtkSMCSLFSamplerProxy::FindColorArray()
{
  vtkSMPropertyHelper input(this, "Input");
  auto* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()) : nullptr;
  if (!source || vtkSMPropertyHelper(this, "ScalarVisibility").GetAsInt() == 0)
  {
    return nullptr;
  }
  vtkPVDataInformation* data = source->GetDataInformation(input.GetOutputPort());
  // Scripts may not have updated it yet.
  if (data->GetNumberOfPoints() == 0)
  {
    source->UpdatePipeline();
    data = source->GetDataInformation(input.GetOutputPort());
  }
  vtkSMPropertyHelper array(this, "ColorArrayName");
  const char* name = array.GetInputArrayNameToProcess();
  if (name && *name)
  {
    return data->GetArrayInformation(name, array.GetInputArrayAssociation());
  }
  vtkPVArrayInformation* scalars =
    data->GetPointDataInformation()->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
  return scalars
    ? scalars
    : data->GetCellDataInformation()->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
void vtkSMCSLFSamplerProxy::UpdateVTKObjects()
{
  vtkSMPropertyHelper table(this, "LookupTable");
  vtkPVArrayInformation* array = table.GetAsProxy() ? nullptr : this->FindColorArray();
  if (array)
  {
    vtkSMSessionProxyManager* proxies = this->GetSessionProxyManager();
    const std::string key = std::string(array->GetName()) + ".PVLookupTable";
    const bool isNew = !proxies->GetProxy("lookup_tables", key.c_str());
    vtkNew<vtkSMTransferFunctionManager> manager;
    vtkSMProxy* colors = manager->GetColorTransferFunction(array->GetName(), proxies);
    if (isNew)
    {
      const double* range = array->GetComponentRange(array->GetNumberOfComponents() > 1 ? -1 : 0);
      vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, range[0], range[1]);
    }
    table.Set(colors);
  }
  this->Superclass::UpdateVTKObjects();
}

//------------------------------------------------------------------------------
void vtkSMCSLFSamplerProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
