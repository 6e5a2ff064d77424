// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewFrustum.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
/// From 0 to 7: a corner of a box.
glm::dvec3 CornerOf(const glm::dvec3& minimum, const glm::dvec3& maximum, int corner)
{
  return { corner & 1 ? maximum.x : minimum.x, corner & 2 ? maximum.y : minimum.y,
    corner & 4 ? maximum.z : minimum.z };
}
}

ViewFrustum::ViewFrustum(
  const DisplayRows& ccdc, const glm::dvec3& sceneMinimum, const glm::dvec3& sceneMaximum)
{
  this->FindEye(ccdc);
  this->FindGaze(ccdc);
  if (!this->IsInside())
  {
    this->Sides = { ccdc[3] + ccdc[0], ccdc[3] - ccdc[0], ccdc[3] + ccdc[1], ccdc[3] - ccdc[1] };
    this->AddSceneSides(sceneMinimum, sceneMaximum);
  }
}

// The eye is where all lines along the display's z axis meet; for a parallel projection, at
// infinity.
void ViewFrustum::FindEye(const DisplayRows& ccdc)
{
  const glm::dmat4 dccc =
    glm::inverse(glm::transpose(glm::dmat4(ccdc[0], ccdc[1], ccdc[2], ccdc[3])));
  const glm::dvec4 eye = dccc[2];
  const double length = glm::length(glm::dvec3(eye));
  this->Eye =
    std::abs(eye.w) > 1e-9 * length ? eye / eye.w : glm::dvec4(glm::dvec3(eye) / length, 0.0);
}

void ViewFrustum::FindGaze(const DisplayRows& ccdc)
{
  // The line on which both display coordinates are 0.
  const glm::dvec3 horizontal(ccdc[0]);
  const glm::dvec3 vertical(ccdc[1]);
  const glm::dvec3 along = glm::cross(horizontal, vertical);
  const glm::dvec3 point =
    -(ccdc[0].w * glm::cross(vertical, along) + ccdc[1].w * glm::cross(along, horizontal)) /
    glm::dot(along, along);
  const glm::dvec3 forward = this->Eye.w == 0.0 ? glm::dvec3(this->Eye) : glm::dvec3(ccdc[3]);
  auto ray = RayToCoordinates(point, glm::dot(along, forward) < 0.0 ? -along : along);
  if (!ray)
  {
    const glm::dvec3 eye(this->Eye);
    ray = RayToCoordinates(glm::dvec3(0.0), this->Eye.w == 0.0 ? eye : -eye);
  }
  this->Gaze = ray ? FaceToCube(ray->Entry.Face, ray->Entry.Coordinates) : glm::dvec3(0.0);
}

// The planes through the eye that touch the scene's box along an edge.
void ViewFrustum::AddSceneSides(const glm::dvec3& minimum, const glm::dvec3& maximum)
{
  const glm::dvec3 eye(this->Eye);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      if (corner & (1 << axis))
      {
        continue;
      }
      glm::dvec3 edge(0.0);
      edge[axis] = 1.0;
      const glm::dvec3 point = CornerOf(minimum, maximum, corner);
      const glm::dvec3 normal = glm::cross(edge, this->Eye.w == 0.0 ? eye : point - eye);
      double least = 0.0;
      double most = 0.0;
      for (int other = 0; other < 8; ++other)
      {
        const double height = glm::dot(normal, CornerOf(minimum, maximum, other) - point);
        least = std::min(least, height);
        most = std::max(most, height);
      }
      const double margin = 1e-9 * (most - least);
      if (least >= -margin && most > margin)
      {
        this->Sides.emplace_back(normal, -glm::dot(normal, point));
      }
      else if (most <= margin && least < -margin)
      {
        this->Sides.emplace_back(-normal, glm::dot(normal, point));
      }
    }
  }
}

bool ViewFrustum::IsInside() const
{
  return this->Eye.w != 0.0 && std::abs(this->Eye.x) < 1.0 && std::abs(this->Eye.y) < 1.0 &&
    std::abs(this->Eye.z) < 1.0;
}

bool ViewFrustum::CanEnter(int face) const
{
  const double along = FaceSign(face) * this->Eye[FaceAxis(face)];
  return this->Eye.w == 0.0 ? along < 0.0 : along >= 1.0 || this->IsInside();
}

bool ViewFrustum::CanLeave(int entryFace, int exitFace) const
{
  return entryFace != exitFace && (!this->CanEnter(exitFace) || this->IsInside());
}

bool ViewFrustum::PassesThrough(
  int face, const glm::dvec2& minimum, const glm::dvec2& maximum) const
{
  const glm::dvec3 least = FaceToCube(face, glm::max(minimum, -1.0));
  const glm::dvec3 most = FaceToCube(face, glm::min(maximum, 1.0));
  const glm::dvec4 middle(0.5 * (least + most), 1.0);
  const glm::dvec3 reach = 0.5 * glm::abs(most - least);
  return std::none_of(this->Sides.begin(), this->Sides.end(),
    [&](const glm::dvec4& side)
    { return glm::dot(side, middle) + glm::dot(glm::abs(glm::dvec3(side)), reach) < 0.0; });
}

bool ViewFrustum::operator==(const ViewFrustum& other) const
{
  return this->Eye == other.Eye && this->Gaze == other.Gaze && this->Sides == other.Sides;
}
}
