// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Imports mappers that draw shapes made from their input: molecules, graphs, splats, spheres and
 * sticks. Each is divided into actors whose mappers draw polygonal data.
 */
#ifndef cslfActorParts_h
#define cslfActorParts_h

#include "cslfImportedScene.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <optional>

class vtkDataArray;
class vtkGraphMapper;
class vtkMapper;
class vtkPointGaussianMapper;
class vtkPolyDataMapper;
class vtkUnsignedCharArray;

namespace cslf
{
/// Gives each cell its own points, with the cell's normal. Returns the block itself if it has no
/// polygons, if cells have no normals, or if points have normals.
vtkSmartPointer<vtkPolyData> SpreadCellNormals(vtkPolyData* block);

/// A part of an actor. Its vertices and its lines may have their own radii: see
/// vtkCSLFMaterial::LineRadiusName and PointRadiusName.
struct ActorPart
{
  vtkSmartPointer<vtkActor> Actor;
  vtkSmartPointer<vtkMatrix4x4> Matrix; ///< from its data to the world
};

using ActorParts = std::vector<ActorPart>;

/// The parts of an actor with an up-to-date mapper, placed by a matrix. Empty if the mapper draws
/// the polygons, lines and vertices of its input, or is of an unknown kind.
std::optional<ActorParts> TakeApart(vtkActor* actor, vtkMatrix4x4* matrix, ImportedScene& scene);

/// A copy of a property. Unlike that of vtkProperty::DeepCopy, it owns its textures, and has the
/// emissive factor.
vtkSmartPointer<vtkProperty> CopyProperty(vtkProperty* property);

/// A part with surface representation, with the property and texture of the whole.
ActorPart MakePart(vtkPolyData* data, vtkActor* whole, vtkMatrix4x4* matrix);

/// Spheres around points, with the points' radii, and their colours or null.
vtkSmartPointer<vtkPolyData> MakeSpheres(
  vtkPoints* points, vtkDataArray* radii, vtkUnsignedCharArray* colors);

/// Cylinders around points, with the points' lengths and radii (the first two components of the
/// scales), directions of the axes, and colours or null.
vtkSmartPointer<vtkPolyData> MakeSticks(
  vtkPoints* centers, vtkDataArray* scales, vtkDataArray* directions, vtkUnsignedCharArray* colors);

/// The parts for each kind of mapper.
ActorParts TakeMoleculeApart(
  vtkActor* actor, vtkMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene);
ActorParts TakeGraphApart(vtkGraphMapper* mapper, ImportedScene& scene);
ActorParts TakeSplatsApart(
  vtkActor* actor, vtkPointGaussianMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene);
ActorParts TakeSpheresApart(
  vtkActor* actor, vtkPolyDataMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene);
ActorParts TakeSticksApart(
  vtkActor* actor, vtkPolyDataMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene);
}

#endif
