// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPerlinNoise.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
constexpr int SidePoints = 400; // points along each side
constexpr double Spacing = 25.0;
constexpr double Easting = 495000.0; // of the south-western corner
constexpr double Northing = 4995000.0;

/// The height in metres: ridges in seven octaves, each finer where the coarser are high.
double GetHeight(vtkPerlinNoise* noise, double x, double y)
{
  double height = 0.0;
  double weight = 1.0;
  double frequency = 1.0 / 4200.0;
  for (int octave = 0; octave < 7; ++octave)
  {
    double place[3] = { x * frequency, y * frequency, 10.37 * octave + 0.5 };
    const double ridge = std::pow(1.0 - std::abs(noise->EvaluateFunction(place)), 2.0);
    height += weight * ridge;
    weight *= 0.5 * std::min(ridge, 1.0);
    frequency *= 2.03;
  }
  return 400.0 + 1100.0 * height;
}

/// A light that the camera does not move.
void AddLights(vtkRenderer* renderer)
{
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->PositionalOff();
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  sun->SetPosition(-1.0, 0.6, 0.9);
  sun->SetColor(1.0, 0.95, 0.85);
  sun->SetIntensity(0.85);
  renderer->AddLight(sun);
  vtkNew<vtkLight> sky;
  sky->SetLightTypeToHeadlight();
  sky->SetColor(0.75, 0.87, 1.0);
  sky->SetIntensity(0.45);
  renderer->AddLight(sky);
}
}

void AddTerrain(vtkRenderer* renderer)
{
  vtkNew<vtkPerlinNoise> noise;
  noise->SetFrequency(1.0, 1.0, 1.0);
  noise->SetAmplitude(1.0);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Height");
  vtkNew<vtkCellArray> triangles;
  for (int row = 0; row < SidePoints; ++row)
  {
    for (int column = 0; column < SidePoints; ++column)
    {
      const double height = GetHeight(noise, Spacing * column, Spacing * row);
      const vtkIdType point =
        points->InsertNextPoint(Easting + Spacing * column, Northing + Spacing * row, height);
      heights->InsertNextValue(height);
      if (row > 0 && column > 0)
      {
        const vtkIdType corners[] = { point - SidePoints - 1, point - SidePoints, point,
          point - 1 };
        triangles->InsertNextCell({ corners[0], corners[1], corners[2] });
        triangles->InsertNextCell({ corners[0], corners[2], corners[3] });
      }
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  data->GetPointData()->SetScalars(heights);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SplittingOff();
  normals->ConsistencyOff();
  // VTK 9.3 and later add up normals in the order of threads: the scene would differ from run to
  // run.
  vtkSMPTools::LocalScope(vtkSMPTools::Config(1), [&] { normals->Update(); });
  double range[2];
  heights->GetRange(range);
  AddSurface(renderer, normals->GetOutput(), MakeLandColors(range[0], range[1]));
  AddLights(renderer);
}
}
