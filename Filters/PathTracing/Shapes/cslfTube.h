// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The shape of a tube: the union of spheres along a line whose radius changes linearly.
 */
#ifndef cslfTube_h
#define cslfTube_h

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

#include "cslfMesh.h"
#include "vtkCSLFModule.h" // for export macro

namespace cslf
{
/// Divides each tube that is longer than 32 of its radii into shorter ones that together have its
/// shape and its values. Embree computes in floats, so its error grows with the square of this
/// ratio. At 600 it is several percent of the radius, and sampled points of a lamp lie so deep
/// below the traced surface that the lamp hides them. A mesh gets at most 2^20 more tubes. If these
/// are not enough, the tubes stay longer.
VTKCSLF_EXPORT void DivideLongTubes(Mesh& mesh);

struct Tube
{
  glm::vec3 Start;
  glm::vec3 Axis{ 0.0f, 0.0f, 1.0f }; ///< of unit length
  float Length = 0.0f;                ///< between the centres of the two ends; 0 for a sphere
  float Radius;                       ///< at the start
  float Slope = 0.0f;                 ///< change of the radius per length, in (-1,1)
  float OnlyEnd = 0.0f;               ///< of a sphere: the number of its end, 0 or 1

  /// Whether another tube continues this one at its start and end: see Mesh::Joints.
  bool Joints[2] = { false, false };

  /// If one end contains the other, the tube is the larger sphere.
  Tube(const glm::vec3& start, const glm::vec3& end, float startRadius, float endRadius)
    : Start(start)
    , Radius(startRadius)
  {
    const glm::vec3 path = end - start;
    const float length = glm::length(path);
    const float growth = endRadius - startRadius;
    if (length > std::abs(growth))
    {
      this->Axis = path / length;
      this->Length = length;
      this->Slope = growth / length;
    }
    else if (growth > 0.0f)
    {
      this->Start = end;
      this->Radius = endRadius;
      this->OnlyEnd = 1.0f;
    }
  }

  bool IsSphere() const { return this->Length == 0.0f; }

  glm::vec3 GetCenter(float along) const
  {
    return this->IsSphere() ? this->Start : this->Start + along * this->Length * this->Axis;
  }

  float GetRadius(float along) const { return this->Radius + along * this->Slope * this->Length; }

  /// Whether one of the spheres that make the tube contains a point.
  bool Contains(const glm::vec3& point) const
  {
    const glm::vec3 path = point - this->Start;
    const float height = glm::dot(path, this->Axis);
    const float across = glm::length(path - height * this->Axis);
    const float lean = this->Slope / std::sqrt(1.0f - this->Slope * this->Slope);
    const float along =
      this->IsSphere() ? 0.0f : std::clamp((height + lean * across) / this->Length, 0.0f, 1.0f);
    return glm::distance(point, this->GetCenter(along)) <= this->GetRadius(along);
  }

  /// Whether a result of FindAlong is on a round end that is a surface.
  bool IsOnEnd(float along) const
  {
    return along <= 0.0f ? !this->Joints[0] : along >= 1.0f && !this->Joints[1];
  }

  /// The sphere that touches the surface at one of its points, numbered from 0 at the start to 1 at
  /// the end. Below 0 and above 1 the point is on a round end.
  float FindAlong(const glm::vec3& point) const
  {
    if (this->IsSphere())
    {
      return this->OnlyEnd;
    }
    const float height = glm::dot(point - this->Start, this->Axis);
    return (height + this->Slope * this->Radius) /
      ((1.0f - this->Slope * this->Slope) * this->Length);
  }
};
}

#endif
