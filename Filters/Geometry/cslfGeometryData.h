// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A field's geometry as polygonal data.
 */
#ifndef cslfGeometryData_h
#define cslfGeometryData_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfSurfaceMesh.h"

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkPolyData;

namespace cslf
{
/// What a geometry has besides its triangles.
struct GeometryRecord
{
  double Error = 0.0; ///< in world coordinates
  double Loss = 0.0;
  std::string Scene;     ///< a hash; not written if it is empty
  bool IsOpaque = false; ///< whether it has only the opaque ones of the scene's surfaces
  std::vector<InstanceGroup> Groups; ///< the bodies that are last in the mesh
};

/// The triangles of a mesh. Its points become `center` + `scale` * point.
vtkSmartPointer<vtkPolyData> MakePolyData(
  const SurfaceMesh& mesh, const glm::dvec3& center, const glm::dvec3& scale);

/// The same in world coordinates, with the field data of a geometry.
VTKCSLF_EXPORT vtkSmartPointer<vtkPolyData> MakeGeometryData(const SurfaceMesh& mesh,
  const glm::dvec3& center, const glm::dvec3& scale, const GeometryRecord& record);
/// The points and triangles of data that has no other polygons.
SurfaceMesh MakeMesh(vtkPolyData* data);
}

#endif
