// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLightImporter.h"

#include "cslfColor.h"
#include "vtkCSLFLight.h"

#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkCollectionRange.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <algorithm>

namespace cslf
{
namespace
{
bool IsOn(vtkLight* light)
{
  return light->GetSwitch() && light->GetIntensity() > 0.0;
}

/// A light where it stands now. What moves with the camera is placed as before the next drawing,
/// but the renderer's own light is left alone.
vtkSmartPointer<vtkLight> Place(vtkLight* light, vtkRenderer* renderer)
{
  auto placed = vtkSmartPointer<vtkLight>::New();
  placed->DeepCopy(light);
  placed->SetTransformMatrix(light->GetTransformMatrix());
  if (!renderer->GetLightFollowCamera() || !renderer->IsActiveCameraCreated())
  {
    return placed;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  if (light->LightTypeIsHeadlight())
  {
    placed->SetTransformMatrix(nullptr);
    placed->SetPosition(camera->GetPosition());
    placed->SetFocalPoint(camera->GetFocalPoint());
  }
  else if (light->LightTypeIsCameraLight())
  {
    placed->SetTransformMatrix(camera->GetCameraLightTransformMatrix());
  }
  return placed;
}

/// Adds the radiance that lights a surface from everywhere as a headlight does straight ahead.
void AddAllAround(vtkLight* light, double radiance[3])
{
  double color[3];
  light->GetDiffuseColor(color);
  for (int i = 0; i < 3; ++i)
  {
    radiance[i] += light->GetIntensity() * SRGBToLinear(color[i]);
  }
}

/// The renderer's environment texture, where it lights the scene.
vtkTexture* FindEnvironment(vtkRenderer* renderer)
{
  return renderer->GetUseImageBasedLighting() ? renderer->GetEnvironmentTexture() : nullptr;
}

void ImportEnvironment(vtkRenderer* renderer, ImportedScene& scene)
{
  vtkTexture* texture = FindEnvironment(renderer);
  if (!texture)
  {
    return;
  }
  if (texture->GetCubeMap() || !texture->GetInputAlgorithm())
  {
    scene.Meet(ImportLimit::CubeMapEnvironments);
    return;
  }
  texture->GetInputAlgorithm()->Update();
  if (!vtkCSLFLight::SetEnvironmentImage(scene.Lights, texture->GetInput(),
        renderer->GetEnvironmentUp(), renderer->GetEnvironmentRight()))
  {
    scene.Meet(ImportLimit::EnvironmentImages);
  }
}
}

vtkMTimeType GetLightTime(vtkRenderer* renderer, bool headlightsAllAround)
{
  vtkMTimeType time = renderer->GetLights()->GetMTime();
  bool followsCamera = false;
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    time = std::max(time, light->GetMTime());
    followsCamera = followsCamera || light->LightTypeIsCameraLight() ||
      (light->LightTypeIsHeadlight() && !headlightsAllAround);
  }
  if (followsCamera && renderer->IsActiveCameraCreated())
  {
    time = std::max(time, renderer->GetActiveCamera()->GetMTime());
  }
  if (vtkTexture* texture = FindEnvironment(renderer))
  {
    time = std::max(time, texture->GetMTime());
    if (texture->GetInputAlgorithm())
    {
      texture->GetInputAlgorithm()->Update();
      time = std::max(time, texture->GetInput()->GetMTime());
    }
  }
  return time;
}

void ImportLights(vtkRenderer* renderer, bool headlightsAllAround, ImportedScene& scene)
{
  double radiance[3] = { 0.0, 0.0, 0.0 };
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    if (!IsOn(light))
    {
      continue;
    }
    if (headlightsAllAround && light->LightTypeIsHeadlight())
    {
      AddAllAround(light, radiance);
      continue;
    }
    vtkCSLFLight::AddLight(scene.Lights, Place(light, renderer));
  }
  if (renderer->GetLights()->GetNumberOfItems() == 0 && renderer->GetAutomaticLightCreation())
  {
    // The renderer would make a headlight before it draws.
    vtkNew<vtkLight> headlight;
    headlight->SetLightTypeToHeadlight();
    if (headlightsAllAround)
    {
      AddAllAround(headlight, radiance);
    }
    else
    {
      vtkCSLFLight::AddLight(scene.Lights, Place(headlight, renderer));
    }
  }
  const double up[3] = { 0.0, 1.0, 0.0 };
  vtkCSLFLight::SetEnvironment(scene.Lights, radiance, radiance, up);
  ImportEnvironment(renderer, scene);
}
}
