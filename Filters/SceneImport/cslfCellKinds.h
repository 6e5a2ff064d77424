// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Vertices, lines and faces of polygonal data, and the points and edges that VTK's window draws for
 * them.
 */
#ifndef cslfCellKinds_h
#define cslfCellKinds_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <set>

namespace cslf
{
enum class CellKind
{
  Vertices,
  Lines,
  Faces ///< polygons and triangle strips
};

using CellKinds = std::set<CellKind>;

vtkIdType CountCells(vtkPolyData* block, CellKind kind);

/// The cells of some kinds, with their data. Shares the points, and has its own list of field data.
vtkSmartPointer<vtkPolyData> SelectCells(vtkPolyData* block, const CellKinds& kinds);

/// The points that cells use, as vertices, one at each place. Where several points or cells share a
/// place, the vertex has the point and the data of the cell that the window draws last, which is
/// the one that is seen. `exceptVertices` leaves out the places of the block's own vertices.
vtkSmartPointer<vtkPolyData> MakePoints(vtkPolyData* block, bool exceptVertices = false);

/// The parts of lines, or the edges of faces, as lines of two points, one at each place. Where
/// several share a place, only the one that the window draws last is returned, with the data of its
/// cell, and only if it belongs to a cell of that kind. As in the window, edge flags of points hide
/// the edges of polygons that start at points whose flag is 0.
vtkSmartPointer<vtkPolyData> MakeEdges(vtkPolyData* block, CellKind kind);

/// Copies the edge flags of points, if there are any.
void CopyEdgeFlags(vtkPolyData* source, vtkPolyData* copy);
}

#endif
