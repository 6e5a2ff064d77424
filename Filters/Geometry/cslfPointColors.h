// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours of the points of a mesh, as viewpoints of a field see them.
 */
#ifndef cslfPointColors_h
#define cslfPointColors_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfDepthViews.h"
#include "cslfSurfaceMesh.h"
#include "cslfViewpointSamples.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <glm/vec4.hpp>

#include <vector>

namespace cslf
{
/// Each point takes its colour from the viewpoint that sees it least obliquely.
class VTKCSLF_EXPORT PointColors
{
public:
  /// Chooses the viewpoints. The mesh is in mesh space. Both must outlive this object.
  PointColors(const DepthViews& views, const SurfaceMesh& mesh);

  /// Whether a point takes its colour from that view.
  bool IsNeeded(int view) const { return !this->PointsOf[view].empty(); }

  /// Reads the colours from a view. The samples may have another resolution than the depths.
  void Read(int view, int resolution, const ViewpointSamples& samples);

  /// The array `Color` for the points, of that type. Points that no viewpoint sees have colours of
  /// points next to them.
  vtkSmartPointer<vtkDataArray> MakeArray(int type);

private:
  const SurfaceMesh& Mesh;
  std::vector<StripPlace> Places;              ///< of the points
  std::vector<std::vector<unsigned>> PointsOf; ///< of each view
  std::vector<glm::vec4> Colors;               ///< as stored, with alpha
};
}

#endif
