// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCellNormals.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace cslf
{
namespace
{
/// Copies the points of all cells of an array, and appends the cells' normals, the first of which
/// is that of cell `firstCell`.
vtkSmartPointer<vtkCellArray> SpreadCells(vtkCellArray* cells, vtkIdType firstCell,
  vtkPolyData* block, vtkPolyData* spread, vtkDataArray* normals)
{
  auto result = vtkSmartPointer<vtkCellArray>::New();
  vtkDataArray* cellNormals = block->GetCellData()->GetNormals();
  vtkPointData* data = spread->GetPointData();
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCellAtId(i, count, corners);
    result->InsertNextCell(static_cast<int>(count));
    for (vtkIdType c = 0; c < count; ++c)
    {
      const vtkIdType point = spread->GetPoints()->InsertNextPoint(block->GetPoint(corners[c]));
      result->InsertCellPoint(point);
      data->CopyData(block->GetPointData(), corners[c], point);
      normals->InsertTuple(point, firstCell + i, cellNormals);
    }
  }
  return result;
}
}

vtkSmartPointer<vtkPolyData> SpreadCellNormals(vtkPolyData* block)
{
  vtkDataArray* cellNormals = block->GetCellData()->GetNormals();
  if (!cellNormals || cellNormals->GetNumberOfTuples() != block->GetNumberOfCells() ||
    block->GetPointData()->GetNormals() ||
    block->GetNumberOfPolys() + block->GetNumberOfStrips() == 0)
  {
    return block;
  }
  auto spread = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(block->GetPoints()->GetDataType());
  spread->SetPoints(points);
  spread->GetPointData()->CopyAllocate(block->GetPointData());
  auto normals = vtk::TakeSmartPointer(cellNormals->NewInstance());
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  vtkIdType firstCell = 0;
  const auto next = [&](vtkCellArray* cells)
  {
    auto result = SpreadCells(cells, firstCell, block, spread, normals);
    firstCell += cells->GetNumberOfCells();
    return result;
  };
  spread->SetVerts(next(block->GetVerts()));
  spread->SetLines(next(block->GetLines()));
  spread->SetPolys(next(block->GetPolys()));
  spread->SetStrips(next(block->GetStrips()));
  spread->GetPointData()->SetNormals(normals);
  spread->GetCellData()->ShallowCopy(block->GetCellData());
  spread->GetCellData()->SetNormals(nullptr);
  spread->SetFieldData(block->GetFieldData());
  return spread;
}
}
