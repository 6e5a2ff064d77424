// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBalls.h"

#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfParallelFor.h"
#include "cslfBallFS.h"
#include "cslfBallVS.h"
#include "cslfColor.h"
#include "cslfOpenGL.h"
#include "cslfShownMaps.h"

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
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace cslf
{
namespace
{
/// How much a matrix may differ from that of a sphere, and points from where it takes the
/// prototype's, as a share of the radius: files round, and the smallest balls have few steps.
constexpr double MaximumSkew = 0.1;

/// Groups of fewer bodies, or with larger prototypes, are drawn as triangles.
constexpr std::size_t MinimumBalls = 32;
constexpr std::size_t MaximumPrototype = 1024; // points or triangles

/// A square has this many texels for each point of the prototype, so that its colours stay apart.
constexpr double TexelsPerPoint = 1.5;

/// Fewer spheres are not drawn by fewer ones: see MeshLevels.
constexpr std::size_t MinimumSpheres = 10000;

/// The largest side of the image of a group. All drivers in use allow it.
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

/// Which triangle a direction from the origin meets, and where.
PointBlend FindBlend(const std::vector<glm::dvec3>& points, const std::uint32_t* corners,
  std::size_t triangles, const glm::dvec3& direction)
{
  PointBlend best;
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

/// The bodies of a group in an order that does not depend on where they are.
std::vector<std::size_t> Shuffle(std::size_t count)
{
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), std::mt19937());
  return order;
}

/// Whether the points and triangles of a body are those of its prototype, at its place: whoever
/// changes a geometry may leave its field data as it was.
bool IsAt(const BodyGroupData& bodies, std::size_t body, double radius, const Cube& box,
  const MeshView& mesh)
{
  const std::array<double, 12>& matrix = bodies.Matrices[body];
  const std::size_t points = bodies.Prototype.size();
  const glm::dvec3 step = 2.0 * MaximumSkew * radius / box.Edges;
  for (std::size_t i = 0; i < points; ++i)
  {
    const glm::dvec3& from = bodies.Prototype[i];
    glm::dvec3 to;
    for (int row = 0; row < 3; ++row)
    {
      const double* numbers = matrix.data() + 4 * row;
      to[row] = numbers[0] * from.x + numbers[1] * from.y + numbers[2] * from.z + numbers[3];
    }
    const glm::dvec3 expected = glm::clamp(box.PointToCube(to), glm::dvec3(-1.0), glm::dvec3(1.0));
    const glm::dvec3 found(mesh.PointsCC[bodies.FirstPoint + body * points + i]);
    const glm::dvec3 away = glm::abs(found - expected);
    if (!(away.x <= step.x && away.y <= step.y && away.z <= step.z))
    {
      return false;
    }
  }
  const std::size_t corners = 3 * bodies.Triangles;
  const std::uint32_t* first = mesh.Corners.data() + 3 * bodies.FirstTriangle;
  const std::uint32_t* own = first + body * corners;
  const auto shift = static_cast<std::uint32_t>(body * points);
  return std::equal(own, own + corners, first,
    [shift](std::uint32_t corner, std::uint32_t same) { return corner == same + shift; });
}

/// The spheres of balls. None if any is none, or is not where its triangles are.
std::vector<glm::vec4> ListSpheres(const BodyGroupData& bodies,
  const std::vector<std::size_t>& order, const Cube& box, const glm::dvec3& scale,
  const MeshView& mesh)
{
  std::vector<glm::vec4> spheres;
  for (const std::size_t body : order)
  {
    const std::array<double, 12>& matrix = bodies.Matrices[body];
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
    const bool isSphere = std::isfinite(radius) && radius > 0.0 && skew <= MaximumSkew * radius;
    if (!isSphere || !IsAt(bodies, body, radius, box, mesh))
    {
      return {};
    }
    spheres.emplace_back(center.x, center.y, center.z, radius);
  }
  return spheres;
}

/// Lays out the image of a group, if it is not too large.
bool LayOutSquares(const BodyGroupData& bodies, const std::vector<std::size_t>& order,
  const std::vector<std::uint32_t>& corners, BallGroup& group)
{
  const double texels = TexelsPerPoint * static_cast<double>(bodies.Prototype.size());
  group.Side = static_cast<int>(std::ceil(std::sqrt(texels)));
  const int side = group.Side + 2;
  const auto count =
    static_cast<int>(std::min<std::size_t>(bodies.Matrices.size(), MaximumImage * 1024));
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
  for (int y = 0; y < side; ++y)
  {
    for (int x = 0; x < side; ++x)
    {
      group.Texels.push_back(FindBlend(bodies.Prototype, triangles.data(), bodies.Triangles,
        GetDirection((2.0 * x - 1.0) / group.Side - 1.0, (2.0 * y - 1.0) / group.Side - 1.0)));
    }
  }
  group.PrototypePoints = bodies.Prototype.size();
  for (const std::size_t body : order)
  {
    group.Points.push_back(bodies.FirstPoint + body * group.PrototypePoints);
  }
  return true;
}

/// The light of a code from 0 to 1, by a table.
class LightDecoder
{
public:
  LightDecoder()
  {
    for (std::size_t i = 0; i < this->Table.size(); ++i)
    {
      this->Table[i] = static_cast<float>(SRGBToLinear(static_cast<double>(i) / Steps));
    }
  }

  float Decode(float code) const
  {
    const float place = Steps * std::clamp(code, 0.0f, 1.0f);
    const auto below = std::min(static_cast<std::size_t>(place), this->Table.size() - 2);
    const float weight = place - static_cast<float>(below);
    return (1.0f - weight) * this->Table[below] + weight * this->Table[below + 1];
  }

private:
  static constexpr int Steps = 1024;
  std::array<float, Steps + 1> Table{};
};

/// The light that a surface with a base colour reflects, as PackColor packs it. Brighter light than
/// 1 does not occur here, see FindBalls.
std::uint32_t PackLight(const glm::vec4& code, const glm::vec3& base)
{
  static const LightDecoder decoder;
  static const ByteEncoder encoder;
  std::uint32_t packed = 0xff000000U;
  for (int c = 0; c < 3; ++c)
  {
    packed |= std::uint32_t(encoder.Encode(decoder.Decode(code[c]) * base[c])) << (8 * c);
  }
  return packed;
}

/// The image of a group: red, green, blue, 255, row by row.
std::vector<std::uint32_t> PaintSquares(const BallGroup& group, const PointColors& colors)
{
  const auto side = static_cast<std::size_t>(group.Side) + 2;
  const auto perRow = static_cast<std::size_t>(group.SquaresPerRow);
  const std::size_t width = perRow * side;
  std::vector<std::uint32_t> image(width * static_cast<std::size_t>(group.Rows) * side, 0U);
  const auto paint = [&](std::size_t square)
  {
    const std::size_t point = group.Points[square];
    const glm::vec4* own = colors.Colors.data() + point;
    const std::size_t first = square / perRow * side * width + square % perRow * side;
    std::vector<glm::vec2> places;
    for (std::size_t i = point; colors.Maps && i < point + group.PrototypePoints; ++i)
    {
      places.push_back(colors.Maps->GetPlace(colors.Mapped, i));
    }
    for (std::size_t i = 0; i < group.Texels.size(); ++i)
    {
      const PointBlend& blend = group.Texels[i];
      const std::size_t corner = point + blend.Points[0];
      const glm::vec4 color = blend.Mix(own);
      image[first + i / side * width + i % side] = colors.Maps && colors.Mapped.Has(corner)
        ? PackLight(color,
            colors.Maps->GetColor(
              colors.Mapped.Numbers[corner] - std::size_t(1), blend.Mix(places.data())))
        : PackColor(color);
    }
  };
  ParallelFor(0, static_cast<vtkIdType>(group.Points.size()), 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType square = begin; square < end; ++square)
      {
        paint(static_cast<std::size_t>(square));
      }
    });
  return image;
}
}

std::size_t Balls::CountAtLevel(const BallGroup& group, std::size_t level)
{
  std::size_t count = group.Spheres.size();
  for (; level > 0 && count > MinimumSpheres; --level)
  {
    count /= 2;
  }
  return count;
}

std::size_t Balls::CountAtLevel(std::size_t level) const
{
  return std::accumulate(this->Groups.begin(), this->Groups.end(), std::size_t(0),
    [level](std::size_t sum, const BallGroup& group) { return sum + CountAtLevel(group, level); });
}

std::size_t Balls::CountLevels() const
{
  std::size_t level = 0;
  while (this->CountAtLevel(level + 1) < this->CountAtLevel(level))
  {
    ++level;
  }
  return level;
}

Balls FindBalls(vtkPolyData* geometry, const Cube& box, const MeshView& mesh)
{
  const std::vector<std::uint32_t>& corners = mesh.Corners;
  const std::vector<glm::vec4>& colors = mesh.Colors;
  Balls balls;
  balls.AreTriangles.assign(corners.size() / 3, false);
  const glm::dvec3 scale = 0.5 * box.Edges;
  for (const BodyGroupData& bodies : ListBodyGroups(geometry, colors.size(), corners.size() / 3))
  {
    if (!bodies.AreBalls || bodies.Matrices.size() < MinimumBalls ||
      std::max(bodies.Prototype.size(), bodies.Triangles) > MaximumPrototype)
    {
      continue;
    }
    const auto first = colors.begin() + static_cast<std::ptrdiff_t>(bodies.FirstPoint);
    const bool areBright = std::any_of(first,
      first + static_cast<std::ptrdiff_t>(bodies.Prototype.size() * bodies.Matrices.size()),
      [](const glm::vec4& color) {
        return std::max({ color.x, color.y, color.z }) > 1.0f;
      });
    if (areBright)
    {
      continue;
    }
    BallGroup group;
    group.Scale = scale;
    const std::vector<std::size_t> order = Shuffle(bodies.Matrices.size());
    group.Spheres = ListSpheres(bodies, order, box, scale, mesh);
    if (group.Spheres.empty() || !LayOutSquares(bodies, order, corners, group))
    {
      continue;
    }
    std::fill_n(balls.AreTriangles.begin() + static_cast<std::ptrdiff_t>(bodies.FirstTriangle),
      bodies.Triangles * bodies.Matrices.size(), true);
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
  std::vector<std::size_t> Counts; ///< at all levels

  void Upload(vtkOpenGLRenderWindow* window, const BallGroup& group);
  void Paint(const BallGroup& group, const PointColors& colors);
  void Draw(vtkOpenGLRenderWindow* window, const DisplayRows& ccdc, const glm::dvec4& eyeCC,
    std::size_t level);
  void Release(vtkWindow* window);
};

BallPicture::BallPicture() = default;

BallPicture::~BallPicture() = default;

void BallPicture::Group::Upload(vtkOpenGLRenderWindow* window, const BallGroup& group)
{
  this->Scale = group.Scale;
  this->Side = group.Side;
  this->SquaresPerRow = group.SquaresPerRow;
  for (std::size_t level = 0; level == 0 || this->Counts[level - 1] > MinimumSpheres; ++level)
  {
    this->Counts.push_back(Balls::CountAtLevel(group, level));
  }
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
  this->Colors->SetContext(window);
  this->Colors->SetMinificationFilter(vtkTextureObject::Linear);
  this->Colors->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Colors->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Colors->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Squares.Program = window->GetShaderCache()->ReadyShaderProgram(cslfBallVS, cslfBallFS, "");
  this->Squares.VAO->Bind();
  this->Spheres->Bind();
  this->Squares.VAO->AddAttributeArray(
    this->Squares.Program, this->Spheres, "sphere", 0, 4 * sizeof(float), VTK_FLOAT, 4, false);
  this->Squares.VAO->Release();
}

void BallPicture::Group::Paint(const BallGroup& group, const PointColors& colors)
{
  const auto side = static_cast<unsigned int>(group.Side + 2);
  std::vector<std::uint32_t> image = PaintSquares(group, colors);
  this->Colors->Create2DFromRaw(static_cast<unsigned int>(group.SquaresPerRow) * side,
    static_cast<unsigned int>(group.Rows) * side, 4, VTK_UNSIGNED_CHAR, image.data());
}

void BallPicture::Group::Draw(vtkOpenGLRenderWindow* window, const DisplayRows& ccdc,
  const glm::dvec4& eyeCC, std::size_t level)
{
  const std::size_t count = this->Counts[std::min(level, this->Counts.size() - 1)];
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
  program->SetUniformf("Growth",
    static_cast<float>(
      std::sqrt(static_cast<double>(this->Counts.front()) / static_cast<double>(count))));
  program->SetUniformi("Side", this->Side);
  program->SetUniformi("SquaresPerRow", this->SquaresPerRow);
  this->Colors->Activate();
  program->SetUniformi("Colors", this->Colors->GetTextureUnit());
  this->Squares.VAO->Bind();
  this->Squares.IBO->Bind();
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * count), GL_UNSIGNED_INT, nullptr);
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

void BallPicture::Paint(const Balls& balls, const PointColors& colors)
{
  for (std::size_t i = 0; i < this->Groups.size(); ++i)
  {
    this->Groups[i]->Paint(balls.Groups[i], colors);
  }
}

void BallPicture::Draw(vtkOpenGLRenderWindow* window, const DisplayRows& ccdc,
  const glm::dvec4& eyeCC, std::size_t level)
{
  // Squares reach farther than their balls.
  const bool clampsDepth = glIsEnabled(GL_DEPTH_CLAMP) == GL_TRUE;
  glEnable(GL_DEPTH_CLAMP);
  for (const auto& group : this->Groups)
  {
    group->Draw(window, ccdc, eyeCC, level);
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
