// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFViewScene.h"

#include "Pipeline/cslfGuard.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPVRenderView.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkSMProxyManager.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMViewProxy.h>
#include <vtkSmartPointer.h>

#include <string>

vtkStandardNewMacro(vtkCSLFViewScene);
cslfGuardedRequestMacro(vtkCSLFViewScene);

namespace
{
/// The client's active view. Null if this process is not a client, or if there is none.
vtkView* GetActiveView()
{
  if (!vtkSMProxyManager::IsInitialized())
  {
    return nullptr;
  }
  vtkSMSessionProxyManager* proxies =
    vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  vtkSMProxySelectionModel* views = proxies ? proxies->GetSelectionModel("ActiveView") : nullptr;
  vtkSMProxy* view = views ? views->GetCurrentProxy() : nullptr;
  return view ? vtkView::SafeDownCast(view->GetClientSideObject()) : nullptr;
}

/// A copy of an array that shares its values, if its type can share them.
vtkSmartPointer<vtkAbstractArray> CopyArray(vtkAbstractArray* array)
{
  auto copy = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  auto* values = vtkDataArray::SafeDownCast(copy);
  if (values)
  {
    values->ShallowCopy(vtkDataArray::SafeDownCast(array));
  }
  else
  {
    copy->DeepCopy(array);
  }
  return copy;
}

/// ParaView requires names for all arrays of points and cells. The arrays belong to those who made
/// the view's data, so copies get the names, which no other array has.
void NameArrays(vtkDataSetAttributes* attributes)
{
  int number = 0;
  for (int i = 0; i < attributes->GetNumberOfArrays();)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    if (array->GetName())
    {
      ++i;
      continue;
    }
    const vtkSmartPointer<vtkAbstractArray> copy = CopyArray(array);
    std::string name;
    do
    {
      name = "Array" + std::to_string(number++);
    } while (attributes->HasArray(name.c_str()));
    copy->SetName(name.c_str());
    const int attribute = attributes->IsArrayAnAttribute(i);
    attributes->RemoveArray(i);
    attributes->AddArray(copy);
    if (attribute >= 0)
    {
      attributes->SetActiveAttribute(name.c_str(), attribute);
    }
  }
}

void NameArrays(vtkMultiBlockDataSet* scene)
{
  for (unsigned int i = 0; i < scene->GetNumberOfBlocks(); ++i)
  {
    if (auto* block = vtkDataSet::SafeDownCast(scene->GetBlock(i)))
    {
      NameArrays(block->GetPointData());
      NameArrays(block->GetCellData());
    }
  }
}

/// Imports what representations show: a view's renderer has decorations, too. Representations have
/// actors of ParaView's class, or plain ones (of molecules and point Gaussians); decorations have
/// other classes. Volumes and slices cannot be imported, and are named in a warning.
class ViewImporter : public vtkCSLFSceneImporter
{
public:
  static ViewImporter* New();
  vtkTypeMacro(ViewImporter, vtkCSLFSceneImporter);

protected:
  bool IsOfScene(vtkProp* prop) override
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    if (!actor)
    {
      return prop->IsA("vtkVolume") || prop->IsA("vtkImageSlice");
    }
    const std::string plain = vtkSmartPointer<vtkActor>::New()->GetClassName();
    return (actor->IsA("vtkPVLODActor") || actor->GetClassName() == plain) &&
      !vtkCSLFMapper::SafeDownCast(actor->GetMapper());
  }
};

vtkStandardNewMacro(ViewImporter);
}

//------------------------------------------------------------------------------
vtkCSLFViewScene::vtkCSLFViewScene()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkCSLFViewScene::~vtkCSLFViewScene() = default;

//------------------------------------------------------------------------------
void vtkCSLFViewScene::SetView(vtkView* view)
{
  if (this->View != view)
  {
    this->View = view;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkView* vtkCSLFViewScene::GetView()
{
  return this->View;
}

//------------------------------------------------------------------------------
void vtkCSLFViewScene::Capture()
{
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkCSLFViewScene::CaptureNow()
{
  auto* view = vtkPVRenderView::SafeDownCast(this->View ? this->View.Get() : GetActiveView());
  if (!view)
  {
    vtkErrorMacro("There is no render view to capture: set View.");
    return false;
  }
  vtkNew<ViewImporter> importer;
  importer->SetRenderer(view->GetRenderer());
  importer->SetInterpolateDisplayedColors(this->InterpolateDisplayedColors);
  importer->Update();
  this->Scene->ShallowCopy(importer->GetOutput());
  NameArrays(this->Scene);
  const unsigned int last = this->Scene->GetNumberOfBlocks() - 1;
  if (!this->CaptureLights)
  {
    vtkCSLFLight::RemoveLights(this->Scene->GetBlock(last));
  }
  this->CaptureTime.Modified();
  return true;
}

//------------------------------------------------------------------------------
int vtkCSLFViewScene::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (this->CaptureTime < this->GetMTime() && !this->CaptureNow())
  {
    return 0;
  }
  vtkMultiBlockDataSet::GetData(outputVector)->ShallowCopy(this->Scene);
  return 1;
}

//------------------------------------------------------------------------------
void vtkCSLFViewScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View: " << this->View.Get() << "\n";
  os << indent << "CaptureLights: " << (this->CaptureLights ? "on" : "off") << "\n";
  os << indent
     << "InterpolateDisplayedColors: " << (this->InterpolateDisplayedColors ? "on" : "off") << "\n";
}
