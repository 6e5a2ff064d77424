// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTriangleList.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkType.h>

namespace cslf
{
vtkSmartPointer<vtkPolyData> Triangulate(vtkPolyData* data)
{
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->SetInputData(data);
  triangulate->PassVertsOff();
  triangulate->PassLinesOff();
  triangulate->Update();
  return triangulate->GetOutput();
}

std::vector<unsigned int> ListCorners(vtkPolyData* triangles)
{
  std::vector<unsigned int> list;
  list.reserve(3 * triangles->GetNumberOfPolys());
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  const auto cells = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    cells->GetCurrentCell(count, corners);
    for (vtkIdType i = 0; i < count; ++i)
    {
      list.push_back(static_cast<unsigned int>(corners[i]));
    }
  }
  return list;
}
}
