// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShownPixels.h"

#include "Coding/Geometry/cslfShownRays.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfParallelFor.h"
#include "cslfColor.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace cslf
{
namespace
{
///@{
/// The rays of a pixel, evenly spread: as many as those of a still view by default.
constexpr int RaysAcross = 5;
constexpr int RaysUp = 4;
constexpr int RaysOfPixel = RaysAcross * RaysUp;
///@}

/// The rows of viewpoints beside those that rays enter between. Of the others, few are asked.
constexpr int RowsAround = 1;
}

ShownPixels::ShownPixels(
  const Description& field, vtkPolyData* geometry, const std::vector<PixelBeam>& beams)
  : Field(field)
  , Pixels(beams.size())
{
  if (geometry && IsUsefulGeometry(geometry) && field.FindChannel(KnownChannel::Depth))
  {
    this->Surfaces.emplace(geometry, field);
  }
  for (std::size_t pixel = 0; pixel < beams.size(); ++pixel)
  {
    const PixelBeam& beam = beams[pixel];
    const glm::dvec3 eyeCC = field.Box.PointToCube(beam.Eye);
    const int faces = FindSeenFaces(field.Box, beam.Eye);
    for (int k = 0; k < RaysOfPixel; ++k)
    {
      const double x = (k % RaysAcross + 0.5) / RaysAcross;
      const double y = (k / RaysAcross + 0.5) / RaysUp;
      const auto ray = RayToCoordinates(eyeCC, field.Box.VectorToCube(beam.GetDirection(x, y)));
      if (ray)
      {
        this->Rays.push_back({ pixel, faces, *ray });
      }
    }
  }
  if (this->Surfaces)
  {
    ParallelFor(0, static_cast<vtkIdType>(this->Rays.size()), 0,
      [this](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end; ++k)
        {
          const auto color =
            ShownRays::LookUpAlone(this->Field, *this->Surfaces, this->Rays[k].Coordinates);
          this->Rays[k].IsKnown = color.has_value();
          this->Rays[k].Color = color.value_or(glm::dvec4(0.0));
        }
      });
  }
}

bool ShownPixels::IsIn(const ViewpointBand& band, const Ray& ray) const
{
  const CubePoint& entry = ray.Coordinates.Entry;
  const int row = this->Field.Grid.FindNodes(entry.Coordinates.y).Lower;
  return band.Face < 0 || (entry.Face == band.Face && row >= band.FirstRow && row < band.EndRow);
}

std::vector<ViewpointBand> ShownPixels::PlanBands(double bytes) const
{
  const Layout& grid = this->Field.Grid;
  const int side = grid.GetViewpoints();
  std::vector<ViewpointBand> bands;
  if (static_cast<double>(this->Field.GetBytes()) <= bytes)
  {
    bands.push_back({ { 0, grid.GetSlices() - 1 } });
  }
  else
  {
    const double row = static_cast<double>(this->Field.GetBytes()) / (FaceCount * side);
    const int rows = std::max(1, static_cast<int>(bytes / row) - 2 * RowsAround - 1);
    for (int face = 0; face < FaceCount; ++face)
    {
      for (int first = 0; first < side - 1; first += rows)
      {
        const int end = std::min(side - 1, first + rows);
        const int low = std::max(0, first - RowsAround);
        const int high = std::min(side - 1, end + RowsAround);
        bands.push_back(
          { { grid.SliceOf({ face, 0, low }), grid.SliceOf({ face, side - 1, high }) }, face, first,
            end });
      }
    }
  }
  bands.erase(std::remove_if(bands.begin(), bands.end(),
                [this](const ViewpointBand& band)
                {
                  return std::none_of(this->Rays.begin(), this->Rays.end(),
                    [&](const Ray& ray) { return !ray.IsKnown && this->IsIn(band, ray); });
                }),
    bands.end());
  return bands;
}

void ShownPixels::LookUp(const ViewpointBand& band, vtkImageData* image)
{
  std::map<int, std::vector<Ray*>> raysOfFaces;
  for (Ray& ray : this->Rays)
  {
    if (!ray.IsKnown && this->IsIn(band, ray))
    {
      raysOfFaces[ray.SeenFaces].push_back(&ray);
    }
  }
  const int* extent = image->GetExtent();
  std::vector<int> slices(extent[5] - extent[4] + 1);
  std::iota(slices.begin(), slices.end(), extent[4]);
  ShownRays shown(this->Field, image, slices, this->Surfaces ? &*this->Surfaces : nullptr);
  for (const auto& [faces, rays] : raysOfFaces)
  {
    shown.SetSeenFaces(faces);
    ParallelFor(0, static_cast<vtkIdType>(rays.size()), 0,
      [&shown, &found = rays](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end; ++k)
        {
          found[k]->Color = shown.LookUp(found[k]->Coordinates);
          found[k]->IsKnown = true;
        }
      });
  }
}

std::vector<glm::dvec4> ShownPixels::GetColors() const
{
  std::vector<LightMean> means(this->Pixels, LightMean(this->Field));
  for (const Ray& ray : this->Rays)
  {
    means[ray.Pixel].Add(ray.Color, 1.0 / RaysOfPixel);
  }
  const bool isLinear = this->Field.FindChannel(KnownChannel::Color)->Encoding == LinearEncoding;
  std::vector<glm::dvec4> colors;
  for (const LightMean& mean : means)
  {
    glm::dvec4 color = mean.GetColor();
    if (isLinear)
    {
      color = { EncodeRadiance(glm::dvec3(color), color.w), color.w };
    }
    for (int k = 0; k < 3; ++k)
    {
      color[k] = ToByte(color[k]) / 255.0;
    }
    colors.push_back(color);
  }
  return colors;
}
}
