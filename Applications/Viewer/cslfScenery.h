// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Objects that the viewer draws around a light field for orientation.
 */
#ifndef cslfScenery_h
#define cslfScenery_h

#include "cslfDescription.h"

#include <vtkSmartPointer.h>

class vtkActor;
class vtkProp;

namespace cslf::tool
{
/// The edges of the cube.
vtkSmartPointer<vtkActor> MakeOutline(const Cube& cube);

/// Axes of world coordinates at the cube's corner with the smallest x and y and the largest z, so
/// that Z points outwards.
vtkSmartPointer<vtkProp> MakeAxes(const Cube& cube);

/// A dot at each of the field's viewpoints.
vtkSmartPointer<vtkActor> MakeViewpointMarkers(const Description& field);
}

#endif
