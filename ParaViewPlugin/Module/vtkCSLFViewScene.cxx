// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFViewScene.h"

#include "Pipeline/cslfGuard.h"
#include "cslfLegend.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkBase64Utilities.h>
#include <vtkCellData.h>
#include <vtkCharArray.h>
#include <vtkCommunicator.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationVector.h>
#include <vtkMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPVRenderView.h>
#include <vtkPointData.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSMProxyManager.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMViewProxy.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

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

/// ParaView requires names for all arrays of points and cells. The captured scene has its colours,
/// so no list offers its arrays to colour by. The arrays belong to those who made the view's data,
/// so copies get the names, which no other array has, and are hidden.
void PrepareArrays(vtkDataSetAttributes* attributes)
{
  int number = 0;
  for (int count = attributes->GetNumberOfArrays(); count > 0; --count)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(0);
    const vtkSmartPointer<vtkAbstractArray> copy = CopyArray(array);
    std::string name = array->GetName() ? array->GetName() : "";
    const int attribute = attributes->IsArrayAnAttribute(0);
    attributes->RemoveArray(0);
    while (name.empty() || attributes->HasArray(name.c_str()))
    {
      name = "Array" + std::to_string(number++);
    }
    copy->SetName(name.c_str());
    copy->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
    attributes->AddArray(copy);
    if (attribute >= 0)
    {
      attributes->SetActiveAttribute(name.c_str(), attribute);
    }
  }
}

void PrepareArrays(vtkMultiBlockDataSet* scene)
{
  for (unsigned int i = 0; i < scene->GetNumberOfBlocks(); ++i)
  {
    if (auto* block = vtkDataSet::SafeDownCast(scene->GetBlock(i)))
    {
      PrepareArrays(block->GetPointData());
      PrepareArrays(block->GetCellData());
    }
  }
}

// The longest text of a scene in a state file.
constexpr std::size_t MaximumText = std::size_t(64) << 20;

// Of a compressed scene, the expansion that zlib can reach at most.
constexpr std::size_t MaximumExpansion = 1100;

/// A scene as text: its size, the size when it is compressed, and that in base 64.
std::string ToText(vtkMultiBlockDataSet* scene)
{
  vtkNew<vtkCharArray> bytes;
  if (!vtkCommunicator::MarshalDataObject(scene, bytes))
  {
    return "";
  }
  const auto* first = reinterpret_cast<const unsigned char*>(bytes->GetPointer(0));
  const std::size_t size = bytes->GetNumberOfValues();
  vtkNew<vtkZLibDataCompressor> compressor;
  const auto compressed = vtk::TakeSmartPointer(compressor->Compress(first, size));
  if (!compressed)
  {
    return "";
  }
  const std::size_t packed = compressed->GetNumberOfValues();
  std::vector<unsigned char> text(4 * (packed / 3 + 1) + 1);
  const std::size_t length =
    vtkBase64Utilities::Encode(compressed->GetPointer(0), packed, text.data());
  return std::to_string(size) + " " + std::to_string(packed) + " " +
    std::string(text.begin(), text.begin() + length);
}

/// The scene of a text. Null if the text is damaged.
vtkSmartPointer<vtkMultiBlockDataSet> FromText(const std::string& text)
{
  std::istringstream stream(text);
  std::size_t size = 0;
  std::size_t packed = 0;
  std::string encoded;
  stream >> size >> packed >> encoded;
  if (packed == 0 || packed > encoded.size() || size / MaximumExpansion > packed)
  {
    return nullptr;
  }
  std::vector<unsigned char> compressed(packed);
  const std::size_t length =
    vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(encoded.data()),
      encoded.size(), compressed.data(), compressed.size());
  vtkNew<vtkZLibDataCompressor> compressor;
  const auto bytes = vtk::TakeSmartPointer(
    length == packed ? compressor->Uncompress(compressed.data(), packed, size) : nullptr);
  if (!bytes)
  {
    return nullptr;
  }
  vtkNew<vtkCharArray> data;
  data->SetNumberOfValues(bytes->GetNumberOfValues());
  std::copy_n(bytes->GetPointer(0), bytes->GetNumberOfValues(), data->GetPointer(0));
  return vtkMultiBlockDataSet::SafeDownCast(vtkCommunicator::UnMarshalDataObject(data));
}

/// Whether a scene has anything beside its last block, which holds the lights.
bool HasSurfaces(vtkMultiBlockDataSet* scene)
{
  for (unsigned int i = 0; i + 1 < scene->GetNumberOfBlocks(); ++i)
  {
    auto* block = vtkDataSet::SafeDownCast(scene->GetBlock(i));
    if (block && block->GetNumberOfCells() > 0)
    {
      return true;
    }
  }
  return false;
}

bool IsAlone()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return !controller || controller->GetNumberOfProcesses() < 2;
}

/// The name of the array whose colours an actor shows. Empty if there is none.
std::string GetColorArray(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  return mapper && mapper->GetScalarVisibility() && mapper->GetLookupTable() &&
      mapper->GetArrayName()
    ? mapper->GetArrayName()
    : "";
}

/// What gives an actor its colours, as text to compare.
std::string DescribeColors(vtkActor* actor)
{
  const std::string array = GetColorArray(actor);
  vtkMapper* mapper = actor->GetMapper();
  std::ostringstream text;
  if (!array.empty())
  {
    text << array << ' ' << mapper->GetScalarMode() << ' '
         << cslf::DescribeTable(mapper->GetLookupTable());
  }
  for (const double* color :
    { actor->GetProperty()->GetAmbientColor(), actor->GetProperty()->GetDiffuseColor() })
  {
    text << ' ' << color[0] << ' ' << color[1] << ' ' << color[2];
  }
  text << ' ' << actor->GetProperty()->GetOpacity();
  return text.str();
}

/// Imports what representations show: a view's renderer has decorations, too. Representations have
/// actors of ParaView's class, or plain ones (of molecules and point Gaussians); decorations have
/// other classes. Slices cannot be imported, and are named in a warning.
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

public:
  /// The actors that are shown and part of the scene.
  std::vector<vtkActor*> GetActors()
  {
    std::vector<vtkActor*> actors;
    vtkCollectionSimpleIterator cookie;
    this->GetRenderer()->GetViewProps()->InitTraversal(cookie);
    while (vtkProp* prop = this->GetRenderer()->GetViewProps()->GetNextProp(cookie))
    {
      auto* actor = vtkActor::SafeDownCast(prop);
      if (actor && actor->GetVisibility() && actor->GetMapper() && this->IsOfScene(prop))
      {
        actors.push_back(actor);
      }
    }
    return actors;
  }
};

vtkStandardNewMacro(ViewImporter);
}

/// An actor that was captured, and its colours then.
struct vtkCSLFViewScene::vtkInternals
{
  struct Captured
  {
    vtkWeakPointer<vtkActor> Actor;
    std::string Array; // empty if there was none
    std::string Colors;
  };
  std::vector<Captured> Actors;
};

//------------------------------------------------------------------------------
vtkCSLFViewScene::vtkCSLFViewScene()
  : Internals(new vtkInternals)
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
    this->Capture();
  }
}

//------------------------------------------------------------------------------
vtkView* vtkCSLFViewScene::GetView()
{
  return this->View;
}

//------------------------------------------------------------------------------
void vtkCSLFViewScene::SetCaptureLights(bool capture)
{
  if (this->CaptureLights != capture)
  {
    this->CaptureLights = capture;
    this->Capture();
  }
}

//------------------------------------------------------------------------------
void vtkCSLFViewScene::SetInterpolateDisplayedColors(bool interpolate)
{
  if (this->InterpolateDisplayedColors != interpolate)
  {
    this->InterpolateDisplayedColors = interpolate;
    this->Capture();
  }
}

//------------------------------------------------------------------------------
void vtkCSLFViewScene::SetExactColors(bool exact)
{
  if (this->ExactColors != exact)
  {
    this->ExactColors = exact;
    this->Capture();
  }
}

//------------------------------------------------------------------------------
void vtkCSLFViewScene::Capture()
{
  this->MustCapture = true;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFViewScene::SetCapturedScene(const char* text)
{
  if (!text || !*text)
  {
    return;
  }
  vtkSmartPointer<vtkMultiBlockDataSet> scene;
  std::string problem;
  cslf::Guard(
    [&]
    {
      scene = FromText(text);
      return true;
    },
    problem);
  if (!scene)
  {
    vtkErrorMacro("The captured scene in the state file is damaged"
      << (problem.empty() ? "" : ": " + problem) << ".");
    return;
  }
  // The other ranks have nothing, as each surface counts once.
  this->Scene->Initialize();
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (IsAlone() || controller->GetLocalProcessId() == 0)
  {
    this->Scene->ShallowCopy(scene);
    PrepareArrays(this->Scene);
  }
  this->Internals->Actors.clear();
  this->MustCapture = false;
  this->Modified();
}

//------------------------------------------------------------------------------
const char* vtkCSLFViewScene::GetCapturedScene()
{
  this->SceneText.clear();
  if (!this->MustCapture && IsAlone())
  {
    this->SceneText = cslf::GuardMethod(
      this, "The captured scene cannot be saved in the state", [&] { return ToText(this->Scene); });
  }
  if (this->SceneText.size() > MaximumText)
  {
    vtkWarningMacro("The captured scene is not in the state, as it takes "
      << (this->SceneText.size() >> 20) << " MiB, more than " << (MaximumText >> 20)
      << " MiB. Save it by File > Save Data, and connect the CSLF Sampler to that file.");
    this->SceneText.clear();
  }
  return this->SceneText.c_str();
}

//------------------------------------------------------------------------------
std::string vtkCSLFViewScene::FindChange()
{
  for (const vtkInternals::Captured& captured : this->Internals->Actors)
  {
    if (captured.Actor && captured.Actor->GetMapper() &&
      DescribeColors(captured.Actor) != captured.Colors)
    {
      return captured.Array.empty() ? "its surfaces" : captured.Array;
    }
  }
  return "";
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
  importer->SetExactColors(this->ExactColors);
  importer->Update();
  if (IsAlone() && !HasSurfaces(importer->GetOutput()))
  {
    vtkErrorMacro("The view shows no surface to capture: show the sources that the scene consists "
                  "of, then press Capture.");
    return false;
  }
  this->Scene->ShallowCopy(importer->GetOutput());
  PrepareArrays(this->Scene);
  vtkDataObject* lights = this->Scene->GetBlock(this->Scene->GetNumberOfBlocks() - 1);
  if (!this->CaptureLights)
  {
    vtkCSLFLight::RemoveLights(lights);
  }
  this->Internals->Actors.clear();
  for (vtkActor* actor : importer->GetActors())
  {
    const std::string array = GetColorArray(actor);
    this->Internals->Actors.push_back({ actor, array, DescribeColors(actor) });
    if (!array.empty())
    {
      cslf::AddLegend(lights->GetFieldData(), array, actor->GetMapper()->GetLookupTable());
    }
  }
  this->MustCapture = false;
  return true;
}

//------------------------------------------------------------------------------
int vtkCSLFViewScene::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  // If there is nothing to capture, the last capture stays.
  if (this->MustCapture && (this->CaptureNow() || HasSurfaces(this->Scene)))
  {
    this->MustCapture = false;
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
  os << indent << "ExactColors: " << (this->ExactColors ? "on" : "off") << "\n";
}
