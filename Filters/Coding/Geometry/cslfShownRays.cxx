// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShownRays.h"

#include "Pipeline/cslfFieldArrays.h"
#include "cslfColor.h"

#include <vtkImageData.h>
#include <vtkPointData.h>

namespace cslf
{
ShownRays::ShownRays(const Description& field, vtkImageData* image, const std::vector<int>& slices,
  const GeometryRays* surfaces)
  : Views(field, image, slices)
  , Colors(field.Grid, image->GetPointData()->GetArray(ColorName), slices)
  , Surfaces(surfaces)
  , HasAll(surfaces && surfaces->IsComplete() && !field.MayShowEnvironment())
{
  if (surfaces && surfaces->GetCells())
  {
    this->Views.SetSurfaces(surfaces->GetCells());
  }
}

void ShownRays::SetSeenFaces(int faces)
{
  this->SeenFaces = faces;
  this->Views.LeaveOut(faces);
}

glm::dvec4 ShownRays::LookUp(const RayCoordinates& ray) const
{
  const auto hit =
    this->Surfaces ? this->Surfaces->Intersect(ray) : std::optional<GeometryRays::Hit>();
  const bool isOpaque = this->Surfaces && this->Surfaces->GetCells();
  if (!hit)
  {
    return this->HasAll ? glm::dvec4(0.0)
                        : this->Colors.Blend(isOpaque ? this->Views.OffSurface(ray)
                                                      : this->Views.DepthCorrected(ray));
  }
  LookupResult before;
  if (isOpaque && (before = this->Views.InFront(ray, hit->Point)).IsFinal)
  {
    return this->Colors.Blend(before);
  }
  if (hit->IsExact)
  {
    return hit->Color;
  }
  const glm::dvec4 seen =
    this->Colors.Blend(this->Views.OnSurface(ray, hit->Point, this->SeenFaces));
  if (seen.w > 0.0)
  {
    return seen;
  }
  if (isOpaque && (before = this->Views.CloseInFront(ray, hit->Point)).IsFinal)
  {
    return this->Colors.Blend(before);
  }
  return hit->Color.w > 0.0 ? hit->Color : this->Colors.Blend(this->Views.DepthCorrected(ray));
}

std::optional<glm::dvec4> ShownRays::LookUpAlone(
  const Description& field, const GeometryRays& surfaces, const RayCoordinates& ray)
{
  if (!surfaces.IsComplete() || surfaces.GetCells() || field.MayShowEnvironment())
  {
    return std::nullopt;
  }
  const auto hit = surfaces.Intersect(ray);
  if (!hit)
  {
    return glm::dvec4(0.0);
  }
  return hit->IsExact ? std::make_optional(hit->Color) : std::nullopt;
}

LightMean::LightMean(const Description& field)
  : IsLinear(field.FindChannel(KnownChannel::Color)->Encoding == LinearEncoding)
{
}

void LightMean::Add(const glm::dvec4& color, double weight)
{
  const glm::dvec3 light = this->IsLinear || color.w <= 0.0
    ? glm::dvec3(color)
    : color.w * SRGBToLinear(glm::dvec3(color) / color.w);
  this->Sum += weight * glm::dvec4(light, color.w);
}

glm::dvec4 LightMean::GetColor() const
{
  return this->IsLinear
    ? this->Sum
    : glm::dvec4(EncodeRadiance(glm::dvec3(this->Sum), this->Sum.w), this->Sum.w);
}
}
