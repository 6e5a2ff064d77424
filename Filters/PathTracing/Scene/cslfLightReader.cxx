// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLightReader.h"

#include "PathTracing/Shapes/cslfTriangles.h"
#include "cslfColor.h"
#include "vtkCSLFLight.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace cslf
{
namespace
{
vtkDataArray* Find(vtkDataObject* data, const char* name)
{
  return data->GetFieldData()->GetArray(name);
}

/// A tuple of three finite numbers. False if there is none.
bool ReadVector(vtkDataArray* array, vtkIdType tuple, glm::dvec3& vector)
{
  if (!array || array->GetNumberOfComponents() != 3 || array->GetNumberOfTuples() <= tuple)
  {
    return false;
  }
  double values[3];
  array->GetTuple(tuple, values);
  vector = { values[0], values[1], values[2] };
  return IsFinite(vector);
}

/// The axes; by default those of a vtkRenderer. False if they are parallel or 0.
bool ReadAxes(vtkDataObject* data, EnvironmentAxes& axes)
{
  glm::dvec3 up(0.0, 1.0, 0.0);
  if (Find(data, vtkCSLFLight::EnvironmentUp()) &&
    !ReadVector(Find(data, vtkCSLFLight::EnvironmentUp()), 0, up))
  {
    return false;
  }
  if (!(glm::length(up) > 0.0))
  {
    return false;
  }
  axes = EnvironmentAxes::FromUp(up);
  glm::dvec3 right(0.0);
  if (Find(data, vtkCSLFLight::EnvironmentRight()))
  {
    if (!ReadVector(Find(data, vtkCSLFLight::EnvironmentRight()), 0, right))
    {
      return false;
    }
    up = glm::normalize(up);
    right -= glm::dot(right, up) * up;
    if (!(glm::length(right) > 1e-6))
    {
      return false;
    }
    axes.Right = glm::normalize(right);
    axes.Front = glm::cross(axes.Right, axes.Up);
  }
  return true;
}

/// Bottom and top. False if there is neither.
bool ReadRadiance(vtkDataObject* data, glm::dvec3& bottom, glm::dvec3& top)
{
  vtkDataArray* radiance = Find(data, vtkCSLFLight::EnvironmentRadiance());
  if (!ReadVector(radiance, 0, bottom))
  {
    return false;
  }
  top = bottom;
  if (radiance->GetNumberOfTuples() > 1 && !ReadVector(radiance, 1, top))
  {
    return false;
  }
  bottom = glm::max(bottom, 0.0);
  top = glm::max(top, 0.0);
  return true;
}

float ToRadiance(double value, bool encoded)
{
  const double linear = encoded ? SRGBToLinear(value / 255.0) : value;
  return std::isfinite(linear) ? static_cast<float>(std::max(linear, 0.0)) : 0.0f;
}

/// The image, its first row at the top. False if there is no suitable image.
bool ReadImage(vtkDataObject* data, EnvironmentImage& image)
{
  vtkDataArray* pixels = Find(data, vtkCSLFLight::EnvironmentImage());
  vtkDataArray* layout = Find(data, vtkCSLFLight::EnvironmentImageLayout());
  if (!pixels || !layout || layout->GetNumberOfComponents() != 2 ||
    layout->GetNumberOfTuples() < 1 || pixels->GetNumberOfComponents() < 3)
  {
    return false;
  }
  const double width = layout->GetComponent(0, 0);
  const double height = layout->GetComponent(0, 1);
  if (!(width >= 1.0) || !(height >= 1.0) ||
    width * height != static_cast<double>(pixels->GetNumberOfTuples()))
  {
    return false;
  }
  image.Width = static_cast<int>(width);
  image.Height = static_cast<int>(height);
  image.Pixels.reserve(pixels->GetNumberOfTuples());
  const bool encoded = pixels->GetDataType() == VTK_UNSIGNED_CHAR;
  for (int row = image.Height - 1; row >= 0; --row)
  {
    for (int column = 0; column < image.Width; ++column)
    {
      const vtkIdType pixel = vtkIdType(row) * image.Width + column;
      image.Pixels.emplace_back(ToRadiance(pixels->GetComponent(pixel, 0), encoded),
        ToRadiance(pixels->GetComponent(pixel, 1), encoded),
        ToRadiance(pixels->GetComponent(pixel, 2), encoded));
    }
  }
  return true;
}

/// Adds the gradient to the rows of an image.
void AddGradient(const glm::vec3& bottom, const glm::vec3& top, EnvironmentImage& image)
{
  for (int row = 0; row < image.Height; ++row)
  {
    const double polar = 3.14159265358979 * (row + 0.5) / image.Height;
    const glm::vec3 added = glm::mix(bottom, top, static_cast<float>(0.5 + 0.5 * std::cos(polar)));
    for (int column = 0; column < image.Width; ++column)
    {
      image.Pixels[std::size_t(row) * image.Width + column] += added;
    }
  }
}
}

bool HasEnvironment(vtkDataObject* data)
{
  return data &&
    (Find(data, vtkCSLFLight::EnvironmentRadiance()) ||
      Find(data, vtkCSLFLight::EnvironmentImage()));
}

bool ReadEnvironment(vtkDataObject* data, Environment& environment)
{
  EnvironmentAxes axes;
  if (!ReadAxes(data, axes))
  {
    return false;
  }
  glm::dvec3 bottom(0.0);
  glm::dvec3 top(0.0);
  if (Find(data, vtkCSLFLight::EnvironmentRadiance()) && !ReadRadiance(data, bottom, top))
  {
    return false;
  }
  if (!Find(data, vtkCSLFLight::EnvironmentImage()))
  {
    environment = Environment(bottom, top, axes);
    return true;
  }
  EnvironmentImage image;
  if (!ReadImage(data, image))
  {
    return false;
  }
  AddGradient(bottom, top, image);
  environment = Environment(std::move(image), 1.0f, axes);
  return true;
}

namespace
{
glm::dvec3 GetTuple3(vtkDataArray* array, vtkIdType index)
{
  double tuple[3];
  array->GetTuple(index, tuple);
  return { tuple[0], tuple[1], tuple[2] };
}

/// Whether irradiance is finite everywhere except at the light.
bool IsAttenuation(const glm::dvec3& attenuation, double exponent)
{
  return IsFinite(attenuation) && std::isfinite(exponent) && exponent >= 0.0 &&
    attenuation.x >= 0.0 && attenuation.y >= 0.0 && attenuation.z >= 0.0 &&
    attenuation != glm::dvec3(0.0);
}

bool IsDirection(const glm::dvec3& vector)
{
  return IsFinite(vector) && glm::length(vector) > 0.0;
}
}

void LightReader::Add(vtkDataObject* data)
{
  if (data)
  {
    this->ReadDirectional(data);
    this->ReadPoints(data);
    this->ReadSpots(data);
  }
}

void LightReader::BeginRank()
{
  this->Directional.Begins.push_back(this->Directional.Lights.size());
  this->Points.Begins.push_back(this->Points.Lights.size());
}

void LightReader::Join()
{
  this->Directional.Join();
  this->Points.Join();
}

void LightReader::LightList::Join()
{
  const auto isLess = [](const Light& a, const Light& b)
  { return a.GetNumbers() < b.GetNumbers(); };
  using Counts = std::map<Light, int, decltype(isLess)>;
  Counts most(isLess);
  std::size_t first = 0;
  this->Begins.push_back(this->Lights.size());
  for (const std::size_t end : this->Begins)
  {
    Counts counts(isLess);
    for (; first < end; ++first)
    {
      ++counts[this->Lights[first]];
    }
    for (const auto& [light, count] : counts)
    {
      int& known = most[light];
      known = std::max(known, count);
    }
  }
  this->Lights.clear();
  this->Begins.clear();
  for (const auto& [light, count] : most)
  {
    this->Lights.insert(this->Lights.end(), count, light);
  }
}

bool LightReader::ReadAttenuations(
  vtkDataObject* data, const char* name, std::vector<Light>& lights)
{
  vtkDataArray* attenuations = data->GetFieldData()->GetArray(name);
  if (!attenuations)
  {
    return true;
  }
  if (attenuations->GetNumberOfComponents() != 4 ||
    attenuations->GetNumberOfTuples() != static_cast<vtkIdType>(lights.size()))
  {
    return false;
  }
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    double tuple[4];
    attenuations->GetTuple(static_cast<vtkIdType>(i), tuple);
    lights[i].Attenuation = { tuple[0], tuple[1], tuple[2] };
    lights[i].AttenuationExponent = tuple[3];
  }
  return true;
}

bool LightReader::ReadCones(vtkDataObject* data, std::vector<Light>& spots)
{
  vtkDataArray* axes = data->GetFieldData()->GetArray(vtkCSLFLight::SpotLightDirection());
  vtkDataArray* cones = data->GetFieldData()->GetArray(vtkCSLFLight::SpotLightCone());
  const auto count = static_cast<vtkIdType>(spots.size());
  if (!axes || !cones || axes->GetNumberOfComponents() != 3 ||
    cones->GetNumberOfComponents() != 2 || axes->GetNumberOfTuples() != count ||
    cones->GetNumberOfTuples() != count)
  {
    return false;
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    spots[i].Axis = GetTuple3(axes, i);
    spots[i].ConeAngle = cones->GetComponent(i, 0);
    spots[i].Exponent = cones->GetComponent(i, 1);
  }
  return true;
}

void LightReader::ReadDirectional(vtkDataObject* data)
{
  for (const Light& light : this->Read(data, vtkCSLFLight::DirectionalLightDirection(),
         vtkCSLFLight::DirectionalLightIrradiance()))
  {
    this->AddIf(IsDirection(light.Place), light, this->Directional);
  }
}

void LightReader::ReadPoints(vtkDataObject* data)
{
  std::vector<Light> points =
    this->Read(data, vtkCSLFLight::PointLightPosition(), vtkCSLFLight::PointLightIntensity());
  const bool match = ReadAttenuations(data, vtkCSLFLight::PointLightAttenuation(), points);
  for (const Light& light : points)
  {
    this->AddIf(match, light, this->Points);
  }
}

void LightReader::ReadSpots(vtkDataObject* data)
{
  std::vector<Light> spots =
    this->Read(data, vtkCSLFLight::SpotLightPosition(), vtkCSLFLight::SpotLightIntensity());
  const bool match =
    ReadCones(data, spots) && ReadAttenuations(data, vtkCSLFLight::SpotLightAttenuation(), spots);
  for (const Light& light : spots)
  {
    this->AddIf(match && IsDirection(light.Axis) && light.ConeAngle >= 0.0 && light.Exponent >= 0.0,
      light, this->Points);
  }
}

std::vector<LightReader::Light> LightReader::Read(
  vtkDataObject* data, const char* places, const char* powers)
{
  std::vector<Light> lights;
  vtkDataArray* place = data->GetFieldData()->GetArray(places);
  vtkDataArray* power = data->GetFieldData()->GetArray(powers);
  if (!data->GetFieldData()->HasArray(places) && !data->GetFieldData()->HasArray(powers))
  {
    return lights;
  }
  if (!place || !power || place->GetNumberOfComponents() != 3 ||
    power->GetNumberOfComponents() != 3 || place->GetNumberOfTuples() != power->GetNumberOfTuples())
  {
    ++this->Rejected;
    return lights;
  }
  for (vtkIdType i = 0; i < place->GetNumberOfTuples(); ++i)
  {
    lights.push_back({ GetTuple3(place, i), GetTuple3(power, i) });
  }
  return lights;
}

void LightReader::AddIf(bool usable, Light light, LightList& list)
{
  light.Power = glm::max(light.Power, 0.0);
  if (usable && IsFinite(light.Place) && IsFinite(light.Power) &&
    IsAttenuation(light.Attenuation, light.AttenuationExponent))
  {
    list.Lights.push_back(light);
  }
  else
  {
    ++this->Rejected;
  }
}

void LightReader::MoveTo(LightSet& lights, const SceneFrame& frame) const
{
  for (const Light& light : this->Directional.Lights)
  {
    lights.Directional.push_back({ glm::normalize(light.Place), light.Power });
  }
  for (const Light& light : this->Points.Lights)
  {
    // Distances are in scene space, so they are divided by the scene's radius. The polynomial is
    // divided by its largest coefficient, so that it fits in floats.
    const glm::dvec3 inScene =
      light.Attenuation * glm::dvec3(1.0, frame.Radius, frame.Radius * frame.Radius);
    const double largest = std::max({ inScene.x, inScene.y, inScene.z });
    PointLight point{ frame.PointToScene(light.Place),
      light.Power / std::pow(largest, light.AttenuationExponent) };
    point.Attenuation = inScene / largest;
    point.AttenuationExponent = static_cast<float>(light.AttenuationExponent);
    if (light.Axis != glm::dvec3(0.0))
    {
      point.Axis = glm::normalize(light.Axis);
      point.ConeCosine =
        static_cast<float>(std::cos(glm::radians(std::min(light.ConeAngle, 180.0))));
      point.Exponent = static_cast<float>(light.Exponent);
    }
    lights.Points.push_back(point);
  }
}
}
