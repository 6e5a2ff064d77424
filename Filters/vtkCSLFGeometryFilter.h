// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFGeometryFilter
 * @brief   makes the geometry of a light field from its depth
 *
 * The sharpest lookup of vtkCSLFMapper needs a geometry: triangles that say where the surfaces are.
 * vtkCSLFSampler makes it from the scene. This filter makes it for fields that have only images:
 * folders of cube maps, old files, and fields of other programs. The input is a light field with
 * the channel `Depth`. The output has two ports, like that of vtkCSLFSampler and vtkCSLFDecoder:
 *
 * - Port 0 is the input, unchanged.
 * - Port 1 is the geometry, for vtkCSLFMapper and vtkCSLFEncoder: triangles in world coordinates.
 * Point scalars are `Color`, of the same type as that of the field, as the least oblique viewpoint
 * sees the front; `BackColor` is that of the back. Field data holds `GeometryError`, the root mean
 * square distance of the surfaces that the viewpoints see from the triangles, and `GeometryLoss`,
 * the share of them that is more than a texel away and does not count in the former. An empty field
 * has an empty geometry.
 *
 * The viewpoints are asked one after the other, from those in the middle of the cube's faces to
 * those between others: up to 9 x 9 on each face, or up to 16 x 16 if they are not nested. Each
 * adds triangles for what it sees and the triangles so far do not have, unless a later one sees it
 * much better. Outlines of surfaces are drawn back to where no viewpoint sees through them.
 * Triangles are removed by meshoptimizer as long as that moves the surface by at most a fifth of a
 * texel, and further, as in vtkCSLFSampler, if there are more than GeometryTriangles. Where
 * surfaces are small and many, a large GeometryLoss says that the depth lookup may be sharper;
 * above 0.2, the filter warns, and mappers use depth.
 *
 * The input is requested a few viewpoints at a time, twice: for depths, and for the colours of the
 * points. Apart from these slices, the filter needs at most about 1 GiB; depths of more than 256 x
 * 256 texels per tile are read at fewer places. Viewpoints that are missing are left out. The
 * result does not depend on the number of threads.
 *
 * Surfaces that are translucent have one depth only, so they become opaque in the geometry. Use the
 * depth lookup for such fields.
 *
 * @sa vtkCSLFSampler vtkCSLFMapper vtkCSLFEncoder
 */
#ifndef vtkCSLFGeometryFilter_h
#define vtkCSLFGeometryFilter_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

#include <vtkSmartPointer.h> // for the geometry

class vtkPolyData;

class VTKCSLF_EXPORT vtkCSLFGeometryFilter : public vtkImageAlgorithm
{
public:
  static vtkCSLFGeometryFilter* New();
  vtkTypeMacro(vtkCSLFGeometryFilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The most triangles of the geometry: from 0, which makes none, to 100000000. Default: 1000000.
   */
  void SetGeometryTriangles(int triangles);
  vtkGetMacro(GeometryTriangles, int);
  ///@}

  /**
   * The output of port 1. It is filled after Update(), which also passes the whole field on, or
   * Update(1), which pulls the field in parts. Requests for a part of the field do not make it.
   */
  vtkPolyData* GetGeometry();

  /**
   * Makes the geometry with the whole field or alone, because it takes much longer than a part of
   * the field.
   */
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkCSLFGeometryFilter();
  ~vtkCSLFGeometryFilter() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFGeometryFilter(const vtkCSLFGeometryFilter&) = delete;
  void operator=(const vtkCSLFGeometryFilter&) = delete;

  class Pass;

  int GeometryTriangles;
  vtkSmartPointer<vtkPolyData> Geometry; ///< made last
  vtkMTimeType GeometryTime = 0;         ///< of the pipeline when it was made
};

#endif
