// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The contents of one polygonal data object in a scene: its triangles, vertices or lines.
 */
#ifndef cslfSceneBlock_h
#define cslfSceneBlock_h

#include "PathTracing/Shapes/cslfMesh.h"
#include "Pipeline/cslfColorMap.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <glm/mat4x4.hpp>

#include <string>
#include <vector>

class vtkDataArray;

namespace cslf
{
/// A sphere or a part of a line.
struct RoundPart
{
  vtkIdType Points[2]; ///< of a sphere, the same twice
  vtkIdType Cell;
};

struct RoundSelection
{
  std::vector<RoundPart> Parts;
  vtkIdType Removed = 0; ///< the number with coordinates that are not finite
};

/// The vertices (as spheres) or the parts of lines (as tubes) of polygonal data.
RoundSelection SelectRound(vtkPolyData* data, Mesh::Shapes shape);

/// An instance of a block, in the world.
struct BlockInstance
{
  glm::dmat4 ToWorld{ 1.0 };
  glm::vec3 Color{ 1.0f }; ///< linear
  float Opacity = 1.0f;
  bool HasColor = false;
  glm::vec3 Emission{ 0.0f }; ///< radiance
  bool HasEmission = false;
  double Scalar = 0.0; ///< that a map gave its colour
  bool HasScalar = false;
};

/// A tuple of radiance. Values that are negative or not finite become 0.
glm::vec3 GetRadiance(vtkDataArray* array, vtkIdType tuple);

struct InstanceSelection
{
  std::vector<BlockInstance> Places; ///< without those of zero size
  bool IsPresent = false;
  bool IsBroken = false; ///< whether arrays do not match
  vtkIdType Removed = 0; ///< the number with a matrix that is not a finite affine transform
};

/// The instances in a block's field data: see vtkCSLFInstances.
InstanceSelection SelectInstances(vtkPolyData* data);

struct SceneBlock
{
  vtkSmartPointer<vtkPolyData> Data;
  Mesh::Shapes Shape = Mesh::Shapes::Triangles;
  std::vector<vtkIdType> Triangles; ///< cells of the data's polygons
  std::vector<RoundPart> Round;
  double LineRadius = 0.0; ///< in the world; 0 for the scene's
  double PointRadius = 0.0;
  double StandardRadius = 0.0; ///< of points without one of their own
  vtkSmartPointer<vtkDataArray> Scalars;
  bool ScalarsOfCells = false;
  glm::vec3 DisplayedWhite{ 0.0f }; ///< see vtkCSLFMaterial
  bool HasFinishedColors = false;   ///< likewise
  SurfaceMaterial Material;
  MaterialTextures Textures;
  std::string Map; ///< what the texture of base colours maps, see ReadColorMap, or nothing
  std::vector<ColorMap> ColorMaps;   ///< or the map of the colours of points, cells or instances
  std::vector<vtkDataArray*> Arrays; ///< of the points, which a geometry keeps
  std::vector<vtkDataArray*> CellArrays; ///< of the cells, likewise
  std::string Appearance;                ///< identifies the material, the textures and the map
  std::vector<BlockInstance> Instances;

  bool HasTextures() const;

  /// Extends bounds by the points, with a margin, in all instances.
  void AddTo(glm::dvec3& lower, glm::dvec3& upper, double margin) const;

  /// Whether points have radii of their own.
  bool HasRadii() const;

  /// The radius of a point's sphere or tube, in the space of the data.
  double GetRadius(vtkIdType point) const;
  double GetLargestRadius() const;

  /// Removes spheres and parts of lines with a radius of 0 at both ends. Returns their number.
  vtkIdType RemovePartsWithoutRadius();
};
}

#endif
