// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Cuts a block with clipping planes.
 */
#ifndef cslfClippedBlock_h
#define cslfClippedBlock_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <set>
#include <string>
#include <vector>

class vtkPlaneCollection;

namespace cslf
{
/// Cuts a block in world coordinates with planes, like VTK's mappers: everything on the negative
/// side of any plane is removed, and the cut is not capped. Points keep their normals, texture
/// coordinates and colours, which are interpolated where cells are cut. If a block has instances,
/// those that the planes cut become geometry; the others stay instances. Field data is kept. The
/// result is in pieces, none of which is empty. Adds what is left out, in words, to `omitted`.
std::vector<vtkSmartPointer<vtkPolyData>> ClipBlock(
  vtkPolyData* block, vtkPlaneCollection* planes, std::set<std::string>& omitted);
}

#endif
