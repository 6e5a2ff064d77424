// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLightImporter.h"

#include "SceneData/cslfTextureImage.h"
#include "cslfColor.h"
#include "vtkCSLFLight.h"

#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkCollectionRange.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <algorithm>

namespace cslf
{
namespace
{
/// The renderer's environment texture, if it lights the scene.
vtkTexture* FindEnvironment(vtkRenderer* renderer)
{
  return renderer->GetUseImageBasedLighting() ? renderer->GetEnvironmentTexture() : nullptr;
}

/// Radiance times a factor: bytes are sRGB-encoded.
vtkSmartPointer<vtkDataArray> Scale(vtkDataArray* colors, double factor)
{
  const bool isEncoded = colors->GetDataType() == VTK_UNSIGNED_CHAR;
  auto scaled = vtkSmartPointer<vtkFloatArray>::New();
  scaled->SetNumberOfComponents(colors->GetNumberOfComponents());
  scaled->SetNumberOfTuples(colors->GetNumberOfTuples());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < colors->GetNumberOfComponents(); ++c)
    {
      const double value = colors->GetComponent(i, c);
      scaled->SetComponent(i, c, factor * (isEncoded ? SRGBToLinear(value / 255.0) : value));
    }
  }
  return scaled;
}
}

void FindEnvironment(vtkRenderer* renderer, ImportedScene& scene)
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
  vtkNew<vtkPolyData> trial;
  scene.HasEnvironment = vtkCSLFLight::SetEnvironmentImage(
    trial, MakeFlatImage(texture), renderer->GetEnvironmentUp(), renderer->GetEnvironmentRight());
  if (!scene.HasEnvironment)
  {
    scene.Meet(ImportLimit::EnvironmentImages);
  }
}

vtkMTimeType GetLightTime(vtkRenderer* renderer, bool headlightsAllAround, bool withCamera)
{
  vtkMTimeType time = renderer->GetLights()->GetMTime();
  bool followsCamera = false;
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    time = std::max(time, light->GetMTime());
    followsCamera = followsCamera || light->LightTypeIsCameraLight() ||
      (light->LightTypeIsHeadlight() && !headlightsAllAround);
  }
  if (withCamera && followsCamera && renderer->IsActiveCameraCreated())
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

void ImportEnvironment(vtkRenderer* renderer, double factor, ImportedScene& scene)
{
  vtkTexture* texture = FindEnvironment(renderer);
  if (!scene.HasEnvironment || !texture)
  {
    return;
  }
  const vtkSmartPointer<vtkImageData> image = MakeFlatImage(texture);
  if (factor != 1.0)
  {
    image->GetPointData()->SetScalars(Scale(image->GetPointData()->GetScalars(), factor));
  }
  vtkCSLFLight::SetEnvironmentImage(
    scene.Lights, image, renderer->GetEnvironmentUp(), renderer->GetEnvironmentRight());
}
}
