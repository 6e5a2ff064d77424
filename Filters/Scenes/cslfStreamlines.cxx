// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFunctionSet.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRungeKutta4.h>
#include <vtkTubeFilter.h>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>
#include <vtkArrowSource.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>

#include <algorithm>
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

namespace
{
constexpr int Lines = 150;
constexpr int Steps = 166;
constexpr double StepLength = 0.035;
constexpr double Radius = 0.008;

/// Hill's spherical vortex in the unit sphere, with swirl around Y: its streamlines wind around
/// nested rings.
glm::dvec3 GetVelocity(const glm::dvec3& point)
{
  constexpr double swirl = 4.0;
  const double across = point.x * point.x + point.z * point.z;
  const double around = swirl * (1.0 - across - point.y * point.y);
  return { point.x * point.y - around * point.z, 1.0 - 2.0 * across - point.y * point.y,
    point.z * point.y + around * point.x };
}

/// The direction of the velocity, so that steps of integration have equal lengths.
class Direction : public vtkFunctionSet
{
public:
  static Direction* New();
  vtkTypeMacro(Direction, vtkFunctionSet);

  using vtkFunctionSet::FunctionValues;
  int FunctionValues(double* place, double* values) override
  {
    const glm::dvec3 direction = glm::normalize(GetVelocity(glm::make_vec3(place)));
    std::copy_n(glm::value_ptr(direction), 3, values);
    return 1;
  }

protected:
  Direction()
  {
    this->NumFuncs = 3;
    this->NumIndepVars = 4; // the place and the time
  }
};

vtkStandardNewMacro(Direction);

/// The next point of a streamline.
glm::dvec3 Advance(vtkInitialValueProblemSolver* solver, glm::dvec3 point)
{
  glm::dvec3 next;
  double step = StepLength;
  double error = 0.0;
  solver->ComputeNextStep(glm::value_ptr(point), glm::value_ptr(next), 0.0, step, 0.0, error);
  return next;
}

/// A random point of the vortex.
glm::dvec3 MakeSeed(vtkMinimalStandardRandomSequence* random)
{
  glm::dvec3 seed;
  do
  {
    for (int i = 0; i < 3; ++i)
    {
      seed[i] = random->GetNextRangeValue(-0.95, 0.95);
    }
  } while (glm::length(seed) > 0.95);
  return seed;
}
}

void AddStreamlines(vtkRenderer* renderer)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(1);
  vtkNew<Direction> direction;
  vtkNew<vtkRungeKutta4> solver;
  solver->SetFunctionSet(direction);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkFloatArray> speeds;
  speeds->SetName("Speed");
  for (int line = 0; line < Lines; ++line)
  {
    glm::dvec3 point = MakeSeed(random);
    lines->InsertNextCell(Steps + 1);
    for (int step = 0; step <= Steps; ++step)
    {
      lines->InsertCellPoint(points->InsertNextPoint(point.x, point.y, point.z));
      speeds->InsertNextValue(static_cast<float>(glm::length(GetVelocity(point))));
      point = Advance(solver, point);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetPointData()->SetScalars(speeds);
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(data);
  tubes->SetNumberOfSides(8);
  tubes->SetRadius(Radius);
  tubes->CappingOn();
  tubes->Update();
  AddSurface(renderer, tubes->GetOutput(), MakeViridis(0.0, 1.6));
}
}
