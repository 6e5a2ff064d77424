// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfAMRSurface.h"

#include "Pipeline/cslfArrayLayout.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUniformGridAMR.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace cslf
{
namespace
{
// How far beyond a face to look for another grid's cell, in widths of the face's cell. It is less
// than half a cell that is finer by any usual ratio.
constexpr double ProbeDistance = 0.01;

// The corners of a voxel's faces, counterclockwise seen from outside: by axis, low side first.
constexpr int FaceCorners[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
  { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };

bool IsVisible(vtkImageData* grid, vtkIdType cell)
{
  constexpr int hidden = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL |
    vtkDataSetAttributes::DUPLICATECELL;
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  return !ghosts || (ghosts->GetValue(cell) & hidden) == 0;
}

/// The cells of a grid along each axis.
struct CellCounts
{
  explicit CellCounts(vtkImageData* grid)
  {
    int points[3];
    grid->GetDimensions(points);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Counts[axis] = std::max(points[axis] - 1, 1);
      this->IsFlat[axis] = points[axis] == 1;
    }
  }

  vtkIdType GetIndex(const int cell[3]) const
  {
    return cell[0] + this->Counts[0] * (cell[1] + this->Counts[1] * vtkIdType(cell[2]));
  }

  int Counts[3];
  bool IsFlat[3];
};

/// Whether a visible cell of any grid contains a point.
bool IsInside(const std::vector<vtkImageData*>& grids, const double point[3])
{
  return std::any_of(grids.begin(), grids.end(),
    [point](vtkImageData* grid)
    {
      int cell[3];
      double coordinates[3];
      double copy[3] = { point[0], point[1], point[2] };
      return grid->ComputeStructuredCoordinates(copy, cell, coordinates) != 0 &&
        IsVisible(grid, grid->ComputeCellId(cell));
    });
}

/// Makes one grid's part of the surface.
class GridSurface
{
public:
  GridSurface(const std::vector<vtkImageData*>& grids, vtkImageData* grid)
    : Grids(grids)
    , Grid(grid)
    , PointData(KeepNumeric(grid->GetPointData()))
    , CellData(KeepNumeric(grid->GetCellData()))
    , Cells(grid)
    , Result(vtkSmartPointer<vtkPolyData>::New())
  {
    this->Points->SetDataTypeToDouble();
    this->Result->GetPointData()->CopyAllocate(this->PointData);
    this->Result->GetCellData()->CopyAllocate(this->CellData);
  }

  vtkSmartPointer<vtkPolyData> Make()
  {
    int cell[3];
    for (cell[2] = 0; cell[2] < this->Cells.Counts[2]; ++cell[2])
    {
      for (cell[1] = 0; cell[1] < this->Cells.Counts[1]; ++cell[1])
      {
        for (cell[0] = 0; cell[0] < this->Cells.Counts[0]; ++cell[0])
        {
          this->AddCell(cell);
        }
      }
    }
    this->Result->SetPoints(this->Points);
    this->Result->SetPolys(this->Faces);
    return this->Result;
  }

private:
  void AddCell(const int cell[3])
  {
    const vtkIdType index = this->Cells.GetIndex(cell);
    if (!IsVisible(this->Grid, index))
    {
      return;
    }
    this->Grid->GetCellPoints(index, this->Corners);
    if (this->Corners->GetNumberOfIds() == 4)
    {
      this->AddFace(index, { 0, 1, 3, 2 });
      return;
    }
    for (int face = 0; this->Corners->GetNumberOfIds() == 8 && face < 6; ++face)
    {
      int neighbour[3] = { cell[0], cell[1], cell[2] };
      neighbour[face / 2] += face % 2 == 0 ? -1 : 1;
      if (!this->HasNeighbour(neighbour, face / 2) && !this->MeetsOtherGrid(face))
      {
        const int* corners = FaceCorners[face];
        this->AddFace(index, { corners[0], corners[1], corners[2], corners[3] });
      }
    }
  }

  bool HasNeighbour(const int neighbour[3], int axis) const
  {
    return neighbour[axis] >= 0 && neighbour[axis] < this->Cells.Counts[axis] &&
      IsVisible(this->Grid, this->Cells.GetIndex(neighbour));
  }

  /// Whether there is a visible cell just beyond a face.
  bool MeetsOtherGrid(int face)
  {
    double low[3];
    double high[3];
    this->Grid->GetPoint(this->Corners->GetId(0), low);
    this->Grid->GetPoint(this->Corners->GetId(7), high);
    double probe[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      // Slightly off the middle, which may lie between finer cells.
      probe[axis] = low[axis] + (0.5 + 0.1 * ProbeDistance) * (high[axis] - low[axis]);
    }
    const int axis = face / 2;
    const double step = ProbeDistance * (high[axis] - low[axis]);
    probe[axis] = face % 2 == 0 ? low[axis] - step : high[axis] + step;
    return IsInside(this->Grids, probe);
  }

  void AddFace(vtkIdType cell, std::initializer_list<int> corners)
  {
    const vtkIdType face = this->Faces->InsertNextCell(4);
    for (int corner : corners)
    {
      this->Faces->InsertCellPoint(this->GetPoint(this->Corners->GetId(corner)));
    }
    this->Result->GetCellData()->CopyData(this->CellData, cell, face);
  }

  vtkIdType GetPoint(vtkIdType point)
  {
    const auto [place, isNew] = this->NewPoints.try_emplace(point, 0);
    if (isNew)
    {
      place->second = this->Points->InsertNextPoint(this->Grid->GetPoint(point));
      this->Result->GetPointData()->CopyData(this->PointData, point, place->second);
    }
    return place->second;
  }

  const std::vector<vtkImageData*>& Grids;
  vtkImageData* Grid;
  vtkSmartPointer<vtkDataSetAttributes> PointData;
  vtkSmartPointer<vtkDataSetAttributes> CellData;
  CellCounts Cells;
  vtkSmartPointer<vtkPolyData> Result;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Faces;
  vtkNew<vtkIdList> Corners;                          // of the current cell
  std::unordered_map<vtkIdType, vtkIdType> NewPoints; // by the grid's points
};
}

vtkSmartPointer<vtkPolyData> ExtractAMRSurface(vtkUniformGridAMR* grids)
{
  std::vector<vtkImageData*> leaves;
  auto leaf = vtk::TakeSmartPointer(grids->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    auto* grid = vtkImageData::SafeDownCast(leaf->GetCurrentDataObject());
    if (grid && grid->GetNumberOfCells() > 0)
    {
      leaves.push_back(grid);
    }
  }
  vtkNew<vtkAppendPolyData> whole;
  whole->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (vtkImageData* grid : leaves)
  {
    whole->AddInputData(GridSurface(leaves, grid).Make());
  }
  if (leaves.empty())
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  whole->Update();
  vtkSmartPointer<vtkPolyData> surface = whole->GetOutput();
  // Its cells are visible, whatever the grids' arrays said.
  surface->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  return surface;
}
}
