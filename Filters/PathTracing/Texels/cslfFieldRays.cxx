// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldRays.h"

namespace cslf
{
RayGrid MakeFieldRays(
  const Layout& layout, const Cube& box, const SceneFrame& frame, int slice, int tile)
{
  const Viewpoint viewpoint = layout.ViewpointOf(slice);
  const int face = ExitFaceOf(viewpoint.Face, tile);
  const double step = 2.0 / layout.GetResolution();
  const glm::dvec3 from = layout.ViewpointPosition(viewpoint);
  const glm::dvec3 corner = FaceToCube(face, { -1.0, -1.0 });
  const auto toScene = [&](const glm::dvec3& vectorCC)
  { return frame.VectorToScene(box.VectorToWorld(vectorCC)); };
  RayGrid rays;
  rays.Origin = frame.PointToScene(box.PointToWorld(from));
  rays.Direction = toScene(corner - from);
  rays.DirectionX = toScene(FaceToCube(face, { -1.0 + step, -1.0 }) - corner);
  rays.DirectionY = toScene(FaceToCube(face, { -1.0, -1.0 + step }) - corner);
  return rays;
}

RayGrid MakeTexelRays(const RayGrid& tile, int x, int y, int cells)
{
  RayGrid rays = tile;
  rays.Origin += static_cast<double>(x) * tile.OriginX + static_cast<double>(y) * tile.OriginY;
  rays.Direction +=
    static_cast<double>(x) * tile.DirectionX + static_cast<double>(y) * tile.DirectionY;
  const double part = 1.0 / cells;
  rays.OriginX *= part;
  rays.OriginY *= part;
  rays.DirectionX *= part;
  rays.DirectionY *= part;
  return rays;
}
}
