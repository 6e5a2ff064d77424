// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMCSLFViewSceneProxy.h"

#include <vtkClientServerStream.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVSession.h>
#include <vtkPVXMLElement.h>

#include <cstring>

vtkStandardNewMacro(vtkSMCSLFViewSceneProxy);

//------------------------------------------------------------------------------
vtkPVXMLElement* vtkSMCSLFViewSceneProxy::SaveXMLState(
  vtkPVXMLElement* root, vtkSMPropertyIterator* iter)
{
  vtkPVXMLElement* state = this->Superclass::SaveXMLState(root, iter);
  if (!state || !this->ObjectsCreated)
  {
    return state;
  }
  vtkClientServerStream request;
  request << vtkClientServerStream::Invoke << VTKOBJECT(this) << "GetCapturedScene"
          << vtkClientServerStream::End;
  this->ExecuteStream(request, false, vtkPVSession::DATA_SERVER_ROOT);
  const char* text = nullptr;
  this->GetLastResult(vtkPVSession::DATA_SERVER_ROOT).GetArgument(0, 0, &text);
  for (unsigned int i = 0; text && *text && i < state->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* property = state->GetNestedElement(i);
    const char* name = property->GetAttribute("name");
    if (name && std::strcmp(name, "CapturedScene") == 0)
    {
      vtkNew<vtkPVXMLElement> element;
      element->SetName("Element");
      element->AddAttribute("index", 0);
      element->AddAttribute("value", text);
      property->RemoveAllNestedElements();
      property->AddNestedElement(element);
      property->SetAttribute("number_of_elements", "1");
    }
  }
  return state;
}

//------------------------------------------------------------------------------
void vtkSMCSLFViewSceneProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
