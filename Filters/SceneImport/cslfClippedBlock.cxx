// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfClippedBlock.h"

#include "Pipeline/cslfTriangleList.h"
#include "Pipeline/cslfValidPolyData.h"
#include "cslfActorImporter.h"
#include "cslfCellKinds.h"
#include "vtkCSLFInstances.h"

#include <vtkAppendPolyData.h>
#include <vtkBoundingBox.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkClipPolyData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkNonMergingPointLocator.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <utility>

namespace cslf
{
namespace
{
using Pieces = std::vector<vtkSmartPointer<vtkPolyData>>;

/// Calls `visit` for each plane.
template <typename Visit>
void ForEachPlane(vtkPlaneCollection* planes, Visit visit)
{
  vtkCollectionSimpleIterator cookie;
  planes->InitTraversal(cookie);
  while (vtkPlane* plane = planes->GetNextPlane(cookie))
  {
    visit(plane);
  }
}

/// Records cells that are left out, of which vtkClipPolyData would leave nothing.
void Omit(vtkIdType count, const char* what, std::set<std::string>& omitted)
{
  if (count > 0)
  {
    omitted.insert(std::to_string(count) + " " + what);
  }
}

vtkIdType CountNotFinite(vtkPolyData* data)
{
  vtkIdType number = 0;
  for (vtkCellArray* cells :
    { data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips() })
  {
    ForEachCell(cells,
      [&](vtkIdType, vtkIdType count, const vtkIdType* points)
      {
        const bool isFinite = std::all_of(points, points + count,
          [data](vtkIdType point) { return IsFinite(GetPoint(data, point)); });
        number += isFinite ? 0 : 1;
      });
  }
  return number;
}

/// The data, or its triangles if it has polygons that touch or cross themselves, or that are left
/// out: vtkClipPolyData would leave nothing of them.
vtkSmartPointer<vtkPolyData> FillPolygons(vtkPolyData* data, std::set<std::string>& omitted)
{
  const Triangulation triangulation = TriangulatePolygons(data);
  Omit(triangulation.WithoutArea, PolygonsWithoutArea, omitted);
  Omit(triangulation.Tangled, TangledPolygons, omitted);
  return triangulation.Filled + triangulation.CountOmitted() > 0 ? triangulation.Triangles.Get()
                                                                 : data;
}

/// Cuts geometry at its position.
Pieces ClipGeometry(vtkPolyData* data, vtkPlaneCollection* planes, std::set<std::string>& omitted)
{
  Pieces clipped;
  // One by one, because vtkClipPolyData mixes up the data of cells of several kinds.
  for (const CellKind kind : { CellKind::Vertices, CellKind::Lines, CellKind::Faces })
  {
    if (CountCells(data, kind) == 0)
    {
      continue;
    }
    vtkSmartPointer<vtkPolyData> piece = SelectCells(data, { kind });
    Omit(
      CountNotFinite(piece), kind == CellKind::Faces ? NotFinitePolygons : NotFiniteRound, omitted);
    piece = kind == CellKind::Faces ? FillPolygons(piece, omitted) : piece;
    ForEachPlane(planes,
      [&piece](vtkPlane* plane)
      {
        vtkNew<vtkClipPolyData> clip;
        clip->SetInputData(piece);
        clip->SetClipFunction(plane);
        // Points at one position may have different normals or texture coordinates.
        vtkNew<vtkNonMergingPointLocator> locator;
        clip->SetLocator(locator);
        clip->Update();
        piece = clip->GetOutput();
      });
    if (piece->GetNumberOfCells() > 0)
    {
      piece->SetFieldData(data->GetFieldData());
      clipped.push_back(piece);
    }
  }
  return clipped;
}

/// The position of a box relative to planes.
enum class Sides
{
  Kept,
  Cut,
  Removed
};

Sides FindSides(vtkPolyData* data, vtkMatrix4x4* matrix, vtkPlaneCollection* planes)
{
  const vtkBoundingBox box(data->GetBounds());
  Sides sides = Sides::Kept;
  ForEachPlane(planes,
    [&](vtkPlane* plane)
    {
      int kept = 0;
      for (int i = 0; i < 8; ++i)
      {
        double corner[4];
        box.GetCorner(i, corner);
        corner[3] = 1.0;
        matrix->MultiplyPoint(corner, corner);
        kept += plane->EvaluateFunction(corner) >= 0.0 ? 1 : 0;
      }
      if (kept == 0)
      {
        sides = Sides::Removed;
      }
      else if (kept < 8 && sides == Sides::Kept)
      {
        sides = Sides::Cut;
      }
    });
  return sides;
}

/// Divides the instances of a block into those that stay and the geometry of those that are cut.
class InstanceClipper
{
public:
  InstanceClipper(vtkPolyData* block, vtkPlaneCollection* planes, std::set<std::string>& omitted)
    : Block(block)
    , Planes(planes)
    , Omitted(omitted)
    , Matrices(block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix()))
    , Colors(vtkUnsignedCharArray::SafeDownCast(
        block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceColor())))
  {
  }

  Pieces Clip()
  {
    vtkNew<vtkPolyData> kept;
    kept->ShallowCopy(this->Block);
    vtkCSLFInstances::RemoveInstances(kept);
    vtkNew<vtkMatrix4x4> matrix;
    for (vtkIdType i = 0; i < this->Matrices->GetNumberOfTuples(); ++i)
    {
      this->Matrices->GetTuple(i, matrix->GetData());
      const Sides sides = FindSides(this->Block, matrix, this->Planes);
      if (sides == Sides::Kept)
      {
        this->Keep(kept, matrix, i);
      }
      else if (sides == Sides::Cut)
      {
        this->Cut(matrix, i);
      }
    }
    Pieces pieces;
    if (this->CutCount > 0)
    {
      this->CutPieces->Update();
      vtkNew<vtkPolyData> cut;
      cut->ShallowCopy(this->CutPieces->GetOutput());
      cut->GetFieldData()->ShallowCopy(this->Block->GetFieldData());
      vtkCSLFInstances::RemoveInstances(cut);
      pieces = ClipGeometry(cut, this->Planes, this->Omitted);
    }
    if (kept->GetFieldData()->HasArray(vtkCSLFInstances::InstanceMatrix()))
    {
      pieces.insert(pieces.begin(), kept.Get());
    }
    return pieces;
  }

private:
  void Keep(vtkPolyData* kept, vtkMatrix4x4* matrix, vtkIdType instance)
  {
    if (!this->Colors)
    {
      vtkCSLFInstances::AddInstance(kept, matrix);
      return;
    }
    double color[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (int i = 0; i < std::min(this->Colors->GetNumberOfComponents(), 4); ++i)
    {
      color[i] = this->Colors->GetTypedComponent(instance, i) / 255.0;
    }
    vtkCSLFInstances::AddInstance(kept, matrix, color);
  }

  void Cut(vtkMatrix4x4* matrix, vtkIdType instance)
  {
    vtkNew<vtkPolyData> source;
    source->CopyStructure(this->Block);
    source->GetPointData()->ShallowCopy(this->Block->GetPointData());
    vtkNew<vtkPolyData> piece;
    piece->ShallowCopy(ExtractSurface(source, matrix));
    if (this->Colors)
    {
      vtkNew<vtkUnsignedCharArray> colors;
      colors->SetName("Colors");
      colors->SetNumberOfComponents(this->Colors->GetNumberOfComponents());
      colors->SetNumberOfTuples(piece->GetNumberOfPoints());
      for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
      {
        colors->SetTuple(i, instance, this->Colors);
      }
      piece->GetPointData()->SetScalars(colors);
    }
    this->CutPieces->AddInputData(piece);
    this->CutPieces->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    ++this->CutCount;
  }

  vtkPolyData* Block;
  vtkPlaneCollection* Planes;
  std::set<std::string>& Omitted;
  vtkDataArray* Matrices;
  vtkUnsignedCharArray* Colors;
  vtkNew<vtkAppendPolyData> CutPieces; // geometry to be cut, in the world
  vtkIdType CutCount = 0;
};
}

std::vector<vtkSmartPointer<vtkPolyData>> ClipBlock(
  vtkPolyData* block, vtkPlaneCollection* planes, std::set<std::string>& omitted)
{
  return block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix())
    ? InstanceClipper(block, planes, omitted).Clip()
    : ClipGeometry(block, planes, omitted);
}
}
