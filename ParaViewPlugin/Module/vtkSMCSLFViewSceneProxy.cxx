// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMCSLFViewSceneProxy.h"

#include <vtkClientServerStream.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVSession.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPropertyHelper.h>

#include <cstring>

vtkStandardNewMacro(vtkSMCSLFViewSceneProxy);

namespace
{
const char* const SceneProperty = "CapturedScene";

/// The property with the scene in a state. Null if there is none.
vtkPVXMLElement* FindScene(vtkPVXMLElement* state)
{
  for (unsigned int i = 0; i < state->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* property = state->GetNestedElement(i);
    const char* name = property->GetAttribute("name");
    if (name && std::strcmp(name, SceneProperty) == 0)
    {
      return property;
    }
  }
  return nullptr;
}
}

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
  vtkPVXMLElement* property = FindScene(state);
  if (property && text && *text)
  {
    vtkNew<vtkPVXMLElement> element;
    element->SetName("Element");
    element->AddAttribute("index", 0);
    element->AddAttribute("value", text);
    property->RemoveAllNestedElements();
    property->AddNestedElement(element);
    property->SetAttribute("number_of_elements", "1");
  }
  return state;
}

//------------------------------------------------------------------------------
int vtkSMCSLFViewSceneProxy::LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator)
{
  vtkPVXMLElement* property = FindScene(element);
  vtkPVXMLElement* scene = property ? property->FindNestedElementByName("Element") : nullptr;
  if (!scene)
  {
    return this->Superclass::LoadXMLState(element, locator);
  }
  vtkSMPropertyHelper(this, SceneProperty).Set(scene->GetAttribute("value"));
  this->UpdateProperty(SceneProperty, 1);
  const int result = this->Superclass::LoadXMLState(element, locator);
  this->UpdateVTKObjects();
  this->UpdateProperty(SceneProperty, 1);
  return result;
}

//------------------------------------------------------------------------------
void vtkSMCSLFViewSceneProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
