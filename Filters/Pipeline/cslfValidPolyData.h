// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Removes cells and arrays of polygonal data that would cause reads out of bounds.
 */
#ifndef cslfValidPolyData_h
#define cslfValidPolyData_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <set>
#include <string>

namespace cslf
{
struct ValidPolyData
{
  vtkSmartPointer<vtkPolyData> Data;   ///< the given data itself if nothing had to be changed
  vtkIdType RemovedCells = 0;          ///< with ids of points that do not exist
  vtkIdType RemovedCellLists = 0;      ///< all vertices, lines, polygons or strips
  std::set<std::string> RemovedArrays; ///< names of arrays with too few tuples

  /// Whether nothing had to be removed.
  bool IsWhole() const
  {
    return this->RemovedCells == 0 && this->RemovedCellLists == 0 && this->RemovedArrays.empty();
  }

  /// Adds descriptions of what was removed to a list.
  VTKCSLF_EXPORT void AddRemoved(std::set<std::string>& list) const;
};

/// Checks polygonal data, which VTK itself never does, and removes
/// - cells with ids of missing points;
/// - all vertices, lines, polygons or strips if their offsets do not ascend from 0 to the length of
///   their connectivity;
/// - arrays of points or cells with fewer tuples than there are points or cells.
/// All arrays but the points' coordinates are vtkAOSDataArrayTemplate in what comes out.
VTKCSLF_EXPORT ValidPolyData MakeSound(vtkPolyData* data);

/// Calls `visit(cell, count, points)` for each cell of a valid list.
template <typename Visit>
void ForEachCell(vtkCellArray* cells, Visit visit)
{
  auto cell = vtk::TakeSmartPointer(cells->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* points;
    cell->GetCurrentCell(count, points);
    visit(cell->GetCurrentCellId(), count, points);
  }
}
}

#endif
