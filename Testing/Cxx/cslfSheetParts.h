// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the scenes of the sheet have in common.
 */
#ifndef cslfSheetParts_h
#define cslfSheetParts_h

#include <vtkSmartPointer.h>

class vtkActor;
class vtkAlgorithm;
class vtkCamera;
class vtkImageData;
class vtkPolyData;
class vtkRenderer;

namespace cslf
{
namespace testing
{
/// Adds an actor of a source's output.
vtkSmartPointer<vtkActor> AddActor(vtkRenderer* renderer, vtkAlgorithm* source);

/// Adds an actor of data.
vtkSmartPointer<vtkActor> AddData(vtkRenderer* renderer, vtkPolyData* data);

/// A camera that looks from a direction at the origin, and sees `reach` to all sides of it. Without
/// perspective, nothing hides from a light at the camera what the camera sees.
vtkCamera* Look(vtkRenderer* renderer, double x, double y, double z, double reach = 1.1);

void AddHeadlight(vtkRenderer* renderer);

/// Letters, which show whether an image is turned or mirrored.
vtkSmartPointer<vtkImageData> MakeLetters();
}
}

#endif
