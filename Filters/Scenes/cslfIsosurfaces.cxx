// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"
#include "cslfSceneActors.h"

#include <vtkContourFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRTAnalyticSource.h>

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
}
