// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFSceneSource.h"

#include "Pipeline/cslfGuard.h"

#include "Scenes/cslfProceduralScene.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>

#include <algorithm>

vtkStandardNewMacro(vtkCSLFSceneSource);
cslfGuardedRequestMacro(vtkCSLFSceneSource);

namespace
{
using cslf::GetProceduralScenes;

const std::string CornellBoxName = "cornell-box";

/// Null if there is none.
const cslf::ProceduralScene* FindScene(const std::string& name)
{
  const auto& scenes = GetProceduralScenes();
  const auto found = std::find_if(scenes.begin(), scenes.end(),
    [&name](const cslf::ProceduralScene& scene) { return scene.Name == name; });
  return found == scenes.end() ? nullptr : &*found;
}

/// The number of a scene among those of GetProceduralScenes.
bool IsProcedural(int scene)
{
  return scene > 0 && scene < vtkCSLFSceneSource::GetNumberOfScenes();
}
}

vtkCSLFSceneSource::vtkCSLFSceneSource()
  : SceneName(CornellBoxName)
{
  this->SetNumberOfInputPorts(0);
}

int vtkCSLFSceneSource::GetNumberOfScenes()
{
  return static_cast<int>(GetProceduralScenes().size()) + 1;
}

const char* vtkCSLFSceneSource::GetSceneName(int scene)
{
  return scene == 0       ? CornellBoxName.c_str()
    : IsProcedural(scene) ? GetProceduralScenes()[scene - 1].Name
                          : nullptr;
}

const char* vtkCSLFSceneSource::GetSceneDescription(int scene)
{
  return scene == 0       ? "The Cornell box, a room with two blocks and a lamp."
    : IsProcedural(scene) ? GetProceduralScenes()[scene - 1].Description
                          : nullptr;
}

bool vtkCSLFSceneSource::HasScene(const char* name)
{
  return name && (name == CornellBoxName || FindScene(name));
}

void vtkCSLFSceneSource::SetUpEnvironment(vtkCSLFEnvironment* environment)
{
  const cslf::ProceduralScene* scene = FindScene(this->SceneName);
  if (!environment || !HasScene(this->SceneName.c_str()))
  {
    return;
  }
  environment->SetMode(!scene || scene->Light == cslf::SceneLight::Window
      ? vtkCSLFEnvironment::NoEnvironment
      : scene->Light == cslf::SceneLight::White ? vtkCSLFEnvironment::ConstantEnvironment
                                                : vtkCSLFEnvironment::GradientEnvironment);
}

bool vtkCSLFSceneSource::AddToRenderer(vtkRenderer* renderer)
{
  const cslf::ProceduralScene* scene = FindScene(this->SceneName);
  if (!scene || !renderer)
  {
    return false;
  }
  return cslf::GuardMethod(this, "The scene cannot be added",
    [&]
    {
      scene->Add(renderer);
      return true;
    });
}

int vtkCSLFSceneSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  if (this->SceneName == CornellBoxName)
  {
    vtkNew<vtkCSLFCornellBoxSource> box;
    box->Update();
    output->ShallowCopy(box->GetOutput());
    return 1;
  }
  const cslf::ProceduralScene* scene = FindScene(this->SceneName);
  if (!scene)
  {
    vtkErrorMacro("There is no scene " << this->SceneName << ".");
    return 0;
  }
  vtkNew<vtkRenderer> renderer;
  scene->Add(renderer);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  importer->Update();
  output->ShallowCopy(importer->GetOutput());
  if (scene->Light != cslf::SceneLight::Window)
  {
    // The last block is that of the renderer's headlight.
    output->SetNumberOfBlocks(output->GetNumberOfBlocks() - 1);
  }
  return 1;
}

void vtkCSLFSceneSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SceneName: " << this->SceneName << "\n";
}
