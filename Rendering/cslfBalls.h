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

#include <array>
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
struct MappedPoints;
class ShownMaps;

/// A place between three points of a prototype.
struct PointBlend
{
  std::array<std::uint32_t, 3> Points{};
  std::array<float, 3> Weights{};

  template <typename Value>
  Value Mix(const Value* values) const
  {
    return this->Weights[0] * values[this->Points[0]] + this->Weights[1] * values[this->Points[1]] +
      this->Weights[2] * values[this->Points[2]];
  }
};

/// The colours of a geometry's points, as GeometryMesh has them, and the maps of those that have
/// any.
struct PointColors
{
  const std::vector<glm::vec4>& Colors;
  const MappedPoints& Mapped;
  const ShownMaps* Maps; ///< null without mapped points
};

/// Spheres with the colours that they have in all directions, in squares of an image: octahedral
/// maps (Praun, Hoppe, "Spherical Parametrization and Remeshing", 2003) within a rim of one texel.
struct BallGroup
{
  glm::vec3 Scale{ 1.0f }; ///< half of the cube's edges, that make cube coordinates world-like
  /// Centre, in cube coordinates times Scale, and radius in world. In random order, so that the
  /// first ones can stand for all.
  std::vector<glm::vec4> Spheres;
  int Side = 0; ///< of a square without rim
  int SquaresPerRow = 0;
  int Rows = 0;
  std::vector<PointBlend> Texels;  ///< of a square with its rim, row by row
  std::vector<std::size_t> Points; ///< of each sphere, the first of the geometry's
  std::size_t PrototypePoints = 0; ///< that it has there
};

/// The groups of a geometry whose bodies are balls, and which triangles these have. Their front is
/// outside.
struct Balls
{
  std::vector<BallGroup> Groups;
  std::vector<bool> AreTriangles; ///< of each triangle, whether a ball replaces it

  /// How many are drawn of a group with fewer of them: half of them at each level, as long as these
  /// are many. They are larger, so that all are as wide together.
  static std::size_t CountAtLevel(const BallGroup& group, std::size_t level);
  std::size_t CountAtLevel(std::size_t level) const;

  /// The number of levels below the finest.
  std::size_t CountLevels() const;
};

/// The triangles of a geometry, in the order of its polygons.
struct MeshView
{
  const std::vector<glm::vec3>& PointsCC;
  const std::vector<std::uint32_t>& Corners;
  const std::vector<glm::vec4>& Colors; ///< of points: exact, and of 8 bits
};

Balls FindBalls(vtkPolyData* geometry, const Cube& box, const MeshView& mesh);

/// Draws the balls of one geometry. Belongs to one render window's context at a time.
class BallPicture
{
public:
  BallPicture();
  ~BallPicture();
  BallPicture(const BallPicture&) = delete;
  BallPicture& operator=(const BallPicture&) = delete;

  /// Uploads balls in place of others. They need colours then.
  void Upload(vtkOpenGLRenderWindow* window, const Balls& balls);

  /// Uploads the colours of these balls, or other ones.
  void Paint(const Balls& balls, const PointColors& colors);

  /// Draws colours and depths, z in DC, of a view from cube coordinates. The eye (w = 1), or the
  /// direction of a parallel projection (w = 0), must be outside of all balls.
  void Draw(vtkOpenGLRenderWindow* window, const DisplayRows& ccdc, const glm::dvec4& eyeCC,
    std::size_t level);

  /// Frees everything. The window's context must be current.
  void Release(vtkWindow* window);

private:
  struct Group;

  std::vector<std::unique_ptr<Group>> Groups;
};
}

#endif
