// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFSceneImporter.h"

#include "Pipeline/cslfGuard.h"

#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfPhase.h"
#include "SceneData/cslfWindowLights.h"
#include "SceneImport/cslfActorImporter.h"
#include "SceneImport/cslfBlockAppearances.h"
#include "SceneImport/cslfImportedScene.h"
#include "SceneImport/cslfLightImporter.h"
#include "SceneImport/cslfVolumeImporter.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFPathTracer.h"

#include <vtkAbstractMapper3D.h>
#include <vtkAbstractVolumeMapper.h>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkAssemblyNode.h>
#include <vtkAssemblyPath.h>
#include <vtkBoundingBox.h>
#include <vtkCameraPass.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageMapper3D.h>
#include <vtkImageProcessingPass.h>
#include <vtkImageSlice.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkLODProp3D.h>
#include <vtkMapper.h>
#include <vtkMapper2D.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPropCollection.h>
#include <vtkRenderPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkTexture.h>
#include <vtkVolume.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <vector>

vtkStandardNewMacro(vtkCSLFSceneImporter);
cslfSetClampMacro(vtkCSLFSceneImporter, PixelSize, 1e-9, 1.0);
cslfSetClampMacro(vtkCSLFSceneImporter, PointRadius, -1.0, cslf::options::PointRadius.Maximum);
cslfGuardedRequestMacro(vtkCSLFSceneImporter);

namespace
{
/// The prop at the end of a path, and its transform. Null if the path is not visible.
vtkProp* GetVisibleEnd(vtkAssemblyPath* path)
{
  vtkCollectionSimpleIterator cookie;
  path->InitTraversal(cookie);
  while (vtkAssemblyNode* node = path->GetNextNode(cookie))
  {
    if (!node->GetViewProp()->GetVisibility())
    {
      return nullptr;
    }
  }
  return path->GetLastNode()->GetViewProp();
}

/// The actor to import for a prop with levels of detail: the selected one, or else the one with the
/// most cells. The prop itself if that is not an actor or there are no levels.
vtkProp* SelectLevel(vtkProp* prop)
{
  auto* levels = vtkLODProp3D::SafeDownCast(prop);
  if (!levels)
  {
    return prop;
  }
  const bool isFixed = !levels->GetAutomaticLODSelection();
  vtkAbstractMapper3D* fixed = isFixed ? levels->GetLODMapper(levels->GetSelectedLODID()) : nullptr;
  vtkNew<vtkPropCollection> volumes;
  levels->GetVolumes(volumes);
  vtkNew<vtkPropCollection> actors;
  levels->GetActors(actors);
  vtkProp* selected = prop;
  vtkIdType largest = -1;
  vtkCollectionSimpleIterator cookie;
  actors->InitTraversal(cookie);
  while (auto* actor = vtkActor::SafeDownCast(actors->GetNextProp(cookie)))
  {
    vtkMapper* mapper = actor->GetMapper();
    vtkAlgorithm* source = mapper ? mapper->GetInputAlgorithm() : nullptr;
    if (!source || (isFixed ? mapper != fixed : volumes->GetNumberOfItems() > 0))
    {
      continue;
    }
    source->Update();
    vtkDataObject* data = mapper->GetInputDataObject(0, 0);
    const vtkIdType size = data ? data->GetNumberOfElements(vtkDataObject::CELL) : 0;
    if (size > largest)
    {
      selected = actor;
      largest = size;
    }
  }
  return selected;
}

/// Calls `visit(prop, matrix)` for all visible props that a prop consists of.
void ForEachPart(vtkProp* prop, const std::function<void(vtkProp*, vtkMatrix4x4*)>& visit)
{
  prop->InitPathTraversal();
  while (vtkAssemblyPath* path = prop->GetNextPath())
  {
    if (vtkProp* end = GetVisibleEnd(path))
    {
      visit(SelectLevel(end), path->GetLastNode()->GetMatrix());
    }
  }
}

/// Records a prop that is not imported, unless it shows nothing. An actor is named by its mapper,
/// if it has one.
void Omit(vtkProp* prop, cslf::ImportedScene& scene)
{
  auto* actor = vtkActor::SafeDownCast(prop);
  if (!actor || actor->IsA("vtkSkybox"))
  {
    scene.Meet(cslf::ImportLimit::OtherProps, prop->GetClassName());
  }
  else if (actor->GetMapper())
  {
    if (actor->GetMapper()->GetNumberOfInputConnections(0) > 0)
    {
      scene.Meet(cslf::ImportLimit::OtherMappers, actor->GetMapper()->GetClassName());
    }
  }
  else if (!vtkSmartPointer<vtkActor>::New()->IsA(actor->GetClassName()))
  {
    // Actors with their own drawing code belong to separate classes.
    scene.Meet(cslf::ImportLimit::OtherProps, actor->GetClassName());
  }
}

/// Whether a pipeline begins with an importer or tracer of this renderer.
bool IsOfImport(vtkAlgorithm* filter, vtkRenderer* renderer)
{
  std::vector<vtkAlgorithm*> found{ filter };
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    auto* importer = vtkCSLFSceneImporter::SafeDownCast(found[i]);
    auto* tracer = vtkCSLFPathTracer::SafeDownCast(found[i]);
    if ((importer && importer->GetRenderer() == renderer) ||
      (tracer && tracer->GetRenderer() == renderer))
    {
      return true;
    }
    for (int port = 0; found[i] && port < found[i]->GetNumberOfInputPorts(); ++port)
    {
      for (int input = 0; input < found[i]->GetNumberOfInputConnections(port); ++input)
      {
        vtkAlgorithm* producer = found[i]->GetInputAlgorithm(port, input);
        if (std::find(found.begin(), found.end(), producer) == found.end())
        {
          found.push_back(producer);
        }
      }
    }
  }
  return false;
}

/// Whether a prop without parts shows what was made of the renderer's scene.
bool IsOfImport(vtkProp* part, vtkRenderer* renderer)
{
  vtkAlgorithm* mapper = nullptr;
  vtkAlgorithm* texture = nullptr;
  if (auto* actor = vtkActor::SafeDownCast(part))
  {
    mapper = actor->GetMapper();
    texture = actor->GetTexture();
  }
  else if (auto* volume = vtkVolume::SafeDownCast(part))
  {
    mapper = volume->GetMapper();
  }
  else if (auto* slice = vtkImageSlice::SafeDownCast(part))
  {
    mapper = slice->GetMapper();
  }
  else if (auto* overlay = vtkActor2D::SafeDownCast(part))
  {
    mapper = overlay->GetMapper();
  }
  return IsOfImport(mapper, renderer) || IsOfImport(texture, renderer);
}

/// The same for all parts of assemblies and levels of detail.
bool ShowsImport(vtkProp* prop, vtkRenderer* renderer)
{
  vtkNew<vtkPropCollection> parts;
  prop->InitPathTraversal();
  while (vtkAssemblyPath* path = prop->GetNextPath())
  {
    vtkProp* end = path->GetLastNode()->GetViewProp();
    parts->AddItem(end);
    end->GetActors(parts);
    end->GetVolumes(parts);
  }
  bool isShown = false;
  vtkCollectionSimpleIterator cookie;
  parts->InitTraversal(cookie);
  while (vtkProp* part = parts->GetNextProp(cookie))
  {
    isShown = isShown || IsOfImport(part, renderer);
  }
  return isShown;
}

/// Passes that draw what a renderer without a pass draws, perhaps without jagged edges, or a part
/// of it. ParaView's views always have a camera pass with its default pass.
const char* const PlainPasses[] = { "vtkDefaultPass", "vtkPVDefaultPass", "vtkLightsPass",
  "vtkOpaquePass", "vtkTranslucentPass", "vtkOrderIndependentTranslucentPass",
  "vtkDepthPeelingPass", "vtkVolumetricPass", "vtkOverlayPass", "vtkOpenGLFXAAPass", "vtkSSAAPass",
  "vtkClearZPass" };

/// Records the passes that draw anything else, among those that a pass consists of.
void MeetPasses(vtkRenderPass* pass, cslf::ImportedScene& scene)
{
  if (!pass)
  {
    return;
  }
  if (auto* sequence = vtkSequencePass::SafeDownCast(pass))
  {
    vtkRenderPassCollection* passes = sequence->GetPasses();
    for (int i = 0; passes && i < passes->GetNumberOfItems(); ++i)
    {
      MeetPasses(vtkRenderPass::SafeDownCast(passes->GetItemAsObject(i)), scene);
    }
    return;
  }
  auto* camera = vtkCameraPass::SafeDownCast(pass);
  auto* processing = vtkImageProcessingPass::SafeDownCast(pass);
  const bool isPlain = camera ||
    std::any_of(std::begin(PlainPasses), std::end(PlainPasses),
      [pass](const char* name) { return pass->IsA(name) != 0; });
  if (!isPlain)
  {
    scene.Meet(cslf::ImportLimit::RenderPasses, pass->GetClassName());
  }
  MeetPasses(camera ? camera->GetDelegatePass()
      : processing  ? processing->GetDelegatePass()
                    : nullptr,
    scene);
}

bool HasLimit(int limit)
{
  return limit >= 0 && limit < vtkCSLFSceneImporter::GetNumberOfLimits();
}

const cslf::ImportLimitText& GetLimit(int limit)
{
  return cslf::GetText(static_cast<cslf::ImportLimit>(limit));
}

/// The median scale of a block's instances, by which the tracer scales widths; 1 if there are none.
double GetTypicalScale(vtkPolyData* data)
{
  vtkDataArray* matrices = data->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  if (!matrices || matrices->GetNumberOfComponents() != 16)
  {
    return 1.0;
  }
  std::vector<double> scales;
  for (vtkIdType i = 0; i < matrices->GetNumberOfTuples(); ++i)
  {
    double squares = 0.0;
    for (int element : { 0, 1, 2, 4, 5, 6, 8, 9, 10 })
    {
      const double value = matrices->GetComponent(i, element);
      squares += value * value;
    }
    if (squares > 0.0)
    {
      scales.push_back(std::sqrt(squares / 3.0));
    }
  }
  if (scales.empty())
  {
    return 1.0;
  }
  const auto middle = scales.begin() + scales.size() / 2;
  std::nth_element(scales.begin(), middle, scales.end());
  return *middle;
}

/// One point, in the middle of all blocks. VTK's writers leave out blocks without points.
vtkSmartPointer<vtkPoints> MakeMiddle(const cslf::ImportedScene& scene)
{
  vtkBoundingBox bounds = scene.VolumeBounds;
  for (const cslf::ImportedBlock& block : scene.Blocks)
  {
    bounds.AddBounds(block.Data->GetBounds());
  }
  double middle[3] = { 0.0, 0.0, 0.0 };
  if (bounds.IsValid())
  {
    bounds.GetCenter(middle);
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->InsertNextPoint(middle);
  return points;
}

/// Converts widths in pixels to widths in the world. Points get another radius if one is given, or
/// none if it is negative.
void SetRadii(cslf::ImportedScene& scene, double pixelSize, double pointRadius)
{
  vtkBoundingBox box = scene.VolumeBounds;
  for (const cslf::ImportedBlock& block : scene.Blocks)
  {
    box.AddBox(cslf::GetPlacedBounds(block.Data));
  }
  const double pixel = box.IsValid() ? pixelSize * box.GetDiagonalLength() : 0.0;
  for (cslf::ImportedBlock& block : scene.Blocks)
  {
    const double scale = GetTypicalScale(block.Data);
    const double radius = 0.5 * pixel / scale;
    if (block.Data->GetNumberOfLines() > 0 && vtkCSLFMaterial::GetLineRadius(block.Data) == 0.0)
    {
      vtkCSLFMaterial::SetLineRadius(block.Data, radius * block.LineWidth);
    }
    if (block.Data->GetNumberOfVerts() > 0 && pointRadius >= 0.0 &&
      vtkCSLFMaterial::GetPointRadius(block.Data) == 0.0)
    {
      vtkCSLFMaterial::SetPointRadius(
        block.Data, pointRadius > 0.0 ? pointRadius / scale : radius * block.PointSize);
    }
  }
}
}

vtkCSLFSceneImporter::vtkCSLFSceneImporter()
  : InterpolateDisplayedColors(cslf::options::InterpolateDisplayedColors.Default)
  , PointRadius(cslf::options::PointRadius.Default)
{
  this->SetNumberOfInputPorts(0);
}

vtkCSLFSceneImporter::~vtkCSLFSceneImporter()
{
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->DeleteObserver);
  }
}

void vtkCSLFSceneImporter::SetRenderer(vtkRenderer* renderer)
{
  if (renderer == this->GetRenderer())
  {
    return;
  }
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->DeleteObserver);
  }
  this->KeptRenderer = nullptr;
  this->Renderer = renderer;
  if (renderer)
  {
    this->DeleteObserver =
      renderer->AddObserver(vtkCommand::DeleteEvent, this, &vtkCSLFSceneImporter::KeepScene);
  }
  this->Modified();
}

vtkRenderer* vtkCSLFSceneImporter::GetRenderer()
{
  return this->KeptRenderer ? this->KeptRenderer.Get() : this->Renderer.Get();
}

// Called when the renderer is about to be deleted. Nobody may take a reference to it any more.
void vtkCSLFSceneImporter::KeepScene()
{
  vtkRenderer* renderer = this->Renderer;
  vtkNew<vtkRenderer> kept;
  vtkCollectionSimpleIterator cookie;
  renderer->GetViewProps()->InitTraversal(cookie);
  while (vtkProp* prop = renderer->GetViewProps()->GetNextProp(cookie))
  {
    if (!ShowsImport(prop, renderer))
    {
      kept->AddViewProp(prop);
    }
  }
  if (renderer->IsActiveCameraCreated())
  {
    kept->SetActiveCamera(renderer->GetActiveCamera());
  }
  kept->SetLightCollection(renderer->GetLights());
  kept->SetAutomaticLightCreation(renderer->GetAutomaticLightCreation());
  kept->SetLightFollowCamera(renderer->GetLightFollowCamera());
  kept->SetUseImageBasedLighting(renderer->GetUseImageBasedLighting());
  if (!IsOfImport(renderer->GetEnvironmentTexture(), renderer))
  {
    kept->SetEnvironmentTexture(renderer->GetEnvironmentTexture());
  }
  kept->SetEnvironmentUp(renderer->GetEnvironmentUp());
  kept->SetEnvironmentRight(renderer->GetEnvironmentRight());
  kept->SetPass(renderer->GetPass());
  this->KeptTime = std::max(renderer->GetMTime(), renderer->GetViewProps()->GetMTime());
  this->KeptRenderer = kept;
  this->Renderer = nullptr;
}

void vtkCSLFSceneImporter::SetSurfaceArraySelection(vtkDataArraySelection* selection)
{
  if (this->SurfaceArraySelection != selection)
  {
    this->SurfaceArraySelection = selection;
    this->Modified();
  }
}

vtkDataArraySelection* vtkCSLFSceneImporter::GetSurfaceArraySelection()
{
  return this->SurfaceArraySelection;
}

vtkMTimeType vtkCSLFSceneImporter::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  if (this->SurfaceArraySelection)
  {
    time = std::max(time, this->SurfaceArraySelection->GetMTime());
  }
  vtkRenderer* renderer = this->GetRenderer();
  if (!renderer || this->FindingTime)
  {
    return time;
  }
  this->FindingTime = true;
  bool isShown = false;
  const auto addTime = [&time](vtkProp* part, vtkMatrix4x4*)
  {
    auto* actor = vtkActor::SafeDownCast(part);
    if (actor && cslf::IsImportable(actor))
    {
      time = std::max(time, cslf::GetImportTime(actor));
    }
    auto* volume = vtkVolume::SafeDownCast(part);
    if (volume && cslf::IsImportable(volume))
    {
      time = std::max(time, cslf::GetImportTime(volume));
    }
  };
  vtkCollectionSimpleIterator cookie;
  renderer->GetViewProps()->InitTraversal(cookie);
  while (vtkProp* prop = renderer->GetViewProps()->GetNextProp(cookie))
  {
    if (this->IsOfScene(prop))
    {
      time = std::max(time, prop->GetMTime());
      ForEachPart(prop, addTime);
    }
    isShown = isShown || ShowsImport(prop, renderer);
  }
  // Who moves the camera around the result does not want another one for each picture. The time of
  // a renderer contains that of its camera.
  const vtkMTimeType ofRenderer =
    isShown ? renderer->vtkViewport::GetMTime() : renderer->GetMTime();
  time = std::max({ time, cslf::GetLightTime(renderer, this->HeadlightsAllAround, !isShown),
    this->KeptRenderer ? this->KeptTime
                       : std::max(ofRenderer, renderer->GetViewProps()->GetMTime()) });
  this->FindingTime = false;
  return time;
}

int vtkCSLFSceneImporter::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkRenderer* renderer = this->GetRenderer();
  if (!renderer)
  {
    vtkErrorMacro("Renderer is not set.");
    return 0;
  }
  cslf::Phase phase(this, "Importing the scene");
  cslf::ImportedScene scene;
  scene.HasExactColors = this->ExactColors;
  if (vtkDataArraySelection* kept = this->SurfaceArraySelection)
  {
    scene.KeepsArray = [kept](const char* name) { return kept->ArrayIsEnabled(name) != 0; };
  }
  const auto import = [&scene](vtkProp* part, vtkMatrix4x4* matrix)
  {
    auto* actor = vtkActor::SafeDownCast(part);
    if (actor && cslf::IsImportable(actor))
    {
      if (actor->IsA("vtkFollower"))
      {
        scene.Meet(cslf::ImportLimit::Followers);
      }
      cslf::ImportActor(actor, matrix, scene);
      return;
    }
    auto* volume = vtkVolume::SafeDownCast(part);
    if (volume && cslf::IsImportable(volume))
    {
      cslf::ImportVolume(volume, matrix, scene);
    }
    else
    {
      Omit(part, scene);
    }
  };
  const int props = renderer->GetViewProps()->GetNumberOfItems();
  int done = 0;
  vtkCollectionSimpleIterator cookie;
  renderer->GetViewProps()->InitTraversal(cookie);
  while (vtkProp* prop = renderer->GetViewProps()->GetNextProp(cookie))
  {
    if (this->IsOfScene(prop))
    {
      ForEachPart(prop, import);
    }
    if (!phase.Report(static_cast<double>(++done) / props))
    {
      return 1; // aborted
    }
  }
  MeetPasses(renderer->GetPass(), scene);
  if (this->ExactColors)
  {
    cslf::FinishExactColors(scene);
  }
  else
  {
    cslf::FindEnvironment(renderer, scene);
    cslf::WindowLights lights(renderer, this->HeadlightsAllAround);
    cslf::FinishAppearances(scene, lights, this->InterpolateDisplayedColors);
    lights.AddTo(scene.Lights);
    cslf::ImportEnvironment(renderer, lights.GetEnvironmentFactor(), scene);
  }
  SetRadii(scene, this->PixelSize, this->PointRadius);

  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  unsigned int index = 0;
  for (const cslf::ImportedBlock& block : scene.Blocks)
  {
    output->SetBlock(index++, block.Data);
  }
  for (const vtkSmartPointer<vtkDataSet>& volume : scene.Volumes)
  {
    output->SetBlock(index++, volume);
  }
  vtkNew<vtkPolyData> lightData;
  lightData->SetPoints(MakeMiddle(scene));
  lightData->SetFieldData(scene.Lights->GetFieldData());
  output->SetBlock(index, lightData);
  if (!scene.Limits.empty())
  {
    vtkWarningMacro("The bake differs from the window in: "
      << cslf::ToText(scene.Limits) << ". See Documentation/WindowAndBake.md.");
  }
  const std::string omitted = scene.ListOmitted();
  if (!omitted.empty())
  {
    vtkWarningMacro("Parts of the scene were left out: " << omitted << ".");
  }
  const std::string materials = scene.Materials.ToText();
  if (!materials.empty())
  {
    vtkWarningMacro(<< materials);
  }
  return 1;
}

int vtkCSLFSceneImporter::GetNumberOfLimits()
{
  return static_cast<int>(cslf::ImportLimit::Count);
}

const char* vtkCSLFSceneImporter::GetLimitName(int limit)
{
  return HasLimit(limit) ? GetLimit(limit).Name : nullptr;
}

const char* vtkCSLFSceneImporter::GetLimitInWindow(int limit)
{
  return HasLimit(limit) ? GetLimit(limit).Window : nullptr;
}

const char* vtkCSLFSceneImporter::GetLimitInBake(int limit)
{
  return HasLimit(limit) ? GetLimit(limit).Bake : nullptr;
}

bool vtkCSLFSceneImporter::GetLimitWarned(int limit)
{
  return HasLimit(limit) && GetLimit(limit).Warned;
}

bool vtkCSLFSceneImporter::IsOfScene(vtkProp* vtkNotUsed(prop))
{
  return true;
}

void vtkCSLFSceneImporter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Renderer: " << this->GetRenderer() << "\n";
  os << indent << "HeadlightsAllAround: " << this->HeadlightsAllAround << "\n";
  os << indent << "InterpolateDisplayedColors: " << this->InterpolateDisplayedColors << "\n";
  os << indent << "ExactColors: " << this->ExactColors << "\n";
  os << indent << "SurfaceArraySelection: " << this->SurfaceArraySelection.Get() << "\n";
  os << indent << "PixelSize: " << this->PixelSize << "\n";
  os << indent << "PointRadius: " << this->PointRadius << "\n";
}
