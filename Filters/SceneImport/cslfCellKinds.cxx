// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCellKinds.h"

#include "Pipeline/cslfArrayLayout.h"

#include "Pipeline/cslfValidPolyData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

namespace cslf
{
namespace
{
/// A list of cells, and the index of its first cell in the data.
struct CellList
{
  vtkCellArray* Cells;
  vtkIdType First;
};

/// Vertices, lines, polygons and strips, the order of cells and of drawing.
std::array<CellList, 4> GetLists(vtkPolyData* block)
{
  std::array<CellList, 4> lists = { { { block->GetVerts(), 0 }, { block->GetLines(), 0 },
    { block->GetPolys(), 0 }, { block->GetStrips(), 0 } } };
  for (std::size_t i = 1; i < lists.size(); ++i)
  {
    lists[i].First = lists[i - 1].First + lists[i - 1].Cells->GetNumberOfCells();
  }
  return lists;
}

/// Polygonal data with the points, the point data and the field data of a block, and no cells.
vtkSmartPointer<vtkPolyData> CopyPoints(vtkPolyData* block)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->SetPoints(block->GetPoints());
  copy->GetPointData()->ShallowCopy(block->GetPointData());
  vtkNew<vtkFieldData> fields;
  fields->ShallowCopy(block->GetFieldData());
  copy->SetFieldData(fields);
  return copy;
}

/// Sets the data of all cells: that of the given cells of the block.
void CopyCellData(vtkPolyData* block, const std::vector<vtkIdType>& cells, vtkPolyData* copy)
{
  vtkCellData* data = copy->GetCellData();
  const auto all = KeepNumeric(block->GetCellData());
  data->CopyAllOn();
  data->CopyAllocate(all, static_cast<vtkIdType>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    data->CopyData(all, cells[i], static_cast<vtkIdType>(i));
  }
}

/// For each point, the first of all points with the same coordinates.
std::vector<vtkIdType> FindPlaces(vtkPolyData* block)
{
  struct Place
  {
    std::array<double, 3> Position;
    vtkIdType Point;
  };
  std::vector<Place> order(block->GetNumberOfPoints());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i].Point = static_cast<vtkIdType>(i);
    block->GetPoint(order[i].Point, order[i].Position.data());
    for (double& value : order[i].Position)
    {
      // Coordinates that are not numbers cannot be sorted.
      value = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
    }
  }
  std::sort(order.begin(), order.end(),
    [](const Place& a, const Place& b)
    { return std::tie(a.Position, a.Point) < std::tie(b.Position, b.Point); });
  std::vector<vtkIdType> places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool isFirst = i == 0 || order[i].Position != order[i - 1].Position;
    places[order[i].Point] = isFirst ? order[i].Point : places[order[i - 1].Point];
  }
  return places;
}

/// The parts of lines and the edges of faces.
class EdgeList
{
public:
  explicit EdgeList(vtkPolyData* block)
    : Block(block)
    , Places(FindPlaces(block))
    , Flags(vtkUnsignedCharArray::SafeDownCast(
        block->GetPointData()->GetAttribute(vtkDataSetAttributes::EDGEFLAG)))
  {
    const std::array<CellList, 4> lists = GetLists(block);
    this->FirstFace = lists[2].First;
    this->AddCells(lists[1], &EdgeList::AddLine);
    this->AddCells(lists[2], &EdgeList::AddPolygon);
    this->AddCells(lists[3], &EdgeList::AddStrip);
  }

  /// Those that are seen and belong to faces, or to lines.
  vtkSmartPointer<vtkPolyData> MakeLines(bool ofFaces)
  {
    std::stable_sort(this->Edges.begin(), this->Edges.end(),
      [](const Edge& a, const Edge& b) { return a.Places < b.Places; });
    vtkNew<vtkCellArray> lines;
    std::vector<vtkIdType> cells;
    for (std::size_t i = 0; i < this->Edges.size(); ++i)
    {
      const Edge& edge = this->Edges[i];
      const bool isLast = i + 1 == this->Edges.size() || this->Edges[i + 1].Places != edge.Places;
      if (isLast && (edge.Cell >= this->FirstFace) == ofFaces)
      {
        lines->InsertNextCell(2, edge.Points.data());
        cells.push_back(edge.Cell);
      }
    }
    vtkSmartPointer<vtkPolyData> result = CopyPoints(this->Block);
    result->SetLines(lines);
    CopyCellData(this->Block, cells, result);
    return result;
  }

private:
  struct Edge
  {
    std::array<vtkIdType, 2> Places; // the smaller one first
    std::array<vtkIdType, 2> Points;
    vtkIdType Cell;
  };

  void Add(vtkIdType cell, vtkIdType from, vtkIdType to)
  {
    const auto [low, high] = std::minmax(this->Places[from], this->Places[to]);
    if (low != high)
    {
      this->Edges.push_back({ { { low, high } }, { { from, to } }, cell });
    }
  }

  using AddCell = void (EdgeList::*)(vtkIdType, vtkIdType, const vtkIdType*);

  void AddCells(const CellList& list, AddCell add)
  {
    ForEachCell(list.Cells,
      [&](vtkIdType cell, vtkIdType count, const vtkIdType* points)
      { (this->*add)(list.First + cell, count, points); });
  }

  void AddLine(vtkIdType cell, vtkIdType count, const vtkIdType* points)
  {
    for (vtkIdType i = 1; i < count; ++i)
    {
      this->Add(cell, points[i - 1], points[i]);
    }
  }

  void AddPolygon(vtkIdType cell, vtkIdType count, const vtkIdType* points)
  {
    const bool hasFlags = this->Flags && this->Flags->GetNumberOfComponents() == 1;
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (!hasFlags || this->Flags->GetValue(points[i]) != 0)
      {
        this->Add(cell, points[i], points[(i + 1) % count]);
      }
    }
  }

  void AddStrip(vtkIdType cell, vtkIdType count, const vtkIdType* points)
  {
    this->AddLine(cell, count, points);
    for (vtkIdType i = 2; i < count; ++i)
    {
      this->Add(cell, points[i - 2], points[i]);
    }
  }

  vtkPolyData* Block;
  std::vector<vtkIdType> Places;
  vtkUnsignedCharArray* Flags; // of points; an edge is drawn if its first point's is not 0
  vtkIdType FirstFace;
  std::vector<Edge> Edges;
};
}

vtkIdType CountCells(vtkPolyData* block, CellKind kind)
{
  switch (kind)
  {
    case CellKind::Vertices:
      return block->GetNumberOfVerts();
    case CellKind::Lines:
      return block->GetNumberOfLines();
    default:
      return block->GetNumberOfPolys() + block->GetNumberOfStrips();
  }
}

vtkSmartPointer<vtkPolyData> SelectCells(vtkPolyData* block, const CellKinds& kinds)
{
  vtkSmartPointer<vtkPolyData> selected = CopyPoints(block);
  std::vector<vtkIdType> cells;
  vtkIdType first = 0;
  for (const CellKind kind : { CellKind::Vertices, CellKind::Lines, CellKind::Faces })
  {
    const vtkIdType count = CountCells(block, kind);
    if (kinds.count(kind) != 0)
    {
      cells.resize(cells.size() + count);
      std::iota(cells.end() - count, cells.end(), first);
    }
    first += count;
  }
  if (kinds.count(CellKind::Vertices) != 0)
  {
    selected->SetVerts(block->GetVerts());
  }
  if (kinds.count(CellKind::Lines) != 0)
  {
    selected->SetLines(block->GetLines());
  }
  if (kinds.count(CellKind::Faces) != 0)
  {
    selected->SetPolys(block->GetPolys());
    selected->SetStrips(block->GetStrips());
  }
  if (selected->GetNumberOfCells() == block->GetNumberOfCells())
  {
    selected->GetCellData()->ShallowCopy(block->GetCellData());
  }
  else
  {
    CopyCellData(block, cells, selected);
  }
  return selected;
}

vtkSmartPointer<vtkPolyData> MakePoints(vtkPolyData* block, bool exceptVertices)
{
  const std::vector<vtkIdType> places = FindPlaces(block);
  struct Use
  {
    vtkIdType Point = -1;
    vtkIdType Cell = -1;
  };
  std::vector<Use> last(places.size());
  for (const CellList& list : GetLists(block))
  {
    ForEachCell(list.Cells,
      [&](vtkIdType cell, vtkIdType count, const vtkIdType* points)
      {
        for (vtkIdType i = 0; i < count; ++i)
        {
          last[places[points[i]]] = { points[i], list.First + cell };
        }
      });
  }
  if (exceptVertices)
  {
    ForEachCell(block->GetVerts(),
      [&](vtkIdType, vtkIdType count, const vtkIdType* points)
      {
        for (vtkIdType i = 0; i < count; ++i)
        {
          last[places[points[i]]] = Use();
        }
      });
  }
  vtkNew<vtkCellArray> vertices;
  std::vector<vtkIdType> cells;
  for (const Use& use : last)
  {
    if (use.Point >= 0)
    {
      vertices->InsertNextCell(1, &use.Point);
      cells.push_back(use.Cell);
    }
  }
  vtkSmartPointer<vtkPolyData> result = CopyPoints(block);
  result->SetVerts(vertices);
  CopyCellData(block, cells, result);
  return result;
}

vtkSmartPointer<vtkPolyData> MakeEdges(vtkPolyData* block, CellKind kind)
{
  return EdgeList(block).MakeLines(kind == CellKind::Faces);
}

void CopyEdgeFlags(vtkPolyData* source, vtkPolyData* copy)
{
  constexpr int attribute = vtkDataSetAttributes::EDGEFLAG;
  if (vtkDataArray* flags = source->GetPointData()->GetAttribute(attribute))
  {
    copy->GetPointData()->SetAttribute(flags, attribute);
  }
}
}
