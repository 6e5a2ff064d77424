// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A mesh, drawn as VTK draws meshes: what a light field is compared with in speed.
 */
#ifndef cslfMeshRenderer_h
#define cslfMeshRenderer_h

#include "cslfCube.h"
#include "cslfOffscreenWindow.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;

namespace cslf
{
namespace tool
{
class MeshRenderer
{
public:
  /// The triangles of a scene's file, with VTK's defaults: a headlight, and colours where the file
  /// has some. Throws a Failure.
  MeshRenderer(const std::string& fileName, int width, int height);
  ~MeshRenderer();

  /// Draws the view and returns the seconds that it took. Throws a Failure.
  double Draw(vtkCamera* camera) { return this->Window.Draw(camera); }

  vtkIdType GetNumberOfTriangles() const;

  /// The cube that a light field of the mesh would have.
  Cube GetCube() const;

private:
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  OffscreenWindow Window;
};
}
}

#endif
