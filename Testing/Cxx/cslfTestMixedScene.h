// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A field among other actors: an opaque cone that pierces its surfaces, a plane behind it that
 * shows around its silhouettes, a translucent sheet in front of it, outline, axes and text. The
 * cone is added after the field, the plane before it: the order must not matter.
 */
#ifndef cslfTestMixedScene_h
#define cslfTestMixedScene_h

class vtkCSLFMapper;
class vtkRenderer;

namespace cslf
{
namespace testing
{
/// Adds the scene and places the camera. The mapper's field lies in the default cube.
void AddMixedScene(vtkRenderer* renderer, vtkCSLFMapper* mapper);
}
}

#endif
