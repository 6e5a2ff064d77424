// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBalls.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "cslfBallFS.h"
#include "cslfBallVS.h"
#include "cslfOpenGL.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLIndexBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkPolyData.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace cslf
{
namespace
{
/// How much a matrix may differ from that of a sphere, as a share of its radius: files round.
constexpr double MaximumSkew = 0.02;

/// A square has this many texels for each point of the prototype, so that its colours stay apart.
constexpr double TexelsPerPoint = 1.5;

/// The largest side of the image of a group: OpenGL 3.2 has no more for sure.
constexpr int MaximumImage = 8192;

/// The direction of a place in an octahedral map, from -1 to 1. Beyond its edges the map goes on
/// as on the sphere.
glm::dvec3 GetDirection(double x, double y)
{
  for (int axis = 0; axis < 2; ++axis)
  {
    if (std::abs(x) > 1.0)
    {
      x = std::copysign(2.0, x) - x;
      y = -y;
    }
    std::swap(x, y);
  }
  glm::dvec3 direction(x, y, 1.0 - std::abs(x) - std::abs(y));
  if (direction.z < 0.0)
  {
    direction.x = std::copysign(1.0 - std::abs(y), x);
    direction.y = std::copysign(1.0 - std::abs(x), y);
  }
  return glm::normalize(direction);
}

/// A colour between three points of a prototype.
struct Blend
{
  std::array<std::uint32_t, 3> Points{};
  std::array<float, 3> Weights{};
};

/// Which triangle a direction from the origin meets, and where.
Blend FindBlend(const std::vector<glm::dvec3>& points, const std::uint32_t* corners,
  std::size_t triangles, const glm::dvec3& direction)
{
  Blend best;
  double bestInside = -2.0;
  for (std::size_t i = 0; i < triangles; ++i)
  {
    const std::uint32_t* at = corners + 3 * i;
    const glm::dmat3 edges(points[at[0]], points[at[1]], points[at[2]]);
    glm::dvec3 weights = glm::inverse(edges) * direction;
    const double sum = weights.x + weights.y + weights.z;
    weights /= sum;
    const double inside = std::min({ weights.x, weights.y, weights.z });
    if (sum > 0.0 && inside > bestInside)
    {
      bestInside = inside;
      best = { { at[0], at[1], at[2] },
        { static_cast<float>(weights.x), static_cast<float>(weights.y),
          static_cast<float>(weights.z) } };
    }
  }
  return best;
}

std::uint32_t PackColor(const glm::vec4& color)
{
  const glm::vec4 steps = glm::round(255.0f * glm::clamp(color, 0.0f, 1.0f));
  return static_cast<std::uint32_t>(steps.x) | static_cast<std::uint32_t>(steps.y) << 8U |
    static_cast<std::uint32_t>(steps.z) << 16U | 0xff000000U;
}

/// Bodies of one prototype, and where their points and triangles begin in the geometry.
struct Bodies
{
  std::vector<glm::dvec3> Prototype;
  std::size_t Triangles = 0;
  std::size_t Count = 0;
  std::size_t FirstPoint = 0;
  std::size_t FirstTriangle = 0;
  vtkIdType FirstPlacement = 0;
  bool AreBalls = false;
};

/// The groups of bodies of a geometry; none if its arrays do not fit.
std::vector<Bodies> ListBodies(vtkPolyData* geometry, std::size_t points, std::size_t triangles)
{
  vtkFieldData* fields = geometry->GetFieldData();
  vtkDataArray* sizes = fields->GetArray(GeometryGroupsName);
  vtkDataArray* prototypes = fields->GetArray(GeometryPrototypesName);
  vtkDataArray* placements = fields->GetArray(GeometryPlacementsName);
  if (!sizes || !prototypes || !placements || sizes->GetNumberOfComponents() != 4 ||
    prototypes->GetNumberOfComponents() != 3 || placements->GetNumberOfComponents() != 12)
  {
    return {};
  }
  std::vector<Bodies> all;
  vtkIdType prototype = 0;
  vtkIdType placement = 0;
  double allPoints = 0.0;
  double allTriangles = 0.0;
  for (vtkIdType i = 0; i < sizes->GetNumberOfTuples(); ++i)
  {
    double size[4];
    sizes->GetTuple(i, size);
    allPoints += size[0] * size[2];
    allTriangles += size[1] * size[2];
    if (!(std::min({ size[0], size[1], size[2] }) >= 1.0) ||
      !(size[0] <= static_cast<double>(prototypes->GetNumberOfTuples() - prototype)) ||
      !(size[2] <= static_cast<double>(placements->GetNumberOfTuples() - placement)) ||
      !(allPoints <= static_cast<double>(points)) ||
      !(allTriangles <= static_cast<double>(triangles)))
    {
      return {};
    }
    Bodies bodies;
    bodies.Prototype.resize(static_cast<std::size_t>(size[0]));
    for (glm::dvec3& point : bodies.Prototype)
    {
      prototypes->GetTuple(prototype++, &point.x);
    }
    bodies.Triangles = static_cast<std::size_t>(size[1]);
    bodies.Count = static_cast<std::size_t>(size[2]);
    bodies.FirstPlacement = placement;
    bodies.AreBalls = size[3] != 0.0;
    placement += static_cast<vtkIdType>(bodies.Count);
    all.push_back(std::move(bodies));
  }
  std::size_t point = points - static_cast<std::size_t>(allPoints);
  std::size_t triangle = triangles - static_cast<std::size_t>(allTriangles);
  for (Bodies& bodies : all)
  {
    bodies.FirstPoint = point;
    bodies.FirstTriangle = triangle;
    point += bodies.Prototype.size() * bodies.Count;
    triangle += bodies.Triangles * bodies.Count;
  }
  return all;
}

/// The spheres of balls. None if any is none, or if triangles and colours are not those of spheres.
std::vector<glm::vec4> ListSpheres(
  vtkPolyData* geometry, const Bodies& bodies, const Cube& box, const glm::dvec3& scale)
{
  vtkDataArray* placements = geometry->GetFieldData()->GetArray(GeometryPlacementsName);
  std::vector<glm::vec4> spheres;
  for (std::size_t body = 0; body < bodies.Count; ++body)
  {
    double matrix[12];
    placements->GetTuple(bodies.FirstPlacement + static_cast<vtkIdType>(body), matrix);
    const double radius = (matrix[0] + matrix[5] + matrix[10]) / 3.0;
    double skew = 0.0;
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        const double expected = row == column ? radius : 0.0;
        skew = std::max(skew, std::abs(matrix[4 * row + column] - expected));
      }
    }
    const glm::dvec3 center = scale * box.PointToCube({ matrix[3], matrix[7], matrix[11] });
    if (!(radius > 0.0 && skew <= MaximumSkew * radius))
    {
      return {};
    }
    spheres.emplace_back(center.x, center.y, center.z, radius);
  }
  return spheres;
}

/// The image of a group, if it is not too large.
bool PaintSquares(const Bodies& bodies, const std::vector<std::uint32_t>& corners,
  const std::vector<glm::vec4>& colors, BallGroup& group)
{
  const double texels = TexelsPerPoint * static_cast<double>(bodies.Prototype.size());
  group.Side = static_cast<int>(std::ceil(std::sqrt(texels)));
  const int side = group.Side + 2;
  const auto count = static_cast<int>(std::min<std::size_t>(bodies.Count, MaximumImage * 1024));
  group.SquaresPerRow = std::min(
    MaximumImage / side, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
  group.Rows = (count + group.SquaresPerRow - 1) / group.SquaresPerRow;
  if (group.Rows * side > MaximumImage)
  {
    return false;
  }
  std::vector<std::uint32_t> triangles(3 * bodies.Triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    triangles[i] =
      corners[3 * bodies.FirstTriangle + i] - static_cast<std::uint32_t>(bodies.FirstPoint);
    if (triangles[i] >= bodies.Prototype.size())
    {
      return false;
    }
  }
  std::vector<Blend> blends;
  for (int y = 0; y < side; ++y)
  {
    for (int x = 0; x < side; ++x)
    {
      blends.push_back(FindBlend(bodies.Prototype, triangles.data(), bodies.Triangles,
        GetDirection((2.0 * x - 1.0) / group.Side - 1.0, (2.0 * y - 1.0) / group.Side - 1.0)));
    }
  }
  const std::size_t width = static_cast<std::size_t>(group.SquaresPerRow) * side;
  group.Texels.assign(width * group.Rows * side, 0U);
  for (std::size_t body = 0; body < bodies.Count; ++body)
  {
    const glm::vec4* own = colors.data() + bodies.FirstPoint + body * bodies.Prototype.size();
    const std::size_t first =
      body / group.SquaresPerRow * side * width + body % group.SquaresPerRow * side;
    for (std::size_t i = 0; i < blends.size(); ++i)
    {
      const Blend& blend = blends[i];
      const glm::vec4 color = blend.Weights[0] * own[blend.Points[0]] +
        blend.Weights[1] * own[blend.Points[1]] + blend.Weights[2] * own[blend.Points[2]];
      group.Texels[first + i / side * width + i % side] = PackColor(color);
    }
  }
  return true;
}
}

std::size_t Balls::Count() const
{
  return std::accumulate(this->Groups.begin(), this->Groups.end(), std::size_t(0),
    [](std::size_t sum, const BallGroup& group) { return sum + group.Spheres.size(); });
}

Balls FindBalls(vtkPolyData* geometry, const Cube& box, const std::vector<std::uint32_t>& corners,
  const std::vector<glm::vec4>& colors)
{
  Balls balls;
  balls.AreTriangles.assign(corners.size() / 3, false);
  const glm::dvec3 scale = 0.5 * glm::dvec3(box.Edges[0], box.Edges[1], box.Edges[2]);
  for (const Bodies& bodies : ListBodies(geometry, colors.size(), corners.size() / 3))
  {
    const auto first = colors.begin() + static_cast<std::ptrdiff_t>(bodies.FirstPoint);
    const bool areBright = std::any_of(first,
      first + static_cast<std::ptrdiff_t>(bodies.Prototype.size() * bodies.Count),
      [](const glm::vec4& color) {
        return std::max({ color.x, color.y, color.z }) > 1.0f;
      });
    if (!bodies.AreBalls || areBright)
    {
      continue;
    }
    BallGroup group;
    group.Scale = scale;
    group.Spheres = ListSpheres(geometry, bodies, box, scale);
    if (group.Spheres.empty() || !PaintSquares(bodies, corners, colors, group))
    {
      continue;
    }
    std::fill_n(balls.AreTriangles.begin() + static_cast<std::ptrdiff_t>(bodies.FirstTriangle),
      bodies.Triangles * bodies.Count, true);
    balls.Groups.push_back(std::move(group));
  }
  return balls;
}

struct BallPicture::Group
{
  glm::vec3 Scale{ 1.0f };
  int Side = 0;
  int SquaresPerRow = 0;
  vtkNew<vtkTextureObject> Colors;
  vtkNew<vtkOpenGLBufferObject> Spheres; ///< four times each, for the corners of a square
  vtkOpenGLHelper Squares;

  void Upload(vtkOpenGLRenderWindow* window, const BallGroup& group);
  void Draw(vtkOpenGLRenderWindow* window, const DisplayRows& ccdc, const glm::dvec4& eyeCC);
  void Release(vtkWindow* window);
};

BallPicture::BallPicture() = default;

BallPicture::~BallPicture() = default;

void BallPicture::Group::Upload(vtkOpenGLRenderWindow* window, const BallGroup& group)
{
  this->Scale = group.Scale;
  this->Side = group.Side;
  this->SquaresPerRow = group.SquaresPerRow;
  std::vector<glm::vec4> corners;
  std::vector<unsigned int> triangles;
  for (const glm::vec4& sphere : group.Spheres)
  {
    const auto first = static_cast<unsigned int>(corners.size());
    corners.insert(corners.end(), 4, sphere);
    triangles.insert(
      triangles.end(), { first, first + 1, first + 2, first + 2, first + 1, first + 3 });
  }
  this->Spheres->Upload(&corners.front().x, 4 * corners.size(), vtkOpenGLBufferObject::ArrayBuffer);
  this->Squares.IBO->Upload(triangles, vtkOpenGLBufferObject::ElementArrayBuffer);
  this->Squares.IBO->IndexCount = triangles.size();
  const auto side = static_cast<unsigned int>(group.Side + 2);
  this->Colors->SetContext(window);
  this->Colors->SetMinificationFilter(vtkTextureObject::Linear);
  this->Colors->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Colors->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Colors->SetWrapT(vtkTextureObject::ClampToEdge);
  std::vector<std::uint32_t> texels = group.Texels;
  this->Colors->Create2DFromRaw(static_cast<unsigned int>(group.SquaresPerRow) * side,
    static_cast<unsigned int>(group.Rows) * side, 4, VTK_UNSIGNED_CHAR, texels.data());
  this->Squares.Program = window->GetShaderCache()->ReadyShaderProgram(cslfBallVS, cslfBallFS, "");
  this->Squares.VAO->Bind();
  this->Spheres->Bind();
  this->Squares.VAO->AddAttributeArray(
    this->Squares.Program, this->Spheres, "sphere", 0, 4 * sizeof(float), VTK_FLOAT, 4, false);
}

void BallPicture::Group::Draw(
  vtkOpenGLRenderWindow* window, const DisplayRows& ccdc, const glm::dvec4& eyeCC)
{
  vtkShaderProgram* program = this->Squares.Program;
  window->GetShaderCache()->ReadyShaderProgram(program);
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      // GLSL's matrices are stored by columns.
      matrix->SetElement(
        column, row, ccdc[row][column] / (column < 3 ? this->Scale[column] : 1.0f));
    }
  }
  program->SetUniformMatrix("BCDCMatrix", matrix);
  const glm::vec4 eye(glm::dvec3(eyeCC) * glm::dvec3(this->Scale), eyeCC.w);
  program->SetUniform4f("EyeBC", &eye.x);
  program->SetUniformi("Side", this->Side);
  program->SetUniformi("SquaresPerRow", this->SquaresPerRow);
  this->Colors->Activate();
  program->SetUniformi("Colors", this->Colors->GetTextureUnit());
  this->Squares.VAO->Bind();
  this->Squares.IBO->Bind();
  glDrawElements(
    GL_TRIANGLES, static_cast<GLsizei>(this->Squares.IBO->IndexCount), GL_UNSIGNED_INT, nullptr);
  this->Squares.IBO->Release();
  this->Squares.VAO->Release();
  this->Colors->Deactivate();
}

void BallPicture::Group::Release(vtkWindow* window)
{
  this->Colors->ReleaseGraphicsResources(window);
  this->Spheres->ReleaseGraphicsResources();
  this->Squares.ReleaseGraphicsResources(window);
}

void BallPicture::Upload(vtkOpenGLRenderWindow* window, const Balls& balls)
{
  this->Release(window);
  for (const BallGroup& group : balls.Groups)
  {
    this->Groups.push_back(std::make_unique<Group>());
    this->Groups.back()->Upload(window, group);
  }
}

void BallPicture::Draw(
  vtkOpenGLRenderWindow* window, const DisplayRows& ccdc, const glm::dvec4& eyeCC)
{
  // Squares reach farther than their balls.
  const bool clampsDepth = glIsEnabled(GL_DEPTH_CLAMP) == GL_TRUE;
  glEnable(GL_DEPTH_CLAMP);
  for (const auto& group : this->Groups)
  {
    group->Draw(window, ccdc, eyeCC);
  }
  if (!clampsDepth)
  {
    glDisable(GL_DEPTH_CLAMP);
  }
}

void BallPicture::Release(vtkWindow* window)
{
  for (const auto& group : this->Groups)
  {
    group->Release(window);
  }
  this->Groups.clear();
}
}
