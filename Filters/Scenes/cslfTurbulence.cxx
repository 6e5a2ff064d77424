// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

#include <vtkContourFilter.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPerlinNoise.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRTAnalyticSource.h>
#include <vtkSMPTools.h>

namespace cslf
{
void AddIsosurfaces(vtkRenderer* renderer)
{
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->SetWholeExtent(-30, 30, -30, 30, -30, 30);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(wavelet->GetOutputPort());
  contour->SetNumberOfContours(3);
  contour->SetValue(0, 110.0);
  contour->SetValue(1, 150.0);
  contour->SetValue(2, 190.0);
  contour->ComputeNormalsOn();
  contour->ComputeScalarsOn();
  contour->Update();
  AddSurface(renderer, contour->GetOutput(), MakeCoolToWarm(110.0, 190.0));
}

namespace
{
constexpr int EdgePoints = 168; // points along each edge

/// A sum of octaves of noise, from coarse to fine.
double GetTurbulence(vtkPerlinNoise* noise, const double point[3])
{
  double sum = 0.0;
  double frequency = 0.055;
  double amplitude = 1.0;
  for (int octave = 0; octave < 4; ++octave)
  {
    double place[3];
    for (int i = 0; i < 3; ++i)
    {
      place[i] = frequency * point[i] + 17.31 * octave + 0.37 * i;
    }
    sum += amplitude * noise->EvaluateFunction(place);
    frequency *= 1.93;
    amplitude *= 0.7;
  }
  return sum;
}

double GetPressure(vtkPerlinNoise* noise, const double point[3])
{
  double place[3] = { 0.013 * point[0] + 5.2, 0.013 * point[1] + 1.7, 0.013 * point[2] + 8.1 };
  return noise->EvaluateFunction(place);
}
}

void AddTurbulence(vtkRenderer* renderer)
{
  vtkNew<vtkPerlinNoise> noise;
  vtkNew<vtkImageData> field;
  field->SetDimensions(EdgePoints, EdgePoints, EdgePoints);
  vtkNew<vtkFloatArray> values;
  values->SetName("Vorticity");
  values->SetNumberOfTuples(static_cast<vtkIdType>(EdgePoints) * EdgePoints * EdgePoints);
  vtkSMPTools::For(0, EdgePoints,
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType i = first * EdgePoints * EdgePoints; i < last * EdgePoints * EdgePoints; ++i)
      {
        const double point[3] = { static_cast<double>(i % EdgePoints),
          static_cast<double>(i / EdgePoints % EdgePoints),
          static_cast<double>(i / (EdgePoints * EdgePoints)) };
        values->SetValue(i, static_cast<float>(GetTurbulence(noise, point)));
      }
    });
  field->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(field);
  contour->SetValue(0, 0.25);
  contour->ComputeNormalsOn();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  vtkNew<vtkFloatArray> pressures;
  pressures->SetName("Pressure");
  pressures->SetNumberOfTuples(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    pressures->SetValue(i, static_cast<float>(GetPressure(noise, surface->GetPoint(i))));
  }
  surface->GetPointData()->SetScalars(pressures);
  AddSurface(renderer, surface, MakeCoolToWarm(-0.5, 0.5));
}
}
