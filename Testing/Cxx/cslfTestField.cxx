// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTestField.h"

#include "cslfColor.h"

#include <vtkAppendPolyData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace cslf
{
namespace testing
{
namespace
{
const glm::dvec3 SphereCenter(0.25, 0.15, 0.1);
constexpr double SphereRadius = 0.45;
constexpr double WallZ = -0.7;
constexpr double WallHalf = 0.85;

glm::dvec3 SphereColor(const glm::dvec3& normal)
{
  const double stripe = 0.5 + 0.5 * std::sin(9.0 * normal.x + 4.0 * normal.y);
  return { 0.15 + 0.7 * stripe, 0.5 + 0.4 * normal.z, 0.3 + 0.25 * normal.y };
}

glm::dvec3 WallColor(double x, double y)
{
  const bool odd =
    (static_cast<int>(std::floor(4.0 * x)) + static_cast<int>(std::floor(4.0 * y))) & 1;
  return odd ? glm::dvec3(0.7, 0.65, 0.2) : glm::dvec3(0.1, 0.2 + 0.2 * x, 0.5);
}

void FillTexel(const Layout& layout, const Viewpoint& viewpoint, int tile, int p, int q,
  int samples, double color[4], double& depth)
{
  const glm::dvec3 eye = layout.ViewpointPosition(viewpoint);
  const int exitFace = ExitFaceOf(viewpoint.Face, tile);
  const glm::dvec2 centre(layout.TexelCoordinate(p), layout.TexelCoordinate(q));
  const double texel = 2.0 / layout.GetResolution();
  glm::dvec3 sum(0.0);
  int hits = 0;
  depth = 1.0;
  double nearest = 2.0;
  for (int sample = 0; sample < samples * samples; ++sample)
  {
    const glm::dvec2 offset(
      (sample % samples + 0.5) / samples - 0.5, (sample / samples + 0.5) / samples - 0.5);
    const TestHit hit = TraceTestScene(eye, FaceToCube(exitFace, centre + texel * offset) - eye);
    if (hit.Hit)
    {
      sum += hit.Color;
      ++hits;
      if (glm::length(offset) < nearest)
      {
        nearest = glm::length(offset);
        depth = hit.Distance;
      }
    }
  }
  const TestHit middle = TraceTestScene(eye, FaceToCube(exitFace, centre) - eye);
  if (middle.Hit && hits > 0)
  {
    depth = middle.Distance;
  }
  const double count = samples * samples;
  color[0] = sum.x / count;
  color[1] = sum.y / count;
  color[2] = sum.z / count;
  color[3] = hits / count;
}
}

TestHit TraceTestScene(const glm::dvec3& originCC, const glm::dvec3& directionCC)
{
  TestHit hit;
  const double a = glm::dot(directionCC, directionCC);
  const double b = glm::dot(directionCC, originCC - SphereCenter);
  const double c =
    glm::dot(originCC - SphereCenter, originCC - SphereCenter) - SphereRadius * SphereRadius;
  const double discriminant = b * b - a * c;
  if (discriminant > 0.0)
  {
    const double distance = (-b - std::sqrt(discriminant)) / a;
    if (distance > 0.0)
    {
      const glm::dvec3 point = originCC + distance * directionCC;
      hit = { true, distance, SphereColor((point - SphereCenter) / SphereRadius) };
    }
  }
  if (directionCC.z != 0.0)
  {
    const double distance = (WallZ - originCC.z) / directionCC.z;
    const glm::dvec3 point = originCC + distance * directionCC;
    if (distance > 0.0 && (!hit.Hit || distance < hit.Distance) && std::abs(point.x) < WallHalf &&
      std::abs(point.y) < WallHalf)
    {
      hit = { true, distance, WallColor(point.x, point.y) };
    }
  }
  return hit;
}

vtkSmartPointer<vtkPolyData> MakeTestSurfaces(const Cube& box)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(SphereCenter.x, SphereCenter.y, SphereCenter.z);
  sphere->SetRadius(SphereRadius);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(-WallHalf, -WallHalf, WallZ);
  wall->SetPoint1(WallHalf, -WallHalf, WallZ);
  wall->SetPoint2(-WallHalf, WallHalf, WallZ);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(sphere->GetOutputPort());
  both->AddInputConnection(wall->GetOutputPort());
  vtkNew<vtkTransform> toWorld;
  toWorld->Translate(box.Center.x, box.Center.y, box.Center.z);
  toWorld->Scale(0.5 * box.Edges.x, 0.5 * box.Edges.y, 0.5 * box.Edges.z);
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetTransform(toWorld);
  moved->SetInputConnection(both->GetOutputPort());
  moved->Update();
  return moved->GetOutput();
}

vtkSmartPointer<vtkImageData> MakeTestField(const Layout& layout, const Cube& box, int colorType,
  int depthType, int samples, int first, int last)
{
  Description description;
  description.Grid = layout;
  description.Box = box;
  const glm::dvec3 least = box.PointToWorld(glm::dvec3(-WallHalf, -WallHalf, WallZ));
  const glm::dvec3 most =
    box.PointToWorld(glm::dvec3(WallHalf, WallHalf, SphereCenter.z + SphereRadius));
  description.SceneBounds = { least.x, most.x, least.y, most.y, least.z, most.z };
  description.Channels.push_back(MakeChannel(KnownChannel::Color, colorType));
  if (depthType != 0)
  {
    description.Channels.push_back(MakeChannel(KnownChannel::Depth, depthType));
  }

  auto image = vtkSmartPointer<vtkImageData>::New();
  int extent[6];
  layout.GetWholeExtent(extent);
  extent[4] = first;
  extent[5] = last < 0 ? extent[5] : last;
  image->SetExtent(extent);
  for (const Channel& channel : description.Channels)
  {
    auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(channel.Type));
    array->SetName(channel.Name.c_str());
    array->SetNumberOfComponents(channel.Components);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    image->GetPointData()->AddArray(array);
  }
  image->GetPointData()->SetActiveScalars(ColorName);
  vtkDataArray* colors = image->GetPointData()->GetArray(ColorName);
  vtkDataArray* depths = image->GetPointData()->GetArray(DepthName);

  const int resolution = layout.GetResolution();
  const vtkIdType slice = static_cast<vtkIdType>(layout.GetStripWidth()) * resolution;
  vtkSMPTools::For(extent[4], extent[5] + 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType z = begin; z < end; ++z)
      {
        const Viewpoint viewpoint = layout.ViewpointOf(static_cast<int>(z));
        for (vtkIdType texel = 0; texel < slice; ++texel)
        {
          const int x = static_cast<int>(texel % layout.GetStripWidth());
          const int y = static_cast<int>(texel / layout.GetStripWidth());
          double color[4];
          double depth;
          FillTexel(layout, viewpoint, x / resolution, x % resolution, y, samples, color, depth);
          const vtkIdType point = (z - extent[4]) * slice + texel;
          if (colorType == VTK_UNSIGNED_CHAR)
          {
            unsigned char bytes[4];
            EncodeColor({ color[0], color[1], color[2] }, color[3], bytes);
            for (int k = 0; k < 4; ++k)
            {
              colors->SetComponent(point, k, bytes[k]);
            }
          }
          else
          {
            colors->SetTuple(point, color);
          }
          if (depths)
          {
            depths->SetComponent(
              point, 0, depthType == VTK_UNSIGNED_SHORT ? std::lround(65535.0 * depth) : depth);
          }
        }
      }
    });
  description.WriteTo(image->GetFieldData());
  return image;
}
}
}
