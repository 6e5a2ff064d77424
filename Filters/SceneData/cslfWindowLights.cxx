// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfWindowLights.h"

#include "cslfColor.h"
#include "vtkCSLFLight.h"

#include <vtkCamera.h>
#include <vtkCollectionRange.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// Lights count as at least this far from a surface, relative to its reach: a lamp in the middle of
// a room lights the walls.
constexpr double NearestPart = 0.5;

/// A light at its current position. Lights that move with the camera are placed as for the next
/// drawing, but the renderer's own light is not changed.
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

glm::dvec3 GetPosition(vtkLight* light)
{
  double position[3];
  light->GetTransformedPosition(position);
  return { position[0], position[1], position[2] };
}

glm::dvec3 GetFocalPoint(vtkLight* light)
{
  double point[3];
  light->GetTransformedFocalPoint(point);
  return { point[0], point[1], point[2] };
}

/// 0 if there is no direction.
glm::dvec3 Normalize(const glm::dvec3& vector)
{
  const double length = glm::length(vector);
  return length > 0.0 ? vector / length : glm::dvec3(0.0);
}

/// The factor of light for a displayed level. No surface may need to reflect more light than it
/// receives to look like the window, so the brightest of the shading models decides.
double GetGain(double level, const ShadingModels& models)
{
  double gain = models.Physical ? 1.0 / vtkMath::Pi() : 0.0;
  for (const auto& [ambient, diffuse] : models.Classic)
  {
    const double reflected = diffuse * level;
    const double displayed = std::min(ambient + reflected, std::max(1.0, reflected));
    const double light = SRGBToLinear(displayed) - SRGBToLinear(ambient);
    gain = level > 0.0 ? std::max(gain, light / level) : gain;
  }
  return gain;
}
}

double GetDecodingExponent(double displayed)
{
  return displayed <= 0.04045 ? 1.0 : 2.4 * displayed / (displayed + 0.055);
}

double GetAttenuation(vtkLight* light, double distance)
{
  const double* values = light->GetAttenuationValues();
  const double divisor = values[0] + distance * (values[1] + distance * values[2]);
  return divisor > 0.0 ? 1.0 / divisor : 1.0;
}

WindowLights::WindowLights(vtkRenderer* renderer, bool headlightsAllAround)
{
  if (renderer->IsActiveCameraCreated())
  {
    double direction[3];
    renderer->GetActiveCamera()->GetDirectionOfProjection(direction);
    this->ToCamera = -glm::dvec3(direction[0], direction[1], direction[2]);
  }
  bool isAnyOn = false;
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    if (light->GetSwitch())
    {
      isAnyOn = true;
      this->Add(light, renderer, headlightsAllAround);
    }
  }
  if (!isAnyOn && renderer->GetAutomaticLightCreation())
  {
    // The renderer would create a headlight before it draws.
    vtkNew<vtkLight> headlight;
    headlight->SetLightTypeToHeadlight();
    this->Add(headlight, renderer, headlightsAllAround);
  }
}

void WindowLights::Add(vtkLight* light, vtkRenderer* renderer, bool headlightsAllAround)
{
  Source source;
  source.Light = Place(light, renderer);
  double color[3];
  light->GetDiffuseColor(color);
  source.Color = std::max(light->GetIntensity(), 0.0) * glm::dvec3(color[0], color[1], color[2]);
  source.ShinesFromAllAround = headlightsAllAround && light->LightTypeIsHeadlight();
  source.MovesWithCamera = light->LightTypeIsHeadlight() || light->LightTypeIsCameraLight();
  this->Sources.push_back(source);
}

glm::dvec3 WindowLights::GetDirection(const Source& source, const glm::dvec3& point)
{
  const glm::dvec3 position = GetPosition(source.Light);
  return Normalize(
    position - (source.Light->GetPositional() ? point : GetFocalPoint(source.Light)));
}

double WindowLights::GetFalloff(const Source& source, const glm::dvec3& point, double nearest)
{
  if (!source.Light->GetPositional() || source.ShinesFromAllAround)
  {
    return 1.0;
  }
  const double distance = glm::length(GetPosition(source.Light) - point);
  return GetAttenuation(source.Light, std::max(distance, nearest));
}

glm::dvec3 WindowLights::GetWindowLevel(
  const glm::dvec3& point, double nearest, const glm::dvec3& normal) const
{
  glm::dvec3 level(0.0);
  for (const Source& source : this->Sources)
  {
    const double cosine =
      source.ShinesFromAllAround ? 1.0 : glm::dot(normal, GetDirection(source, point));
    level += std::max(cosine, 0.0) * GetFalloff(source, point, nearest) * source.Color;
  }
  return level;
}

glm::dvec3 WindowLights::FindNormal(const glm::dvec3& point, double nearest) const
{
  glm::dvec3 best = this->ToCamera;
  double most = 0.0;
  for (const Source& source : this->Sources)
  {
    if (source.MovesWithCamera)
    {
      return this->ToCamera;
    }
    const glm::dvec3 normal = GetDirection(source, point);
    const double level = glm::dot(LuminanceWeights, this->GetWindowLevel(point, nearest, normal));
    if (level > most)
    {
      most = level;
      best = normal;
    }
  }
  return best;
}

void WindowLights::Calibrate(const glm::dvec3& center, double reach, const ShadingModels& models)
{
  const double nearest = NearestPart * reach;
  const glm::dvec3 normal = this->FindNormal(center, nearest);
  const glm::dvec3 level = this->GetWindowLevel(center, nearest, normal);
  glm::dvec3 sum(0.0);
  for (Source& source : this->Sources)
  {
    // The level where this light matters: that of a surface facing it.
    const glm::dvec3 direction = GetDirection(source, center);
    glm::dvec3 own = this->GetWindowLevel(center, nearest, direction);
    if (source.ShinesFromAllAround || glm::dot(direction, normal) > 0.0)
    {
      own = glm::max(own, level);
    }
    const glm::dvec3 gain(GetGain(own.x, models), GetGain(own.y, models), GetGain(own.z, models));
    const double falloff = GetFalloff(source, center, nearest);
    source.Exponent =
      models.Classic.empty() ? 1.0 : GetDecodingExponent(glm::dot(LuminanceWeights, own));
    source.Power = gain * source.Color * std::pow(falloff, 1.0 - source.Exponent);
    sum += gain;
  }
  // VTK's physically based surfaces reflect an environment unchanged, but 1 / pi of lights.
  this->EnvironmentFactor = 1.0;
  if (models.Physical && !models.Classic.empty() && !this->Sources.empty())
  {
    this->EnvironmentFactor =
      vtkMath::Pi() * glm::dot(LuminanceWeights, sum) / static_cast<double>(this->Sources.size());
  }
}

LightLevel WindowLights::GetLevel(const glm::dvec3& center, double reach) const
{
  const double nearest = NearestPart * reach;
  const glm::dvec3 normal = this->FindNormal(center, nearest);
  LightLevel level;
  level.Window = this->GetWindowLevel(center, nearest, normal);
  level.Direct = glm::dvec3(0.0);
  for (const Source& source : this->Sources)
  {
    if (source.ShinesFromAllAround)
    {
      level.Around += source.Power;
      continue;
    }
    const double cosine = std::max(glm::dot(normal, GetDirection(source, center)), 0.0);
    level.Direct +=
      cosine * std::pow(GetFalloff(source, center, nearest), source.Exponent) * source.Power;
  }
  return level;
}

void WindowLights::AddTo(vtkDataObject* lights) const
{
  glm::dvec3 around(0.0);
  for (const Source& source : this->Sources)
  {
    if (source.ShinesFromAllAround)
    {
      around += source.Power;
      continue;
    }
    vtkLight* light = source.Light;
    const glm::dvec3 position = GetPosition(light);
    const glm::dvec3 direction = GetFocalPoint(light) - position;
    const glm::dvec3 power = vtkMath::Pi() * source.Power;
    const double* values = light->GetAttenuationValues();
    const bool falls = values[0] + values[1] + values[2] > 0.0;
    const double attenuation[4] = { falls ? values[0] : 1.0, values[1], values[2],
      source.Exponent };
    if (power == glm::dvec3(0.0))
    {
      continue;
    }
    if (!light->GetPositional())
    {
      vtkCSLFLight::AddDirectionalLight(lights, &direction[0], &power[0]);
    }
    else if (light->GetConeAngle() < 90.0)
    {
      vtkCSLFLight::AddSpotLight(lights, &position[0], &direction[0], &power[0],
        light->GetConeAngle(), source.Exponent * light->GetExponent(), attenuation);
    }
    else
    {
      vtkCSLFLight::AddPointLight(lights, &position[0], &power[0], attenuation);
    }
  }
  const double up[3] = { 0.0, 1.0, 0.0 };
  vtkCSLFLight::SetEnvironment(lights, &around[0], &around[0], up);
}
}
