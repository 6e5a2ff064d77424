// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMCSLFSamplerProxy.h"

#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkSMArrayListDomain.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMTransferFunctionManager.h>
#include <vtkSMTransferFunctionProxy.h>

#include <string>

vtkStandardNewMacro(vtkSMCSLFSamplerProxy);

//------------------------------------------------------------------------------
// The array that colours the inputs, from the first one that has it. Null if there is none.
vtkPVArrayInformation* vtkSMCSLFSamplerProxy::FindColorArray()
{
  vtkSMPropertyHelper input(this, "Input");
  vtkSMPropertyHelper color(this, "ColorArrayName");
  const char* name = color.GetInputArrayNameToProcess();
  for (unsigned int i = 0; name && *name && i < input.GetNumberOfElements(); ++i)
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(i));
    if (!source)
    {
      continue;
    }
    // Scripts may not have updated it yet.
    if (source->GetDataInformation(input.GetOutputPort(i))->GetNumberOfPoints() == 0)
    {
      source->UpdatePipeline();
    }
    vtkPVArrayInformation* array = source->GetDataInformation(input.GetOutputPort(i))
                                     ->GetArrayInformation(name, color.GetInputArrayAssociation());
    if (array)
    {
      return array;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
// Returns to the default if no input has the chosen array. Scripts that give the input as a keyword
// get the default of the active source's arrays first.
void vtkSMCSLFSamplerProxy::ResetMissingArray()
{
  vtkSMProperty* color = this->GetProperty("ColorArrayName");
  auto* arrays = color->FindDomain<vtkSMArrayListDomain>();
  const bool isKnown = arrays && arrays->GetNumberOfStrings() > 1; // the first is no array
  if (isKnown && !color->IsInDomains() && !this->FindColorArray())
  {
    color->ResetToDomainDefaults(false);
  }
}

//------------------------------------------------------------------------------
void vtkSMCSLFSamplerProxy::UpdateVTKObjects()
{
  this->ResetMissingArray();
  vtkSMPropertyHelper table(this, "LookupTable");
  const bool isChosen = table.GetAsProxy() && table.GetAsProxy() != this->TableOfArray;
  const bool isColored = vtkSMPropertyHelper(this, "ScalarVisibility").GetAsInt() != 0;
  vtkPVArrayInformation* array = isColored ? this->FindColorArray() : nullptr;
  vtkSMSessionProxyManager* proxies = this->GetSessionProxyManager();
  const std::string key = array ? std::string(array->GetName()) + ".PVLookupTable" : "";
  const bool isNew = array && !proxies->GetProxy("lookup_tables", key.c_str());
  // States have the table of the array as if it was chosen.
  if (array && (!isChosen || table.GetAsProxy() == proxies->GetProxy("lookup_tables", key.c_str())))
  {
    vtkNew<vtkSMTransferFunctionManager> manager;
    vtkSMProxy* colors = manager->GetColorTransferFunction(array->GetName(), proxies);
    if (isNew)
    {
      const double* range = array->GetComponentRange(array->GetNumberOfComponents() > 1 ? -1 : 0);
      vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, range[0], range[1]);
    }
    table.Set(colors);
    this->TableOfArray = colors;
  }
  this->Superclass::UpdateVTKObjects();
}

//------------------------------------------------------------------------------
void vtkSMCSLFSamplerProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
