// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfValidPolyData.h"

#include "cslfArrayLayout.h"

#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace cslf
{
namespace
{
/// The number of points whose coordinates can be read.
vtkIdType CountPoints(vtkPolyData* data)
{
  vtkPoints* points = data->GetPoints();
  return points && points->GetData()->GetNumberOfComponents() == 3 ? points->GetNumberOfPoints()
                                                                   : 0;
}

/// Removes the arrays that have fewer tuples than there are points or cells.
void RemoveShortArrays(
  vtkDataSetAttributes* attributes, vtkIdType tuples, std::set<std::string>& removed)
{
  for (int i = attributes->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < tuples)
    {
      removed.insert(array->GetName() ? array->GetName() : "(without a name)");
      attributes->RemoveArray(i);
    }
  }
}

/// The vertices, lines, polygons or strips of polygonal data, and which of them are valid.
class CellList
{
public:
  CellList(vtkCellArray* cells, vtkIdType points)
    : Cells(cells)
    , Count(cells ? std::max<vtkIdType>(cells->GetNumberOfCells(), 0) : 0)
    , IsValid(!cells || cells->IsValid())
  {
    if (this->IsValid)
    {
      this->ForEach(
        [&](vtkIdType, vtkIdType count, const vtkIdType* ids)
        {
          const bool sound = std::all_of(
            ids, ids + count, [points](vtkIdType id) { return id >= 0 && id < points; });
          this->Broken += sound ? 0 : 1;
        });
    }
  }

  bool IsSound() const { return this->IsValid && this->Broken == 0; }

  /// The valid cells. Adds their indices in the whole data, from `first` on, to `kept`.
  vtkSmartPointer<vtkCellArray> Copy(vtkIdType points, vtkIdType first, vtkIdList* kept) const
  {
    auto copy = vtkSmartPointer<vtkCellArray>::New();
    if (this->IsValid)
    {
      this->ForEach(
        [&](vtkIdType cell, vtkIdType count, const vtkIdType* ids)
        {
          if (std::all_of(
                ids, ids + count, [points](vtkIdType id) { return id >= 0 && id < points; }))
          {
            copy->InsertNextCell(count, ids);
            kept->InsertNextId(first + cell);
          }
        });
    }
    return copy;
  }

  vtkCellArray* Cells;
  vtkIdType Count;
  bool IsValid;
  vtkIdType Broken = 0;

private:
  template <typename Visit>
  void ForEach(Visit visit) const
  {
    if (this->Count > 0)
    {
      ForEachCell(this->Cells, visit);
    }
  }
};

using CellLists = std::array<CellList, 4>;

/// Replaces the cells by the valid ones, with their data.
void RemoveBrokenCells(vtkPolyData* data, const CellLists& lists, vtkIdType points)
{
  vtkNew<vtkIdList> kept;
  std::array<vtkSmartPointer<vtkCellArray>, 4> cells;
  vtkIdType first = 0;
  for (std::size_t i = 0; i < lists.size(); ++i)
  {
    cells[i] = lists[i].Copy(points, first, kept);
    first += lists[i].Count;
  }
  data->SetVerts(cells[0]);
  data->SetLines(cells[1]);
  data->SetPolys(cells[2]);
  data->SetStrips(cells[3]);
  vtkNew<vtkCellData> cellData;
  cellData->ShallowCopy(data->GetCellData());
  const auto all = KeepNumeric(cellData);
  data->GetCellData()->Initialize();
  data->GetCellData()->CopyAllOn();
  data->GetCellData()->CopyAllocate(all, kept->GetNumberOfIds());
  for (vtkIdType i = 0; i < kept->GetNumberOfIds(); ++i)
  {
    data->GetCellData()->CopyData(all, kept->GetId(i), i);
  }
}
}

void ValidPolyData::AddRemoved(std::set<std::string>& list) const
{
  if (this->RemovedCells > 0)
  {
    list.insert("cells with ids of missing points");
  }
  if (this->RemovedCellLists > 0)
  {
    list.insert("cells with invalid offsets");
  }
  for (const std::string& name : this->RemovedArrays)
  {
    list.insert("array " + name + ", which is too short");
  }
}

ValidPolyData MakeSound(vtkPolyData* data)
{
  ValidPolyData sound;
  const vtkIdType points = CountPoints(data);
  const CellLists lists = { { { data->GetVerts(), points }, { data->GetLines(), points },
    { data->GetPolys(), points }, { data->GetStrips(), points } } };
  vtkIdType cells = 0;
  for (const CellList& list : lists)
  {
    cells += list.Count;
    sound.RemovedCells += list.Broken;
    sound.RemovedCellLists += list.IsValid ? 0 : 1;
  }
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->CopyStructure(data);
  copy->GetPointData()->ShallowCopy(data->GetPointData());
  copy->GetCellData()->ShallowCopy(data->GetCellData());
  copy->GetFieldData()->ShallowCopy(data->GetFieldData());
  RemoveShortArrays(copy->GetPointData(), points, sound.RemovedArrays);
  RemoveShortArrays(copy->GetCellData(), cells, sound.RemovedArrays);
  bool hasOtherLayouts = MakeAOS(copy->GetPointData());
  hasOtherLayouts = MakeAOS(copy->GetCellData()) || hasOtherLayouts;
  hasOtherLayouts = MakeAOS(copy->GetFieldData()) || hasOtherLayouts;
  if (sound.RemovedCells > 0 || sound.RemovedCellLists > 0)
  {
    RemoveBrokenCells(copy, lists, points);
  }
  sound.Data = sound.IsWhole() && !hasOtherLayouts ? data : copy.Get();
  return sound;
}
}
