// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light field that a window shows, for exporters of its surfaces.
 */
#ifndef cslfShownField_h
#define cslfShownField_h

#include "cslfGeometryMesh.h"
#include "cslfShownMaps.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkActor;
class vtkCSLFMapper;
class vtkRenderer;
class vtkRenderWindow;

namespace cslf
{
struct ShownField
{
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkActor> Actor;
  vtkCSLFMapper* Mapper = nullptr;
  ShownGeometry Shown;

  /// What the surfaces alone do not show, in sentences.
  std::vector<std::string> Omissions;
};

/// The first visible actor with a vtkCSLFMapper in a renderer of the window; if the renderer is
/// null, in any. Throws std::runtime_error if there is none, or if it has no surfaces with colours.
ShownField FindShownField(vtkRenderWindow* window, vtkRenderer* renderer);

/// Writes bytes, one after the other, to a file, which appears complete or not at all. Returns a
/// warning, which is mostly empty. Throws std::runtime_error.
std::string WriteComplete(const std::string& fileName, const std::vector<std::string>& parts);
}

#endif
