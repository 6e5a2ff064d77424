// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How well triangles represent a surface.
 */
#ifndef cslfSurfaceError_h
#define cslfSurfaceError_h

#include "vtkCSLFModule.h" // for export macro

#include "Pipeline/cslfPhase.h"
#include "cslfSurfaceMesh.h"

#include <glm/vec3.hpp>

#include <vector>

namespace cslf
{
struct SurfaceError
{
  double RootMeanSquare = 0.0; ///< of the distances of points that are not lost
  double Loss = 0.0;           ///< the share of the points that are lost

  /// The mean square distance, if points that are lost have this one.
  double GetMeanSquare(double ofLost) const
  {
    return (1.0 - this->Loss) * this->RootMeanSquare * this->RootMeanSquare +
      this->Loss * ofLost * ofLost;
  }
};

/// Measures how far points of a surface lie from a mesh. Those that are farther away than `most`
/// are lost. Throws Aborted.
VTKCSLF_EXPORT SurfaceError MeasureError(const std::vector<glm::vec3>& points,
  const SurfaceMesh& mesh, double most, const Progress& progress);
}

#endif
