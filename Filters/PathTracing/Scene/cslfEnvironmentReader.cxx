// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEnvironmentReader.h"

#include "PathTracing/Shapes/cslfTriangles.h"
#include "cslfColor.h"
#include "vtkCSLFLight.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
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
}
