// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMeshRenderer.h"

#include "Console/cslfMessages.h"
#include "Options/cslfCameraOptions.h"
#include "Scenes/cslfSceneFiles.h"

#include "Pipeline/cslfTriangleList.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

namespace cslf::tool
{
MeshRenderer::MeshRenderer(const std::string& fileName, int width, int height)
  : Window(width, height)
{
  Scene scene;
  scene.Parts.push_back(ReadScenePart(fileName));
  vtkNew<vtkAppendPolyData> append;
  scene.ForEachPolyData([&](vtkPolyData* polyData) { append->AddInputData(polyData); });
  append->Update();
  ThrowOnError();
  this->Mesh = Triangulate(append->GetOutput());
  if (this->GetNumberOfTriangles() == 0)
  {
    throw Failure(fileName + " has no triangles.");
  }
  this->Mapper->SetInputData(this->Mesh);
  this->Actor->SetMapper(this->Mapper);
  this->Window.AddActor(this->Actor);
}

MeshRenderer::~MeshRenderer() = default;

vtkIdType MeshRenderer::GetNumberOfTriangles() const
{
  return this->Mesh->GetNumberOfPolys();
}

Cube MeshRenderer::GetCube() const
{
  double bounds[6];
  this->Mesh->GetBounds(bounds);
  return Cube::FromBounds(bounds, options::Offset.Default);
}
}
