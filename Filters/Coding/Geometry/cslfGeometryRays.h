// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where rays meet a field's geometry.
 */
#ifndef cslfGeometryRays_h
#define cslfGeometryRays_h

#include "vtkCSLFModule.h" // for export macro

#include "Lookup/cslfLookup.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfDescription.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <glm/vec4.hpp>

#include <memory>
#include <optional>

namespace cslf
{
class VTKCSLF_EXPORT GeometryRays
{
public:
  struct Hit
  {
    GeometryPoint Point;
    glm::dvec4 Color;     ///< the geometry's own, on the side of the ray; alpha is 0 without one
    bool IsExact = false; ///< whether it is the colour from all directions
  };

  /// Polygons in world coordinates, with point data `Color`, `BackColor` and `ExactColor`.
  GeometryRays(vtkPolyData* geometry, const Description& field);

  /// Whether it has all surfaces: rays that miss it see none.
  bool IsComplete() const { return this->HasAll; }

  /// Where it is, if it has only the opaque surfaces: rays may meet others. Otherwise null.
  const std::shared_ptr<const SurfaceCells>& GetCells() const { return this->Cells; }

  /// The first point that a ray meets. May be called by several threads at once.
  std::optional<Hit> Intersect(const RayCoordinates& ray) const;

private:
  vtkNew<vtkPolyData> TrianglesCC;
  vtkNew<vtkStaticCellLocator> Locator;
  PointColorArrays Colors; ///< of TrianglesCC
  MappedPoints Mapped;     ///< likewise
  bool HasAll;
  std::shared_ptr<const SurfaceCells> Cells;
};
}

#endif
