// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A medium on a grid of scalars, such as a volume that a vtkVolume shows.
 */
#ifndef cslfVolume_h
#define cslfVolume_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Rays/cslfRayPacket.h"
#include "SIMD/cslfLanes.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cslf
{
struct SceneFrame;

/// What a volume is made of. In grid space, the nodes of an even grid have whole coordinates; those
/// of another grid have the coordinates of its axes.
struct VolumeData
{
  const float* Values = nullptr;        ///< x varies fastest; where it is NaN, there is nothing
  std::vector<float> Converted;         ///< the values, unless they are those of Holder
  vtkSmartPointer<vtkDataArray> Holder; ///< keeps the values
  int Size[3] = { 0, 0, 0 };            ///< in nodes, at least 2 along each axis
  std::vector<float> Axes[3];           ///< increasing coordinates of nodes; empty if they are even
  glm::dvec3 Low{ 0.0 };                ///< the volume's box in grid space
  glm::dvec3 High{ 0.0 };
  glm::dmat4 ToData{ 1.0 };        ///< from grid space to the coordinates of the data set
  glm::dmat4 Placement{ 1.0 };     ///< and from there to the world
  std::vector<glm::dvec4> Planes;  ///< in the world; what is on their negative sides is cut away
  bool IsNearest = false;          ///< whether a point has the value of the nearest node
  bool IsLit = false;              ///< whether it scatters light; otherwise it emits its colours
  float Anisotropy = 0.0f;         ///< of Henyey and Greenstein's phase function, in (-1,1)
  float Range[2] = { 0.0f, 1.0f }; ///< the scalars of the first and last entry
  std::vector<glm::vec4> Table;    ///< displayed colours, and opacities over the unit distance
  double UnitDistance = 1.0;       ///< in the coordinates of the data set, as in VTK's mappers

  glm::dmat4 GetToWorld() const { return this->Placement * this->ToData; }
};

/// The parts of rays inside a volume's box, with their parameters from scene space.
struct VolumeSpans
{
  Lanes<float> Near;
  Lanes<float> Far;  ///< less than Near where a ray misses
  Vec3Lanes Origin;  ///< in grid space, at the ray's origin
  Vec3Lanes Step;    ///< in grid space, for a unit of the ray's length
  Lanes<float> Rate; ///< the length of that unit in the coordinates of the data set
};

/// What fills the points of a packet of rays. Volumes that overlap add up.
struct MediumLanes
{
  Lanes<float> Extinction; ///< for a unit of scene space
  Vec3Lanes Light;         ///< displayed colours, weighted by extinction

  void Clear()
  {
    std::fill_n(this->Extinction.Values, LaneCount, 0.0f);
    cslf::Clear(this->Light);
  }
};

class VTKCSLF_EXPORT Volume
{
public:
  /// The entries of the table, whose last one is for values that are not numbers.
  static constexpr int TableSize = 4096;

  Volume(VolumeData data, const SceneFrame& frame);

  const VolumeData& GetData() const { return this->Data; }
  bool IsLit() const { return this->Data.IsLit; }

  /// Whether there is nothing anywhere.
  bool IsEmpty() const { return this->Empty; }

  /// The longest step in scene space that follows the grid.
  float GetStep() const { return this->StepLength; }

  /// The part of a ray in which there may be anything. False if there is none before `far`.
  bool FindSpan(const Ray& ray, float far, float& near, float& end) const;

  /// The same for the lanes of a packet, ready for AddMedium.
  void FindSpans(const Vec3Lanes& origins, const Vec3Lanes& directions, const Lanes<float>& far,
    const LaneMask& active, VolumeSpans& spans) const;

  /// Adds what fills the points at some parameters of the rays, where these are in the spans.
  void AddMedium(const VolumeSpans& spans, const Lanes<float>& at, const LaneMask& active,
    MediumLanes& medium) const;

  /// A corner of the box that contains everything, in scene space.
  glm::dvec3 GetCorner(int corner) const;

  /// The length of a vector of scene space in the coordinates of the data set.
  float GetRate(const glm::vec3& direction) const
  {
    return glm::length(this->DataFromScene * direction);
  }

  /// The displayed colour of a point in scene space, and its extinction for a unit of length in the
  /// coordinates of the data set.
  float Get(const glm::vec3& point, glm::vec3& color) const;

  /// Calls `visit(begin, end, majorant)` for the parts of a ray between two of its parameters, with
  /// a bound of what Get returns in each, until it returns false.
  template <typename Visit>
  void ForEachPart(const Ray& ray, float near, float far, const Visit& visit) const;

private:
  friend struct VolumeKernel;

  glm::vec3 ToGrid(const glm::vec3& point) const;
  glm::dvec3 FindDistances(const glm::dmat4& matrix) const;
  void MakeTable();
  void MakeBricks();
  void FindBox();

  VolumeData Data;
  glm::mat4 FromScene{ 1.0f }; // to grid space
  glm::mat3 DataFromScene{ 1.0f };
  std::vector<glm::vec4> Planes;    // in scene space
  std::vector<glm::vec4> Table;     // colours and extinctions of the entries; one more for NaN
  float TableScale = 1.0f;          // entries for a unit of the scalar
  std::vector<float> Majorants;     // of the bricks
  int Bricks[3] = { 0, 0, 0 };      // their number along each axis
  std::vector<float> BrickEdges[3]; // in grid space, one more than bricks
  glm::vec3 Low{ 0.0f };            // the box of the bricks that contain anything
  glm::vec3 High{ 0.0f };
  float StepLength = 1.0f;
  bool Empty = true;
};

template <typename Visit>
void Volume::ForEachPart(const Ray& ray, float near, float far, const Visit& visit) const
{
  const glm::vec3 origin = this->ToGrid(ray.Origin);
  const glm::vec3 step = glm::mat3(this->FromScene) * ray.Direction;
  int brick[3];
  int direction[3];
  float next[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float>& edges = this->BrickEdges[axis];
    const float place = origin[axis] + near * step[axis];
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, place);
    brick[axis] = static_cast<int>(above - edges.begin()) - 1;
    direction[axis] = step[axis] > 0.0f ? 1 : step[axis] < 0.0f ? -1 : 0;
  }
  const auto findNext = [&](int axis)
  {
    const int edge = brick[axis] + (direction[axis] > 0 ? 1 : 0);
    next[axis] = direction[axis] == 0 || edge <= 0 || edge >= this->Bricks[axis]
      ? far
      : (this->BrickEdges[axis][edge] - origin[axis]) / step[axis];
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    findNext(axis);
  }
  for (float begin = near; begin < far;)
  {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const float end = std::min(std::max(next[axis], begin), far);
    const std::size_t index =
      (std::size_t(brick[2]) * this->Bricks[1] + brick[1]) * this->Bricks[0] + brick[0];
    if (end > begin && !visit(begin, end, this->Majorants[index]))
    {
      return;
    }
    if (!(next[axis] < far))
    {
      return;
    }
    begin = end;
    brick[axis] += direction[axis];
    findNext(axis);
  }
}
}

#endif
