// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"
#include "cslfSceneActors.h"

#include <vtkArrowSource.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace cslf
{
namespace
{
// The arrows are near the points of a grid, at distances of 1.
constexpr int Sizes[] = { 50, 20, 20 };

struct Vortex
{
  glm::dvec3 Center;
  glm::dvec3 Axis;
};

const Vortex Vortices[] = { { { -14.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } },
  { { 3.0, 2.0, -2.0 }, { 0.0, 0.8, -0.6 } }, { { 18.0, -3.0, 3.0 }, { 0.6, 0.0, 0.8 } } };

/// The sum of the vortices, each with a core of radius 7, and of a wind along X.
glm::dvec3 GetFlow(const glm::dvec3& point)
{
  glm::dvec3 velocity(0.35, 0.0, 0.0);
  for (const Vortex& vortex : Vortices)
  {
    const glm::dvec3 arm = (point - vortex.Center) / 7.0;
    velocity +=
      std::exp(0.5 - 0.5 * glm::dot(arm, arm)) * (glm::cross(vortex.Axis, arm) + 0.3 * vortex.Axis);
  }
  return velocity;
}
}

void AddArrows(vtkRenderer* renderer)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(2);
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> velocities;
  velocities->SetName("Velocity");
  velocities->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> speeds;
  speeds->SetName("Speed");
  const int count = Sizes[0] * Sizes[1] * Sizes[2];
  for (int i = 0; i < count; ++i)
  {
    const int place[] = { i % Sizes[0], i / Sizes[0] % Sizes[1], i / (Sizes[0] * Sizes[1]) };
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = place[axis] - 0.5 * (Sizes[axis] - 1) + random->GetNextRangeValue(-0.3, 0.3);
    }
    const glm::dvec3 velocity = GetFlow(point);
    points->InsertNextPoint(point.x, point.y, point.z);
    velocities->InsertNextTuple3(velocity.x, velocity.y, velocity.z);
    speeds->InsertNextValue(glm::length(velocity));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->AddArray(velocities);
  data->GetPointData()->SetScalars(speeds);
  vtkNew<vtkArrowSource> arrow;
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(arrow->GetOutputPort());
  mapper->SetOrientationArray("Velocity");
  mapper->SetOrientationModeToDirection();
  mapper->SetScaleArray("Speed");
  mapper->SetScaleModeToScaleByMagnitude();
  mapper->SetScaleFactor(1.6);
  mapper->SetLookupTable(MakeCoolToWarm(0.0, 1.4));
  mapper->UseLookupTableScalarRangeOn();
  AddActor(renderer, mapper);
}
}
