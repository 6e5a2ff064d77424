// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parts of a cube's surface through which the lines of sight of a camera can enter and leave.
 */
#ifndef cslfViewFrustum_h
#define cslfViewFrustum_h

#include "cslfCube.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace cslf
{
/// The rows of a matrix from CC to display coordinates.
using DisplayRows = std::array<glm::dvec4, 4>;

/// A camera's view of a cube. From outside at most three faces are visible, through which lines of
/// sight enter; all of them leave through the other faces. From inside, all faces are both.
class VTKCSLF_EXPORT ViewFrustum
{
public:
  ViewFrustum() = default;

  /// The eye and the sides of the picture follow from the matrix. `sceneMinimum` and `sceneMaximum`
  /// are the bounds of the scene in CC.
  ViewFrustum(
    const DisplayRows& ccdc, const glm::dvec3& sceneMinimum, const glm::dvec3& sceneMaximum);

  /// w = 1: the eye; w = 0: the direction of a parallel projection. In CC.
  const glm::dvec4& GetEye() const { return this->Eye; }

  bool IsInside() const;

  /// Whether lines of sight can enter through a face.
  bool CanEnter(int face) const;

  /// Whether lines of sight that enter through a face can leave through another.
  bool CanLeave(int entryFace, int exitFace) const;

  /// Whether any line of sight of the picture that may meet the scene passes through this part of a
  /// face. It may be true if none does, but it is never false if one does.
  bool PassesThrough(int face, const glm::dvec2& minimum, const glm::dvec2& maximum) const;

  /// The point where the line of sight of the picture's middle enters the cube or, if it misses the
  /// cube, that of the cube's centre.
  const glm::dvec3& GetGaze() const { return this->Gaze; }

  bool operator==(const ViewFrustum& other) const;
  bool operator!=(const ViewFrustum& other) const { return !(*this == other); }

private:
  void FindEye(const DisplayRows& ccdc);
  void FindGaze(const DisplayRows& ccdc);
  void AddSceneSides(const glm::dvec3& minimum, const glm::dvec3& maximum);

  glm::dvec4 Eye{ 0.0, 0.0, 0.0, 1.0 };
  glm::dvec3 Gaze{ 0.0 };
  std::vector<glm::dvec4> Sides; ///< planes, positive where lines of sight may pass
};
}

#endif
