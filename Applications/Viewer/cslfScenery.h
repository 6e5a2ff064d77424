// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the viewer draws around a light field to show where things are.
 */
#ifndef cslfScenery_h
#define cslfScenery_h

#include "cslfDescription.h"

#include <vtkSmartPointer.h>

class vtkActor;
class vtkProp;

namespace cslf
{
namespace tool
{
/// The edges of the cube.
vtkSmartPointer<vtkActor> MakeOutline(const Cube& cube);

/// Axes of world coordinates at the cube's corner of least x and y and greatest z: Z leads out of
/// it.
vtkSmartPointer<vtkProp> MakeAxes(const Cube& cube);

/// A dot at each of the field's viewpoints.
vtkSmartPointer<vtkActor> MakeViewpointMarkers(const Description& field);
}
}

#endif
