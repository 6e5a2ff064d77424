// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws a mesh with VTK, to compare its speed with a light field.
 */
#ifndef cslfMeshRenderer_h
#define cslfMeshRenderer_h

#include "Pictures/cslfOffscreenWindow.h"
#include "cslfCube.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;

namespace cslf::tool
{
class MeshRenderer
{
public:
  /// The triangles of a scene's file, with VTK's defaults: a headlight, and colours if the file has
  /// any. Throws a Failure.
  MeshRenderer(const std::string& fileName, int width, int height);
  ~MeshRenderer();

  /// Draws the view and returns the seconds that it took. Throws a Failure.
  double Draw(vtkCamera* camera) { return this->Window.Draw(camera); }

  vtkIdType GetNumberOfTriangles() const;

  /// The cube of a light field of the mesh.
  Cube GetCube() const;

private:
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  OffscreenWindow Window;
};
}

#endif
