// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The balls of a geometry, drawn as spheres instead of their triangles.
 */
#ifndef cslfBalls_h
#define cslfBalls_h

#include "cslfCube.h"
#include "cslfViewFrustum.h"

#include <vtkNew.h>
#include <vtkOpenGLHelper.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkPolyData;
class vtkTextureObject;
class vtkWindow;

namespace cslf
{
/// Spheres with the colours that they have in all directions, in squares of an image: octahedral
/// maps (Praun, Hoppe, "Spherical Parametrization and Remeshing", 2003) within a rim of one texel.
struct BallGroup
{
  glm::vec3 Scale{ 1.0f }; ///< half of the cube's edges, that make cube coordinates world-like
  std::vector<glm::vec4> Spheres; ///< centre, in cube coordinates times Scale, and radius in world
  int Side = 0;                   ///< of a square without rim
  int SquaresPerRow = 0;
  int Rows = 0;
  std::vector<std::uint32_t> Texels; ///< red, green, blue, 255, row by row
};

/// The groups of a geometry whose bodies are balls of one colour on both sides, and which triangles
/// these have: the last ones of the geometry come last. Colours, of points, are exact.
struct Balls
{
  std::vector<BallGroup> Groups;
  std::vector<bool> AreTriangles; ///< of each triangle, whether a ball replaces it

  std::size_t Count() const;
};

/// `corners` are those of the geometry's triangles in the order of its polygons.
Balls FindBalls(vtkPolyData* geometry, const Cube& box, const std::vector<std::uint32_t>& corners,
  const std::vector<glm::vec4>& colors);

/// Draws the balls of one geometry. Belongs to one render window's context at a time.
class BallPicture
{
public:
  BallPicture();
  ~BallPicture();
  BallPicture(const BallPicture&) = delete;
  BallPicture& operator=(const BallPicture&) = delete;

  /// Uploads balls in place of others.
  void Upload(vtkOpenGLRenderWindow* window, const Balls& balls);

  /// Draws colours and depths, z in DC, of a view from cube coordinates. The eye (w = 1), or the
  /// direction of a parallel projection (w = 0), must be outside of all balls.
  void Draw(vtkOpenGLRenderWindow* window, const DisplayRows& ccdc, const glm::dvec4& eyeCC);

  /// Frees everything. The window's context must be current.
  void Release(vtkWindow* window);

private:
  struct Group;

  std::vector<std::unique_ptr<Group>> Groups;
};
}

#endif
