// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A light field whose every ray is known in closed form: a striped sphere before a chequered wall,
 * both the same from all sides. For tests of everything after the sampler.
 */
#ifndef cslfTestField_h
#define cslfTestField_h

#include "cslfDescription.h"

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

class vtkImageData;
class vtkPolyData;

namespace cslf
{
namespace testing
{
/// The result of a ray of the scene.
struct TestHit
{
  bool Hit = false;
  double Distance = 0.0;   ///< in units of the direction's length
  glm::dvec3 Color{ 0.0 }; ///< linear
};

/// The first hit of a ray in CC.
TestHit TraceTestScene(const glm::dvec3& originCC, const glm::dvec3& directionCC);

/// The scene's surfaces in the world of a field of that cube, for VTK's own mapper.
vtkSmartPointer<vtkPolyData> MakeTestSurfaces(const Cube& box);

/// The scene's light field with `samples` x `samples` regular samples per texel, slices `first` to
/// `last` (all of them for last < 0). The types are VTK's; a depth type of 0 leaves depth out.
vtkSmartPointer<vtkImageData> MakeTestField(const Layout& layout, const Cube& box, int colorType,
  int depthType, int samples = 2, int first = 0, int last = -1);
}
}

#endif
